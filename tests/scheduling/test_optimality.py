"""The exact method finds what looking at every schedule finds, and the checker accepts what it finds."""

import numpy as np
import pytest

from scheduling.polygons import travel_in_polygons
from scheduling.small import small_instance

pytest.importorskip("highspy")

from formicarium.scheduling import completion, covering, heldkarp, travel
from formicarium.scheduling.checker import check
from formicarium.scheduling.clock import Clock, OutOfTime
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.diving import dive
from formicarium.scheduling.exhaustive import least_time_of_all, least_travel_of_all
from formicarium.scheduling.generator import draw_instance
from formicarium.scheduling.instance import Instance, Task, Team
from formicarium.scheduling.model import solve_model
from formicarium.scheduling.packing import ticks_of
from formicarium.scheduling.pricing import Prices
from formicarium.scheduling.problem import problem_of
from formicarium.scheduling.reach import Reach
from formicarium.scheduling.schedule import travel_cost
from formicarium.scheduling.solver import solve


def same_time(seed, reach, most):
    instance = small_instance(seed, most)
    answer = solve(instance, "time", reach.name.lower())
    assert answer.proven
    assert answer.value == pytest.approx(least_time_of_all(instance, reach))
    assert not check(instance, answer.schedule, reach.name.lower()).faults
    return instance, answer


def same_travel(seed, reach, most):
    instance = small_instance(seed, most)
    charged = seed % 2 == 0
    answer = solve(instance, "travel", reach.name.lower(), charge_first=charged)
    assert answer.proven
    time = answer.time_limit
    assert answer.value == pytest.approx(least_travel_of_all(instance, reach, time, charged), rel=1.5e-4, abs=1e-5)
    verdict = check(instance, answer.schedule, reach.name.lower(), time)
    assert not verdict.faults
    first = verdict.first_trip if charged else 0.0
    own = instance.robots * (verdict.trip + first) + verdict.relays * instance.spacing / instance.paths
    assert answer.value == pytest.approx(own)
    if reach is Reach.INSCRIBED:
        assert verdict.over_radio == 0


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("reach", [Reach.PRINTED, Reach.INSCRIBED])
def test_least_time_is_that_of_all_schedules(seed, reach):
    same_time(seed, reach, 5)


@pytest.mark.parametrize("seed", range(100, 108))
@pytest.mark.parametrize("reach", [Reach.PRINTED, Reach.INSCRIBED])
def test_least_travel_is_that_of_all_schedules(seed, reach):
    same_travel(seed, reach, 4)


def no_branching(_, most=float("inf")):
    assert most == 0


@pytest.mark.parametrize("seed", range(400, 416))
def test_dynamic_programmes_alone_prove_the_same(seed, monkeypatch):
    """Without the bound of gathering boxes before them and branch and bound behind them."""
    monkeypatch.setattr(travel, "gathering_bound", lambda *_: 0.0)
    monkeypatch.setattr(travel, "LOOK", 0)
    monkeypatch.setattr(travel.Branching, "run", no_branching)
    same_travel(seed, (Reach.PRINTED, Reach.INSCRIBED)[seed % 2], 4)


def test_a_programme_without_room_says_so_and_the_search_goes_on(monkeypatch):
    monkeypatch.setattr(travel, "gathering_bound", lambda *_: 0.0)
    monkeypatch.setattr(travel, "LOOK", 0)
    monkeypatch.setattr(heldkarp, "MOST_BYTES", 4 * 16**2 * 3)  # three states of the coarse programme
    had_room, run = [], heldkarp.HeldKarp.run
    monkeypatch.setattr(heldkarp.HeldKarp, "run", lambda *all_of: had_room.append(run(*all_of)) or had_room[-1])
    same_travel(402, Reach.PRINTED, 4)
    assert had_room == [False]


def test_out_of_time_below_a_target_proves_nothing(monkeypatch):
    def stopped(search, *_):
        search.bound = search.incumbent.target = 0.5 * search.incumbent.goal
        raise OutOfTime

    monkeypatch.setattr(travel, "gathering_bound", lambda *_: 0.0)
    monkeypatch.setattr(travel, "LOOK", 0)
    monkeypatch.setattr(travel.Search, "_grow", stopped)
    answer = solve(small_instance(101, 4), "travel", "printed")
    assert answer.ended == "time limit" and not answer.proven and answer.bound < answer.value


