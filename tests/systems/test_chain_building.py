"""The chain forms from what robots sense: in any convex arena, and not at the same places twice (T5)."""

import math

import numpy as np
import pytest

from formicarium.devices.booth import HALF
from formicarium.systems.sequencing.arena import build_arena
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.simulate import drain

HEXAGON = np.array([(0.9 * math.cos(k * math.pi / 3), 0.9 * math.sin(k * math.pi / 3)) for k in range(6)])
IRREGULAR = np.array([(-0.8, -0.75), (0.55, -0.85), (1.0, 0.05), (0.45, 0.85), (-0.75, 0.6)])
TURN = np.array([(math.cos(0.7), math.sin(0.7)), (-math.sin(0.7), math.cos(0.7))])
ARENAS = {
    "turned": (HEXAGON @ TURN, [(0, 0.5), (2, 0.5), (4, 0.5)]),
    "unequal spacing": (HEXAGON, [(0, 0.3), (2, 0.65), (4, 0.4)]),
    "irregular": (IRREGULAR, [(0, 0.4), (2, 0.5), (4, 0.6)]),
}


def branch_is_built(arena, seed: int, seconds: int = 1500) -> bool:
    p = mark_i3_parameters()
    shape = None if arena is None else build_arena(*arena, 0.0, p.arena.wall_friction, p.booth.friction)
    state = begin(p, seed, arena=shape)
    for _ in range(seconds // 10):
        run(state, 100)
        if (drain(state)["kind"] == EventKind.BRANCH).any():
            return True
    return False


@pytest.mark.parametrize("name", ARENAS)
def test_a_branch_is_built_in_arenas_nobody_has_told_the_robots_about(name):
    assert any(branch_is_built(ARENAS[name], seed) for seed in range(5))


@pytest.mark.long
@pytest.mark.parametrize("name", ARENAS)
def test_a_branch_is_built_in_most_of_twenty_trials(name):
    assert sum(branch_is_built(ARENAS[name], seed) for seed in range(100, 120)) >= 12


def test_where_the_first_task_is_never_right_no_chain_begins():
    """T2: a guardian knows what feedback tells it and nothing else. The same trial with feedback builds its branch."""
    built = []
    for never in (True, False):
        state = begin(mark_i3_parameters(), 0)
        if never:
            state.coordinator[0].always_negative = state.coordinator[0].order[0]
        logs = []
        for _ in range(8):
            run(state, 1000)
            logs.append(drain(state))
        events = np.concatenate(logs)
        done = events[events["kind"] == EventKind.EXECUTED]
        if never:
            assert len(done) >= 3 and not (done["value"] == 1).any()
        roles = events[events["kind"] == EventKind.ROLE]["value"]
        built.append(bool(np.isin(roles, (Role.TAIL, Role.LINK)).any()))
    assert built == [False, True]


def first_branch(seed: int) -> dict[int, tuple[float, float]] | None:
    """Return where the links of branch 1 stand when it is established, as its origin guardian's booth sees them."""
    state = begin(mark_i3_parameters(), seed)
    for _ in range(150):
        run(state, 100)
        if (drain(state)["kind"] == EventKind.BRANCH).any():
            break
    else:
        return None
    m = state.memories
    first = next(i for i in range(len(m)) if m[i].role == Role.GUARDIAN and m[i].branch == 1)
    booth = next(booth for booth in state.booths if booth.colour == m[first].colour)
    places = {}
    for i in range(len(m)):
        if m[i].role == Role.LINK and m[i].branch == 1:
            dx, dy = state.world.bodies[i].x - booth.x, state.world.bodies[i].y - booth.y
            out = -booth.cosine * dx - booth.sine * dy
            right = -booth.sine * dx + booth.cosine * dy
            places[int(m[i].link_number)] = (float(out), float(right))
    return places


@pytest.fixture(scope="module")
def branches():
    return [branch for branch in (first_branch(seed) for seed in range(20, 32)) if branch]


def test_links_stand_elsewhere_in_every_trial(branches):
    """T5: sd over 1 cm, seen from the booth where the branch begins."""
    assert len(branches) >= 6
    for k in (2, 3, 4):
        spots = np.array([branch[k] for branch in branches if k in branch])
        assert len(spots) >= 5
        assert spots.std(axis=0).max() > 0.01


def test_a_branch_starts_on_the_right_of_its_guardian():
    """TS-49: the first tail stands within the invited sector, task at the guardian's back."""
    bearings = []
    for seed in range(20, 32):
        state = begin(mark_i3_parameters(), seed)
        while state.clock[0].cycle < 3000 and not (state.memories.role == Role.TAIL).any():
            run(state, 1)
        roles, bodies = state.memories.role, state.world.bodies
        if (roles == Role.TAIL).any():
            first, origin = int(np.argmax(roles == Role.TAIL)), int(np.argmax(state.memories.tail == 1))
            dx, dy = bodies[first].x - bodies[origin].x, bodies[first].y - bodies[origin].y
            bearings.append(math.remainder(math.atan2(dy, dx) - bodies[origin].heading, math.tau))
    assert len(bearings) >= 6
    p = mark_i3_parameters()
    reach = p.behaviour.sector_half_width + math.radians(15)  # half an emitter
    assert np.abs(np.array(bearings) + math.pi / 2).max() < reach + math.radians(35)  # guardians may be turned
    assert np.median(bearings) == pytest.approx(-math.pi / 2, abs=reach)


def test_without_runners_no_chain_begins():
    """T5: a lone robot becomes guardian of what it meets; the first task's guardian invites for ever."""
    conditions = set()
    for seed in range(12):
        state = begin(mark_i3_parameters(robots=1), seed)
        run(state, 6000)
        m = state.memories[0]
        if m.role == Role.GUARDIAN:
            conditions.add((int(m.condition), int(m.confident)))
            assert m.in_chain == 0 and m.tail == m.confident
    assert conditions == {(0, 1), (1, 0)}
    kinds = drain(state)["kind"]
    assert not np.isin(kinds, (EventKind.BRANCH, EventKind.CHAIN, EventKind.SEQUENCE)).any()


def test_guardians_stand_before_their_booths_with_the_task_at_their_back():
    """TS-45: driven out straight about 0.25 m; so 0.19 m inside the wall line (TS-36)."""
    outs = []
    for seed in range(6):
        state = begin(mark_i3_parameters(), seed)
        run(state, 800)
        for i, memory in enumerate(state.memories):
            if memory.role != Role.GUARDIAN:
                continue
            booth = next(booth for booth in state.booths if booth.colour == memory.colour)
            body = state.world.bodies[i]
            dx, dy = body.x - booth.x, body.y - booth.y
            outs.append(-booth.cosine * dx - booth.sine * dy)
            assert abs(-booth.sine * dx + booth.cosine * dy) < 0.12
            assert math.cos(body.heading) * booth.cosine + math.sin(body.heading) * booth.sine < -0.5
    assert len(outs) >= 10
    assert np.median(outs) == pytest.approx(mark_i3_parameters().behaviour.exit_distance, abs=0.03)
    assert min(outs) > HALF
