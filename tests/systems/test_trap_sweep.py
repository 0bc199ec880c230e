"""How a branch sweeps and finds its guardian, against builds that cheat (T7 to T9), and the sweep test (A9)."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from formicarium.robots.records import Colour
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import SequencingParameters
from formicarium.systems.sequencing.setup import SequencingState, begin
from systems.stage import add_packet, chain, end_in_tail, events_of, guardian, put, step, wide_stage, written

SIDE = {3: 0.9, 4: 0.66}  # m, of the paper's hexagon and octagon, by tasks (TS-33)
ROBOTS = {3: 20, 4: 22}  # the paper's numbers for these arenas
PATIENCE = 20_000  # cycles, then a branch is stuck
STAND = 0.19  # m, a guardian stands so far inside the wall (TS-36)


def parameters(tasks: int, robots: int, side: float) -> SequencingParameters:
    """Return Mark I in a polygon with two sides a task."""
    arena = {"tasks": tasks, "sides": 2 * tasks, "side": side}
    tables = {"arena": arena, "behaviour": {"tasks": tasks}, "swarm": {"robots": robots}}
    return SequencingParameters.model_validate(tables)


# T7


def sweeping(links: int, seed: int) -> SequencingState:
    """Return a straight branch without walls whose last robot, a tail, begins to sweep at once.

    Nobody hears anything, so that nobody learns that a link of the branch takes itself for established.
    """
    state = wide_stage(links + 1, seed, epuck={"radio_loss": 1.0})
    chain(state, links, float(state.behaviour[0].spacing))
    end_in_tail(state, links)
    return state


def places(state) -> np.ndarray:
    """Return where everybody is, (N, 2) m."""
    return np.column_stack([state.world.bodies.x, state.world.bodies.y])


def moved(now: np.ndarray, then: np.ndarray) -> np.ndarray:
    """Return how far everybody is from where it was, m."""
    return np.hypot(*(now - then).T)


def bends(line: np.ndarray) -> np.ndarray:
    """Return by how much a line of places turns to the left at each of its inner places, degrees."""
    ways = np.unwrap(np.arctan2(*np.diff(line, axis=0).T[::-1]))
    return np.degrees(np.diff(ways))


@pytest.mark.parametrize("seed", range(1, 4))
def test_the_tip_moves_first_and_the_wave_travels_to_the_origin(seed):
    """T7: a rigid branch would move all at once and stay straight."""
    state = sweeping(7, seed)
    start, first = places(state), {}
    while 1 not in first and state.clock[0].cycle < PATIENCE:
        run(state, 1)
        for k in np.flatnonzero(moved(places(state), start) > 0.03):
            first.setdefault(int(k), int(state.clock[0].cycle))
    assert list(first) == [7, 6, 5, 4, 3, 2, 1]  # in the order in which they moved
    assert (np.diff(list(first.values())) >= 1).all()
    assert moved(places(state), start)[7] > 0.3
    assert bends(places(state)).sum() > 15.0  # and the branch is a bow to the left


def direction(state, i: int, pivot: int = 0) -> float:
    """Return where a robot stands, seen from another: degrees to the left of where the branch began."""
    to, at = state.world.bodies[i], state.world.bodies[pivot]
    return math.degrees(math.atan2(to.y - at.y, to.x - at.x))


def until_turned(state, pivot: int, angle: float) -> None:
    """Let the branch sweep until its tip, seen from a member of it, has turned to the left by so many degrees."""
    while state.clock[0].cycle < PATIENCE and direction(state, 7, pivot) < angle:
        run(state, 10)
    assert direction(state, 7, pivot) >= angle


@pytest.mark.parametrize("frozen", [2, 3, 4, 5])
def test_with_a_frozen_link_the_branch_bends_there_and_does_not_turn(frozen):
    """T7: a link that takes itself for established stays (TS-70); only what is beyond it can follow the tip."""
    held, free = sweeping(7, seed=1), sweeping(7, seed=1)
    start = places(held)
    while moved(places(held), start)[7] < 0.03:  # the sweep has begun
        run(held, 1)
    held.memories[frozen].established = 1
    until_turned(held, frozen, 60.0)
    path = moved(places(held), start)
    assert path[: frozen + 1] == pytest.approx(0.0, abs=0.005)
    assert bends(places(held))[frozen - 1] > 20.0
    assert path[frozen + 1 :].min() > 0.03 and (np.diff(path[frozen:]) > 0.0).all()
    until_turned(free, 0, 60.0)
    path = moved(places(free), start)
    assert path[1:].min() > 0.03 and (np.diff(path) > 0.0).all()  # without a frozen one all follow


# T8


def against_the_wall(seed: int) -> SequencingState:
    """Return a branch that runs from its guardian parallel to the wall into the next wall, tail last, in place."""
    state = begin(parameters(3, 4, SIDE[3]), seed)
    first_branch(state, 3, gap=0.165)
    state.memories[3].requested = 0
    return state


def first_branch(state, links: int, gap: float) -> None:
    """Make robot 0 the first guardian, before booth 0, and lay robots 1.. to its right, the last one the tail."""
    booth = state.booths[0]
    x, y = booth.x - (STAND + 0.06) * booth.cosine, booth.y - (STAND + 0.06) * booth.sine
    inward = math.atan2(-booth.sine, -booth.cosine)
    right = inward - 0.5 * math.pi
    chain(state, links, gap)
    end_in_tail(state, links)
    for k in range(links + 1):
        put(state, k, x + k * gap * math.cos(right), y + k * gap * math.sin(right), right if k else inward)
    state.memories[0].colour = booth.colour


def until_sweep(state, proximity: float | None, tail: int = 3) -> tuple[int, float]:
    """Return when the tail begins to sweep and what it feels of the wall on the way; ``proximity`` replaces that."""
    felt = []

    def touch(state):
        felt.append(state.readings[tail].proximity.max())
        if proximity is not None:
            state.readings[tail].proximity[:] = proximity

    while state.memories[tail].state != State.SWEEP and len(felt) < 1500:
        step(state, 1, touch)
    return len(felt), float(np.mean(felt))


@pytest.mark.parametrize("seed", [1, 2])
def test_when_a_branch_sweeps_has_nothing_to_do_with_the_wall_it_feels(seed):
    """T8, TS-85: with the wall as it is, without proximity sensors, boxed in, and without a wall."""
    as_it_is, felt = until_sweep(against_the_wall(seed), None)
    assert felt > 0.3  # the wall is there to be felt
    assert 0 < as_it_is < 1500
    assert until_sweep(against_the_wall(seed), 0.0)[0] == as_it_is
    assert until_sweep(against_the_wall(seed), 1.0)[0] == as_it_is
    open_country = wide_stage(4, seed)
    chain(open_country, 3, 0.165)
    end_in_tail(open_country, 3)
    open_country.memories[3].requested = 0
    when, felt = until_sweep(open_country, None)
    assert felt < 0.1 and when == as_it_is


def requests(period: int, tail: int = 3) -> Callable[[SequencingState], None]:
    """Return an edit: every so many cycles the tail hears a request of a robot that never takes up the offer."""
    payload = written(identity=250, request=1)

    def ask(state):
        if state.clock[0].cycle % period == 0:
            add_packet(state.readings[tail], payload, 0.2, float(state.memories[tail].sector))

    return ask


@pytest.mark.parametrize("already", [False, True])
@pytest.mark.parametrize("share", [0.0, 0.5])
def test_while_robots_try_to_join_in_vain_no_sweep_begins(share, already):
    """T8, TS-85: asked in every cycle or now and then, before the first sweep and between two; then it sweeps."""
    state = against_the_wall(seed=1)
    idle = int(state.behaviour[0].sweep_idle)
    if already:
        state.memories[3].requested = -idle
        for _ in range(10 * idle):
            swept = state.memories[3].state == State.SWEEP
            step(state)
            if swept and state.memories[3].state == State.OPEN:
                break
        assert swept and state.memories[3].state == State.OPEN
    states = set()
    ask = requests(max(1, int(share * idle)))
    step(state, 1, requests(1))
    step(state, 5 * idle, ask, lambda state: states.add(int(state.memories[3].state)))
    assert states == {State.OPEN, State.OFFER} and state.memories[3].chosen == 250
    patience = int(state.behaviour[0].offer_patience)
    step(state, idle + 2 * patience, None, lambda state: states.add(int(state.memories[3].state)))
    assert State.SWEEP in states


# T9 and A9, without walls


def towards_neighbour(tasks: int, links: int, seed: int) -> SequencingState:
    """Return a branch at -90 degrees to its guardian's heading, and the right-hand neighbour where a polygon has it.

    Guardians stand 2 R sin(pi / m) apart, with R the apothem less 0.19 m; the neighbour is pi / m to the left of
    the branch (TS-39). Robot 0 is the origin, then come the members, tail last, the neighbour, and a spare robot
    that is switched off.
    """
    state = begin(parameters(tasks, links + 3, 4.0), seed)
    chain(state, links, float(state.behaviour[0].spacing))
    end_in_tail(state, links)
    left = math.pi / tasks
    between = 2.0 * (0.5 * SIDE[tasks] / math.tan(0.5 * left) - STAND) * math.sin(left)
    put(state, links + 1, between * math.cos(left), between * math.sin(left), left + math.pi)
    guardian(state, links + 1, Colour.GREEN, False)
    put(state, links + 2, -3.0, -3.0)
    state.robots[links + 2].alive = 0
    return state


@pytest.mark.parametrize(("tasks", "links"), [(3, 5), (4, 4)])
@pytest.mark.parametrize("seed", [1, 2])
def test_a_branch_oversteps_a_guardian_whose_light_is_off(tasks, links, seed):
    """T9: it hears the dark guardian all the time, and docks at the lit one in the same scene."""
    for lit in (True, False):
        state = towards_neighbour(tasks, links, seed)
        tail, other = links, links + 1
        states, silence = set(), []
        while direction(state, tail) < direction(state, other) + 20.0 and state.clock[0].cycle < PATIENCE:
            if not lit:
                state.commands[other].colour = Colour.OFF  # before anybody looks
            run(state, 1)
            states.add(int(state.memories[tail].state))
            silence.append(int(state.clock[0].cycle - state.memories[tail].adverts[Colour.GREEN].heard))
            if State.DOCK in states:
                break
        assert (State.DOCK in states) == lit
        if lit:
            assert state.memories[tail].chosen == state.robots[other].identity
        else:
            assert direction(state, tail) > direction(state, other) + 15.0
            assert state.memories[tail].chosen == 0 and state.memories[other].established == 0
            assert np.median(silence[-500:]) < 10  # cycles since it was heard last


@pytest.mark.parametrize(("tasks", "links"), [(3, 5), (3, 6), (4, 4), (4, 5)])
@pytest.mark.parametrize("seed", [1, 2])
def test_from_ninety_degrees_a_branch_sweeps_to_its_right_hand_neighbour_and_one_recruit_closes_it(tasks, links, seed):
    """A9, TS-84: anticlockwise by 60 or 45 degrees, less what the camera sees ahead."""
    state = towards_neighbour(tasks, links, seed)
    tail, other, spare = links, links + 1, links + 2
    path = []
    while state.memories[tail].state != State.DOCK and state.clock[0].cycle < PATIENCE:
        run(state, 1)
        path.append(direction(state, tail))
    assert state.memories[tail].state == State.DOCK
    assert state.memories[tail].chosen == state.robots[other].identity
    assert np.diff(path).min() > -0.5 and min(path) > -1.0  # never clockwise
    assert 180.0 / tasks - 30.0 < path[-1] < 180.0 / tasks + 1.0
    bodies = state.world.bodies
    way = math.atan2(bodies[other].y - bodies[tail].y, bodies[other].x - bodies[tail].x)
    put(state, spare, bodies[tail].x + 0.19 * math.cos(way), bodies[tail].y + 0.19 * math.sin(way), way + math.pi / 2)
    state.robots[spare].alive, state.memories[spare].state = 1, State.FOLLOW
    run(state, 1200)
    branch = [*range(1, links + 1), spare]
    assert (state.memories.role[branch] == Role.LINK).all() and state.memories.established[branch].all()
    assert (state.memories[other].in_chain, state.memories[other].branch) == (1, 2)
    assert state.memories.link_number[branch].tolist() == list(range(1, links + 2))


# A9, in the arena


def begun_chain(tasks: int, seed: int) -> SequencingState:
    """Return a trial with guardians before all booths, a branch of two at -90 degrees, and runners in the middle."""
    robots = ROBOTS[tasks]
    state = begin(parameters(tasks, robots, SIDE[tasks]), seed)
    first_branch(state, 2, float(state.behaviour[0].spacing))
    for k in range(1, tasks):
        booth = state.booths[k]
        x, y = booth.x - (STAND + 0.06) * booth.cosine, booth.y - (STAND + 0.06) * booth.sine
        put(state, 2 + k, x, y, math.atan2(-booth.sine, -booth.cosine))
        guardian(state, 2 + k, int(booth.colour), False)
    rows = math.ceil((robots - tasks - 2) / 4)
    for j, i in enumerate(range(tasks + 2, robots)):
        put(state, i, 0.11 * (j % 4 - 1.5), 0.11 * (j // 4 - 0.5 * (rows - 1)), 2.4 * j)
    return state


def reached_booth(tasks: int, seed: int) -> int | None:
    """Return which booth's guardian the first branch reaches within ten minutes, None if none."""
    state = begun_chain(tasks, seed)
    for _ in range(600):
        run(state, 10)
        if len(events_of(state, EventKind.BRANCH)):
            return next(k for k in range(1, tasks) if state.memories[2 + k].established == 1)
    return None


@pytest.mark.parametrize("tasks", [3, 4])
def test_with_recruits_a_branch_along_the_wall_reaches_the_right_hand_neighbour(tasks):
    """A9. Booths are numbered counter-clockwise: 1 is on the right of 0. Some branches miss it, as printed (TS-88)."""
    booths = [reached_booth(tasks, seed) for seed in range(20)]
    assert booths.count(1) >= 11


@pytest.mark.long
@pytest.mark.parametrize("tasks", [3, 4])
def test_with_recruits_most_of_a_hundred_branches_reach_the_right_hand_neighbour(tasks):
    """A9: and one that misses it seldom reaches another instead."""
    booths = [reached_booth(tasks, seed) for seed in range(5000, 5100)]
    print({booth: booths.count(booth) for booth in (1, 2, 3, None)})
    assert booths.count(1) >= 70
    assert booths.count(1) > 3 * sum(booth not in (1, None) for booth in booths)
