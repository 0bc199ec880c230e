"""Random streams: a published generator, named, and nobody's draws depend on anybody else's."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import kstest

from formicarium.streams import advanced, derived, generator, mixed, normal, stream, uniform

WORDS = st.integers(0, 2**64 - 1)
ALL = 2**64


def draws(state, count, kind):
    """Return ``count`` numbers of a stream."""
    values = []
    for _ in range(count):
        state = np.uint64(advanced(state))
        values.append(kind(state))
    return np.array(values, np.uint64 if kind is mixed else float)


def plain_mixed(word):
    """SplitMix64's output function with Python's own integers."""
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9 % ALL
    word = (word ^ (word >> 27)) * 0x94D049BB133111EB % ALL
    return word ^ (word >> 31)


def test_the_generator_is_splitmix64():
    """The first outputs for seed 1234567 that are published with implementations of SplitMix64."""
    expected = [
        6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431, 16408922859458223821,
    ]  # fmt: skip
    assert draws(np.uint64(1234567), 5, mixed).tolist() == expected


@given(WORDS)
def test_mixing_is_arithmetic_modulo_two_to_the_64(word):
    assert int(mixed(np.uint64(word))) == plain_mixed(word)
    assert int(advanced(np.uint64(word))) == (word + 0x9E3779B97F4A7C15) % ALL


@given(WORDS, st.integers(0, 2**63 - 1))
def test_deriving_is_arithmetic_modulo_two_to_the_64(word, number):
    expected = plain_mixed(word ^ ((number * 0x9E3779B97F4A7C15 + 0xBF58476D1CE4E5B9) % ALL))
    assert int(derived(np.uint64(word), number)) == expected


@given(WORDS)
def test_uniform_numbers_are_in_zero_to_below_one(word):
    assert 0.0 <= uniform(np.uint64(word)) < 1.0


@given(WORDS)
def test_normal_numbers_end_at_three_and_a_third_standard_deviations(word):
    assert abs(normal(np.uint64(word))) <= 3.31


def test_uniform_and_normal_numbers_are_distributed_as_they_say():
    start, count = stream(1, "test"), 100_000
    flat, bell = draws(start, count, uniform), draws(start, count, normal)
    assert kstest(flat, "uniform").pvalue > 1e-3
    assert bell.mean() == pytest.approx(0.0, abs=4 / math.sqrt(count))
    assert bell.std() == pytest.approx(1.0, rel=0.01)
    assert kstest(bell, "norm").statistic < 0.006  # the tails are cut
    for values in (flat, bell):
        assert abs(np.corrcoef(values[1:], values[:-1])[0, 1]) < 4 / math.sqrt(count)


def test_streams_of_other_seeds_names_keys_cycles_and_channels_have_nothing_in_common():
    starts = [stream(seed, name, key) for seed in (1, 2) for name in ("noise", "decisions") for key in (0, 1, 2)]
    starts += [np.uint64(derived(starts[0], number)) for number in (0, 1, 2, 1 << 20, 2 << 20)]
    assert len({int(start) for start in starts}) == len(starts)
    table = np.array([draws(start, 4000, uniform) for start in starts])
    likeness = np.corrcoef(table) - np.eye(len(table))
    assert np.abs(likeness).max() < 5 / math.sqrt(4000)


def test_neighbouring_events_draw_apart():
    """The first draw of cycle t and of cycle t + 1, of key k and of key k + 1."""
    start = stream(1, "noise", 7)
    first = np.array([[uniform(np.uint64(advanced(np.uint64(derived(np.uint64(derived(start, t)), k)))))
                       for k in range(40)] for t in range(200)])  # fmt: skip
    assert abs(np.corrcoef(first[1:].ravel(), first[:-1].ravel())[0, 1]) < 4 / math.sqrt(8000)
    assert abs(np.corrcoef(first[:, 1:].ravel(), first[:, :-1].ravel())[0, 1]) < 4 / math.sqrt(8000)
    assert kstest(first.ravel(), "uniform").pvalue > 1e-3


def test_a_stream_is_the_same_on_every_machine_for_ever():
    assert int(stream(0, "noise", 0)) == 18289175030525828258
    assert int(stream(41, "booth", 2)) == 16550906029327761997


def test_generators_are_named_and_repeat():
    one, same, other = (generator(*which).random(50) for which in ((1, "layout"), (1, "layout"), (1, "order")))
    assert np.array_equal(one, same)
    assert not np.isin(one, other).any()


def test_interpreted_streams_are_the_compiled_ones():
    program = (
        "import numpy as np; from formicarium.streams import *; s = stream(3, 'x')\n"
        "for k in range(50):\n s = advanced(s); d = derived(s, k * 2**40); print(int(d), repr(float(normal(d))))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], env=os.environ | {"FORMICARIUM_INTERPRETED": "1"},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stderr == ""
    state, lines = stream(3, "x"), []
    for k in range(50):
        state = np.uint64(advanced(state))
        word = np.uint64(derived(state, k * 2**40))
        lines.append(f"{int(word)} {float(normal(word))!r}")
    assert done.stdout.split("\n")[:-1] == lines
