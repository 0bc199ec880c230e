"""Figures 4 to 6 from the implementation: a cache of booths, the states of a pair, the arena."""

import math
from collections.abc import Sequence

import numpy as np

from formicarium.devices.booth import BACK_BARRIER, BAY_END, BAY_HALF_WIDTH, FRONT_BARRIER, HALF, placed
from formicarium.devices.cache_pair import PAIR, Pair, came_in, colour_of, went_out
from formicarium.devices.depot import Place
from formicarium.physics.floor import corners
from formicarium.physics.records import records
from formicarium.robots.records import Colour
from formicarium.studies.diagram import Area, Disc, Mark, Plan, Plans
from formicarium.systems.partitioning.arena import Arena, make_arena
from formicarium.systems.partitioning.parameters import PartitioningParameters, partitioning_parameters
from formicarium.systems.partitioning.setup import begin

SEED = 110001
DARK = "#55595f"
INSIDE = -0.005  # m, depth at which the robots of Fig. 5 stand in their bays: over the back barrier, off the front one


def figure_4(parameters: PartitioningParameters | None = None) -> Plans:
    """Return the cache: pairs of booths with their light barriers and lights."""
    p = parameters or partitioning_parameters()
    arena, state = make_arena(p.arena), begin(p, SEED)
    booths = [k for k, place in enumerate(arena.places) if place in (Place.CACHE_DROP, Place.CACHE_PICK)]
    lights = [(float(state.lights[k].x), float(state.lights[k].y), DARK) for k in booths]
    barriers = [(_across(arena, k, depth), DARK) for k in booths for depth in (FRONT_BARRIER, BACK_BARRIER)]
    front, back = (_in_booth(arena, booths[0], depth, BAY_HALF_WIDTH) for depth in (FRONT_BARRIER, BACK_BARRIER))
    last = p.arena.cache_pairs - 1
    gap = _in_booth(arena, booths[last], 0.0, HALF)
    marks = [
        Mark("front barrier", *front, shift=(-0.13, 0.09)),
        Mark("back barrier: behind it\na robot is inside", *back, shift=(0.0, 0.15)),
        Mark("light", *lights[0][:2], shift=(0.12, 0.13)),
        Mark(
            f"bay {200 * BAY_HALF_WIDTH:.0f} cm wide",
            *_in_booth(arena, booths[last], FRONT_BARRIER, 0.0),
            shift=(-0.14, -0.10),
        ),
        Mark(
            f"pitch {100 * p.arena.booth_pitch:.0f} cm",
            gap[0],
            gap[1] + 0.5 * p.arena.booth_pitch - HALF,
            shift=(-0.2, 0.0),
        ),
    ]
    box = _round(np.array([[x, y] for x, y, _ in arena.booths[booths]]), HALF + 0.16)
    robot = _in_booth(arena, booths[1], INSIDE, 0.0)
    disc = Disc(*robot, heading=float(arena.booths[booths[1]][2]), loaded=True)
    plan = Plan("", _booth_areas(arena, booths), [disc], marks, barriers, lights, box)
    note = "source to the left, nest to the right; an array of source or nest is one side of it"
    return Plans("Fig. 4: an array of booths", note, [plan], p.epuck.radius, 8.5)


def figure_5(parameters: PartitioningParameters | None = None) -> Plans:
    """Return what one pair goes through, as the automaton has it: four states and, red, two visits."""
    p = parameters or partitioning_parameters()
    arena = make_arena(p.arena)
    drop = arena.places.index(Place.CACHE_DROP)
    pick = arena.places.index(Place.CACHE_PICK)
    pair, occupied = records(PAIR, 1)[0], [0, 0]
    plans: list[Plan] = []

    def shoot(title: str, discs: Sequence[Disc]) -> None:
        colours = [Colour(colour_of(pair, side, occupied[side])).name.lower() for side in (0, 1)]
        areas = _booth_areas(arena, (drop, pick), dict(zip((drop, pick), colours, strict=True)))
        box = _round(arena.booths[[drop, pick], :2], HALF + 0.07)
        state = Pair(int(pair.state)).name
        plans.append(Plan(f"({'abcdef'[len(plans)]}) {state}: {title}", areas, discs, box=box))

    def standing(booth: int, depth: float, loaded: bool, out: bool) -> Disc:
        way = float(arena.booths[booth, 2]) + (math.pi if out else 0.0)
        return Disc(*_in_booth(arena, booth, depth, 0.0), way, loaded)

    before = -HALF - 0.045
    shoot("free for an object", [standing(drop, before, True, False)])
    came_in(pair, 0)
    occupied[0] = 1
    shoot("a robot inside drops it", [standing(drop, INSIDE, False, False)])
    went_out(pair, 0)
    occupied[0] = 0
    shoot("the object waits", [standing(drop, before, False, True), standing(pick, before, False, False)])
    came_in(pair, 1)
    occupied[1] = 1
    shoot("a robot inside takes it", [standing(pick, INSIDE, True, False)])
    went_out(pair, 1)
    occupied[1] = 0
    shoot("free again", [standing(pick, before, True, True)])
    note = "source side left, nest side right; dark sides grey; arrow: way the robot faces; black: with an object"
    return Plans("Fig. 5: a pair of the cache", note, plans, p.epuck.radius, 5.2)


