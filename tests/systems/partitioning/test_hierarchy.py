"""A tree of tasks (TP-O2): what tasks cost, where robots cut them, what is timed, and two caches that differ."""

import math

import numpy as np
import pytest

from formicarium.physics.records import records
from formicarium.robots.forager import READING
from formicarium.systems.partitioning.choices import awaited, choose, close_timer, gives_up
from formicarium.systems.partitioning.hierarchy import choose_in_tree, cost_of_first, cost_of_second, turn_away
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind, of_two_caches
from formicarium.systems.partitioning.memory import CHART, MEMORY, NEVER, Area, Estimate, Label, Way
from formicarium.systems.partitioning.middle import picked_in_middle
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin, make_interfacing
from formicarium.systems.partitioning.study import run_trial
from formicarium.trial.simulate import simulate

THREE = {"subtasks": 3}
SHORT_LEGS = {"width": 2.4, "height": 1.6, "cache_depth": 1.0, "leg_width": 0.6, "bottom_width": 0.4, "block_top": 0.95}


def tree(**fields):
    return partitioning_parameters(arena=THREE, strategy={"hierarchical": True} | fields).strategy.record()[0]


def forager(seed=5):
    """Return a robot's memory with round times: 60 s for each of three parts, 200 s past one cache, 400 s for all."""
    memory = records(MEMORY, 1)[0]
    memory.harvest = memory.store = 60.0
    memory.whole = 400.0
    memory.ways[:] = (110.0, 90.0, 120.0, 80.0, 35.0, 25.0)
    memory.timer, memory.stay, memory.choices, memory.patience = NEVER, -1.0, seed, seed
    return memory


def logistic(advantage):
    """Equation 1 with S = 5."""
    return 1.0 / (1.0 + math.exp(-5.0 * advantage))


def test_a_part_costs_what_its_own_decision_makes_it_cost():
    """120 s cut against 200 s in one: P_p = 1 / (1 + exp(-5 (200 / 120 - 1))), and 60 s more for the other part."""
    cut = logistic(200 / 120 - 1)
    expected = 60.0 + cut * 120.0 + (1 - cut) * 200.0
    assert cost_of_first(forager(), tree()) == pytest.approx(expected)
    assert cost_of_second(forager(), tree()) == pytest.approx(expected)


def test_a_dear_part_is_done_in_one():
    memory = forager()
    memory.store += 400.0
    assert cost_of_first(memory, tree()) == pytest.approx(60.0 + 200.0, rel=0.01)
    assert cost_of_second(memory, tree()) > 580.0


@pytest.mark.parametrize(("area", "loaded"), [(Area.SOURCE, 1), (Area.NEST, 0)])
def test_every_task_decides_on_its_own(area, loaded):
    """Chances from the source, and as in a mirror from the nest: whole task, then where, then the part that is left."""
    memory, table = forager(), tree()
    memory.area, memory.loaded, memory.whole = area, loaded, 240.0
    parts = cost_of_first(memory, table)  # both caches alike: the place of the cut is drawn evenly
    cut = logistic(240.0 / parts - 1) if parts < 240.0 else logistic(1 - parts / 240.0)
    expected = {
        (Label.CORRIDOR, Area.NEST if loaded else Area.SOURCE): 1 - cut,
        (Label.CACHE, None): cut * (0.5 + 0.5 * logistic(200 / 120 - 1)),
        (Label.CORRIDOR, Area.MIDDLE): cut * 0.5 * (1 - logistic(200 / 120 - 1)),
    }
    found = dict.fromkeys(expected, 0)
    draws = 6000
    for _ in range(draws):
        choose_in_tree(memory, table)
        assert memory.probability == pytest.approx(cut)
        label = Label(int(memory.label))
        found[label, None if label == Label.CACHE else Area(int(memory.far))] += 1
    for way, chance in expected.items():
        assert found[way] / draws == pytest.approx(chance, abs=4 * math.sqrt(chance * (1 - chance) / draws))


