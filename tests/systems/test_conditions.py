"""How a guardian learns its place in the order and a runner obeys it: sections 6 and 6.1, tables and traces."""

from itertools import islice, permutations

import numpy as np
import pytest

from formicarium.devices.coordinator import COORDINATOR, judge
from formicarium.physics.records import records
from formicarium.robots.infrared import SUCCESS
from formicarium.robots.records import ROBOT, Colour
from formicarium.systems.sequencing.booth_visit import take_verdict
from formicarium.systems.sequencing.guardian import become_guardian, qualifies, update_condition
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import BehaviourTable
from formicarium.systems.sequencing.setup import make_memories
from systems.one_robot import OneRobot
from systems.stage import written

# Section 6.1: (CND, CONF) -> performs (x) or skips (.) for CNT = 0, 1, 2, 3.
DECISIONS = {
    (0, 1): "x...",
    (1, 1): ".x..",
    (2, 1): "..x.",
    (3, 1): "...x",
    (1, 0): ".xxx",
    (2, 0): "..xx",
    (3, 0): "...x",
}
DECIDED = [(cnd, conf, cnt, row[cnt] == "x") for (cnd, conf), row in DECISIONS.items() for cnt in range(4)]

# Section 6.1: m, before, FEED, CNT sent -> after.
UPDATES = [
    (3, (1, 0), 1, 2, (1, 1)),
    (3, (1, 0), 0, 1, (2, 0)),
    (3, (1, 0), 1, 3, (2, 1)),
    (4, (1, 0), 0, 2, (3, 0)),
    (4, (1, 0), 1, 4, (3, 1)),
    (3, (2, 0), 1, 3, (2, 1)),
    (4, (2, 0), 1, 3, (2, 1)),
    (4, (2, 0), 0, 2, (3, 0)),
    (4, (2, 0), 1, 4, (3, 1)),
    (4, (3, 0), 1, 4, (3, 1)),
]


@pytest.mark.parametrize(("cnd", "conf", "cnt", "performs"), DECIDED)
def test_a_runner_performs_exactly_when_the_guardian_directs_it(cnd, conf, cnt, performs):
    assert bool(qualifies(cnt, cnd, conf)) == performs


@pytest.mark.parametrize(("cnd", "conf", "cnt", "performs"), [row for row in DECIDED if row[0] < 3 and row[2] < 3])
def test_a_runner_at_a_guardian_sets_out_for_its_task_exactly_when_directed(cnd, conf, cnt, performs):
    """The same table, the message in four bytes, the guardian a cyan light, the booth a red one."""
    robot = OneRobot().turn_to(State.FOLLOW)
    robot.memory.count = cnt
    payload = written(identity=50, guardian=1, colour=Colour.RED, count=cnd, confident=conf, in_chain=1)
    for _ in range(8):
        robot.hear(payload, 0.2, 0.5).see((Colour.CYAN, 0.2, 0.5), (Colour.RED, 0.25, -0.8)).live()
    assert (robot.memory.state == State.APPROACH) == performs
    assert robot.memory.candidate == 0 and robot.memory.count == cnt
    assert robot.memory.role == Role.RUNNER


@pytest.mark.parametrize(("tasks", "before", "feed", "sent", "after"), UPDATES)
def test_a_guardian_learns_from_a_notification(tasks, before, feed, sent, after):
    robot = OneRobot(tasks=tasks).guard(Colour.GREEN, False)
    robot.memory.condition, robot.memory.confident = before
    for _ in range(3):  # notifications are repeated (TS-60)
        robot.hear(written(identity=9, count=sent, direction=feed), 0.2, 1.0).live()
        assert (robot.memory.condition, robot.memory.confident) == after
        robot.memory.restarts = 0


@pytest.mark.parametrize("condition", [0, 1, 2])
@pytest.mark.parametrize("feed", [0, 1])
@pytest.mark.parametrize("sent", [1, 2, 3])
def test_a_confident_guardian_ignores_notifications(condition, feed, sent):
    robot = OneRobot().guard(Colour.GREEN, True, condition + 1)
    robot.hear(written(identity=9, count=sent, direction=feed), 0.2, 1.0).live()
    assert (robot.memory.condition, robot.memory.confident) == (condition, 1)


@pytest.mark.parametrize(
    ("count", "success", "after"),
    [(0, True, (0, 1)), (0, False, (1, 0)), (1, True, (1, 1)), (1, False, (2, 0)), (2, True, (2, 1))],
)
def test_the_first_execution_gives_the_first_condition(count, success, after):
    """TS-53, TS-54: only the guardian of the first task starts the chain."""
    robot = OneRobot().guard(Colour.GREEN, success, count + 1)
    m = robot.memory
    assert (m.condition, m.confident) == after and m.role == Role.GUARDIAN
    assert m.tail == (after == (0, 1)) and m.in_chain == 0 and m.count == 0


