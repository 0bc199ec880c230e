"""Physical honesty (T3, T21, T30): no overlap, no overspeed, no way through walls, and who is hit moves."""

from typing import NamedTuple

import numpy as np
import pytest

from formicarium.devices.booth import BAY_HALF_WIDTH, HALF
from formicarium.physics.grid import find_neighbours
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.phases import move

OVERLAP = 0.002  # m
STEP = 0.12 * 0.1 + 0.005  # m, speed limit times cycle, and what mending a contact may add
TOUCH = 0.0715  # m between centres: nearer than this two robots may have touched within the cycle
SETTINGS = {"setting 0": {}, "crowded": {"robots": 60}, "booths inside": {"arena": {"tam_offset": 0.12}}}


class Track(NamedTuple):
    """Where everybody was at the end of every cycle of a trial."""

    places: np.ndarray  # (T, N, 2)
    standing: np.ndarray  # (T, N) whether the wheels were commanded to stand in the cycle that ends there
    member: np.ndarray  # (T, N) whether a link or guardian
    state: object


def track(seed, seconds, **parameters):
    state = begin(mark_i3_parameters(**parameters), seed)
    bodies, rows = state.world.bodies, []
    for _ in range(round(10 * seconds) + 1):
        roles = state.memories.role
        standing = (state.commands.left == 0.0) & (state.commands.right == 0.0)
        member = (roles == Role.LINK) | (roles == Role.GUARDIAN)
        rows.append((np.stack([bodies.x, bodies.y], axis=1), standing, member))
        run(state, 1)
        state.clock[0].event_count = 0
    return Track(*(np.array(column) for column in zip(*rows)), state)


def nearest(places):
    """Return how near the nearest other robot was, (T, N)."""
    result = []
    for part in np.array_split(places, max(1, len(places) // 500)):
        gaps = np.hypot(*(part[:, :, None, :] - part[:, None, :, :]).transpose(3, 0, 1, 2))
        gaps[:, np.arange(gaps.shape[1]), np.arange(gaps.shape[1])] = np.inf
        result.append(gaps.min(axis=2))
    return np.concatenate(result)


def distance_to_scenery(places, segments):
    """Return the least distance of any centre to any wall or booth face, m."""
    points, least = places.reshape(-1, 2), np.inf
    for face in segments:
        a, along = np.array([face.ax, face.ay]), np.array([face.bx - face.ax, face.by - face.ay])
        share = np.clip((points - a) @ along / (along @ along), 0.0, 1.0)
        least = min(least, np.hypot(*(a + share[:, None] * along - points).T).min())
    return least


def check_entries(places, booths):
    """Whoever is inside a booth's cube came in over the line of its mouth; return the number of entries."""
    entries = 0
    for booth in booths:
        dx, dy = places[..., 0] - booth.x, places[..., 1] - booth.y
        depth, side = booth.cosine * dx + booth.sine * dy, booth.cosine * dy - booth.sine * dx
        inside = (np.abs(depth) < HALF) & (np.abs(side) < HALF)
        assert not inside[0].any()
        for cycle, i in zip(*np.nonzero(inside[1:] & ~inside[:-1])):
            assert depth[cycle, i] <= -HALF and abs(side[cycle + 1, i]) < BAY_HALF_WIDTH
            entries += 1
        assert (np.abs(side[inside]) <= BAY_HALF_WIDTH - 0.035 + OVERLAP).all()
    return entries


def check(story):
    """Hold a trial to all of it; return how often somebody entered a booth and how often a standing member moved."""
    steps = np.hypot(*np.diff(story.places, axis=0).transpose(2, 0, 1))
    near = nearest(story.places)
    gap = distance_to_scenery(story.places, story.state.world.segments)
    print(f"least distances: {near.min():.5f} m between robots, {gap:.5f} m to walls; longest step {steps.max():.5f} m")
    assert near.min() >= 0.07 - OVERLAP
    assert gap >= 0.035 - OVERLAP
    assert steps.max() <= STEP
    # Walls stand 0.033 m or more from every centre and nobody jumps 0.017 m: no wall was crossed.
    still = story.standing[1:] & story.standing[:-1]
    pushed = still & (steps > 5e-4)
    touched = np.minimum(near[1:], near[:-1]) < TOUCH
    assert not (pushed & ~touched).any()  # who stands still moves only if it is touched
    return check_entries(story.places, story.state.booths), int((pushed & story.member[1:]).sum())


@pytest.mark.parametrize("setting", SETTINGS)
def test_robots_are_solid_and_walls_are_walls(setting):
    check(track(1, 200, **SETTINGS[setting]))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(62001, 62101))  # the reported runs, docs/results/seeds.md
def test_robots_are_solid_and_walls_are_walls_for_a_whole_trial(seed):
    check(track(seed, 2400))


@pytest.mark.long
def test_over_many_trials_robots_enter_booths_and_push_chain_members():
    entries, pushed = zip(*(check(track(seed, 1200)) for seed in range(20, 26)))
    assert sum(entries) > 0 and sum(pushed) > 0


def members():
    """Return a state in which there are links and guardians, and the places in memory of one of each."""
    for seed in range(1, 20):
        state = begin(mark_i3_parameters(), seed)
        for _ in range(60):
            run(state, 100)
            state.clock[0].event_count = 0
            roles = state.memories.role.tolist()
            if Role.LINK in roles and Role.GUARDIAN in roles and Role.RUNNER in roles:
                return state, roles
    raise AssertionError("no chain was begun in twenty trials")


@pytest.mark.parametrize("role", [Role.LINK, Role.GUARDIAN])
def test_a_chain_member_that_is_hit_moves(role):
    """A runner drives into a member whose wheels stand, with nobody else near: both go on at half the speed."""
    state, roles = members()
    hit, runner, bodies = roles.index(role), roles.index(Role.RUNNER), state.world.bodies
    bodies.x, bodies.y = 5.0 + 0.2 * np.arange(len(bodies)), 5.0
    bodies.forward = bodies.turning = bodies.speed_x = bodies.speed_y = bodies.turn_rate = 0.0
    bodies[hit].x, bodies[hit].y = 0.0, 0.0
    bodies[runner].x, bodies[runner].y, bodies[runner].heading, bodies[runner].forward = -0.08, 0.0, 0.0, 0.08
    find_neighbours(state.world)
    for _ in range(20):
        move(state)
    assert bodies[hit].x == pytest.approx(0.5 * 0.08 * 2.0, abs=0.015)
    assert bodies[hit].x - bodies[runner].x == pytest.approx(0.07, abs=0.001)