@pytest.mark.parametrize(("loaded", "end"), [(1, Area.NEST), (0, Area.SOURCE)])
def test_in_the_middle_the_part_that_begins_there_decides(loaded, end):
    memory, table = forager(), tree()
    memory.area, memory.loaded = Area.MIDDLE, loaded
    choose_in_tree(memory, table)
    assert memory.probability == pytest.approx(logistic(200 / 120 - 1)) and memory.far == end
    if loaded:
        memory.store = 1e6  # the second cache is dear
    else:
        memory.harvest = 1e6  # the first one is
    choose_in_tree(memory, table)
    assert memory.label == Label.CORRIDOR


def test_ways_are_timed_from_hand_over_to_hand_over_and_not_after_giving_up():
    memory, reading, chart, table = forager(), records(READING, 1)[0], records(CHART, 1)[0], tree(alpha=0.8)
    chart.cycle_time, chart.subtasks = 0.1, 3
    here = {"harvest": Area.SOURCE, "second": Area.MIDDLE, "first": Area.MIDDLE, "store": Area.NEST}
    before = memory.ways.copy()

    def arrive(place, cycle, loaded, label):
        """Close the trip at a place, then set out from there."""
        memory.area, memory.loaded, reading.cycle = here[place], loaded, cycle
        close_timer(reading, memory, table, chart, place == "store")
        memory.label, memory.timer, memory.set_out = label, cycle, memory.area

    trips = [
        ("harvest", 1000, 1, Label.CORRIDOR, None),
        ("second", 3000, 0, Label.CORRIDOR, Way.SOURCE_TO_SECOND),  # 200 s
        ("harvest", 4500, 1, Label.CORRIDOR, Way.SECOND_TO_SOURCE),  # 150 s
        ("second", 9500, 0, Label.CACHE, Way.SOURCE_TO_SECOND),  # 500 s
        ("first", 9900, 1, Label.CACHE, Way.SECOND_TO_FIRST),  # 40 s
        ("second", 10200, 0, Label.CACHE, Way.FIRST_TO_SECOND),  # 30 s
        ("first", 10600, 1, Label.CORRIDOR, Way.SECOND_TO_FIRST),
        ("store", 13600, 0, Label.CORRIDOR, Way.FIRST_TO_NEST),  # 300 s
        ("first", 15600, 1, Label.GAVE_UP, Way.NEST_TO_FIRST),  # 200 s
        ("store", 20000, 0, Label.CACHE, None),
    ]
    lasted, expected = {}, before.copy()
    start = None
    for place, cycle, loaded, label, way in trips:
        arrive(place, cycle, loaded, label)
        if way is None:
            assert memory.updated == Estimate.NONE
        else:
            lasted[way] = 0.1 * (cycle - start)
            expected[way] = 0.2 * expected[way] + 0.8 * lasted[way]
            assert memory.updated == Estimate.WAY and memory.measured == pytest.approx(lasted[way])
        assert memory.ways == pytest.approx(expected)
        start = cycle
    assert (memory.harvest, memory.store, memory.whole) == (60.0, 60.0, 400.0)


def test_the_whole_is_still_twice_a_crossing():
    memory, reading, chart, table = forager(), records(READING, 1)[0], records(CHART, 1)[0], tree()
    chart.cycle_time = 0.1
    memory.area, memory.set_out, memory.label, memory.timer, reading.cycle = Area.NEST, Area.SOURCE, 2, 1000, 3000
    close_timer(reading, memory, table, chart, True)
    assert memory.whole == pytest.approx(0.2 * 400.0 + 0.8 * 2 * 200.0) and memory.updated == Estimate.WHOLE


def test_patience_is_scaled_by_the_parts_of_the_cut_at_that_cache():
    memory, table = forager(), tree()
    memory.store = 500.0
    first, second = cost_of_first(memory, table), cost_of_second(memory, table)
    assert first < second
    for area, set_out, to_pick, own, parts in (
        (Area.SOURCE, Area.SOURCE, False, 60.0, first), (Area.NEST, Area.NEST, True, 500.0, second),
        (Area.MIDDLE, Area.NEST, True, 80.0, first), (Area.MIDDLE, Area.SOURCE, False, 110.0, second),
        (Area.MIDDLE, Area.MIDDLE, True, 25.0, first), (Area.MIDDLE, Area.MIDDLE, False, 35.0, second),
    ):  # fmt: skip
        memory.area, memory.set_out = area, set_out
        assert awaited(memory, table, to_pick) == pytest.approx((own, parts))


