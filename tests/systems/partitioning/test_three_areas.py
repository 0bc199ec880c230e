"""Three sub-tasks in a row (TP-O1): an arena of three areas, the rules of the middle one, and who wins when."""

import itertools

import numpy as np
import pytest

from formicarium.devices.depot import Place
from formicarium.physics.records import records
from formicarium.robots.forager import READING
from formicarium.systems.partitioning.arena import make_arena, shades_of
from formicarium.systems.partitioning.behaviour import next_area
from formicarium.systems.partitioning.choices import choose, close_timer
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.memory import CHART, MEMORY, Area, Estimate, Ground, Label
from formicarium.systems.partitioning.middle import dropped_in_middle
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin
from formicarium.systems.partitioning.study import run_trial
from formicarium.trial.record import OBJECT

THREE = {"subtasks": 3}


def test_the_papers_arena_is_the_case_of_two():
    two = make_arena(partitioning_parameters().arena)
    assert two.middle_area is None and len(two.booths) == 14 and len(two.solids) == 2
    assert len(shades_of(partitioning_parameters().arena)) == 7


def test_a_second_cache_stands_between_the_middle_area_and_the_nest():
    table = partitioning_parameters(arena=THREE).arena
    arena = make_arena(table)
    assert len(arena.booths) == 4 + 4 + 2 * 6 and sorted(set(arena.pairs)) == [-1, 0, 1, 2, 3, 4, 5]
    left, _, right, _ = arena.middle_area
    for booth, place, pair in zip(arena.booths, arena.places, arena.pairs, strict=True):
        if place == Place.CACHE_DROP:
            assert booth[0] < left if pair < 3 else right < booth[0] < arena.nest_area[0]
    assert np.ptp(arena.corners[:, 0]) == pytest.approx(1.6 + 0.8 + 0.24)
    assert arena.lamp[0] == pytest.approx(0.5 * (left + right))


def test_the_floor_tells_twelve_places_apart():
    shades = sorted(shades_of(partitioning_parameters(arena=THREE).arena).values())
    assert len(shades) == len(Ground) and np.diff(shades).min() > 0.07


def test_a_third_of_the_robots_begins_in_each_area():
    state = begin(partitioning_parameters(robots=14, arena=THREE), 110064)
    left, _, right, _ = make_arena(partitioning_parameters(arena=THREE).arena).middle_area
    x = state.world.bodies.x
    assert [(x < left).sum(), ((x > left) & (x < right)).sum(), (x > right).sum()] == [6, 4, 4]
    assert ((state.memories.middle >= 50) & (state.memories.middle <= 100)).all()


def test_who_gives_up_does_the_neighbouring_sub_task_as_well():
    memory, chart = records(MEMORY, 1)[0], records(CHART, 1)[0]
    table = partitioning_parameters().strategy.record()[0]
    for subtasks, area, to_pick, expected in (
        (2, Area.SOURCE, False, Area.NEST), (2, Area.NEST, True, Area.SOURCE),
        (3, Area.SOURCE, False, Area.MIDDLE), (3, Area.MIDDLE, False, Area.NEST),
        (3, Area.NEST, True, Area.MIDDLE), (3, Area.MIDDLE, True, Area.SOURCE),
    ):  # fmt: skip
        chart.subtasks, memory.area = subtasks, area
        assert next_area(memory, table, chart, to_pick) == expected


def test_the_middle_is_timed_from_drop_to_drop_and_a_way_out_of_it_measures_nothing():
    memory, reading, chart = records(MEMORY, 1)[0], records(READING, 1)[0], records(CHART, 1)[0]
    memory.harvest = memory.store = memory.middle = 60.0
    memory.whole, memory.area, memory.choices, chart.cycle_time, chart.subtasks = 900.0, Area.MIDDLE, 3, 0.1, 3
    table = partitioning_parameters(arena=THREE, strategy={"method": "always"}).strategy.record()[0]
    for cycle, expected in ((1000, 60.0), (2000, 0.2 * 60.0 + 0.8 * 100.0)):
        reading.cycle = cycle
        if cycle == 1000:
            choose(reading, memory, table, chart)  # came with an object it had not fetched here
        else:
            dropped_in_middle(reading, memory, table, chart)
        assert memory.middle == pytest.approx(expected)
    memory.label, memory.area, reading.cycle = Label.CORRIDOR, Area.SOURCE, 5000
    close_timer(reading, memory, table, chart, False)
    assert memory.whole == 900.0 and memory.updated == Estimate.NONE


def test_all_sub_tasks_count_in_the_choice():
    memory, reading, chart = records(MEMORY, 1)[0], records(READING, 1)[0], records(CHART, 1)[0]
    memory.harvest = memory.store = 60.0
    memory.whole, table = 240.0, partitioning_parameters().strategy.record()[0]
    found = []
    for middle in (0.0, 120.0):
        memory.middle = middle
        choose(reading, memory, table, chart)
        found.append(float(memory.probability))
    assert found[0] > 0.99 and found[1] == pytest.approx(0.5)


def test_with_three_areas_objects_pass_both_caches_and_nobody_crosses_one():
    parameters = partitioning_parameters(robots=9, arena=THREE, strategy={"method": "always"})
    state = begin(parameters, 110065)
    side = state.world.bodies.x.copy()
    run(state, 9000)
    assert (state.pairs.state > 0).any() and (state.memories.measured_at[:, Estimate.MIDDLE] > 0).any()
    inner_left, _, inner_right, _ = make_arena(parameters.arena).middle_area
    left, right = inner_left - 0.12, inner_right + 0.12  # the middle of each cache: who is in a booth is on its side
    for before, after in zip(side, state.world.bodies.x, strict=True):
        assert (before < left) == (after < left) and (before > right) == (after > right)


def test_objects_of_both_caches_are_shown():
    """A frame has a light for every booth and a place for an object of every pair, and so has the scene."""
    parameters = partitioning_parameters(robots=6, arena=THREE, swarm={"time_cap": 5.0})
    trial = run_trial(parameters, 110097, frames_every=5.0)
    places = [polygon for polygon in trial.scene.polygons if polygon.colour == OBJECT]
    assert len(places) == 6 and trial.frames.lit.shape[1] == 20 + 6
    x = [place.points[:, 0].mean() for place in places]
    left, _, right, _ = make_arena(parameters.arena).middle_area
    assert max(x[:3]) < left and min(x[3:]) > right


@pytest.mark.long
def test_partitioning_wins_where_the_caches_are_cheap_and_loses_where_they_are_dear():
    """Acceptance of TP-O1; adaptive robots are at least above the worse reference where it matters."""
    objects = {}
    for time, method in itertools.product((0.0, 200.0), ("never", "always", "adaptive")):
        parameters = partitioning_parameters(
            robots=12, arena=THREE, swarm={"time_cap": 20000.0}, strategy={"method": method},
            cache={"interfacing_time": time},
        )  # fmt: skip
        objects[time, method] = run_trial(parameters, 110062).outcome["objects_per_robot"]
    assert objects[0.0, "always"] > 1.3 * objects[0.0, "never"]
    assert objects[200.0, "never"] > 1.3 * objects[200.0, "always"]
    assert objects[200.0, "adaptive"] > 1.3 * objects[200.0, "always"]