def same_as_model(seed, reach, most, seconds):
    """Hold the exact method against the paper's model; tell for time and travel if that closed in time."""
    instance = small_instance(seed, most)
    answer = solve(instance, "time", reach.name.lower())
    model = solve_model(instance, reach, Clock(seconds))
    timed = closed(model)
    if timed:
        assert model.value == pytest.approx(answer.value)
    assert model.bound <= answer.value + 1e-6
    shorter = solve(instance, "travel", reach.name.lower(), charge_first=False)
    model = solve_model(instance, reach, Clock(seconds), time=answer.value)
    if closed(model):
        assert model.value == pytest.approx(shorter.value, rel=3e-4, abs=1e-4)
        wider = instance._replace(spacing=instance.spacing * (1.0 + 1e-5))  # HiGHS bends a row by up to 1e-6
        assert not check(wider, model.schedule, reach.name.lower(), answer.value).faults
        assert travel_cost(instance, model.schedule, False) == pytest.approx(model.value, rel=1e-5, abs=1e-5)
    assert model.bound <= shorter.value * (1.0 + 3e-4) + 1e-4
    return timed, closed(model)


def closed(model):
    return model.schedule is not None and model.value - model.bound <= 1e-4 * model.value + 1e-6


@pytest.mark.parametrize("seed", range(200, 204))
def test_the_papers_model_agrees(seed):
    assert same_as_model(seed, Reach.PRINTED, 4, 60) == (True, True)


@pytest.mark.parametrize("seed", range(300, 310))
def test_in_the_true_circle_no_arm_is_longer_than_the_radio_reaches(seed):
    instance = small_instance(seed, 5)
    times = [solve(instance, "time", reach).value for reach in ("inscribed", "euclid", "printed")]
    assert times[0] >= times[1] >= times[2]  # each octagon holds the other or lies in it
    answer = solve(instance, "travel", "euclid")
    verdict = check(instance, answer.schedule, "euclid", answer.time_limit)
    assert answer.proven and not verdict.faults and verdict.over_radio == 0


def least_travel_in_the_circle(seed):
    instance, charged = small_instance(seed, 4), seed % 2 == 0
    answer = solve(instance, "travel", "euclid", 20.0, charge_first=charged)
    assert answer.proven and answer.time_bound == answer.time_limit
    least, most = travel_in_polygons(instance, answer.time_limit, charged)
    assert least * (1 - 1e-6) - 1e-5 <= answer.value <= most * (1 + 1.2e-4) + 1e-5
    assert answer.bound <= most + 1e-5
    assert not check(instance, answer.schedule, "euclid", answer.time_limit).faults


@pytest.mark.parametrize("seed", range(500, 512))
def test_the_least_travel_in_the_true_circle_lies_between_those_of_polygons(seed):
    """Arms that go on sticking out of their circle once passed for tours that cannot be (21 of 90 instances)."""
    least_travel_in_the_circle(seed)


@pytest.mark.long
@pytest.mark.parametrize("part", range(4))
def test_two_hundred_instances_in_the_true_circle(part):
    for seed in range(2000 + 50 * part, 2050 + 50 * part):
        least_travel_in_the_circle(seed)


@pytest.mark.parametrize("scale", [1e-2, 1e4])
@pytest.mark.parametrize("reach", ["printed", "inscribed", "euclid"])
def test_hops_may_be_of_any_length(reach, scale):
    for seed in (101, 103, 105):
        known = solve(small_instance(seed, 4), "travel", reach)
        instance = scaled(small_instance(seed, 4), scale)
        answer = solve(instance, "travel", reach)
        assert answer.proven and answer.value == pytest.approx(scale * known.value, rel=1.5e-4)
        assert not check(instance, answer.schedule, reach, answer.time_limit).faults


def scaled(instance, factor):
    """The same instance, far off and in other units."""
    x, y = 3e5 * factor, -5e5 * factor
    region = tuple(factor * value + shift for value, shift in zip(instance.region, (x, y, x, y)))
    return instance._replace(
        tasks=tuple(task._replace(x=factor * task.x + x, y=factor * task.y + y) for task in instance.tasks),
        region=region,
        start=(factor * instance.start[0] + x, factor * instance.start[1] + y),
        spacing=factor * instance.spacing,
    )