def test_a_wait_longer_than_a_way_renews_it():
    memory, reading, chart, table = forager(), records(READING, 1)[0], records(CHART, 1)[0], tree(giveup_offset=1000.0)
    chart.cycle_time = 0.1  # with so great an offset the first draw ends the wait
    memory.area = memory.set_out = Area.MIDDLE
    for waited, expected in ((200, 25.0), (1000, 0.2 * 25.0 + 0.8 * 100.0)):
        memory.wait_began, memory.draw_due, reading.cycle = 0, 0, waited
        assert gives_up(reading, memory, table, chart, True)
        assert memory.ways[Way.SECOND_TO_FIRST] == pytest.approx(expected) and memory.label == Label.GAVE_UP


def test_who_gives_up_decides_on_what_is_left():
    memory, table = forager(), tree()
    for area, loaded, end in ((Area.SOURCE, 1, Area.NEST), (Area.NEST, 0, Area.SOURCE)):
        memory.area, memory.loaded = area, loaded
        memory.whole = 1e6
        assert turn_away(memory, table) == Area.MIDDLE
        memory.whole = 1.0
        assert turn_away(memory, table) == end
    memory.area, memory.whole = Area.MIDDLE, 1e6
    assert [turn_away(memory, table) for memory.loaded in (1, 0)] == [Area.NEST, Area.SOURCE]


def test_without_a_tree_who_picks_up_in_the_middle_does_not_decide():
    memory, reading, chart = forager(), records(READING, 1)[0], records(CHART, 1)[0]
    before = memory.copy()
    picked_in_middle(reading, memory, partitioning_parameters(arena=THREE).strategy.record()[0], chart)
    assert memory == before
    memory.area = Area.MIDDLE
    choose(reading, memory, tree(), chart)
    assert memory.choices != before.choices


def logs(seed=110094, robots=9, storage=None, **groups):
    return simulate(run, begin(partitioning_parameters(robots=robots, **groups), seed, storage=storage))


@pytest.mark.parametrize("method", ["never", "always"])
def test_a_tree_that_is_never_or_always_cut_is_the_row_of_sub_tasks(method):
    """Where equation 1 has no say the tree changes nobody's way: the same hand-overs in the same cycles."""
    found = [
        logs(arena=THREE, swarm={"time_cap": 2000.0}, strategy={"method": method, "hierarchical": hierarchical})
        for hierarchical in (False, True)
    ]
    kinds = (EventKind.HARVESTED, EventKind.STORED, EventKind.DROPPED, EventKind.PICKED, EventKind.VISIT)
    plain, treed = (log[np.isin(log["kind"], kinds)][["cycle", "kind", "robot"]] for log in found)
    assert len(plain) > 40 and plain.tolist() == treed.tolist()


def test_where_robots_are_stored_does_not_matter():
    groups = {"arena": THREE, "swarm": {"time_cap": 900.0}, "strategy": {"hierarchical": True}}
    order = np.random.default_rng(1).permutation(9)
    plain = logs(**groups)
    assert len(plain) > 50 and logs(storage=order, **groups).tobytes() == plain.tobytes()


def test_first_guesses_of_ways_are_a_sub_tasks_each():
    memories = begin(partitioning_parameters(arena=THREE, robots=30, strategy={"hierarchical": True}), 110095).memories
    assert ((memories.ways[:, :4] >= 50) & (memories.ways[:, :4] <= 100)).all()
    assert memories.ways[:, 4] + memories.ways[:, 5] == pytest.approx(memories.middle)
    assert np.ptp(memories.ways[:, 0]) > 25 and abs(np.corrcoef(memories.ways[:, 0], memories.ways[:, 2])[0, 1]) < 0.6
    assert not begin(partitioning_parameters(arena=THREE, robots=6), 110095).memories.ways.any()