def figure_6(parameters: PartitioningParameters | None = None) -> Plans:
    """Return the arena with its floor, path, lamp and booths, and ten robots where they start."""
    p = parameters or partitioning_parameters()
    arena, state = make_arena(p.arena), begin(p, SEED)
    areas = [Area(arena.corners, "arena")]
    areas += [Area(corners(patch), f"floor {patch.shade:.2f}") for patch in arena.floor]
    areas += [Area(points, "wall") for points in arena.solids]
    shown = {Place.SOURCE: "green", Place.NEST: "blue", Place.CACHE_DROP: "blue", Place.CACHE_PICK: "off"}
    areas += _booth_areas(arena, range(len(arena.places)), {k: shown[Place(v)] for k, v in enumerate(arena.places)})
    bodies = state.world.bodies
    discs = [Disc(float(b.x), float(b.y), float(b.heading), False) for b in bodies]
    width, height, t = p.arena.width, p.arena.height, p.arena
    marks = [
        Mark("source", 0.06, height - 0.33, (-0.24, 0.0)),
        Mark("nest", width - 0.06, height - 0.33, (0.24, 0.0)),
        Mark("cache", 0.5 * width, height - t.cache_top, (0.0, t.cache_top + 0.09)),
        Mark("path", 0.5 * t.leg_width, 0.5 * t.bottom_width + 0.5, (-0.45, 0.0)),
        Mark("corridor", 0.75 * width, 0.5 * t.bottom_width - 0.12, (0.65, -0.13)),
        Mark("lamp", *arena.lamp, shift=(0.0, -0.11)),
    ]
    box = (-0.42, -0.2, width + 0.42, height + 0.18)
    plan = Plan("", areas, discs, marks, dots=[(*arena.lamp, "#e8c400")], box=box)
    note = f"{width:g} m by {height:g} m; ten robots where they start (seed {SEED}), the cache empty"
    return Plans("Fig. 6: the arena", note, [plan], p.epuck.radius, 2.6)


def _booth_areas(arena: Arena, booths: Sequence[int], colours: dict[int, str] | None = None) -> list[Area]:
    """Return the walls of booths, and the bays in what they show."""
    areas = []
    for k in booths:
        own = arena.segments[arena.segments.group == k + 1]
        colour = (colours or {}).get(k, "off")
        bay = [(-HALF, -BAY_HALF_WIDTH), (BAY_END, -BAY_HALF_WIDTH), (BAY_END, BAY_HALF_WIDTH), (-HALF, BAY_HALF_WIDTH)]
        points = np.array([_in_booth(arena, k, depth, side) for depth, side in bay])
        areas.append(Area(points, "#e6e4df" if colour == "off" else colour))
        areas.append(Area(np.stack([own.ax, own.ay], axis=1), "wall"))
    return areas


def _in_booth(arena: Arena, booth: int, depth: float, side: float) -> tuple[float, float]:
    """Return a place given in a booth's frame."""
    x, y, way = (float(number) for number in arena.booths[booth])
    return placed(x, y, way, depth, side)


def _across(arena: Arena, booth: int, depth: float) -> np.ndarray:
    """Return the ends of a line across a bay."""
    return np.array([_in_booth(arena, booth, depth, side) for side in (-BAY_HALF_WIDTH, BAY_HALF_WIDTH)])


def _round(points: np.ndarray, margin: float) -> tuple[float, float, float, float]:
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
