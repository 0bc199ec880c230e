"""Looking changes nothing; only what is done to a trial does, and that is done again in a replay."""

from typing import Any
from unittest import SkipTest

import numpy as np

from formicarium.contracts.broken import require
from formicarium.contracts.states import begun, length_of
from formicarium.systems.registry import System, resolve
from formicarium.trial.simulate import simulate
from formicarium.trial.watching import Impossible, Watching
from formicarium.views.live.checking import Checks
from formicarium.views.live.session import Session
from formicarium.views.live.snapshots import arrays_of
from formicarium.views.recording.digest import digest

ROBOTS = 12
CYCLES = 6000


def watched(name: str) -> tuple[System, Any, Watching]:
    """Return a system that can be watched, and parameters of few robots.

    Raises:
        SkipTest: if it cannot.
    """
    system = resolve(name)
    if system.watching is None:
        raise SkipTest(f"{name} is not watched")
    return system, system.configure(robots=ROBOTS), system.watching


def bytes_of(session: Session) -> list[bytes]:
    """Return all arrays of a session's state as bytes."""
    return [array.tobytes() for array in arrays_of(session.state)]


def watching_gives_the_same_bytes(name: str) -> None:
    """A trial that is looked at, sent back and forth, is the trial that nobody looks at."""
    system, parameters, watching = watched(name)
    alone = begun(system, parameters, 5)
    last = min(CYCLES, int(alone.clock[0].last_cycle))
    alone.clock[0].last_cycle = last
    events = simulate(system.advance, alone)  # type: ignore[arg-type]
    session = Session(system, parameters, 5)
    session.state.clock[0].last_cycle = session.last_cycle = last
    draws = np.random.default_rng(1)
    while not session.finished:
        session.advance(int(draws.integers(1, 700)))
        frame, packets = session.frame(), session.packets()
        require(
            frame.x.shape == (1, ROBOTS) and np.isfinite([frame.x, frame.y, frame.heading]).all(), "a frame is broken"
        )
        require(packets.max(initial=0) < ROBOTS and (packets[:, 0] != packets[:, 1]).all(), "packets name no robots")
        told = session.inspect(int(draws.choice(session.identity)))
        require(told is not None, "inspect knows nothing of a robot")
        sound = all(
            len(row) == len(section.columns)
            for section in told.sections  # type: ignore[union-attr]
            for row in section.rows
        )
        require(sound, "inspect: a row of a section has not as many cells as columns")
        if draws.uniform() < 0.2:
            here = session.cycle
            session.seek(int(draws.integers(0, session.frontier + 1)))
            session.seek(here)
    session.seek(session.frontier)
    require(session.events.tobytes() == events.tobytes(), "the watched trial has other events")
    require(digest(session.state) == digest(alone), "the watched trial has another state")
    require(dict(session.outcome()) == dict(watching.outcome(parameters, alone, events)), "it has another outcome")
    require(all(watching.tell(event) for event in session.events), "tell says nothing of an event")


