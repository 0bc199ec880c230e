"""Wrapping an angle of many turns: all at once, and to the same bit as turn by turn."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from formicarium.angles import wrapped


def turn_by_turn(angle: float) -> float:
    """Return the same angle in (-pi, pi], the long way."""
    while angle > math.pi:
        angle -= 2.0 * math.pi
    while angle <= -math.pi:
        angle += 2.0 * math.pi
    return angle


@settings(max_examples=2000, deadline=None)
@given(st.floats(-50_000.0, 50_000.0))
@example(math.pi)
@example(-math.pi)
@example(64.0)
@example(np.nextafter(64.0, 0.0))
@example(128.0 - 2.0**-46)
def test_many_turns_are_taken_off_to_the_same_bit_as_one_by_one(angle):
    assert wrapped(angle) == turn_by_turn(angle)


@pytest.mark.parametrize("exponent", range(1, 17))
def test_it_is_the_same_on_both_sides_of_every_power_of_two(exponent):
    steps = np.arange(-300, 300)
    power = 2.0**exponent
    for spacing in (np.spacing(power), np.spacing(power) / 2, math.pi / 7):
        for angle in power + steps * spacing:
            assert wrapped(angle) == turn_by_turn(angle)
            assert wrapped(-angle) == turn_by_turn(-angle)


def test_a_million_million_turns_end():
    assert -math.pi < wrapped(2.0 * math.pi * 1e12) <= math.pi