def test_a_late_notification_does_not_lower_the_condition_unless_the_paper_is_taken_literally():
    """TS-60."""
    for monotone, after in ((True, 3), (False, 2)):
        table = BehaviourTable(tasks=4, cnd_monotone=monotone).record()[0]
        memory = OneRobot().guard(Colour.GREEN, False, 3).memory
        update_condition(memory, False, 1, table)
        assert (memory.condition, memory.confident) == (after, 0)


@pytest.mark.parametrize("tasks", [3, 4])
def test_a_condition_that_no_runner_can_meet_starts_again(tasks):
    """TS-61."""
    table = BehaviourTable(tasks=tasks).record()[0]
    memory = OneRobot().guard(Colour.GREEN, False, tasks - 1).memory
    update_condition(memory, False, tasks - 1, table)
    assert (memory.condition, memory.confident, memory.restarts) == (1, 0, 1)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_a_failed_runner_reports_its_old_count_and_forgets_it(count):
    """TS-59, T17: reset before the report, and the guardian would fall back to CND = 1 for ever."""
    robot = OneRobot()
    robot.memory.count, robot.memory.candidate = count, 0
    take_verdict(robot.memory, 0, False, robot.table)
    assert (robot.memory.reported, robot.memory.count, robot.memory.notifying) == (count, 0, 1)


@pytest.mark.parametrize(("tasks", "count", "after"), [(3, 0, 1), (3, 1, 2), (3, 2, 0), (4, 2, 3), (4, 3, 0)])
def test_a_successful_runner_reports_the_increased_count_and_starts_again_after_the_last(tasks, count, after):
    """TS-56, TS-103, TS-104: CNT = m is reported, then 0."""
    robot = OneRobot(tasks=tasks)
    robot.memory.count, robot.memory.candidate = count, 0
    take_verdict(robot.memory, 0, True, robot.table)
    assert (robot.memory.reported, robot.memory.count, robot.memory.notifying) == (count + 1, after, 1)


class Experiment:
    """Guardians in chain order, runners, and the experimenter's computer: the logic without any motion."""

    def __init__(self, places: tuple[int, ...]) -> None:
        self.tasks = len(places)
        self.table = BehaviourTable(tasks=self.tasks).record()[0]
        self.coordinator = records(COORDINATOR, 1)[0]
        self.coordinator.tasks = self.tasks
        for guardian, place in enumerate(places):
            self.coordinator.order[place - 1] = guardian + 1  # the colour of guardian k is k + 1
        self.guardians = self.memories(self.tasks)
        for k, memory in enumerate(self.guardians):
            success = judge(self.coordinator, 100 + k, 1, k + 1) == SUCCESS
            become_guardian(memory, 0, success, 1)
        self.runners = self.memories(4)

    @staticmethod
    def memories(count: int) -> np.recarray:
        robots = records(ROBOT, count)
        robots.identity = robots.key = np.arange(1, count + 1)
        return make_memories(robots, 1)

    def condition(self, k: int) -> tuple[int, int]:
        return int(self.guardians[k].condition), int(self.guardians[k].confident)

    def meet(self, runner: int, k: int) -> bool | None:
        """Let a runner meet a guardian: None if it skips, else whether its execution was a success."""
        memory, guardian = self.runners[runner], self.guardians[k]
        if not qualifies(memory.count, guardian.condition, guardian.confident):
            return None
        success = judge(self.coordinator, 1 + runner, memory.count + 1, k + 1) == SUCCESS
        take_verdict(memory, 0, success, self.table)
        update_condition(guardian, memory.verdict == 1, memory.reported, self.table)
        return success


def tour(tasks: int):
    """Pass the guardians of an open chain out and back, again and again."""
    while True:
        yield from range(tasks)
        yield from range(tasks - 2, 0, -1)


def first_sequence(places: tuple[int, ...]) -> tuple[int, int, str]:
    """Let one ideal runner tour until its first full sequence: (visits, failures, executions)."""
    experiment = Experiment(places)
    failures, done = 0, []
    for visits, k in enumerate(islice(tour(experiment.tasks), 200), 1):
        before = experiment.condition(k)
        success = experiment.meet(0, k)
        if success is None:
            continue
        failures += not success
        after = experiment.condition(k)
        changed = "" if after == before else f"({after[0]},{after[1]})"
        done.append(f"g{k}{'+' if success else '-'}{changed}")
        if success and experiment.runners[0].reported == experiment.tasks:
            return visits, failures, " ".join(done)
    raise AssertionError("no full sequence in 200 visits")


