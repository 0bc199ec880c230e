"""The cases measured in the reference simulator (docs/choices.md), and closed formulas of mechanics."""

import math

import numpy as np
import pytest

from formicarium.physics.world import box, chain, make_bodies, make_world
from physics.flat_scenes import DISC, discs, overlaps, run

WALL = chain([(0.3, -2.0), (0.3, 2.0)])
NEAR = {"abs": 0.002}  # m
FAST = {"rel": 0.05}


def test_from_rest_a_disc_covers_8_125_mm_and_then_10_mm_a_cycle():
    world = make_world(discs([(0, 0)], forward=0.1))
    covered = [float(run(world, 0.1).bodies.x[0]) for _ in range(4)]
    assert covered == pytest.approx([0.008125, 0.018125, 0.028125, 0.038125], abs=1e-12)


def test_a_spin_loses_its_first_substep_only():
    world = make_world(discs([(0, 0)], turning=0.1 / 0.053))
    turned = [float(run(world, 0.1).bodies.heading[0]) for _ in range(2)]
    assert turned == pytest.approx([0.169811, 0.169811 + 0.188679], abs=1e-6)


def test_an_arc_follows_the_heading_at_the_start_of_each_cycle():
    body = run(make_world(discs([(0, 0)], forward=0.075, turning=0.05 / 0.053)), 0.2).bodies[0]
    assert (body.x, body.y, body.heading) == pytest.approx((0.013851, 0.000572, 0.179245), abs=1e-6)


def test_a_wall_stops_a_disc_for_ever():
    world = run(make_world(discs([(0, 0)], forward=0.1), WALL), 4)
    assert world.bodies.x[0] == pytest.approx(0.265125, abs=0.0002)
    assert run(world, 60).bodies.x[0] == pytest.approx(0.265125, abs=0.0002)
    assert abs(world.bodies.speed_x[0]) < 1e-6


def test_a_wall_stops_a_disc_larger_than_the_scenery_lists_reach():
    world = run(make_world(discs([(0, 0)], forward=0.1, radius=0.2), WALL), 4)
    assert world.bodies.x[0] == pytest.approx(0.1, abs=0.0002)


def test_two_discs_head_on_stop_each_other():
    world = run(make_world(discs([(0, 0), (0.3, 0)], [0, math.pi], 0.1)), 4)
    assert np.ptp(world.bodies.x) - 0.07 == pytest.approx(-0.00025, abs=0.0003)
    assert np.abs(world.bodies.speed_x).max() < 1e-6


def test_a_pusher_shares_its_speed_with_a_disc_that_holds_still():
    world = run(make_world(discs([(0, 0), (0.1, 0)], forward=[0.1, 0.0])), 2)
    assert world.bodies.speed_x == pytest.approx([0.05, 0.05], rel=1e-6)
    # Chipmunk's law of motion: 10 cm/s until they touch, 5 cm/s from then on.
    touched = 0.1 + (0.03 - 0.008125) / 0.1
    assert world.bodies.x[1] == pytest.approx(0.1 + 0.05 * (2 - touched), **NEAR)


def test_a_pusher_pins_a_disc_to_a_wall():
    world = run(make_world(discs([(0, 0), (0.2, 0)], forward=[0.1, 0.0]), WALL), 10)
    assert world.bodies.x == pytest.approx([0.195, 0.265], abs=0.0006)
    assert np.abs(world.bodies.speed_x).max() < 1e-6


def test_at_45_degrees_into_a_wall_friction_slows_the_slide_to_6_576_cm_s():
    world = run(make_world(discs([(0, 0)], math.pi / 4, 0.1), WALL), 6)
    assert world.bodies.speed_y[0] == pytest.approx(0.06576, rel=1e-3)
    assert world.bodies.heading[0] == pytest.approx(math.pi / 4)


def test_overlapping_discs_part_without_gaining_speed():
    world = make_world(discs([(0, 0), (0.06, 0)]))
    assert overlaps(world) == pytest.approx(0.01)
    assert overlaps(run(world, 0.1)) == pytest.approx(0.0099 * (0.9**60) ** 0.1 + 0.0001, rel=1e-6)
    assert overlaps(run(world, 2)) < 0.0002
    assert np.abs(world.bodies.speed_x).max() == 0.0
    assert world.bodies.x.sum() == pytest.approx(0.06)


def test_two_undriven_discs_meet_centrally_and_share_their_momentum():
    bodies = discs([(0, 0), (0.2, 0)], speed_x=[0.2, -0.1], mass=[0.4, 0.9], force_limit=0, torque_limit=0)
    world = run(make_world(bodies), 2)
    assert world.bodies.speed_x == pytest.approx([(0.4 * 0.2 - 0.9 * 0.1) / 1.3] * 2, rel=1e-9)


