"""Named random streams that do not depend on the order in which anybody draws.

A stream is one unsigned 64-bit number. ``draw`` advances it (SplitMix64: Steele, Lea and Flood, "Fast
splittable pseudorandom number generators", OOPSLA 2014). Sensors do not keep streams: they *derive* one for
each event from who senses what of whom at which cycle, so that neither the order of robots in memory nor a
new sensor reshuffles anyone else's noise.
"""

import hashlib
from statistics import NormalDist

import numpy as np

from formicarium.compiled import INTERPRETED, compiled

if INTERPRETED:
    np.seterr(over="ignore")  # wrapping round 2**64 is the generator's business, not an accident

GAMMA = np.uint64(0x9E3779B97F4A7C15)
MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
MIX_2 = np.uint64(0x94D049BB133111EB)
SHIFT_30 = np.uint64(30)
SHIFT_27 = np.uint64(27)
SHIFT_31 = np.uint64(31)
SHIFT_11 = np.uint64(11)
UNIT = 1.0 / 9007199254740992.0  # 2**-53

# Quantiles of the standard normal distribution, looked up with linear interpolation: no logarithm in the hot
# path, the same bits on every platform. The tails end at 3.3 standard deviations, as a real sensor's do.
NORMAL_STEPS = 1024
NORMAL_QUANTILES = np.array(
    [NormalDist().inv_cdf((step + 0.5) / (NORMAL_STEPS + 1)) for step in range(NORMAL_STEPS + 1)]
)


def stream(seed: int, name: str, key: int = 0) -> np.uint64:
    """Return the start of the stream called ``name`` of robot or device ``key`` in trial ``seed``."""
    digest = hashlib.blake2b(f"{seed}/{name}/{key}".encode(), digest_size=8).digest()
    return np.uint64(int.from_bytes(digest, "little"))


def generator(seed: int, name: str) -> np.random.Generator:
    """Return a NumPy generator for work done once, before a trial (a layout, a schedule of failures)."""
    return np.random.default_rng(int(stream(seed, name)))


@compiled
def mixed(state):
    """Scramble 64 bits (the output function of SplitMix64)."""
    state = (state ^ (state >> SHIFT_30)) * MIX_1
    state = (state ^ (state >> SHIFT_27)) * MIX_2
    return state ^ (state >> SHIFT_31)


@compiled
def derived(state, number):
    """Return the stream that belongs to ``number`` (a cycle, a channel, another's key) under a stream."""
    return mixed(state ^ (np.uint64(number) * GAMMA + MIX_1))


@compiled
def advanced(state):
    """Return the stream's next state. Use as ``state = advanced(state)`` before every draw."""
    return state + GAMMA


@compiled
def uniform(state):
    """Return a number in [0, 1) from a stream's state."""
    return np.float64(mixed(state) >> SHIFT_11) * UNIT


@compiled
def normal(state):
    """Return a standard normal number, cut at 3.3 standard deviations, from a stream's state."""
    place = uniform(state) * NORMAL_STEPS
    step = int(place)
    share = place - step
    return NORMAL_QUANTILES[step] * (1.0 - share) + NORMAL_QUANTILES[step + 1] * share