def test_a_tour_that_costs_nothing_has_no_gap():
    """The interior of a programme gave it a cost of -1e-9, and a gap was divided by a value of 0."""
    corner = 2.4202494856184336
    places = [(1.1345115298677215, 1.6502312871477811), (1.546293296673362, 1.7438822631446742),
              (0.9151759815423868, 1.8276459363053679)]  # fmt: skip
    tasks = tuple(Task(f"t{k}", x, y, 19) for k, (x, y) in enumerate(places))
    instance = Instance("zero", (Team(20),), tasks, (0.0, 0.0, corner, corner), (0.5 * corner, 0.5 * corner))
    answer = solve(instance, "travel", "euclid", charge_first=False)
    assert answer.proven and (answer.value, answer.bound, answer.gap) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("reach", ["printed", "inscribed", "euclid"])
def test_what_is_proven_has_no_gap_where_a_nanometre_counts(reach):
    """A hundred robots, hops of a tenth of a millimetre: points rounded to nanometres cost 2e-4 of the way."""
    corner = 0.0007048402995508192
    tasks = (Task("a", 0.0002811438896116977, 0.0001282187067850764, 95),
             Task("b", 0.00018915327881192958, 0.0005644557030725591, 50))  # fmt: skip
    instance = Instance("tiny", (Team(100),), tasks, (0.0, 0.0, corner, corner), (corner / 2, corner / 2), spacing=1e-4)
    answer = solve(instance, "travel", reach)
    assert answer.proven and answer.gap <= 1.001e-4
    assert not check(instance, answer.schedule, reach, answer.time_limit).faults


def test_ways_shorter_than_a_thousandth_of_a_hop_are_proven():
    """The least difference that counts, 1e-7 hops, was compared with itself."""
    for step in np.geomspace(1e-6, 2e-4, 12):
        tasks = (Task("a", 0.0, 0.0, 2), Task("b", 2.0 + float(step), 0.0, 2))
        answer = solve(Instance("near", (Team(3),), tasks, (0.0, 0.0, 3.0, 0.0), (0.0, 0.0)), "travel", "printed",
                       charge_first=False)  # fmt: skip
        assert answer.proven and answer.value == pytest.approx(3 * step, rel=1e-3, abs=2e-7)


@pytest.mark.parametrize(("number", "tasks", "reach"), [(5, 300, "printed"), (3, 200, "inscribed")])
def test_the_clock_is_heard_within_a_look_at_many_tasks(number, tasks, reach):
    instance = draw_instance(number, 0.5, 3, tasks)
    for _ in range(2):  # the first one compiles
        answer = solve(instance, "time", reach, 3.0, processor_time=True)
    assert answer.seconds < 4.5 and not check(instance, answer.schedule, reach).faults


def test_durations_with_the_noise_of_floating_point_have_a_common_unit():
    instance = small_instance(103, 4)
    noisy = instance._replace(
        tasks=tuple(task._replace(duration=0.1 * (k + 3)) for k, task in enumerate(instance.tasks))
    )
    clean = instance._replace(
        tasks=tuple(task._replace(duration=float(k + 3)) for k, task in enumerate(instance.tasks))
    )
    long = instance._replace(tasks=tuple(task._replace(duration=1333.3333333) for task in instance.tasks))
    answer = solve(long, "travel", "printed")  # more than nine digits
    assert answer.proven and not check(long, answer.schedule, "printed", answer.time_limit).faults
    found = [solve(one, "time", "printed") for one in (noisy, clean)]
    assert found[0].proven and found[0].value == pytest.approx(0.1 * found[1].value)


@pytest.mark.parametrize("tasks", [99, 300])  # both take more than twenty seconds to their end
def test_the_clock_is_heard_while_a_long_tour_is_measured(tasks):
    instance = draw_instance(6, 0.05, 900, tasks)
    chained = (
        instance._replace(priorities=tuple((f"t{k}", f"t{k + 1}") for k in range(1, tasks)))
        if tasks < 100
        else instance
    )
    for limit in (1.0, 3.0):  # the first one compiles
        answer = solve(chained, "travel", "printed", limit, processor_time=True)
    assert answer.ended == "time limit" and answer.seconds < 2 * limit
    assert answer.time_bound <= answer.time_limit and not check(chained, answer.schedule, "printed").faults


@pytest.mark.long
@pytest.mark.parametrize("part", range(10))
def test_five_hundred_instances(part):
    for seed in range(1000 + 50 * part, 1050 + 50 * part):
        reach = (Reach.PRINTED, Reach.INSCRIBED)[seed % 2]
        same_time(seed, reach, 7)
        same_travel(seed, reach, 5)


