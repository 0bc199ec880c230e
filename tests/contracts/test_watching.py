"""Looking changes nothing; only what is done to a trial does, and that is done again in a replay."""

import numpy as np
import pytest

from formicarium.trial.simulate import simulate
from formicarium.trial.watching import Impossible
from formicarium.views.live.checking import Checks
from formicarium.views.live.session import Session
from formicarium.views.live.snapshots import arrays_of
from formicarium.views.recording.digest import digest

ROBOTS = 12
CYCLES = 6000


@pytest.fixture
def parameters(system):
    if system.watching is None:
        pytest.skip(f"{system.name} is not watched")
    return system.configure(robots=ROBOTS)


def bytes_of(session):
    return [array.tobytes() for array in arrays_of(session.state)]


def test_a_watched_trial_gives_the_same_bytes(system, parameters):
    alone = system.begin(parameters, 5)
    alone.clock[0].last_cycle = CYCLES
    events = simulate(system.advance, alone)
    session = Session(system, parameters, 5)
    session.state.clock[0].last_cycle = session.last_cycle = CYCLES
    draws = np.random.default_rng(1)
    while not session.finished:
        session.advance(int(draws.integers(1, 700)))
        frame, packets = session.frame(), session.packets()
        assert frame.x.shape == (1, ROBOTS) and np.isfinite([frame.x, frame.y, frame.heading]).all()
        assert packets.max(initial=0) < ROBOTS and (packets[:, 0] != packets[:, 1]).all()
        told = session.inspect(int(draws.choice(session.identity)))
        assert all(len(row) == len(section.columns) for section in told.sections for row in section.rows)
        if draws.uniform() < 0.2:
            here = session.cycle
            session.seek(int(draws.integers(0, session.frontier + 1)))
            session.seek(here)
    session.seek(session.frontier)
    assert session.events.tobytes() == events.tobytes() and digest(session.state) == digest(alone)
    assert dict(session.outcome()) == dict(system.watching.outcome(parameters, alone, events))
    assert all(system.watching.tell(event) for event in session.events)


def test_a_frame_shows_what_the_state_holds(system, parameters):
    session = Session(system, parameters, 6)
    session.advance(3000)
    order, state, frame = np.argsort(session.state.robots.identity), session.state, session.frame()
    assert frame.cycle.tolist() == [3000] and frame.identity.tolist() == sorted(state.robots.identity)
    assert np.array_equal(frame.x[0], state.world.bodies.x[order].astype("f4"))
    assert np.array_equal(frame.role[0], system.roles(state)[order])
    assert frame.lit.shape[1] == sum(polygon.is_device for polygon in session.scene.polygons)


def test_going_back_gives_the_state_that_was(system, parameters):
    session = Session(system, parameters, 7)
    known = {}
    while session.cycle < 4000 and not session.finished:
        session.advance(137)
        known[session.cycle] = digest(session.state)
    for cycle in np.random.default_rng(3).permutation(list(known)):
        session.seek(int(cycle))
        assert session.cycle == cycle and digest(session.state) == known[cycle]


def test_what_a_robot_hears_came_from_whom_the_viewer_says(system, parameters):
    """Identities in the packets, where the system puts them first, are those of the senders that are drawn."""
    session = Session(system, parameters, 8)
    if "packets" not in session.state.readings.dtype.names:
        assert session.packets().shape == (0, 2)
        pytest.skip(f"robots of {system.name} have no radio")
    right = total = 0
    for _ in range(100):
        session.advance(20)
        packets = session.packets()
        count = session.state.readings["packet_count"][session.state.robots["alive"] == 1].sum()
        assert len(packets) == count
        x, y = session.frame().x[0], session.frame().y[0]
        gap = np.hypot(x[packets[:, 0]] - x[packets[:, 1]], y[packets[:, 0]] - y[packets[:, 1]])
        reach = dict(session.scene.ranges).get("radio", np.inf)
        right, total = right + int((gap < reach + 0.05).sum()), total + len(gap)
    assert total > 500 and right >= 0.999 * total  # who has just changed what it says may be taken for another


def test_what_was_done_by_hand_is_done_again(system, parameters):
    session = Session(system, parameters, 9)
    session.advance(500)
    victim, moved = (int(robot) for robot in session.identity[:2])
    session.intervene("kill", victim)
    session.advance(300)
    for x, y in np.random.default_rng(4).uniform(-0.5, 0.5, (50, 2)):
        try:
            session.intervene("move", moved, float(x), float(y))
            break
        except Impossible:
            continue
    session.advance(CYCLES)
    assert [deed.deed for deed in session.interventions] == ["kill", "move"]
    again = Session(system, parameters, 9, session.interventions)
    again.advance(session.cycle)
    assert bytes_of(again) == bytes_of(session) and again.events.tobytes() == session.events.tobytes()
    again.seek(1200)
    again.seek(session.cycle)
    assert bytes_of(again) == bytes_of(session)
    untouched = Session(system, parameters, 9)
    untouched.advance(session.cycle)
    assert digest(untouched.state) != digest(session.state)


def test_the_dead_neither_move_nor_speak(system, parameters):
    session = Session(system, parameters, 10)
    session.advance(400)
    session.intervene("kill", int(session.identity[3]))
    session.advance(1)
    i = int(np.nonzero(session.state.robots["identity"] == session.identity[3])[0][0])
    assert session.state.robots["alive"][i] == 0
    assert "enabled" not in session.state.commands.dtype.names or session.state.commands["enabled"][i].sum() == 0
    steps = session.state.robots["left_path"][i]
    session.advance(600)
    assert abs(session.state.robots["left_path"][i] - steps) < 1e-3


def test_a_robot_is_put_where_there_is_room_and_nowhere_else(system, parameters):
    session = Session(system, parameters, 11)
    session.advance(50)
    before, bodies = bytes_of(session), session.state.world.bodies
    mover = int(session.state.robots["identity"][0])
    for x, y, why in ((99.0, 0.0, "outside"), (bodies.x[1], bodies.y[1], "another robot"), (np.nan, 0.0, "")):
        if why:
            with pytest.raises(Impossible, match=why):
                session.intervene("move", mover, float(x), float(y))
    for deed, subject in (("kill", 999), ("block", 99), ("dance", mover)):
        with pytest.raises(Impossible):
            session.intervene(deed, subject)
    assert bytes_of(session) == before and session.interventions == []


def test_a_changed_state_is_noticed_by_its_digest(system, parameters):
    session = Session(system, parameters, 12)
    session.advance(1000)
    wanted = {1000: digest(session.state)}
    good, bad = (Session(system, parameters, 12, checks=Checks(wanted)) for _ in range(2))
    good.advance(1000)
    bad.advance(999)
    bad.state.world.bodies.x[0] += 1e-15
    bad.advance(1)
    assert good.checks.differs is None and good.checks.agreed == 1000 and bad.checks.differs == 1000
