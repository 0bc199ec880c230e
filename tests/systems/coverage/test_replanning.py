"""New plans of what is left (ST-72): made of what has come to the master, and of nothing else."""

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.contracts.states import copy_of, differences
from formicarium.scheduling.checker import check
from formicarium.scheduling.instance import Instance, Task, Team
from formicarium.scheduling.schedule import Arm, Schedule, Slot
from formicarium.systems.coverage.measures import EventKind
from formicarium.systems.coverage.memory import Mode, Planning
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.replanning import advance, plan_anew
from systems.coverage.swarm import line, stay, swarm
from systems.coverage.test_mission import FLOWN, PLANNED, SLOTS, mission

AGAIN = {"slots": SLOTS, "replans": 3}
LONE = ({"x": 0.0, "y": 0.0, "tasks": ({"name": "end", "x": 6.0, "y": 0.0, "duration": 60.0, "robots": 3},)},)


def planning(**groups):
    return mission(**{"behaviour": FLOWN, "mission": AGAIN, **groups})


def fly(state, until=9000):
    """Advance to the end; return the kinds of events with their subjects."""
    told = []
    while not state.clock[0].finished and state.clock[0].cycle < until:
        advance(state, 100)
        told += state.events[: state.clock[0].event_count].tolist()
        state.clock[0].event_count = 0
    return told


def test_a_new_plan_is_one_that_the_checker_accepts_for_what_is_left():
    """Done tasks are left out, the others last as long as they still want, places and order are those of the map."""
    slots = (
        *SLOTS,
        {"x": 0.0, "y": 0.0, "tasks": ({"name": "mast", "x": 5.0, "y": 0.0, "robots": 5, "after": ("gate",)},)},
    )
    state = planning(mission={"slots": slots, "replans": 1})
    memory, chart = state.memories[0], state.charts[0]
    memory.credited, memory.crew, memory.way_ahead, memory.way_aside = 0b0001, 6, 1.5, -2.5
    memory.worked[1] = 12
    plan_anew(memory, chart)
    assert memory.planning == Planning.ANSWERED and memory.plans == 1
    names = {2: ("gate", -1.0, 2.5, 1.8), 3: ("roof", -3.0, -3.0, 4.0), 4: ("mast", 5.0, 0.0, 20.0)}
    left = Instance(
        "left", (Team(6),), tuple(Task(n, x, y, 1, d) for n, x, y, d in names.values()), (-3.0, -3.0, 5.0, 2.5),
        (1.5, -2.5), (("gate", "mast"),), spacing=1.0,
    )  # fmt: skip
    found = []
    for slot in memory.slots[: int(memory.slot_count)]:
        arms = [Arm(names[int(slot.task[k])][0], int(slot.wanted[k]) - 1) for k in range(int(slot.task_count))]
        longest = max(names[int(slot.task[k])][3] for k in range(int(slot.task_count)))
        assert slot.hold_cycles == round(10 * longest) and slot.hold_limit == 1000 + slot.hold_cycles
        for k in range(int(slot.task_count)):
            assert (slot.task_ahead[k], slot.task_aside[k]) == names[int(slot.task[k])][1:3]
        found.append(Slot(float(slot.point_ahead), float(slot.point_aside), longest, tuple(arms)))
    assert not check(left, Schedule(tuple(found)), "inscribed").faults
    assert state.charts[0].slot_count == 3


def test_nothing_but_memory_and_chart_makes_a_plan():
    """Tasks are moved, others die, bodies stand elsewhere: the master that has not heard of it plans the same."""
    one = planning()
    other = copy_of(one)
    other.beacons.x += 50.0
    other.tasks.worked[:] = 10**6
    other.robots.alive[3:] = 0
    other.world.bodies.x += 3.0
    for state in (one, other):
        plan_anew(state.memories[0], state.charts[0])
    assert one.memories.tobytes() == other.memories.tobytes()
    assert (one.memories.slot_count[1:] == 0).all()


