"""What is measured of a trial: times, names of causes, spans; on event logs made by hand."""

from itertools import pairwise

import numpy as np
import pytest

from formicarium.systems.sequencing.measures import STALLED, EventKind, cause, outcome
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.parameters import mark_i3_parameters, mark_ii3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.systems.sequencing.study import MARK_I3, MARK_II3, ROLES, timeline
from formicarium.trial.record import EVENT, Scene, Trial

CYCLE = 0.1


def log(*events) -> np.ndarray:
    """Return a log of (seconds, kind, robot, subject, value, detail); what is missing is 0."""
    rows = [(round(seconds / CYCLE), *rest, *[0] * (5 - len(rest))) for seconds, *rest in events]
    return np.array(rows, EVENT)


def sequences(*seconds):
    return [(t, EventKind.SEQUENCE, 1, 0, n, 0) for n, t in enumerate(seconds, 1)]


def moved(seconds, role):
    return (seconds, EventKind.DISPLACED, 5, 1, role)


ROW = {
    "members": 15,
    "died": 0,
    "guardians": 3,
    "time_chain_s": 300.0,
    "branches": 2,
    "duration_s": 2400.0,
}


@pytest.mark.parametrize(
    ("fields", "events", "name"),
    [
        ({"guardians": 2, "time_chain_s": None, "branches": 0}, [], "a task found no guardian"),
        ({"guardians": 4}, [], "two guardians for one task"),
        ({"members": 20, "time_chain_s": None, "branches": 1}, [], "all robots in an unfinished chain"),
        ({"members": 18, "died": 2, "time_chain_s": None, "branches": 1}, [], "all robots in an unfinished chain"),
        ({"time_chain_s": None, "branches": 0}, [], "branch 1 missed its guardian"),
        ({"time_chain_s": None, "branches": 1}, [], "branch 2 missed its guardian"),
        ({"members": 20}, [], "all robots in the finished chain"),
        ({}, sequences(500.0, 2400.0 - STALLED + 1), "too slow"),
        ({"duration_s": 300.0 + STALLED - 1}, [], "too slow"),
        ({}, [*sequences(500.0), moved(600.0, Role.GUARDIAN), moved(700.0, Role.LINK)], "guardian displaced"),
        ({}, [*sequences(500.0), moved(600.0, Role.LINK)], "link displaced"),
        ({}, sequences(500.0, 2400.0 - STALLED - 1), "runners stuck"),
        ({}, [], "runners stuck"),
    ],
)
def test_a_failed_trial_has_a_named_cause(fields, events, name):
    assert cause(ROW | fields, log(*events), 20, 3, CYCLE) == name


LOOP = ROW | {
    **{"time_elected_s": 310.0, "time_solved_s": 900.0, "upi_found": 2, "upi_correct": 2, "steps_behind": 0},
    **{"runners": 5, "runners_inside": 1, "branches": 3, "tails": 0, "members": 20},
}
OPEN = {"time_chain_s": None, "time_elected_s": None, "time_solved_s": None}


@pytest.mark.parametrize(
    ("fields", "events", "name"),
    [
        ({"guardians": 2, "branches": 0} | OPEN, [], "a task found no guardian"),
        ({"members": 25, "branches": 2} | OPEN, [], "all robots in an unfinished chain"),
        ({"branches": 1, "tails": 2} | OPEN, [], "2 of 3 branches missed their guardian"),
        ({"branches": 1, "tails": 1} | OPEN, [], "a branch lost its tail"),
        (OPEN, [], "the loop did not close"),
        ({"time_elected_s": None, "time_solved_s": None}, [], "no election"),
        ({"upi_found": 3}, [], "a wrong order taken for right"),
        ({"steps_behind": 1}, [], "news did not get round the loop"),
        ({"runners_inside": 5}, [], "all free robots inside the loop"),
        ({"members": 25}, [], "all robots in the finished chain"),
        ({}, [(2400.0 - STALLED + 1, EventKind.STEP, 7, 1, 4)], "too slow"),
        ({}, [(600.0, EventKind.STEP, 7, 1, 4), moved(700.0, Role.LINK)], "link displaced"),
        ({}, [], "runners stuck"),
    ],
)
def test_a_failed_trial_of_mark_ii_has_a_named_cause(fields, events, name):
    assert cause(LOOP | fields, log(*events), 25, 3, CYCLE) == name


def finished(robots=20, **roles):
    """Return the state of a trial at its end, with so many guardians, links and tails."""
    state = begin(mark_i3_parameters(robots=robots), 1)
    state.clock[0].cycle = 24_000
    taken = [role for name, count in roles.items() for role in [Role[name]] * count]
    state.memories.role[: len(taken)] = taken
    return state