def frames_show_the_state(name: str) -> None:
    """A frame shows what the state holds."""
    system, parameters, _ = watched(name)
    session = Session(system, parameters, 6)
    session.advance(CYCLES // 2)
    order, state, frame = np.argsort(session.state.robots.identity), session.state, session.frame()
    require(frame.cycle.tolist() == [session.cycle], "the frame is of another cycle")
    require(frame.identity.tolist() == sorted(state.robots.identity), "the frame has other robots")
    require(np.array_equal(frame.x[0], state.world.bodies.x[order].astype("f4")), "robots are drawn elsewhere")
    if system.roles is not None:
        require(
            np.array_equal(frame.role[0], system.roles(state)[order]), "roles in frames are not those of the system"
        )
    require(frame.lit.shape[1] == len(session.scene.devices), "lit has not one number a device of the scene")


def going_back_is_exact(name: str) -> None:
    """Going back gives the state that was."""
    system, parameters, _ = watched(name)
    session = Session(system, parameters, 7)
    known = {}
    while session.cycle < 4000 and not session.finished:
        session.advance(137)
        known[session.cycle] = digest(session.state)
    for cycle in np.random.default_rng(3).permutation(list(known)):
        session.seek(int(cycle))
        require(digest(session.state) == known[int(cycle)], f"the state of cycle {cycle} is another after going back")


def heard_from_whom_is_drawn(name: str) -> None:
    """What a robot hears comes from the robot from which the viewer draws it, and from nobody out of reach."""
    system, parameters, _ = watched(name)
    session = Session(system, parameters, 8)
    right = total = 0
    while session.cycle < 2000 and not session.finished:
        session.advance(20)
        packets, readings = session.packets(), session.state.readings
        count = 0
        if "packets" in (readings.dtype.names or ()):
            count = readings["packet_count"][session.state.robots["alive"] == 1].sum()
        require(len(packets) == count, f"{len(packets)} packets are drawn, {count} are heard")
        x, y = session.frame().x[0], session.frame().y[0]
        gap = np.hypot(x[packets[:, 0]] - x[packets[:, 1]], y[packets[:, 0]] - y[packets[:, 1]])
        reach = dict(session.scene.ranges).get("radio", np.inf)
        right, total = right + int((gap < reach + 0.05).sum()), total + len(gap)
    # who has just changed what it says may be taken for another
    require(right >= 0.999 * total, f"{total - right} of {total} packets are drawn from robots out of reach")


def deeds_are_done_again(name: str) -> None:
    """What was done by hand is done again in a replay, and makes another trial."""
    system, parameters, _ = watched(name)
    length = length_of(system, parameters, 9, CYCLES + 800)
    session = Session(system, parameters, 9)
    session.advance(min(500, length // 3))
    victim, moved = (int(robot) for robot in session.identity[:2])
    session.intervene("kill", victim)
    session.advance(min(300, length // 3))
    corners = np.concatenate([polygon.points for polygon in session.scene.polygons])
    for x, y in np.random.default_rng(4).uniform(corners.min(axis=0), corners.max(axis=0), (50, 2)):
        try:
            session.intervene("move", moved, float(x), float(y))
            break
        except Impossible:
            continue
    session.advance(CYCLES)
    require([deed.deed for deed in session.interventions] == ["kill", "move"], "no robot can be killed and moved")
    again = Session(system, parameters, 9, session.interventions)
    again.advance(session.cycle)
    same = bytes_of(again) == bytes_of(session) and again.events.tobytes() == session.events.tobytes()
    require(same, "the same deeds give another trial")
    again.seek(again.cycle // 5)
    again.seek(session.cycle)
    require(bytes_of(again) == bytes_of(session), "going back over deeds gives another state")
    untouched = Session(system, parameters, 9)
    untouched.advance(session.cycle)
    require(digest(untouched.state) != digest(session.state), "killing and moving robots changes nothing")


def the_dead_are_still(name: str) -> None:
    """The dead neither move nor speak."""
    system, parameters, _ = watched(name)
    session = Session(system, parameters, 10)
    session.advance(min(400, length_of(system, parameters, 10, 1000) // 3))
    session.intervene("kill", int(session.identity[3]))
    session.advance(1)
    i = int(np.nonzero(session.state.robots["identity"] == session.identity[3])[0][0])
    command = session.state.commands[i]
    said = [name for name in ("left", "right", "enabled") if name in command.dtype.names]
    require(session.state.robots["alive"][i] == 0, "a killed robot lives")
    require(not any(np.any(command[name]) for name in said), "a dead robot drives or speaks")
    steps = session.state.robots["left_path"][i]
    session.advance(600)
    require(abs(session.state.robots["left_path"][i] - steps) < 1e-3, "the wheels of a dead robot turn")


def deeds_that_cannot_be_done(name: str) -> None:
    """A robot is put where there is room and nowhere else; a deed that cannot be done changes nothing."""
    system, parameters, _ = watched(name)
    session = Session(system, parameters, 11)
    session.advance(min(50, length_of(system, parameters, 11, 200) // 3))
    before, bodies = bytes_of(session), session.state.world.bodies
    mover = int(session.state.robots["identity"][0])
    deeds = [("move", mover, 99.0, 0.0), ("move", mover, float(bodies.x[1]), float(bodies.y[1]))]
    deeds += [("kill", 999, 0.0, 0.0), ("block", 99, 0.0, 0.0), ("dance", mover, 0.0, 0.0)]
    for deed, subject, x, y in deeds:
        try:
            session.intervene(deed, subject, x, y)
        except Impossible:
            continue
        require(False, f"{deed} {subject} at ({x:.2f}, {y:.2f}) should be Impossible")
    require(bytes_of(session) == before and session.interventions == [], "a deed that cannot be done left a trace")


def a_changed_state_is_noticed(name: str) -> None:
    """A state that differs in the last bit has another digest."""
    system, parameters, _ = watched(name)
    cycle = min(1000, length_of(system, parameters, 12, 1000) - 1)
    session = Session(system, parameters, 12)
    session.advance(cycle)
    wanted = {cycle: digest(session.state)}
    good, bad = (Session(system, parameters, 12, checks=Checks(wanted)) for _ in range(2))
    good.advance(cycle)
    bad.advance(cycle - 1)
    bad.state.world.bodies.x[0] = np.nextafter(bad.state.world.bodies.x[0], 9.0) + 1e-12
    bad.advance(1)
    require(good.checks is not None and bad.checks is not None, "checks are gone")
    require(good.checks.differs is None and good.checks.agreed == cycle, "the same trial has another digest")  # type: ignore[union-attr]
    require(bad.checks.differs == cycle, "a changed state is not noticed")  # type: ignore[union-attr]