def test_each_cache_keeps_robots_for_its_own_time():
    cache = {"interfacing_time": 5.0, "second_extra": 20.0}
    log = logs(arena=THREE, swarm={"time_cap": 1500.0}, strategy={"method": "always"}, cache=cache)
    visits = log[log["kind"] == EventKind.VISIT]
    first, second = (visits[(visits["value"] >= 3) == is_second]["detail"] for is_second in (False, True))
    assert len(first) > 10 and len(second) > 5
    assert 50 <= first.min() < 200 and second.min() >= 250


def test_interfacing_times_of_both_caches_both_sides_before_and_after():
    cache = {"interfacing_time": 30.0, "taking_extra": 5.0, "second_extra": 100.0}
    cache |= {"switch_time": 1000.0, "switched_time": 10.0}
    first, second = make_interfacing(partitioning_parameters(arena=THREE, cache=cache))
    assert (first.give_time, first.take_time, first.switched_give_time, first.switched_take_time) == (30, 35, 10, 15)
    assert (second.give_time, second.take_time) == (130, 135)
    assert (second.switched_give_time, second.switched_take_time, second.switch_cycle) == (110, 115, 10000)
    assert len(make_interfacing(partitioning_parameters())) == 1


@pytest.mark.parametrize(
    ("groups", "words"),
    [
        ({"strategy": {"hierarchical": True}}, "strategy.hierarchical needs two caches: set arena.subtasks to 3"),
        ({"cache": {"second_extra": 5.0}}, "cache.second_extra needs two caches: set arena.subtasks to 3"),
        ({"arena": THREE, "cache": {"interfacing_time": 10.0, "second_extra": -20.0}}, "second_extra -20 makes"),
        ({"arena": THREE, "strategy": {"hierarchical": True, "social_weight": 0.5}}, "social_weight 0.5: set one to 0"),
        ({"arena": THREE, "strategy": {"hierarchical": True, "exploration_age": 60.0}}, "exploration_age 60: set one"),
    ],
)
def test_what_does_not_go_together_is_refused(groups, words):
    with pytest.raises(ValueError, match=words):
        partitioning_parameters(**groups)


def test_choices_are_counted_beside_each_cache():
    made = [
        (EventKind.HARVESTED, Label.CACHE), (EventKind.HARVESTED, Label.CORRIDOR), (EventKind.PASSED_ON, Label.CACHE),
        (EventKind.STORED, Label.CORRIDOR), (EventKind.TAKEN_ON, Label.CACHE), (EventKind.PICKED, 2),
        (EventKind.PICKED, 3), (EventKind.PICKED, 5), (EventKind.PICKED, -1),
    ]  # fmt: skip
    events = np.array(made, [("kind", "i8"), ("subject", "i8")])
    expected = {"chosen_first": 2 / 3, "chosen_second": 1 / 2, "over_first": 1 / 4, "over_second": 2 / 4}
    assert of_two_caches(events, 3, 4) == pytest.approx(expected)


@pytest.mark.long
@pytest.mark.parametrize(("first", "extra"), [(0.0, 200.0), (200.0, -200.0)])
def test_the_dear_cache_is_chosen_less_than_half_of_the_time_and_the_cheap_one_more(first, extra):
    """Acceptance of TP-O2 on one seed, with a draw of P_g every 10 s; the study has twenty."""
    parameters = partitioning_parameters(
        robots=12, arena=THREE | SHORT_LEGS, swarm={"time_cap": 20000.0},
        strategy={"hierarchical": True, "giveup_draw_period": 10.0},
        cache={"interfacing_time": first, "second_extra": extra},
    )  # fmt: skip
    row = run_trial(parameters, 110096).outcome
    shares = row["chosen_first"], row["chosen_second"]
    cheap, dear = shares if extra > 0 else shares[::-1]
    assert cheap > 0.5 > dear
