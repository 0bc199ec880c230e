"""Microseconds per body-step of the flat world: discs that wander in a hexagon and turn away from each other.

    python benchmarks/physics.py

Prints for each scene the cost of one body in one control cycle (10 sub-steps), of moving alone and of seeing:
eight beams of 0.05 m, and the lines of sight to all neighbours within 0.82 m.
"""

import importlib.util
import time
from pathlib import Path

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.grid import find_neighbours
from formicarium.physics.rays import bodies_in_line_of_sight, cast, look_round
from formicarium.physics.step import step
from formicarium.streams import advanced, derived, uniform

# The tests' own scene. It cannot be imported by name: this file is called physics, too.
PLACE = Path(__file__).parents[1] / "tests" / "physics" / "flat_scenes.py"
SPECIFICATION = importlib.util.spec_from_file_location("flat_scenes", PLACE)
flat_scenes = importlib.util.module_from_spec(SPECIFICATION)
SPECIFICATION.loader.exec_module(flat_scenes)

ANGLES = np.radians(11.25 + 45.0 * np.arange(8))
COSINES, SINES = np.cos(ANGLES), np.sin(ANGLES)
# Bodies, side of the hexagon (m).
SCENES = ((20, 0.9), (40, 0.9), (40, 1.8), (160, 3.6), (216, 3.6), (1000, 8.0))


@compiled
def wander(world, cycles, moment):
    """Run the world; a body with another close ahead, or held up, turns on the spot for about two seconds."""
    for cycle in range(cycles):
        for i in range(len(world.bodies)):
            body = world.bodies[i]
            moment = advanced(moment)
            if body.forward > 0.0:
                slow = body.speed_x * body.speed_x + body.speed_y * body.speed_y < 0.0064
                stop = slow and cycle > 5
                for k in range(world.neighbour_count[i]):
                    near = world.neighbours[i, k]
                    if near.distance < 0.11 and near.dx * body.speed_x + near.dy * body.speed_y > 0.0:
                        stop = True
                if stop:
                    body.forward = 0.0
                    body.turning = 1.0 if uniform(moment) < 0.5 else -1.0
            elif uniform(moment) < 0.05:
                body.forward = 0.1
                body.turning = 0.0
        step(world)
        find_neighbours(world)
    return moment


@compiled
def look(world, cycles, distances, cosines, sines):
    """Cast the beams of every body, many times over."""
    total = 0.0
    for _ in range(cycles):
        for i in range(len(world.bodies)):
            cast(world, i, 0.036, 0.05, cosines, sines, distances)
            total += distances[0]
    return total


@compiled
def see(world, cycles):
    """Ask for the line of sight from every body to all its neighbours, many times over."""
    seen = 0
    for _ in range(cycles):
        for i in range(len(world.bodies)):
            look_round(world, i)
            for k in range(world.neighbour_count[i]):
                if bodies_in_line_of_sight(world, i, k):
                    seen += 1
    return seen


def timed(work, cycles, count, *arguments):
    """Return microseconds per body-step: the best of three."""
    best = np.inf
    for _ in range(3):
        start = time.perf_counter()
        work(*arguments)
        best = min(best, time.perf_counter() - start)
    return 1e6 * best / (cycles * count)


def main():
    distances = np.zeros(8)
    moment = derived(np.uint64(1), 0)
    start = time.perf_counter()
    world = flat_scenes.hexagon(20, 0.9)
    moment = wander(world, 1, moment)
    look(world, 1, distances, COSINES, SINES)
    see(world, 1)
    print(f"compiled or loaded in {time.perf_counter() - start:.1f} s")
    print("bodies  side m  touching %  neighbours |  step+neighbours  neighbours  beams  sight   µs/body-step")
    for count, side in SCENES:
        world = flat_scenes.hexagon(count, side)
        cycles = max(20, 100_000 // count)
        moment = wander(world, 600, moment)
        moving = timed(wander, cycles, count, world, cycles, moment)
        finding = timed(only_neighbours, cycles, count, world, cycles)
        looking = timed(look, cycles, count, world, cycles, distances, COSINES, SINES)
        seeing = timed(see, cycles, count, world, cycles)
        touching = 100.0 * np.mean(world.solver.motions.touched[:count] * world.solver.motions.involved[:count])
        print(
            f"{count:6d}  {side:6.2f}  {touching:10.0f}  {world.neighbour_count.mean():10.1f} |"
            f"  {moving:15.3f}  {finding:10.3f}  {looking:5.3f}  {seeing:5.3f}"
        )


@compiled
def only_neighbours(world, cycles):
    """Rebuild the neighbour lists, many times over."""
    for _ in range(cycles):
        find_neighbours(world)


if __name__ == "__main__":
    main()