def test_times_are_those_of_the_end_of_the_cycle_in_which_it_happened():
    """TS-136, TS-137."""
    state = finished(GUARDIAN=3, LINK=11)
    state.chain[0].sequences = 6
    events = log((310.0, EventKind.CHAIN, 4, 0, 14), *sequences(400.0, 420.0, 470.0, 500.0, 530.0, 531.0))
    row = outcome(state, events)
    assert row["time_chain_s"] == pytest.approx(310.0 + CYCLE)
    assert row["time_1_s"] == pytest.approx(400.0 + CYCLE) and row["time_5_s"] == pytest.approx(530.0 + CYCLE)
    assert row["time_10_s"] is None and row["success"] == 0 and row["sequences"] == 6
    assert (row["guardians"], row["links"], row["tails"], row["members"]) == (3, 11, 0, 14)
    assert row["duration_s"] == pytest.approx(2400.0)


def test_a_success_needs_no_cause():
    state = finished(GUARDIAN=3, LINK=11)
    state.chain[0].sequences = 10
    events = log((310.0, EventKind.CHAIN, 4, 0, 14), *sequences(*range(400, 1400, 100)))
    row = outcome(state, events)
    assert row["success"] == 1 and row["cause"] is None and row["time_10_s"] == pytest.approx(1300.0 + CYCLE)


def test_what_happened_is_counted():
    events = log(
        (1.0, EventKind.EXECUTED, 1, 1, 1, 1),
        (2.0, EventKind.EXECUTED, 1, 2, 0, 2),
        (3.0, EventKind.EXECUTED, 2, 1, 1, 1),
        (4.0, EventKind.NO_ANSWER, 2, 1),
        (5.0, EventKind.DISPLACED, 2, 1, Role.LINK),
        (6.0, EventKind.PROTOCOL_FAULT, 2, 1, 3),
        (7.0, EventKind.UNFOUNDED, 2, 1, 3),
        (8.0, EventKind.DISAGREEMENT, 2, 1),
        (9.0, EventKind.DIED, 9, 0, Role.RUNNER),
        (9.5, EventKind.BRANCH, 3, 1, 5),
    )
    row = outcome(finished(), events)
    names = ("executions", "failures", "no_answers", "displaced", "protocol_faults", "unfounded", "disagreements")
    assert [row[name] for name in (*names, "died", "branches")] == [3, 1, 1, 1, 1, 1, 1, 1, 1]


def test_the_dead_are_no_members():
    """A dead guardian and the one that took its place (U31) are not two guardians for one task."""
    state = finished(GUARDIAN=4, LINK=10)
    state.robots.alive[0] = 0
    row = outcome(state, log((9.0, EventKind.DIED, int(state.robots[0].identity), 1, Role.GUARDIAN)))
    assert row["guardians"] == 3 and row["members"] == 13
    assert row["cause"] != "two guardians for one task"


def test_dead_links_do_not_use_up_the_free_runners():
    state = finished(GUARDIAN=3, LINK=12)
    state.robots.alive[3:8] = 0  # five of the links; five runners are left
    events = log(*((9.0, EventKind.DIED, 10 + k, 1, Role.LINK) for k in range(5)))
    assert "all robots" not in outcome(state, events)["cause"]


SCENE = Scene((), 0.035, ROLES, CYCLE)


def test_the_timeline_shows_who_was_what_from_when_to_when():
    events = log(
        (10.0, EventKind.ROLE, 7, 1, Role.GUARDIAN, Role.RUNNER),
        (20.0, EventKind.ROLE, 3, 1, Role.TAIL, Role.RUNNER),
        (30.0, EventKind.ROLE, 3, 1, Role.LINK, Role.TAIL),
        (35.0, EventKind.BRANCH, 7, 1, 1),
        (40.0, EventKind.CHAIN, 7, 0, 3),
        (50.0, EventKind.DIED, 7, 1, Role.GUARDIAN),
        (60.0, EventKind.SEQUENCE, 9, 0, 1),
    )
    events["cycle"] -= 1  # what happens in a cycle has happened at its end
    shown = timeline(Trial({"duration_s": 100.0}, events, None, SCENE))
    assert shown.lanes == ("3", "7", "9") and shown.duration == 100.0
    spans = {
        lane: [(s.start, s.end, ROLES[s.role]) for s in shown.spans if shown.lanes[s.lane] == lane]
        for lane in shown.lanes
    }
    assert spans == {
        "3": [(0.0, 20.0, "runner"), (20.0, 30.0, "tail"), (30.0, 100.0, "link")],
        "7": [(0.0, 10.0, "runner"), (10.0, 50.0, "guardian"), (50.0, 100.0, "dead")],
        "9": [(0.0, 100.0, "runner")],
    }
    assert shown.marks == ((35.0, "branch 1"), (40.0, "chain complete")) and shown.counts == (60.0,)


@pytest.fixture(scope="module")
def trial():
    return MARK_I3.run(mark_i3_parameters(), 77, frames_every=10.0)


def test_the_spans_of_every_robot_cover_the_whole_trial(trial):
    shown = timeline(trial)
    assert len(shown.lanes) == 20
    for lane in range(20):
        spans = [span for span in shown.spans if span.lane == lane]
        assert spans[0].start == 0.0 and spans[-1].end == shown.duration
        assert all(a.end == b.start for a, b in pairwise(spans))


