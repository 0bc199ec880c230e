"""Arms that branch (ST-75): numbers of branches, who goes over to which, the finished figure against its design."""

import math

import numpy as np
import pytest

from formicarium.contracts.interpreted import compiled, interpreted
from formicarium.contracts.states import copy_of, differences
from formicarium.systems.coverage.branches import descends, level_of, swing_of
from formicarium.systems.coverage.fractals import SHIFTS, area, boxes, design, dimension, fractal_columns, sampled
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.study import run_trial
from systems.coverage.swarm import advance, line, stay, swarm

FRACTAL = {"shape": "fractal"}


def formation_of(**numbers):
    return swarm(setting=8, robots=7, formation={**FRACTAL, **numbers}).charts[0].formation


@pytest.mark.parametrize("branch", [0, 1, 2, 0o11, 0o21, 0o123, 0o7654])
def test_a_branch_number_is_read_digit_by_digit(branch):
    """Against Python's own octal digits."""
    digits = f"{branch:o}".strip("0") if branch else ""
    formation = formation_of(branches=7, angle=0.6)
    assert level_of(branch) == len(digits)
    assert swing_of(branch, formation) == pytest.approx(sum(0.2 * (int(digit) - 4) for digit in digits))
    for other in (0, 1, 2, 0o11, 0o12, 0o7, 0o76):
        before = f"{other:o}" if other else ""
        assert descends(branch, other) == digits.startswith(before)


def queue(**formation):
    """Return a row of seven robots of one arm, 1.2 m apart, the fourth and those beyond it to spare."""
    state = swarm(
        [(1.2 * k, 0.0, 0.3 * k) for k in range(8)],
        setting=8,
        tasks={"count": 1, "first_direction": 0.0, "distance": 40.0},
        formation={**FRACTAL, "branch_robots": 3, "patience": 1.0, **formation},
    )
    return stay(state, 14)


def test_places_count_along_the_row_and_the_first_to_spare_goes_over():
    state = queue()
    assert state.memories.place[1:].tolist() == [1, 2, 3, 4, 5, 6, 7]
    stay(state, 8)
    assert (state.memories.branch[1:4] == 0).all() and (state.memories.branch[5:] == 0).all()
    assert state.memories.branch[4] in (1, 2)


def test_who_is_of_a_branch_without_a_root_goes_back_to_the_stem():
    """The arm is two robots short of a root; the robot in the child has had nobody to align with for 50 cycles."""
    state = queue(branch_robots=9)
    state.memories.branch[3] = 1
    stay(state, 45)
    assert state.memories.branch[3] == 1
    stay(state, 10)
    assert state.memories.branch[3] == 0


def test_nobody_goes_over_where_the_design_has_no_more_branchings():
    """The last branches take all who are left."""
    state = queue(branch_robots=60)
    stay(state, 40)
    assert (state.memories.branch == 0).all()


def test_who_goes_over_joins_the_child_with_fewer_robots():
    """Robots 5 and 6 stand in child 1 already, beside the root; robot 4 is next."""
    for child in (1, 2):
        state = queue(patience=2.0)
        for robot in (5, 6):
            state.memories.branch[robot] = child
            state.memories.place[robot] = robot - 4
            body = state.world.bodies[robot]
            body.x, body.y = 3.6 + 0.3 * (robot - 4), 1.0 if child == 2 else -1.0
        stay(state, 60)
        assert state.memories.branch[4] == 3 - child


@pytest.fixture(scope="module")
def grown():
    """Return seven robots in one arm that has branched twice, one robot a branch, and its parameters."""
    p = coverage_parameters(
        8, 8, swarm={"time_cap": 300.0}, tasks={"count": 1}, formation={**FRACTAL, "branch_robots": 1, "ratio": 0.7}
    )
    state = swarm(setting=8, robots=8, seed=5, tasks={"count": 1}, formation=p.formation.model_dump())
    return p, advance(state, 3000)


def test_seven_robots_make_an_arm_that_branches_twice(grown):
    """1 + 2 + 4 branches, each 0.7 of the one before within 10 %, 60 degrees off it, and never parted."""
    p, state = grown
    row = fractal_columns(p, state)
    assert row["branches"] == row["branches_full"] == 7 and row["places_filled"] == 1.0
    assert row["ratio_1"] == pytest.approx(0.7, rel=0.1) and row["ratio_2"] == pytest.approx(0.7, rel=0.1)
    assert row["angle_off"] < 6.0
    assert state.connections[0].losses == 0


def test_a_robot_astray_is_missed_in_the_figure(grown):
    """The measure is of places, not of what robots believe: a tip that is moved away spoils ratio and angle."""
    p, state = grown
    moved = copy_of(state)
    last = int(np.flatnonzero(moved.memories.branch > 7)[0])
    moved.world.bodies[last].x += 2.0
    was, now = fractal_columns(p, state), fractal_columns(p, moved)
    assert abs(now["ratio_2"] - 0.7) > abs(was["ratio_2"] - 0.7) + 0.02


