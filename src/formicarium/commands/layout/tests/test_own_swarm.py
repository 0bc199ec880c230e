"""The contracts that every system keeps, and what this swarm is for."""

import pytest
from formicarium.contracts import CONTRACTS
from formicarium.systems.registry import resolve


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda contract: contract.__name__)
def test_contract(contract):
    contract("own-swarm")


def test_robots_that_never_leave_gather_sooner():
    system = resolve("own-swarm")
    usual = system.configure()
    loyal = usual.model_copy(update={"behaviour": usual.behaviour.model_copy(update={"leave": 0.0})})
    times = [
        sum(system.run(parameters, seed).outcome["duration_s"] for seed in range(1, 6)) for parameters in (usual, loyal)
    ]
    assert times[1] < times[0]