@pytest.mark.long
@pytest.mark.parametrize("part", range(10))
def test_the_papers_model_agrees_wherever_it_closes(part, capsys):
    """Of five hundred instances of up to six tasks, given five seconds of HiGHS for each objective."""
    seeds = range(1000 + 50 * part, 1050 + 50 * part)
    ended = [same_as_model(seed, (Reach.PRINTED, Reach.INSCRIBED)[seed % 2], 6, 5) for seed in seeds]
    timed, travelled = (sum(one) for one in zip(*ended, strict=True))
    with capsys.disabled():
        print(f" closed in {timed} and {travelled} of 50 ", end="")
    assert timed >= 40 and travelled >= 20


@pytest.mark.parametrize(("number", "density", "seed", "limit"), [
    (6, 0.05, 900001, 2.0), (8, 0.05, 900001, 2.0), (6, 0.1, 1, 4.0),  # the last one grows many sets
])  # fmt: skip
def test_a_hundred_tasks_end_in_time(number, density, seed, limit):
    """Seconds of the processor: no part of the search may be begun that does not look at the clock again in time."""
    instance = draw_instance(number, density, seed)
    solve(instance, "time", "printed", limit, processor_time=True)  # compiles
    answer = solve(instance, "time", "printed", limit, processor_time=True)
    assert answer.schedule is not None and answer.bound <= answer.value
    assert answer.seconds < 1.5 * limit


@pytest.mark.parametrize(("number", "density", "tasks"), [(1, 0.2, 20), (3, 0.05, 60), (9, 0.05, 30)])
def test_what_a_box_does_not_hand_on_is_in_no_better_set(number, density, tasks):
    problem = problem_of(draw_instance(number, density, 900, tasks), Reach.PRINTED)
    everything = np.ones(problem.size, bool)
    for seed in range(8):
        gains = np.random.default_rng([7, seed]).uniform(0.0, 1.0, problem.size)
        all_tasks, some = (
            Prices(problem, many).best(gains, everything, 0.5, 50_000, problem.region) for many in (False, True)
        )
        assert all_tasks.bound == pytest.approx(gains[all_tasks.sets[-1]].sum())  # none is left to look at
        assert some.bound == pytest.approx(all_tasks.bound)
        assert gains[some.sets[-1]].sum() == pytest.approx(some.bound)


@pytest.mark.parametrize("few", ["SOME", "MANY"])
@pytest.mark.parametrize(("number", "density"), [(1, 0.2), (2, 0.1), (5, 0.05)])
def test_the_ways_of_more_tasks_prove_the_same_time(number, density, few, monkeypatch):
    """Dives where otherwise more than 40 tasks begin; from 150 on pricing part by part, prices from the interior."""
    instance = draw_instance(number, density, 900)
    known = solve(instance, "time", "printed")
    for name in {few, "SOME"}:  # MANY: boxes hand on some of the tasks only, too
        monkeypatch.setattr(covering, name, 0)
        monkeypatch.setattr(completion, name, 0)
    answer = solve(instance, "time", "printed", 60.0, processor_time=True)
    assert known.proven and answer.bound <= known.value <= answer.value
    assert answer.bound >= 0.9 * known.value and not check(instance, answer.schedule, "printed").faults
    problem, clock = problem_of(instance, Reach.PRINTED), Clock(60.0)
    sets = covering.Covering(problem, clock)
    lengths = [covering.Layer(int(ticks), 0) for ticks in sorted(set(problem.ticks))]
    relaxed = sets.relax(np.arange(problem.size), lengths, float("inf"), 10.0)
    for draws in (None, np.random.default_rng(1)):
        slots = dive(problem, sets, relaxed.gains, 2, float("inf"), 30.0, draws)
        assert sorted(task for slot in slots for task in slot) == list(range(problem.size))
        assert all(Places(problem).deploy(np.array(slot)) is not None for slot in slots)
        assert known.value <= ticks_of(problem, slots) * problem.unit <= 1.5 * known.value
    assert dive(problem, sets, relaxed.gains, 2, known.value / problem.unit, 30.0, None) == []  # none is better
    assert dive(problem, sets, relaxed.gains, 2, float("inf"), 0.0, None) == []  # out of time
