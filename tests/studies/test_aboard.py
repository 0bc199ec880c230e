"""What is made of estimates on the messages of an eruption (ST-73)."""

import numpy as np
import pytest

from formicarium.connectivity.estimate import Estimates
from formicarium.studies.estimators_aboard import (
    AboardParameters,
    delivered_share,
    fly,
    judge,
    lag_of,
    median_node,
    sail,
)
from formicarium.systems.coverage.parameters import coverage_parameters


def test_a_late_copy_of_the_truth_has_its_delay_as_lag():
    times = np.arange(400)
    truth = 1.0 + 5.0 * np.exp(-times / 60.0) + 0.3 * np.sin(times / 9.0)
    late = np.concatenate([np.full(17, truth[0]), truth[:-17]])
    assert lag_of(late, truth, 60) == (17, 0.0)
    assert lag_of(1.5 * late, truth, 60)[1] > 0.1  # what is wrong by half is not made right by waiting


def test_the_median_node_is_of_those_that_say_anything():
    values = np.array([[1.0, 2.0, np.nan], [np.nan, np.nan, np.inf], [3.0, 1.0, 2.0]])
    assert median_node(values).tolist() == [1.5, np.inf, 2.0]


def test_judged_by_hand():
    truth = np.array([1.0, 1.0, 2.0, 2.0])
    said = np.array([[1.0], [1.4], [1.9], [5.0]])
    found = judge(Estimates(np.arange(1, 5), said, None), truth, 0.5)
    assert (found["within_half"], found["within_tenth"], found["within_hundredth"]) == (0.75, 0.5, 0.25)
    assert found["error"] == pytest.approx(0.225)


@pytest.fixture(scope="module")
def short():
    swarm = coverage_parameters(5, swarm={"time_cap": 20.0}, footbot={"radio_loss": 0.3})
    return AboardParameters(eruption=swarm)


def test_messages_are_those_that_the_radio_delivered(short):
    """Seven of ten between robots in sight of each other, and none between others."""
    voyage = sail(short.eruption, 3, 1)
    assert not voyage.received[0].any()
    assert not (voyage.received[1:] & ~voyage.sight).any()
    assert delivered_share(sail(short.eruption, 3, 5), 5) == pytest.approx(0.7, abs=0.02)


def test_a_run_has_a_row_of_every_estimator_and_repeats(short):
    one, two = fly(short, 3).outcome, fly(short, 3).outcome
    assert one == two
    for method in ("pi1", "pi1_long", "pi2", "wave", "wave_long"):
        assert one[f"{method}_error"] > 0.0
        assert len(str(one[f"{method}_said"]).split()) == len(str(one[f"{method}_truth"]).split()) == 40