@pytest.mark.parametrize("aside", [0.01, 0.03, 0.06])
def test_two_undriven_frictionless_discs_meet_aslant_and_keep_their_momentum(aside):
    bodies = discs([(0, 0), (0.2, aside)], speed_x=[0.2, -0.1], mass=[0.4, 0.9], force_limit=0, torque_limit=0)
    momentum, energy = np.sum(bodies.mass * bodies.speed_x), np.sum(bodies.mass * bodies.speed_x**2)
    after = run(make_world(bodies, friction=0.0), 2).bodies
    assert np.sum(after.mass * after.speed_x) == pytest.approx(momentum, rel=1e-12)
    assert np.sum(after.mass * after.speed_y) == pytest.approx(0.0, abs=1e-15)
    assert np.sum(after.mass * (after.speed_x**2 + after.speed_y**2)) < energy
    assert after.turn_rate.tolist() == [0.0, 0.0] and after.speed_y[0] < 0.0 < after.speed_y[1]


def test_a_rolling_start_keeps_angular_momentum():
    bodies = discs([(0, 0), (0.0701, 0.03)], speed_x=[0.2, 0], force_limit=0, torque_limit=0)
    about_origin = lambda b: np.sum(b.inertia * b.turn_rate + b.mass * (b.x * b.speed_y - b.y * b.speed_x))  # noqa: E731
    before = about_origin(bodies)
    after = run(make_world(bodies), 1).bodies
    assert np.abs(after.turn_rate).min() > 0.01
    # Impulses act on two rims a little apart while discs overlap: a share of slop / radius is lost.
    assert about_origin(after) == pytest.approx(before, abs=0.03 * 0.4 * 0.2 * 0.03)


@pytest.mark.parametrize("speed", [0.05, 0.1, 0.3])
def test_a_passive_disc_slides_v_squared_over_2a(speed):
    floor = 0.02  # share of its weight: force_limit = floor * mass * 9.81
    world = run(make_world(discs([(0, 0)], speed_x=speed, force_limit=floor * 0.4 * 9.81)), 3)
    # Position with the old speed: one sub-step of half the speed is added to the textbook's way.
    assert world.bodies.x[0] == pytest.approx(speed**2 / (2 * floor * 9.81) + speed * 0.005, abs=1e-4)
    assert world.bodies.speed_x[0] == 0.0


def test_a_pushed_passive_disc_moves_along_and_stops_when_left_alone():
    passive = 0.1 * 0.2 * 9.81  # N: friction coefficient 0.1 under 0.2 kg
    bodies = discs([(0, 0), (0.15, 0)], forward=[0.1, 0], mass=[0.4, 0.2], force_limit=[1.5, passive])
    world = run(make_world(bodies), 2)
    assert world.bodies.speed_x == pytest.approx([0.1, 0.1], rel=1e-6)
    world.bodies.forward[0] = -0.1
    start = world.bodies.x[1]
    run(world, 2)
    # It is let go at a speed that the pusher's own braking (3.75 m/s2) has not yet changed.
    assert world.bodies.x[1] - start == pytest.approx(0.1**2 / (2 * 0.981) + 0.0005, abs=0.001)


def test_a_disc_slides_along_a_box_and_past_its_corner():
    side = box(0.3, 0.0, 0.0, 0.2, 0.2)
    world = run(make_world(discs([(0.1, 0.08)], math.radians(20), 0.1), side), 8)
    body = world.bodies[0]
    assert body.x > 0.5 and body.y > 0.135
    assert body.speed_x == pytest.approx(0.1 * math.cos(math.radians(20)), rel=1e-3)


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("x", math.nan, "x must be finite"),
        ("radius", 0.0, "radius must be positive"),
        ("mass", -1.0, "mass must be positive"),
        ("force_limit", -1.0, "force_limit must not be negative"),
        ("key", 7, "every key must be different"),
    ],
)
def test_impossible_bodies_are_refused(field, value, complaint):
    bodies = discs([(0, 0), (1, 0)])
    bodies[field] = value
    with pytest.raises(ValueError, match=complaint):
        make_world(bodies)


def test_misspelt_and_impossible_settings_are_refused():
    with pytest.raises(ValueError, match="no setting is called sloppiness"):
        make_world(discs([(0, 0)]), sloppiness=1)
    with pytest.raises(ValueError, match="substeps must be positive"):
        make_world(discs([(0, 0)]), substeps=0)
    with pytest.raises(ValueError, match="reach must cover two bodies"):
        make_world(discs([(0, 0)]), reach=0.1)
    with pytest.raises(ValueError, match="has no weight"):
        make_bodies(1, **DISC, weight=1)
    with pytest.raises(ValueError, match="at least one"):
        make_world(make_bodies(0))
    with pytest.raises(ValueError, match="must have a length"):
        make_world(discs([(0, 0)]), chain([(1, 1), (1, 1)]))