GOLDEN = {
    (1, 2, 3): (3, 0, "g0+ g1+(1,1) g2+(2,1)"),
    (1, 3, 2): (8, 1, "g0+ g1-(2,0) g0+ g2+(1,1) g1+(2,1)"),
    (1, 2, 3, 4): (4, 0, "g0+ g1+(1,1) g2+(2,1) g3+(3,1)"),
    (1, 2, 4, 3): (11, 1, "g0+ g1+(1,1) g2-(3,0) g0+ g1+ g3+(2,1) g2+(3,1)"),
    (1, 3, 2, 4): (22, 2, "g0+ g1-(2,0) g0+ g2+(1,1) g3-(3,0) g0+ g2+ g1+(2,1) g3+(3,1)"),
    (1, 3, 4, 2): (27, 3, "g0+ g1-(2,0) g0+ g2-(2,0) g0+ g3+(1,1) g2-(3,0) g0+ g3+ g1+(2,1) g2+(3,1)"),
    (1, 4, 2, 3): (12, 1, "g0+ g1-(2,0) g0+ g2+(1,1) g3+(2,1) g1+(3,1)"),
    (1, 4, 3, 2): (18, 2, "g0+ g1-(2,0) g0+ g2-(2,0) g0+ g3+(1,1) g2+(2,1) g1+(3,1)"),
}


@pytest.mark.parametrize("places", GOLDEN, ids=str)
def test_one_ideal_runner_finds_the_order_as_in_the_golden_vectors(places):
    """TS-63, all rows: visits, failures and the order of executions."""
    assert first_sequence(places) == GOLDEN[places]


def test_the_golden_vectors_are_all_orders_that_begin_at_the_first_guardian():
    assert set(GOLDEN) == {(1, *rest) for m in (3, 4) for rest in permutations(range(2, m + 1))}


@pytest.mark.parametrize("tasks", [3, 4])
def test_one_runner_needs_at_most_so_many_failures(tasks):
    """TS-8: (m-1)(m-2)/2, reached by some order."""
    failures = [first_sequence(places)[1] for places in GOLDEN if len(places) == tasks]
    assert max(failures) == (tasks - 1) * (tasks - 2) // 2


@pytest.mark.parametrize("tasks", [3, 4])
@pytest.mark.parametrize("seed", range(5))
def test_several_runners_in_any_order_of_meetings_find_the_order(tasks, seed):
    """With correct feedback CND never exceeds m - 1 and a confident guardian knows its true place (TS-57, TS-61)."""
    random = np.random.default_rng(seed)
    for places in (places for places in GOLDEN if len(places) == tasks):
        experiment = Experiment(places)
        for _ in range(2000):
            experiment.meet(int(random.integers(4)), int(random.integers(tasks)))
            for k, place in enumerate(places):
                condition, confident = experiment.condition(k)
                assert condition == place - 1 if confident else condition <= place - 1
        assert [experiment.condition(k) for k in range(tasks)] == [(place - 1, 1) for place in places]
        assert not any(guardian.restarts for guardian in experiment.guardians)


def test_the_trace_of_movie_s1():
    """Section 14.1, true order red, green, blue; chain red - blue - green. C3: the movie's "CNT = 1" is CND = 1."""
    experiment = Experiment((1, 3, 2))
    red, blue, green = range(3)
    first, second = 0, 1

    def counts():
        return int(experiment.runners[first].count), int(experiment.runners[second].count)

    assert [experiment.condition(k) for k in (red, blue, green)] == [(0, 1), (1, 0), (1, 0)]  # 0:20
    assert experiment.meet(first, red) is True and counts() == (1, 0)  # 2:02
    assert experiment.meet(second, red) is True and counts() == (1, 1)
    assert qualifies(1, *experiment.condition(blue))  # 2:56: (1,0), CNT 1, told to perform
    assert experiment.meet(first, blue) is False and counts() == (0, 1)  # 5:48
    assert experiment.condition(blue) == (2, 0)
    assert experiment.meet(second, blue) is None and counts() == (0, 1)  # skips
    assert experiment.meet(second, green) is True and counts() == (0, 2)  # 6:22
    assert experiment.condition(green) == (1, 1)
    assert experiment.condition(blue) == (2, 0)
    assert experiment.meet(second, blue) is True  # 8:10
    assert experiment.condition(blue) == (2, 1)
    assert experiment.runners[second].reported == 3 and counts() == (0, 0)
    assert experiment.meet(first, red) is True  # and again, now without failures
    assert [experiment.meet(first, k) for k in (blue, green, blue)] == [None, True, True]
