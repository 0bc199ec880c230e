"""A trial is its parameters and its seed: nothing else, and nobody who looks, changes a byte of it."""

from typing import Any

import numpy as np

from formicarium.contracts.broken import require
from formicarium.contracts.states import advanced, begun, differences, length_of, shortened
from formicarium.systems.registry import System, resolve
from formicarium.trial.record import Trial
from formicarium.trial.simulate import simulate

ROBOTS = 12  # enough to push, talk and take roles, few enough to be quick
LONGEST = 2400.0  # s, and most trials are not so long either


def small(system: System) -> Any:
    """Return parameters of a short trial of few robots."""
    return shortened(system, system.configure(robots=ROBOTS), LONGEST)


def bytes_of(trial: Trial) -> tuple[bytes, str]:
    """Return everything a trial has led to, comparable byte by byte."""
    return trial.events.tobytes(), repr(sorted(trial.outcome.items()))


def same_seed_same_trial(name: str) -> None:
    """The same seed is the same trial, and another seed is another."""
    system = resolve(name)
    trials = [bytes_of(system.run(small(system), seed)) for seed in (5, 5, 6, 7)]
    require(
        trials[0] == trials[1], "two runs with seed 5 differ: is there a global, a clock, a set or np.random in it?"
    )
    require(len(set(trials)) == 3, "runs with seeds 5, 6 and 7 are not all different: where is the seed used?")


def seed_decides_the_start(name: str) -> None:
    """The seed decides where everybody starts."""
    system = resolve(name)
    starts = [begun(system, small(system), seed).world.bodies for seed in (5, 5, 6)]
    require(starts[0].tobytes() == starts[1].tobytes(), "two trials with seed 5 start differently")
    require(not np.isin(starts[2].x, starts[0].x).any(), "trials with seeds 5 and 6 share places")


def looking_changes_nothing(name: str) -> None:
    """A trial with frames and progress is, byte for byte, the trial without."""
    system, told = resolve(name), []
    alone = system.run(small(system), 8)
    watched = system.run(small(system), 8, frames_every=0.7, watch=lambda *seconds: told.append(seconds))
    require(bytes_of(watched) == bytes_of(alone), "a run with frames differs from one without")
    require(alone.frames is None and watched.frames is not None, "frames come when asked for, and only then")
    ended: Any = alone.outcome.get("duration_s")
    require(told and ended is not None, "a run tells how far it is, and its row has duration_s")
    require(abs(told[-1][0] - float(ended)) < 1e-6, f"told to end at {told[-1][0]} s, duration_s is {ended}")


def looks_of_any_length(name: str) -> None:
    """The trial is the same whether it is advanced by 1, 37, 100 or 10,000 cycles at a time."""
    system = resolve(name)
    for look in (1, 37, 10_000):
        logs, states = [], []
        for length in (100, look):
            state = begun(system, small(system), 9)
            state.clock[0].last_cycle = min(4000, int(state.clock[0].last_cycle))
            logs.append(simulate(lambda state, cycles: advanced(system, state, cycles), state, look=length))
            states.append(state)
        require(logs[0].tobytes() == logs[1].tobytes(), f"looks of {look} cycles give other events than looks of 100")
        found = differences(states[0]._replace(events=states[1].events), states[1])
        require(not found, f"looks of {look} cycles give another state: {', '.join(found[:5])}")


def storage_does_not_matter(name: str) -> None:
    """Where robots are kept in memory does not matter: everything is ordered by keys that travel with them."""
    system = resolve(name)
    parameters = system.configure()
    count = len(begun(system, parameters, 4).robots)
    length = length_of(system, parameters, 4, 6000)
    for storage in (np.arange(count)[::-1], np.random.default_rng(1).permutation(count)):
        plain, mixed = begun(system, parameters, 4), begun(system, parameters, 4, storage=storage)
        require(mixed.robots.key[storage].tolist() == plain.robots.key.tolist(), "begin ignores storage")
        logs = []
        for state in (plain, mixed):
            state.clock[0].last_cycle = length
            logs.append(simulate(lambda state, cycles: advanced(system, state, cycles), state))
        require(logs[1].tobytes() == logs[0].tobytes(), "robots stored in another order give other events")
        for part in ("robots", "memories", "commands"):
            found = differences(getattr(plain, part), getattr(mixed, part)[storage])
            require(not found, f"robots stored in another order: {part}{found[:1]} differ; does one rely on its index?")
        require(not differences(plain.world.bodies, mixed.world.bodies[storage]), "bodies depend on storage")
