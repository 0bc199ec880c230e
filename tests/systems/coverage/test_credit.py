"""Credit of tasks and losses of connection, reckoned again from the recorded log by other code (ST-69, ST-70)."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from formicarium.systems.coverage.measures import EventKind
from formicarium.systems.coverage.memory import Mode
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.study import run_trial
from systems.coverage.swarm import line, move, stay, swarm
from systems.coverage.test_mission import SLOTS

LONE = ({"x": 0.0, "y": 0.0, "tasks": ({"name": "end", "x": 6.0, "y": 0.0, "duration": 60.0, "robots": 3},)},)
BARE = {"variant": "faithful", "arm_choice": "quota"}
ON = {"rendezvous": "flocking", "sweep_cycles": 600, "strays": "return", "agreed_cycles": 0, "arm_choice": "quota"}
NOISE = {"radio_loss": 0.1, "range_noise": 0.02, "bearing_noise": 0.035}
RUNS = {
    "safe, noise": ({"variant": "safe", **ON}, NOISE, 0.0, 1),
    "faithful, bare": (BARE, {}, 0.0, 2),
    "thin radio": ({"variant": "buzz", "arm_choice": "quota"}, {"radio_loss": 0.3}, 0.0, 3),
    "robots die": ({"variant": "safe", **ON}, {}, 0.002, 4),
    "master dies": ({"variant": "safe", **ON, "silence_cycles": 50, "census_cycles": 300}, NOISE, 0.0, 5),
}
DEATH = {"count": 1, "aim": "master", "earliest": 90.0, "latest": 91.0}


def parameters(behaviour, footbot, failure_rate):
    return coverage_parameters(
        0,
        8,
        swarm={"time_cap": 500.0, "failure_rate": failure_rate},
        tasks={"programme": "mission", "erupt_limit": 100.0},
        mission={"slots": SLOTS, "replans": 3 if "silence_cycles" in behaviour else 0},
        failures=DEATH if "silence_cycles" in behaviour else {},
        behaviour=behaviour,
        footbot=footbot,
    )


def joined(places, living, reach, radius):
    """Return (N,) labels of components by radio range, and by lines that no other body crosses."""
    count = len(places)
    gaps = places[:, None] - places[None]
    distance = np.hypot(gaps[..., 0], gaps[..., 1])
    near = (distance <= reach) & living[:, None] & living & ~np.eye(count, dtype=bool)
    clear = near.copy()
    for i, j in zip(*np.nonzero(near), strict=True):
        way = (places[j] - places[i]) / distance[i, j]
        rest = places - places[i]
        along, across = rest @ way, np.abs(rest @ np.array([-way[1], way[0]]))
        between = (along > 0.0) & (along < distance[i, j]) & (across < radius)
        between[[i, j]] = False
        clear[i, j] = not between.any()
    return [connected_components(csr_array(links), directed=False)[1] for links in (near, clear)]


def reckoned(p, trial):
    """Return from frames and events alone: cycles of work on each task, and for each cycle if the swarm was parted."""
    frames, events = trial.frames, trial.events
    column = {int(identity): k for k, identity in enumerate(frames.identity)}
    master = int(np.flatnonzero(frames.role[0] == trial.scene.roles.index("master"))[0])
    living = np.ones(len(column), bool)
    mode, epoch = np.zeros(len(column), int), np.zeros(len(column), int)
    first = np.cumsum([0, *(len(slot.tasks) for slot in p.mission.slots)])
    aims = {(k, arm): first[k] + arm for k, slot in enumerate(p.mission.slots) for arm in range(len(slot.tasks))}
    sites = np.array([(task.x, task.y) for task in p.mission.tasks])
    worked, parted, place = np.zeros(len(sites), int), [], 0
    for moment, after in enumerate(frames.cycle):
        while place < len(events) and events[place]["cycle"] < after:
            event = events[place]
            if event["kind"] == EventKind.PHASE:
                mode[column[int(event["robot"])]] = event["subject"]
                epoch[column[int(event["robot"])]] = event["value"]
            elif event["kind"] == EventKind.DIED:
                living[column[int(event["robot"])]] = False
            elif event["kind"] == EventKind.FOLLOWED:
                master = column[int(event["robot"])]
            elif event["kind"] == EventKind.AIMED:
                aims[int(event["detail"]), int(event["subject"]) - 1] = int(event["value"]) - 1
            place += 1
        if after == 0:
            continue
        places = np.stack([frames.x[moment], frames.y[moment]], axis=1).astype(float)
        ranged, sighted = joined(places, living, p.footbot.radio_range, p.footbot.radius)
        parted.append(not (living[master] and (ranged[living] == ranged[master]).all()))
        at_work = living & living[master] & (sighted == sighted[master]) & np.isin(mode, (Mode.ERUPT, Mode.HOLD))
        arm = frames.carried[moment].astype(int)
        for k, site in enumerate(sites):
            own = np.array([a > 0 and aims[max(e - 1, 0) // 4, a - 1] == k for a, e in zip(arm, epoch, strict=True)])
            worked[k] += bool((at_work & own & (np.hypot(*(places - site).T) <= p.footbot.beacon_range)).any())
    return worked, np.array(parted)


@pytest.mark.parametrize(
    "run", [pytest.param(run, marks=pytest.mark.long) if run in ("thin radio", "robots die") else run for run in RUNS]
)
def test_credit_and_losses_agree_with_what_other_code_reads_in_the_log(run):
    """Traps 19 and 23: every cycle, nothing averaged."""
    behaviour, footbot, failure_rate, seed = RUNS[run]
    p = parameters(behaviour, footbot, failure_rate)
    trial = run_trial(p, seed, frames_every=0.1)
    assert np.array_equal(np.diff(trial.frames.cycle), np.ones(len(trial.frames.cycle) - 1))
    worked, parted = reckoned(p, trial)
    row = trial.outcome
    assert [round(10.0 * row[f"worked_{k + 1}_s"]) for k in range(3)] == worked.tolist()
    assert worked.sum() > 0
    needed = [round(10.0 * task.duration) for task in p.mission.tasks]
    assert row["tasks_done"] == (worked >= needed).sum() and row["mission_done"] == (worked >= needed).all()
    done = trial.events[trial.events["kind"] == EventKind.WORKED]
    assert sorted(done["subject"].tolist()) == (np.flatnonzero(worked >= needed) + 1).tolist()
    assert row["lost_share_range"] == pytest.approx(parted.mean())
    if parted.any():
        assert row["first_loss_range_s"] == pytest.approx(0.1 * (int(parted.argmax()) + 1))
    else:
        assert row["first_loss_range_s"] is None
    longest = max((len(run) for run in "".join("01"[int(lost)] for lost in parted).split("0")), default=0)
    assert row["longest_loss_range_s"] == pytest.approx(0.1 * longest)
    assert row["flock_s"] + row["erupt_s"] + row["hold_s"] + row["gather_s"] == pytest.approx(row["duration_s"])


def test_some_of_these_runs_part_and_some_lose_robots():
    """Otherwise the test above would compare nothing with nothing."""
    rows = {run: run_trial(parameters(*RUNS[run][:3]), RUNS[run][3]).outcome for run in RUNS}
    assert max(row["lost_share_range"] for row in rows.values()) > 0.05
    assert rows["robots die"]["died"] > 0
    assert rows["master dies"]["followed"] == 1 and rows["master dies"]["planned_anew"] >= 1
    assert {row["mission_done"] for row in rows.values()} == {0, 1}


def test_who_passes_by_or_is_away_from_the_master_does_no_work():
    """Trap 19: of four robots in a chain the last stands at the task; it must be of the task's arm, and linked."""
    state = swarm(line(4), setting=0, tasks={"programme": "mission"}, mission={"slots": LONE}, behaviour=BARE)
    state.memories.epoch, state.memories.mode = 2, Mode.ERUPT
    stay(state, 5)
    assert (state.memories.arm[1:] == 1).all() and stay(state, 10).tasks[0].worked == 12
    state.beacons.task = 2
    assert stay(state, 10).tasks[0].worked == 12
    assert state.tasks[0].covered == 1
    state.beacons.task = 1
    hidden = stay(move(state, 2, 40.0, 0.0), 10)
    assert hidden.tasks[0].covered == 0 and hidden.tasks[0].worked == 12
