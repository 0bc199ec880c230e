"""Any system with failures: its name and what fails, ``mark-i3+kill:3@120+block:0@300``.

kill:ROBOT@SECONDS   robot number 1..N dies (numbers, not identities: those are drawn from the seed)
block:DEVICE@SECONDS, unblock:DEVICE@SECONDS   a booth goes dark and mute, or works again; numbered from 0 as drawn
rate:R               every robot dies at the rate R per second, by a random stream of its own

Such a name goes wherever that of a system goes: run, watch, campaigns, studies. Failures are part of a run's identity.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from formicarium.streams import generator
from formicarium.systems.registry import System, Targets, UnknownSystem
from formicarium.trial.film import Film, frames_of, make_film
from formicarium.trial.record import Trial
from formicarium.trial.simulate import simulate
from formicarium.trial.watching import Impossible, Intervention

DEEDS = ("kill", "block", "unblock")


class Failure(NamedTuple):
    """Something that fails, or works again."""

    deed: str  # of DEEDS, or "rate"
    subject: int  # robot from 1, device from 0
    value: float  # seconds; for a rate 1/s


def read_failures(texts: list[str], said: str) -> tuple[Failure, ...]:
    """Return the failures of a name's parts after the first "+".

    Raises:
        UnknownSystem: if one cannot be read; says how they are written.
    """
    found = []
    for text in texts:
        deed, _, rest = text.partition(":")
        subject, _, seconds = rest.partition("@")
        try:
            failure = Failure(deed, 0, float(rest)) if deed == "rate" else Failure(deed, int(subject), float(seconds))
        except ValueError:
            failure = Failure("", 0, 0.0)
        if failure.deed not in (*DEEDS, "rate") or not 0 <= failure.value < 1e9 or failure.subject < (deed == "kill"):
            raise UnknownSystem(
                f"{said}: cannot read {text!r}: failures are +kill:ROBOT@SECONDS, +block:DEVICE@SECONDS, "
                "+unblock:DEVICE@SECONDS, +rate:DEATHS_PER_SECOND"
            )
        found.append(failure)
    return tuple(found)


def failing(system: System, texts: list[str]) -> System:
    """Return the system with failures.

    Raises:
        UnknownSystem: if they cannot be read, or the system does not show its states.
    """
    name = "+".join([system.name, *texts])
    failures = read_failures(texts, name)
    if system.begin is None or system.advance is None or system.watching is None:
        raise UnknownSystem(f"{name}: {system.name} has no begin, advance and watching, so nothing can fail in it")
    plain_begin, plain_advance, watching = system.begin, system.advance, system.watching

    def begin(parameters: Any, seed: int, **options: Any) -> Any:
        state = plain_begin(parameters, seed, **options)
        cycle_time = watching.scene(parameters, state).cycle_time
        for failure in failures:
            if failure.deed == "rate" and failure.value > 0:
                lives = generator(seed, "failures by rate").exponential(1.0 / failure.value, len(state.robots))
                for key, seconds in enumerate(lives):
                    die(state, key, int(min(seconds / cycle_time, 1e12)))
            elif failure.deed == "kill":
                if failure.subject > len(state.robots):
                    raise ValueError(f"{name}: there is no robot {failure.subject}, they are 1 to {len(state.robots)}")
                die(state, failure.subject - 1, round(failure.value / cycle_time))
            else:
                try:
                    watching.intervene(plain_begin(parameters, seed), Intervention(0, failure.deed, failure.subject))
                except Impossible as error:
                    raise ValueError(f"{name}: {error}") from error
        return state

    def due(state: Any) -> dict[int, list[Failure]]:
        cycle_time = float(np.asarray(state.world.settings["cycle_time"])[0])
        found: dict[int, list[Failure]] = {}
        for failure in failures:
            if failure.deed in ("block", "unblock"):
                found.setdefault(round(failure.value / cycle_time), []).append(failure)
        return found

    def advance(state: Any, cycles: int) -> None:
        clock, changes = state.clock[0], due(state)
        end = int(clock.cycle) + cycles
        while clock.cycle < end and not clock.finished:
            now = int(clock.cycle)
            for failure in changes.get(now, ()):
                watching.intervene(state, Intervention(now, failure.deed, failure.subject))
            plain_advance(state, min([end, *(cycle for cycle in changes if cycle > now)]) - now)

    def roll(state: Any, cycles: int, every: int, film: Film) -> None:
        clock = state.clock[0]
        end = clock.cycle + cycles
        while clock.cycle < end and not clock.finished and film.taken[0] < len(film.cycle):
            advance(state, int(min(end - clock.cycle, every - clock.cycle % every)))
            if clock.cycle % every == 0:
                watching.shoot(state, film)

    def run(
        parameters: Any,
        seed: int,
        *,
        frames_every: float | None = None,
        watch: Callable[[float, float], None] | None = None,
    ) -> Trial:
        state = begin(parameters, seed)
        scene = watching.scene(parameters, state)
        every = 1 if frames_every is None else max(1, round(frames_every / scene.cycle_time))
        room = 2 + int(state.clock[0].last_cycle) // every if frames_every is not None else 1
        film = make_film(room, len(state.robots), scene)
        take = None if frames_every is None else lambda state: watching.shoot(state, film)
        try:
            events = simulate(advance, state, every=every, take=take, watch=watch)
        except Exception as error:
            if system.explained is None:
                raise
            raise system.explained(parameters, seed, int(state.clock[0].cycle), error, texts) from error
        frames = None if frames_every is None else frames_of(film, np.asarray(state.robots["identity"]))
        return Trial(watching.outcome(parameters, state, events), events, frames, scene)

    run.__wrapped__ = system.run  # type: ignore[attr-defined]  # the sources of a run are the system's
    return system._replace(
        name=name,
        summary=f"{system.summary}; with failures: {', '.join(texts)}",
        run=run,
        begin=begin,
        advance=advance,
        targets=Targets(system.targets.columns, {}, "", system.targets.published_cap),
        watching=watching._replace(roll=roll),
        onboard=None,
    )


def die(state: Any, key: int, cycle: int) -> None:
    """Let the robot with a key die at a cycle, unless it dies earlier anyway."""
    i = int(np.nonzero(np.asarray(state.robots["key"]) == key)[0][0])
    before = int(state.robots[i].dies_at)
    state.robots[i].dies_at = cycle if before < 0 else min(before, cycle)
