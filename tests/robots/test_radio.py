"""The range-and-bearing board: what of the others' words arrives, and how well one can tell from where."""

import math

import numpy as np
import pytest
from scipy.stats import chi2

from formicarium.devices.booth import booth_outline
from formicarium.physics.world import chain
from robots.stage import QUIET, Stage, around

CLEAR = {"radio_loss": 0.0}


def pair(distance, heading=0.0, **epuck):
    """Return a stage on which robot 1, ``distance`` m ahead of robot 0, speaks to all sides."""
    stage = Stage([(0, 0), (distance, 0)], [0.0, heading], **(QUIET | epuck))
    stage.say(1, [1, 2, 3, 4])
    return stage


@pytest.mark.parametrize("distance, heard", [(0.1, 1), (0.7999, 1), (0.8, 0), (0.8001, 0), (1.5, 0)])
def test_packets_arrive_from_nearer_than_the_range_only(distance, heard):
    assert len(pair(distance).hear()) == heard


def test_the_four_bytes_arrive_as_sent():
    stage = pair(0.4)
    for payload in ([0, 0, 0, 0], [255, 255, 255, 255], [1, 128, 64, 254]):
        stage.say(1, payload)
        assert stage.hear()[0].payload.tolist() == payload


def test_without_noise_distance_is_centre_to_centre_and_bearing_from_the_heading():
    stage = Stage([(0.1, 0.2), (0.1, 0.6), (-0.2, 0.2)], [math.pi / 2, 1.0, 2.0], **QUIET)
    stage.say(1, [1, 0, 0, 0])
    stage.say(2, [2, 0, 0, 0])
    packets = {int(packet.payload[0]): packet for packet in stage.hear()}
    assert (packets[1].distance, packets[1].bearing) == pytest.approx((0.4, 0.0))
    assert (packets[2].distance, packets[2].bearing) == pytest.approx((0.3, math.pi / 2))


@pytest.mark.parametrize("heading", [0.0, 0.7, -2.9, 40.0])
@pytest.mark.parametrize("off", [0.0, -14.9, 14.9])
def test_twelve_emitters_with_separate_contents_reach_the_robots_in_their_sectors(heading, off):
    places = around(12, 0.5, heading + math.radians(off))
    stage = Stage([(0, 0), *places], [heading] + [0.3] * 12, **QUIET)
    stage.say(0, [[emitter, 2 * emitter, 7, 0] for emitter in range(12)])
    for k in range(12):
        packets = stage.hear(k + 1)
        assert [packet.payload.tolist() for packet in packets] == [[k, 2 * k, 7, 0]]


def test_an_emitter_that_is_off_leaves_its_sector_silent():
    stage = Stage([(0, 0), *around(12, 0.5)], 0.0, **QUIET)
    stage.say(0, [9, 9, 9, 9], emitters=[0, 4])
    assert [len(stage.hear(k + 1)) for k in range(12)] == [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]


def test_a_body_between_two_robots_is_silence():
    stage = Stage([(0, 0), (0.5, 0), (0.25, 0.0)], 0.0, **QUIET)
    stage.say(1, [1, 0, 0, 0])
    for y, heard in ((0.0, 0), (0.0349, 0), (-0.0349, 0), (0.0351, 1), (-0.0351, 1)):
        stage.put(2, 0.25, y)
        assert len(stage.hear()) == heard
    for x in (-0.2, 0.7):  # behind either of them it is in nobody's way
        stage.put(2, x, 0.0)
        assert len(stage.hear()) == 1


def test_booth_walls_block_and_arena_walls_do_not():
    low = Stage([(0, 0), (0.5, 0)], 0.0, chain([(0.25, -1), (0.25, 1)]), **QUIET)
    booth = Stage([(0, 0), (0.5, 0)], 0.0, booth_outline(0.25, 0.0, math.pi / 2, 0.1, 1), **QUIET)
    for stage, heard in ((low, 1), (booth, 0)):
        stage.say(1, [1, 0, 0, 0])
        assert len(stage.hear()) == heard


def test_a_robot_in_a_booth_is_heard_through_its_mouth_only():
    inside, outside = (0.0, 0.0), [0.25, -0.25]  # a bay that points along x, with its mouth at x = -0.06
    stage = Stage([inside, (outside[1], 0.0), (outside[1], 0.25), (outside[0], 0.0), (0.0, 0.3)],
                  0.0, booth_outline(0.0, 0.0, 0.0, 0.1, 1), **QUIET)  # fmt: skip
    stage.say(0, [1, 0, 0, 0])
    assert [len(stage.hear(k)) for k in (1, 2, 3, 4)] == [1, 0, 0, 0]


def crowd(count, seed=1, **epuck):
    """Return a stage with a listener in the middle of ``count`` speakers that say who they are."""
    stage = Stage([(0, 0), *around(count, 0.4)], 0.0, seed=seed, **epuck)
    for k in range(count):
        stage.say(k + 1, [k, 0, 0, 0])
    return stage


