"""The contracts that every system keeps, as functions to call on a system of one's own.

With pytest, in a folder laid out by ``formicarium new``::

    @pytest.mark.parametrize("contract", CONTRACTS, ids=lambda contract: contract.__name__)
    def test_contract(contract):
        contract("my-swarm")

Each takes the name of a system as ``formicarium run`` does, and raises ``Broken`` (an AssertionError) if the system
does not keep it, or ``unittest.SkipTest`` if the system has nothing to hold it against.
"""

from formicarium.contracts.broken import Broken
from formicarium.contracts.interpreted import compiled_equals_interpreted
from formicarium.contracts.repeatability import (
    looking_changes_nothing,
    looks_of_any_length,
    same_seed_same_trial,
    seed_decides_the_start,
    storage_does_not_matter,
)
from formicarium.contracts.sensors import no_dead_sensor, own_identity_and_clock, own_noise
from formicarium.contracts.turned_world import no_compass
from formicarium.contracts.watching import (
    a_changed_state_is_noticed,
    deeds_are_done_again,
    deeds_that_cannot_be_done,
    frames_show_the_state,
    going_back_is_exact,
    heard_from_whom_is_drawn,
    the_dead_are_still,
    watching_gives_the_same_bytes,
)

CONTRACTS = (
    same_seed_same_trial,
    seed_decides_the_start,
    looking_changes_nothing,
    looks_of_any_length,
    storage_does_not_matter,
    no_dead_sensor,
    own_identity_and_clock,
    own_noise,
    no_compass,
    compiled_equals_interpreted,
    watching_gives_the_same_bytes,
    frames_show_the_state,
    going_back_is_exact,
    heard_from_whom_is_drawn,
    deeds_are_done_again,
    the_dead_are_still,
    deeds_that_cannot_be_done,
    a_changed_state_is_noticed,
)

__all__ = [
    "CONTRACTS",
    "Broken",
    "a_changed_state_is_noticed",
    "compiled_equals_interpreted",
    "deeds_are_done_again",
    "deeds_that_cannot_be_done",
    "frames_show_the_state",
    "going_back_is_exact",
    "heard_from_whom_is_drawn",
    "looking_changes_nothing",
    "looks_of_any_length",
    "no_compass",
    "no_dead_sensor",
    "own_identity_and_clock",
    "own_noise",
    "same_seed_same_trial",
    "seed_decides_the_start",
    "storage_does_not_matter",
    "the_dead_are_still",
    "watching_gives_the_same_bytes",
]