def test_a_branch_whose_root_is_gone_is_not_full(grown):
    """Its robots still have their places."""
    p, state = grown
    less = copy_of(state)
    less.robots.alive[int(np.flatnonzero(less.memories.branch == 1)[0])] = 0
    row = fractal_columns(p, less)
    assert row["branches_full"] == 7 - 3  # itself and its two children
    assert row["places_filled"] == pytest.approx(6 / 7)


@pytest.mark.parametrize("setting", [8, 9])
def test_formations_are_the_same_compiled_and_interpreted(setting):
    """To the last bit, as the contract asks of stars."""
    state = advance(swarm(setting=setting, robots=16, seed=6), 600)
    assert differences(interpreted("coverage", state, 12), compiled("coverage", state, 12)) == []


def test_stars_say_nothing_of_branches_and_their_messages_are_no_longer():
    star = advance(swarm(setting=5, seed=4), 300)
    assert (star.memories.branch == 0).all() and (star.commands.message.place == 0).all()
    message = star.commands.message
    assert (message.bytes == 54 + 27 * message.arm_count + 9 * message.entry_count).all()
    other = advance(swarm(setting=5, seed=4, formation=FRACTAL), 300)
    message = other.commands.message
    assert (message.bytes == 58 + 27 * message.arm_count + 9 * message.entry_count).all()


def test_no_message_of_a_crowd_is_longer_than_the_radio_allows():
    state = swarm(setting=8, robots=60, formation={"shape": "network"}, tasks={"count": 6})
    for _ in range(40):
        advance(state, 1)
        assert state.commands.message.bytes.max() <= 500


def grid(count):
    """Return the lines of a square grid of side 1."""
    at = np.linspace(0.0, 1.0, count)
    lines = [((x, 0.0), (x, 1.0)) for x in at] + [((0.0, y), (1.0, y)) for y in at]
    return 20.0 * np.array(lines)


def test_a_line_lies_in_as_many_boxes_as_it_should():
    """Over all shifts of the grid the mean is 1 + (|dx| + |dy|) / size. So a short line has less than one dimension."""
    line = np.array([((0.0, 0.3), (20.0, 7.0))])
    for size in (0.5, 2.0, 8.0):
        counts = [boxes(sampled(line), size, i, j) for i in range(SHIFTS) for j in range(SHIFTS)]
        assert np.mean(counts) == pytest.approx(1.0 + 26.7 / size, rel=0.03)
    assert 0.9 < dimension(line, 0.5) < 1.0


@pytest.mark.long
def test_a_filled_square_has_twice_the_dimension_of_a_line():
    one = dimension(np.array([((0.0, 0.0), (20.0, 0.0))]), 0.5)
    assert dimension(grid(60), 0.5) == pytest.approx(2.0 * one, rel=0.03)


def test_boxes_are_counted_as_by_hand():
    points = np.array([(0.1, 0.1), (0.9, 0.9), (1.1, 0.1)])
    assert boxes(points, 1.0, 0, 0) == 2
    assert boxes(points, 1.0, 0, 1) == 3  # shifted up by a quarter: 0.35, 1.15, 0.35
    assert boxes(points, 10.0, 0, 0) == 1


def test_areas_are_those_of_discs():
    assert area(np.array([(0.0, 0.0)]), 3.0) == pytest.approx(math.pi * 9.0, rel=0.01)
    assert area(np.array([(0.0, 0.0), (0.0, 0.0), (50.0, 0.0)]), 3.0) == pytest.approx(2 * math.pi * 9.0, rel=0.01)


def test_a_design_has_the_lengths_and_turns_that_were_asked_for():
    formation = formation_of(branch_robots=2, ratio=0.5, angle=1.0)
    branches = design(formation, 2.4, 3)
    lengths = np.hypot(*(branches[:, 1] - branches[:, 0]).T)
    assert len(branches) == 3 * 7
    assert sorted(np.round(lengths, 9)) == [1.2] * 12 + [2.4] * 6 + [4.8] * 3


def test_only_the_rows_of_a_fractal_have_its_columns():
    star = run_trial(coverage_parameters(5, swarm={"time_cap": 5.0}), 1).outcome
    fractal = run_trial(coverage_parameters(8, 7, swarm={"time_cap": 5.0}), 1).outcome
    assert set(fractal) - set(star) == {
        "branches", "branches_full", "places_filled", "settled_s", "ratio_1", "ratio_2", "angle_off", "decades",
        "dimension", "dimension_design", "area_in_range_m2",
    }  # fmt: skip


def test_a_line_of_robots_hears_only_neighbours_so_places_need_no_map():
    """Places are right with headings at random, each robot hearing its two neighbours alone."""
    draws = np.random.default_rng(1)
    places = [(x, y, draws.uniform(-3, 3) if x else 0.0) for x, y, _ in line(6)]
    state = swarm(places, setting=8, tasks={"count": 1, "first_direction": 0.0, "distance": 40.0})
    assert stay(state, 14).memories.place[1:].tolist() == [1, 2, 3, 4, 5]