@pytest.mark.parametrize("capacity", [0, 1, 5])
def test_never_more_packets_than_the_capacity(capacity):
    stage = crowd(14, radio_capacity=capacity, **CLEAR)
    counts = {len(stage.hear(cycle=cycle)) for cycle in range(200)}
    assert counts == {capacity}
    assert stage.robots[0].packets_heard == 200 * capacity


def test_every_sender_is_as_likely_to_get_through_and_to_be_first():
    count, cycles = 12, 6000
    stage = crowd(count, **CLEAR)
    heard = [stage.hear(cycle=cycle).payload[:, 0] for cycle in range(cycles)]
    assert all(len(set(senders)) == 5 for senders in heard)  # nobody twice
    share = 5 / count
    through = np.bincount(np.concatenate(heard), minlength=count) - cycles * share
    statistic = (through**2).sum() / (cycles * share * (1 - share)) * (count - 1) / count
    assert chi2.sf(statistic, count - 1) > 1e-4
    first = np.bincount([senders[0] for senders in heard], minlength=count) - cycles / count
    assert chi2.sf((first**2).sum() / (cycles / count), count - 1) > 1e-4


def test_the_nearest_have_no_right_of_way():
    stage = Stage([(0, 0), *around(5, 0.2), *around(5, 0.6, 0.3)], 0.0, **CLEAR)
    for k in range(10):
        stage.say(k + 1, [k, 0, 0, 0])
    heard = np.concatenate([stage.hear(cycle=cycle).payload[:, 0] for cycle in range(3000)])
    assert np.mean(heard < 5) == pytest.approx(0.5, abs=4 * 0.5 / math.sqrt(len(heard)))


def test_who_is_hidden_or_speaks_elsewhere_takes_no_place_in_the_queue():
    stage = crowd(10, **CLEAR)
    for k in range(5, 10):
        stage.say(k + 1, [k, 0, 0, 0], emitters=[])
    assert all(len(stage.hear(cycle=cycle)) == 5 for cycle in range(100))
    for k in range(10):  # their headings are 0, so emitter 6 of the robot at bearing 0 points at the listener
        stage.say(k + 1, [k, 0, 0, 0], emitters=[6])
    assert {tuple(stage.hear(cycle=cycle).payload[:, 0]) for cycle in range(50)} == {(0,)}


def test_one_packet_in_twenty_is_lost():
    stage = pair(0.4, radio_loss=0.05)
    lost = np.mean([len(stage.hear(cycle=cycle)) == 0 for cycle in range(8000)])
    assert lost == pytest.approx(0.05, abs=4 * math.sqrt(0.05 * 0.95 / 8000))


def test_a_lost_packet_has_used_its_place():
    stage = crowd(12, radio_loss=0.5)
    counts = [len(stage.hear(cycle=cycle)) for cycle in range(2000)]
    assert np.mean(counts) == pytest.approx(2.5, abs=4 * math.sqrt(1.25 / 2000))
    assert max(counts) == 5


@pytest.mark.parametrize("distance, spread", [(0.08, 0.03), (0.12, 0.03), (0.4, 0.1), (0.75, 0.1875)])
def test_range_is_off_by_a_quarter_but_by_three_centimetres_at_least(distance, spread):
    stage = pair(distance, radio_distance_noise=0.25, radio_distance_noise_floor=0.03)
    seen = np.array([stage.hear(cycle=cycle)[0].distance for cycle in range(4000)])
    assert seen.mean() == pytest.approx(distance, abs=5 * spread / math.sqrt(4000))
    assert seen.std() == pytest.approx(spread, rel=0.05)
    assert seen.min() >= 0.0


def test_bearing_is_off_by_eight_degrees_and_stays_within_half_a_turn():
    stage = Stage([(0, 0), (-0.4, 0)], 0.0, **CLEAR)
    stage.say(1, [0, 0, 0, 0])
    bearings = np.array([stage.hear(cycle=cycle)[0].bearing for cycle in range(4000)])
    assert (bearings > -math.pi).all() and (bearings <= math.pi).all()
    off = (bearings - math.pi + math.pi) % (2 * math.pi) - math.pi
    assert off.mean() == pytest.approx(0.0, abs=4 * math.radians(8) / math.sqrt(4000))
    assert off.std() == pytest.approx(math.radians(8), rel=0.05)


def test_two_robots_that_hear_each_other_err_apart():
    stage = Stage([(0, 0), (0.4, 0)], [0.0, math.pi], **CLEAR)
    for i in (0, 1):
        stage.say(i, [0, 0, 0, 0])
    seen = np.array([[stage.hear(i, cycle)[0].distance for i in (0, 1)] for cycle in range(3000)])
    assert abs(np.corrcoef(seen.T)[0, 1]) < 4 / math.sqrt(3000)
