"""What is timed, and when (AC-30): a scripted robot against sums worked by hand."""

import numpy as np
import pytest

from formicarium.physics.records import records
from formicarium.robots.forager import READING
from formicarium.systems.partitioning.choices import choose, close_timer, gives_up, start_wait
from formicarium.systems.partitioning.memory import CHART, MEMORY, NEVER, Estimate, Label
from formicarium.systems.partitioning.parameters import partitioning_parameters


class Robot:
    """One robot's memory, and a clock in seconds."""

    def __init__(self, **strategy):
        self.memory, self.reading = records(MEMORY, 1)[0], records(READING, 1)[0]
        self.chart = records(CHART, 1)[0]
        self.chart.cycle_time = 0.1
        self.memory.harvest, self.memory.store, self.memory.whole = 60.0, 80.0, 150.0
        self.memory.timer = NEVER
        self.memory.patience = np.uint64(5)
        self.strategy = partitioning_parameters(strategy=strategy).strategy.record()[0]

    def close(self, seconds, at_nest, label=None):
        self.reading.cycle = round(10 * seconds)
        close_timer(self.reading, self.memory, self.strategy, self.chart, at_nest)
        choose(self.reading, self.memory, self.strategy, self.chart)
        if label is not None:
            self.memory.label = label

    @property
    def estimates(self):
        return float(self.memory.harvest), float(self.memory.store), float(self.memory.whole)

    def wait(self, begun, until, to_pick):
        """Wait from one second to another; return the cycles at which it would have left, whatever it drew."""
        self.reading.cycle = round(10 * begun)
        start_wait(self.reading, self.memory, self.strategy, self.chart)
        for cycle in range(round(10 * begun) + 1, round(10 * until) + 1):
            self.reading.cycle = cycle
            if gives_up(self.reading, self.memory, self.strategy, self.chart, to_pick):
                return cycle / 10 - begun
        return None


def test_the_first_harvest_measures_nothing():
    robot = Robot()
    robot.close(30.0, at_nest=False)
    assert robot.estimates == (60.0, 80.0, 150.0)


def test_a_trace_worked_by_hand():
    robot = Robot()
    robot.close(30.0, False, Label.CACHE)
    robot.close(130.0, False, Label.CORRIDOR)  # 100 s from harvest to harvest: phi_1
    assert robot.estimates == pytest.approx((0.2 * 60 + 0.8 * 100, 80.0, 150.0))
    robot.close(330.0, True, Label.CACHE)  # a crossing of 200 s counts twice (TP-22)
    assert robot.estimates == pytest.approx((92.0, 80.0, 0.2 * 150 + 0.8 * 400))
    robot.close(380.0, True, Label.GAVE_UP)  # 50 s from store to store: phi_2
    assert robot.estimates == pytest.approx((92.0, 0.2 * 80 + 0.8 * 50, 350.0))
    robot.close(700.0, False, Label.CORRIDOR)  # a crossing after giving up measures nothing
    assert robot.estimates == pytest.approx((92.0, 56.0, 350.0))
    robot.close(850.0, True)
    assert robot.estimates == pytest.approx((92.0, 56.0, 0.2 * 350 + 0.8 * 300))


def test_a_short_wait_that_is_given_up_leaves_the_estimates_alone():
    robot = Robot()
    assert robot.wait(0.0, 20.0, to_pick=False) < 20.0
    assert robot.memory.updated == Estimate.NONE and robot.estimates == (60.0, 80.0, 150.0)
    assert robot.memory.label == Label.GAVE_UP


@pytest.mark.parametrize(("to_pick", "own"), [(False, 60.0), (True, 80.0)])
def test_a_wait_longer_than_the_estimate_renews_it_with_the_wait_alone(to_pick, own):
    """TP-23: conditional, so no estimate ever shrinks by giving up (T6)."""
    robot = Robot(giveup_draw_period=100.0)
    waited = robot.wait(0.0, 5000.0, to_pick)
    assert waited % 100.0 == 0.0 and waited > own
    expected = 0.2 * own + 0.8 * waited
    assert robot.estimates[1 if to_pick else 0] == pytest.approx(expected)
    assert robot.estimates[0 if to_pick else 1] == (60.0 if to_pick else 80.0)


def test_to_the_letter_there_are_ten_draws_a_second_and_the_mean_wait_is_a_fifth_of_one():
    """TP-16, reading A: the first draw one step after arrival gives 0.31 s."""
    robot = Robot()
    robot.memory.store = 60.0
    waits = [robot.wait(0.0, 60.0, to_pick=False) for _ in range(4000)]
    assert robot.memory.draws_made == round(10 * waits[-1])
    assert np.mean(waits) == pytest.approx(0.31, abs=0.02)


@pytest.mark.long
def test_with_a_threshold_a_third_leaves_at_once_and_half_by_the_sum_of_all_estimates():
    """TP-16, reading T: for estimates of 60 s the median wait is 180 s."""
    robot = Robot(giveup_mode="threshold")
    robot.memory.store = 60.0
    waits = []
    for _ in range(400):
        robot.memory.harvest = 60.0
        waits.append(robot.wait(0.0, 400.0, to_pick=False) or 400.0)
    assert np.mean(np.array(waits) < 0.2) == pytest.approx(0.32, abs=0.06)
    assert np.median(waits) == pytest.approx(180.0, abs=30.0)


def test_who_always_partitions_never_gives_up_and_who_never_does_never_goes_to_the_cache():
    assert Robot(method="always").wait(0.0, 1000.0, to_pick=True) is None
    robot = Robot(method="never")
    for second in range(200):
        robot.close(float(second), second % 2 == 0)
        assert robot.memory.label == Label.CORRIDOR