def test_times_recomputed_from_the_raw_log_are_those_of_the_row(trial):
    """T24, T26."""
    events, row = trial.events, trial.outcome
    counted = events[events["kind"] == EventKind.SEQUENCE]
    assert counted["value"].tolist() == list(range(1, row["sequences"] + 1))
    for name, n in (("time_1_s", 1), ("time_5_s", 5), ("time_10_s", 10)):
        reached = round(float(counted["cycle"][n - 1] + 1) * CYCLE, 6) if len(counted) >= n else None
        assert row[name] == reached
    roles = {}
    for event in events[events["kind"] == EventKind.ROLE]:
        roles[int(event["robot"])] = int(event["value"])
    assert row["members"] == sum(role != Role.RUNNER for role in roles.values())
    assert row["links"] == sum(role == Role.LINK for role in roles.values())


def test_a_branch_event_tells_its_number_and_its_links(trial):
    branches = trial.events[trial.events["kind"] == EventKind.BRANCH]
    assert branches["subject"].tolist() == list(range(1, len(branches) + 1))
    assert (branches["value"] >= 1).all()


def test_the_condition_of_a_guardian_is_logged_whenever_it_changes(trial):
    """Only the transitions of section 6.1 occur."""
    last = {}
    for event in trial.events[trial.events["kind"] == EventKind.CONDITION]:
        who, now = int(event["robot"]), (int(event["value"]), int(event["detail"]))
        before = last.get(who)
        assert now in {(0, 1), (1, 0), (1, 1), (2, 0), (2, 1)}
        assert before is None or (before[1] == 0 and now != before)
        last[who] = now
    assert len(last) >= 3


def test_a_trial_without_runners_is_ended_and_counts_as_run_to_its_cap():
    """TS-145, T25: twelve robots are too few, all join the chain; run on to the cap, nothing else comes of it."""
    early, whole = (
        MARK_I3.run(mark_i3_parameters(robots=12, swarm={"idle_limit": limit}), 5001) for limit in (100.0, 0.0)
    )
    ended, row = early.events[-1], early.outcome
    assert ended["kind"] == EventKind.HOPELESS
    assert row["hopeless_s"] == pytest.approx((ended["cycle"] + 1) * CYCLE)
    assert whole.outcome["hopeless_s"] is None
    assert row["duration_s"] == whole.outcome["duration_s"] == 2400.0
    roles = early.events[early.events["kind"] == EventKind.ROLE]
    last_runner = roles[roles["detail"] == Role.RUNNER]["cycle"][-1]
    assert ended["cycle"] - last_runner + 1 == round(100.0 / CYCLE)
    for name in ("success", "sequences", "time_chain_s", "time_1_s", "members", "cause"):
        assert row[name] == whole.outcome[name]


def test_a_trial_with_a_runner_left_is_not_ended():
    same = MARK_I3.run(mark_i3_parameters(swarm={"idle_limit": 0.1}), 5002)
    assert same.outcome["hopeless_s"] is None
    assert same.outcome["success"] == 1


PROGRESS = (EventKind.CHAIN, EventKind.STEP, EventKind.SOLVED, EventKind.SEQUENCE)


@pytest.mark.parametrize(
    ("system", "parameters"), [(MARK_I3, mark_i3_parameters), (MARK_II3, mark_ii3_parameters)], ids=["I3", "II3"]
)
def test_a_complete_chain_that_gets_nowhere_is_ended(system, parameters):
    """TS-145: sequences and steps of the search put the end off; a limit above the longest wait ends nothing."""
    whole = system.run(parameters(), 5002)
    assert whole.outcome["success"] == 1
    cycles = whole.events["cycle"][np.isin(whole.events["kind"], PROGRESS)]
    waits = np.diff(cycles)
    longest = int(waits.max())
    above, below = (
        system.run(parameters(swarm={"stall_limit": (longest + more) * CYCLE}), 5002) for more in (0.5, -1.5)
    )
    assert above.outcome == whole.outcome
    ended, row = below.events[-1], below.outcome
    assert (ended["kind"], ended["value"]) == (EventKind.HOPELESS, 1)
    assert ended["cycle"] == cycles[waits.argmax()] + longest - 1
    assert row["hopeless_s"] == pytest.approx((ended["cycle"] + 1) * CYCLE)
    assert (row["success"], row["time_10_s"], row["duration_s"]) == (0, None, parameters().swarm.time_cap)


def test_an_unfinished_chain_is_not_ended():
    """Of a hundred successful runs of Mark II3 one had closed its loop after 79,271 s."""
    trial = MARK_I3.run(mark_i3_parameters(robots=12, swarm={"stall_limit": 100.0}), 5001)
    assert (trial.outcome["hopeless_s"], trial.outcome["time_chain_s"]) == (None, None)
