"""A system that no viewer has heard of: fireflies that fly in circles and flash, in plain Python without a world.

Its name for the registry is "fireflies:FIREFLIES".
"""

from typing import NamedTuple

import numpy as np
from pydantic import BaseModel, Field

from formicarium.systems.registry import System, Targets
from formicarium.trial.events import CLOCK, write_event
from formicarium.trial.film import frames_of, make_film
from formicarium.trial.record import EVENT, Polygon, Scene, Timeline, Trial
from formicarium.trial.simulate import drain
from formicarium.trial.watching import Impossible, Inspection, Section, Watching

FLY = np.dtype(
    [(name, "i8") for name in ("identity", "alive", "phase")] + [(name, "f8") for name in ("x", "y", "turn")]
)
HEDGE = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])


class Meadow(BaseModel):
    flies: int = Field(8, ge=1, le=100)
    cycles: int = Field(2000, ge=1)


class State(NamedTuple):
    clock: np.recarray
    robots: np.recarray
    lamp: np.recarray
    events: np.recarray


def begin(parameters, seed, *, storage=None):
    draws = np.random.default_rng(seed)
    count = parameters.flies
    clock, robots, lamp = (np.zeros(n, kind).view(np.recarray) for n, kind in ((1, CLOCK), (count, FLY), (1, LAMP)))
    clock.last_cycle = parameters.cycles
    robots.identity, robots.alive = np.arange(1, count + 1), 1
    robots.x, robots.y = draws.uniform(-0.8, 0.8, (2, count))
    robots.turn, robots.phase = draws.uniform(-3, 3, count), draws.integers(0, 50, count)
    return State(clock, robots, lamp, np.zeros(100 * count, EVENT).view(np.recarray))


LAMP = np.dtype([("blocked", "i8")])


def advance(state, cycles):
    clock, flies = state.clock[0], state.robots
    for _ in range(cycles):
        awake = flies.alive == 1
        flies.turn[awake] += 0.1
        flies.x[awake] += 0.01 * np.cos(flies.turn[awake])
        flies.y[awake] += 0.01 * np.sin(flies.turn[awake])
        flies.phase[awake] = (flies.phase[awake] + 1) % 50
        for identity in flies.identity[awake & (flies.phase == 0)]:
            write_event(clock, state.events, 0, identity, 0, 0, 0)
        clock.cycle += 1


def scene(parameters, state):
    polygons = (Polygon(HEDGE, "wall"), Polygon(0.1 * HEDGE, "yellow"))
    return Scene(polygons, 0.04, ("dark", "flashing", "gone"), 0.1, (("sight", 0.3),))


def shoot(state, film):
    moment = film.taken[0]
    film.cycle[moment] = state.clock[0].cycle
    for name, values in (("x", state.robots.x), ("y", state.robots.y), ("heading", state.robots.turn)):
        film.shots[name][moment] = values
    film.shots["role"][moment] = np.where(state.robots.alive == 0, 2, state.robots.phase < 5)
    film.shots["place"][moment] = film.shots["after"][moment] = -1
    film.lit[moment, 0] = 1 - state.lamp[0].blocked
    film.taken[0] += 1


def roll(state, cycles, every, film):
    for _ in range(cycles):
        if film.taken[0] == len(film.cycle):
            return
        advance(state, 1)
        if state.clock[0].cycle % every == 0:
            shoot(state, film)


def inspect(state, identity):
    fly = state.robots[identity - 1]
    return Inspection(identity, "a firefly", (Section("Mind", ("field", "value"), (("phase", str(fly.phase)),)),))


def tell(event):
    return f"firefly {event['robot']} flashes"


def intervene(state, intervention):
    if intervention.deed in ("block", "unblock"):
        state.lamp[0].blocked = intervention.deed == "block"
    elif intervention.deed == "kill":
        state.robots[intervention.subject - 1].alive = 0
    else:
        raise Impossible("fireflies cannot be caught")


def outcome(parameters, state, events):
    return {"flashes": len(events), "duration_s": float(state.clock[0].cycle) / 10}


def run(parameters, seed, *, frames_every=None, watch=None):
    state = begin(parameters, seed)
    film = make_film(parameters.cycles + 1, parameters.flies, scene(parameters, state))
    shoot(state, film)
    logs = []
    while state.clock[0].cycle < parameters.cycles:
        roll(state, min(100, parameters.cycles - int(state.clock[0].cycle)), 5, film)
        logs.append(drain(state))
    events = np.concatenate(logs)
    return Trial(
        outcome(parameters, state, events), events, frames_of(film, state.robots.identity), scene(parameters, state)
    )


FIREFLIES = System(
    name="fireflies",
    summary="Insects that flash; a stand-in for tests",
    parameters=Meadow,
    configure=lambda setting=None, robots=None: Meadow(flies=robots or 8),
    run=run,
    kinds=("flash",),
    targets=Targets({}, {}, "", 0.0),
    timeline=lambda trial: Timeline((), (), (), (), 200.0),
    begin=begin,
    advance=advance,
    watching=Watching(scene, shoot, roll, inspect, tell, intervene, outcome),
)
