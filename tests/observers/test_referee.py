"""The referee counts what robots do, not what they say (TS-31, T15, T18)."""

import itertools

import numpy as np
import pytest

from formicarium.devices.booth import BAY_END, BAY_HALF_WIDTH, HALF, placed
from formicarium.devices.service import serve_booths
from formicarium.observers.referee import REFEREE, TASKS, executed, locate
from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.robots.infrared import CLAIM, HEARD_HIGH, HIGH_HALF, LOW_HALF
from formicarium.robots.records import SILENCE
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind, note
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.simulate import drain

# its sheet


def sheet():
    record = records(REFEREE, 1)[0]
    record.booth = -1
    return record


@pytest.mark.parametrize("tasks", [2, 3, 4])
def test_a_sequence_is_the_last_tasks_in_the_right_order_each_counted_once(tasks):
    order = np.zeros(8, np.int64)
    order[:tasks] = np.random.default_rng(tasks).permutation(tasks) + 1
    done = np.random.default_rng(tasks + 10).integers(1, tasks + 1, 3000)
    record, history, sequences = sheet(), [], 0
    for count, colour in enumerate(done):
        history.append(int(colour))
        complete = history[-tasks:] == order[:tasks].tolist()
        assert executed(record, colour, order, tasks) == complete
        if complete:
            sequences += 1
            history.clear()  # no task counts for two sequences
        assert (record.sequences, record.executions, record.last) == (sequences, count + 1, colour)
        assert record.length <= TASKS
    assert sequences > 5


def test_presence_is_the_centre_in_the_bay_and_nothing_else():
    state = begin(mark_i3_parameters(), 1)
    record, body = state.referee[0], state.world.bodies[0]
    draws = np.random.default_rng(1)
    places = [(*draws.uniform(-0.15, 0.15, 2), int(draws.integers(3))) for _ in range(3000)]
    for cycle, (depth, side, b) in enumerate(places):
        booth = state.booths[b]
        body.x, body.y = placed(booth.x, booth.y, np.arctan2(booth.sine, booth.cosine), depth, side)
        before, since = record.booth, record.since
        locate(record, body, state.booths, HALF, BAY_HALF_WIDTH, BAY_END, cycle)
        inside = -HALF < depth < BAY_END and abs(side) < BAY_HALF_WIDTH
        assert record.booth == (b if inside else -1)
        assert record.since == (since if record.booth == before else cycle)


# puppets: robots put into booths by hand, saying what they are told to say


class Puppets:
    """A trial in which nobody decides: robots are put into booths and say what the test wants."""

    def __init__(self, seed=3):
        self.state = begin(mark_i3_parameters(booth={"exchange_failure": 0.0}), seed)
        self.events = []
        order = self.state.coordinator[0].order
        self.booth_of = [int(np.flatnonzero(self.state.booths.colour == order[k])[0]) for k in range(3)]

    def put(self, robot, booth=None):
        """Put a robot into a booth, or into the middle of the arena."""
        body = self.state.world.bodies[robot]
        if booth is None:
            body.x, body.y = 0.01 * robot, 0.0
        else:
            record = self.state.booths[booth]
            body.x, body.y = placed(record.x, record.y, np.arctan2(record.sine, record.cosine), 0.0, 0.0)
        find_neighbours(self.state.world)

    def pass_cycles(self, count):
        state = self.state
        for _ in range(count):
            serve_booths(
                state.booths, state.lights, state.coordinator[0], state.robots, state.world.bodies, state.commands,
                state.booth_table[0], state.clock[0].cycle, 0.1,
            )  # fmt: skip
            note(state)
            state.clock[0].cycle += 1
            yield
        self.events.append(drain(state))

    def visit(self, robot, task, claim, *, alias=None, instead=None, cycles=100):
        """Let a robot do task number ``task`` of the correct order, claiming what it likes.

        Args:
            robot: who says so.
            task: 0, 1, 2 of the correct order.
            claim: the number it claims.
            alias: robot whose identity it uses.
            instead: robot that takes its place in the bay after the exchange has begun.
            cycles: how long the visit lasts.
        """
        booth, last = self.booth_of[task], SILENCE
        identity = int(self.state.robots[robot if alias is None else alias].identity)
        self.put(robot, booth)
        command = self.state.commands[robot]
        for n, _ in enumerate(self.pass_cycles(cycles)):
            heard = int(self.state.robots[robot].infrared_heard)
            last = heard if heard != SILENCE else last
            words = {SILENCE: HIGH_HALF | identity >> 4, HEARD_HIGH: LOW_HALF | identity & 0x0F}
            command.infrared = words.get(last, CLAIM | claim)
            if n == 10 and instead is not None:
                self.put(instead, booth)
                self.put(robot)
        command.infrared = SILENCE
        for who in {robot, instead} - {None}:
            self.put(who)
        for _ in self.pass_cycles(2):
            pass

    def count(self, kind, **fields):
        events = np.concatenate(self.events)
        chosen = events["kind"] == kind
        for name, value in fields.items():
            chosen &= events[name] == value
        return int(chosen.sum())

    @property
    def sequences(self):
        assert self.state.chain[0].sequences == self.count(EventKind.SEQUENCE)
        return self.count(EventKind.SEQUENCE)