def test_a_task_without_word_is_planned_again_and_one_with_word_is_not():
    """The beacon of the gate is away for the first slot: of its two tasks only the gate is in the new plan."""
    state = planning(tasks={**PLANNED, "erupt_limit": 20.0})
    state.beacons.x[1] += 100.0
    while state.memories[0].plans == 0 and state.clock[0].cycle < 5000:
        advance(state, 1)
    state.beacons.x[1] -= 100.0
    memory = state.memories[0]
    planned = [int(t) for slot in memory.slots[: int(memory.slot_count)] for t in slot.task[: int(slot.task_count)]]
    assert sorted(planned) == [2, 3] and memory.credited == 0b001
    told = fly(state)
    assert state.clock[0].finished == 1 and (state.tasks.worked >= state.tasks.needed).all()
    assert EventKind.FOLLOWED not in [event[2] for event in told]


def test_a_mission_without_losses_is_never_planned_anew():
    state = planning()
    fly(state)
    assert state.clock[0].finished == 1 and state.memories[0].plans == 0 and state.memories[0].credited == 0b111


def test_it_ends_after_as_many_plans_as_are_allowed():
    state = planning(mission={"slots": SLOTS, "replans": 2}, tasks={**PLANNED, "erupt_limit": 10.0})
    state.beacons.x += 100.0
    fly(state)
    assert state.clock[0].finished == 1 and state.memories[0].plans == 2 and state.survey[0].planned == 2


def test_what_the_master_counts_is_what_the_referee_counts():
    """In a chain, as often as word comes; and no more once nobody is at the task."""
    state = swarm(line(4), setting=0, tasks=PLANNED, mission={"slots": LONE, "replans": 1}, behaviour=FLOWN)
    state.memories.epoch, state.memories.mode = 2, Mode.ERUPT
    for cycles in (20, 100, 57):
        stay(state, cycles)
        assert 0 <= state.tasks[0].worked - state.memories[0].worked[0] <= 3
    counted = int(state.memories[0].worked[0])
    state.beacons.x += 100.0
    stay(state, 100)
    assert state.memories[0].worked[0] - counted <= 3 and state.tasks[0].worked >= state.memories[0].worked[0]


def test_in_slices_or_in_one_piece_it_is_the_same():
    one = planning(tasks={**PLANNED, "erupt_limit": 20.0})
    one.beacons.x[1] += 100.0
    other = copy_of(one)
    for cycles in (1, 7, 300, 999):
        while one.clock[0].cycle < 2600 and not one.clock[0].finished:
            advance(one, min(cycles, int(2600 - one.clock[0].cycle)))
            one.clock[0].event_count = 0
            if cycles != 999:
                break
    while other.clock[0].cycle < 2600 and not other.clock[0].finished:
        advance(other, min(100, int(2600 - other.clock[0].cycle)))
        other.clock[0].event_count = 0
    assert one.memories[0].plans > 0
    found = [name for name in differences(one, other) if not name.startswith((".events", ".clock"))]
    assert found == []


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"region": (0.0, 1.0)}, r"mission.region = \[0.0, 1.0\]: must be four lengths"),
        (
            {"slots": ({"tasks": ({"name": "a", "x": 1.0, "after": ("b",), "robots": 1},)},)},
            "task 'a' is after 'b', but there is no such task",
        ),
        (
            {"slots": tuple({"tasks": tuple({"x": 1.0 * k} for k in range(6))} for _ in range(11)), "replans": 1},
            "66 tasks, a swarm tells 63 apart",
        ),
    ],
)
def test_what_cannot_be_planned_anew_is_refused_by_name(change, said):
    with pytest.raises(ValidationError, match=said):
        coverage_parameters(0, 21, tasks={"programme": "mission"}, mission={"slots": SLOTS, **change})


def test_default_missions_ask_for_no_plan():
    state = mission(behaviour=FLOWN)
    assert (state.charts.task_count == 0).all() and np.asarray(state.survey["asked"]).sum() == 0