TROUBLE = (EventKind.DISAGREEMENT, EventKind.PROTOCOL_FAULT)


def test_an_honest_robot_is_believed():
    puppets = Puppets()
    for _ in range(2):
        for task in range(3):
            puppets.visit(0, task, task + 1)
    assert puppets.sequences == 2
    assert puppets.count(EventKind.EXECUTED, value=1) == 6
    assert [puppets.count(kind) for kind in TROUBLE] == [0, 0]


@pytest.mark.parametrize("order", [order for order in itertools.permutations(range(3)) if order != (0, 1, 2)])
def test_other_orders_are_no_sequences(order):
    puppets = Puppets()
    count = 0
    for task in order:
        puppets.visit(0, task, count + 1)
        count = int(puppets.state.coordinator[0].done[puppets.state.robots[0].identity])
    assert puppets.count(EventKind.EXECUTED) == 3 and puppets.sequences == 0
    assert [puppets.count(kind) for kind in TROUBLE] == [0, 0]


def test_a_robot_that_claims_more_than_it_did_is_found_out():
    puppets = Puppets()
    puppets.visit(0, 2, 3)  # the last task of the order, as if it had done the others
    assert puppets.sequences == 0
    assert puppets.count(EventKind.EXECUTED, value=0) == 1
    assert puppets.count(EventKind.PROTOCOL_FAULT, value=3) == 1


def test_a_robot_that_counts_wrong_has_done_its_sequence_all_the_same():
    """The referee goes by what was done; that the booths thought otherwise is logged."""
    puppets = Puppets()
    for task in range(3):
        puppets.visit(0, task, 1)
    assert puppets.sequences == 1
    assert puppets.count(EventKind.EXECUTED, value=1) == 1
    assert puppets.count(EventKind.DISAGREEMENT) == 1


def test_a_robot_under_anothers_name_does_not_finish_its_sequence():
    puppets = Puppets()
    puppets.visit(0, 0, 1)
    puppets.visit(0, 1, 2)
    puppets.visit(5, 2, 3, alias=0)  # the coordinator is deceived, the referee is not
    assert puppets.count(EventKind.EXECUTED, value=1) == 3
    assert puppets.sequences == 0
    assert puppets.count(EventKind.DISAGREEMENT) == 1


def test_a_sequence_whose_last_task_was_done_in_absence_does_not_count():
    puppets = Puppets()
    puppets.visit(0, 0, 1)
    puppets.visit(0, 1, 2)
    puppets.visit(0, 2, 3, instead=7)
    assert puppets.sequences == 0
    assert puppets.count(EventKind.DISAGREEMENT) == 1


def test_no_task_done_in_absence_counts():
    puppets = Puppets()
    puppets.visit(0, 0, 1, instead=7)
    puppets.visit(0, 1, 2, instead=7)
    puppets.visit(0, 2, 3)
    assert puppets.count(EventKind.DISAGREEMENT) >= 2
    assert puppets.sequences == 0


def test_a_visit_cut_short_is_no_execution():
    puppets = Puppets()
    for task in range(3):
        puppets.visit(0, task, task + 1, cycles=65)
    assert puppets.count(EventKind.EXECUTED) == 0 and puppets.sequences == 0
    assert puppets.count(EventKind.VISIT, value=1) == 3


# a whole trial, judged again from places alone


@pytest.mark.parametrize("lying", [False, True], ids=["honest", "lying"])
def test_every_execution_of_a_trial_was_a_robot_in_a_bay_for_the_task_time(lying):
    """Watch all centres in all cycles; the log must tell the same story, even if robots' counts are forged."""
    state = begin(mark_i3_parameters(), 2)
    draws = np.random.default_rng(1)
    inside, logs = [], []
    way = np.arctan2(state.booths.sine, state.booths.cosine)
    for _ in range(6000):
        if lying:
            state.memories["count"] = draws.integers(0, 3, len(state.robots))
        run(state, 1)
        dx, dy = (np.subtract.outer(state.world.bodies[c], state.booths[c]) for c in "xy")
        depth, side = np.cos(way) * dx + np.sin(way) * dy, np.cos(way) * dy - np.sin(way) * dx
        inside.append((np.abs(depth) < HALF) & (np.abs(side) < BAY_HALF_WIDTH))
        logs.append(drain(state))
    events, inside = np.concatenate(logs), np.array(inside)
    index = {int(identity): i for i, identity in enumerate(state.robots.identity)}
    tasks = [event for event in events if event["kind"] == EventKind.EXECUTED]
    order, done, sequences = state.coordinator[0].order[:3].tolist(), {}, 0
    for event in tasks:
        i, cycle = index[int(event["robot"])], int(event["cycle"])
        b = int(np.flatnonzero(state.booths.colour == event["subject"])[0])
        assert inside[cycle - 70 : cycle + 1, i, b].all()
        done.setdefault(i, []).append(int(event["subject"]))
        if done[i][-3:] == order:
            done[i].clear()
            sequences += 1
    assert len(tasks) > 0
    assert state.chain[0].sequences <= sequences  # a future guardian's own task is no part of a sequence (TS-137)
    assert np.sum(events["kind"] == EventKind.DISAGREEMENT) == 0 or lying
