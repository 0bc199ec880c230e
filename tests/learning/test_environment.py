"""A swarm as a PettingZoo environment: its own contract tests, and the same trial as the simulator's."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

import formicarium
from formicarium.commands.errors import UserError
from formicarium.commands.laying_out import lay_out
from formicarium.robots.footbot import READING as FOOTBOT_READING
from formicarium.robots.records import SILENCE
from formicarium.systems.registry import names, resolve
from formicarium.trial.simulate import drain

pytest.importorskip("pettingzoo")
from gymnasium.spaces import flatten, unflatten
from pettingzoo.test import parallel_api_test, parallel_seed_test

from formicarium.learning.environment import SwarmEnvironment
from formicarium.learning.spaces import blanked

OPEN = [name for name in names() if resolve(name).onboard is not None]
OWN = "learners"
IDLE = ("infrared",)  # a field that what is laid out does not use: who decides it alone changes nothing


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Stand in the folder of a system that was just laid out."""
    place, before = tmp_path_factory.mktemp("own"), os.getcwd()
    os.chdir(place)
    lay_out(OWN)
    os.chdir(place / OWN)
    yield place / OWN
    os.chdir(before)
    sys.path[:] = [path for path in sys.path if path != str(place / OWN)]


def made(name, robots=4, seconds=4.0, changes=None, **options):
    chosen = formicarium.parameters(name, robots=robots, changes={"time_cap": seconds, **(changes or {})})
    return formicarium.parallel_env(name, parameters=chosen, **options)


def sampled(env):
    return {agent: env.action_space(agent).sample() for agent in env.agents}


def played(env, seed, actions=sampled, cycles=10_000):
    """Play a trial; return all that was seen of it."""
    seen = [env.reset(seed=seed)]
    for k, agent in enumerate(env.agents):
        env.action_space(agent).seed(k)
    while env.agents and len(seen) <= cycles:
        seen.append(env.step(actions(env)))
    return seen


def bytes_of(value):
    if isinstance(value, dict):
        return {key: bytes_of(part) for key, part in value.items()}
    return value.tobytes() if isinstance(value, np.ndarray) else value


@pytest.mark.parametrize("name", [*OPEN, OWN])
@pytest.mark.filterwarnings("error::UserWarning")
def test_it_passes_the_tests_of_pettingzoo(name, folder):
    parallel_api_test(made(name), num_cycles=60)
    parallel_seed_test(lambda: made(name), num_cycles=20)


@pytest.mark.parametrize("name", [*OPEN, OWN])
def test_a_seed_decides_a_whole_trial_and_another_seed_another(name, folder):
    """That of PettingZoo ends after one step."""
    first, again, other = (
        [[bytes_of(part) for part in step] for step in played(made(name), seed)] for seed in (7, 7, 8)
    )
    assert len(first) == 41 and first == again and first != other


@pytest.mark.parametrize("name", ["mark-i3", OWN])
def test_what_is_observed_is_the_reading_and_lies_in_its_space(name, folder):
    env = made(name, robots=12)
    for observations, *_ in played(env, 3):
        readings = np.asarray(env.swarm.readings)
        for agent, observation in observations.items():
            assert env.observation_space(agent).contains(observation)
            assert {key.partition(".")[0] for key in observation} == set(readings.dtype.names)
            for part in ("blobs.distance", "packets.distance"):
                count = int(observation[f"{part[: -len('s.distance')]}_count"][0])
                assert not observation[part][count:].any()
    assert max(int(observation["packet_count"][0]) for observation in observations.values()) > 0
    kept = {agent: bytes_of(observation) for agent, observation in observations.items()}
    env.reset(seed=9)
    assert kept == {agent: bytes_of(observation) for agent, observation in observations.items()}


WHEELS = ("left", "right")


@pytest.mark.parametrize(
    ("name", "act"),
    [*((name, act) for name in ("mark-i3", OWN, "coverage") for act in (WHEELS, None)), ("partitioning", None)],
)
def test_who_does_what_the_behaviour_would_gets_the_trial_of_the_simulator(name, act, folder):
    """With the wheels alone left to the learner, roles, memories and events are the same too."""
    system, events = resolve(name), []
    env = made(name, robots=8, seconds=60.0, act=act, reward=lambda state, log: events.append(log) or 0.0)
    state = system.begin(formicarium.parameters(name, robots=8, changes={"time_cap": 60.0}), 5)

    def same(env):
        system.advance(state, 1)
        fields = env.action_space("robot_1").keys()
        return {
            agent: {field: np.atleast_1d(np.asarray(state.commands[field])[i]) for field in fields}
            for i, agent in enumerate(env.possible_agents)
        }

    _, _, ended, late, _ = played(env, 5, same)[-1]
    assert env.swarm.clock[0].cycle == 600 and all(late.values()) and not any(ended.values())
    assert env.swarm.world.bodies.tobytes() == state.world.bodies.tobytes()
    if act is not None:
        assert env.swarm.memories.tobytes() == state.memories.tobytes()
        assert np.concatenate(events).tobytes() == drain(state).tobytes()
        assert len(np.concatenate(events)) > 8


def test_a_goal_ends_a_trial_and_the_time_cap_cuts_it_off(folder):
    env = made(OWN, robots=3, seconds=300.0, changes={"stay": 0.5, "near": 0.8}, act=IDLE)
    *_, (_, _, ended, late, _) = played(env, 2, lambda env: {agent: {"infrared": [SILENCE]} for agent in env.agents})
    assert all(ended.values()) and not any(late.values()) and env.agents == []
    assert env.swarm.clock[0].cycle < env.swarm.clock[0].last_cycle


def test_a_message_of_many_parts_is_observed_and_stays_the_behaviours():
    """Word of the phase goes from robot to robot, though the learner decides every speed and light."""
    env = made("coverage", robots=3, seconds=6.0)
    assert set(env.action_space("robot_2")) == {"ahead", "aside", "left", "right", "colour", "enabled"}
    speak = {name: np.zeros(box.shape, box.dtype) for name, box in env.action_space("robot_1").items()}
    speak["enabled"][:] = 1
    *_, (observations, *_) = played(env, 1, lambda env: dict.fromkeys(env.agents, speak))
    heard = observations["robot_2"]
    assert heard["packets.arms.direction"].shape == (128, 6)
    assert heard["packet_count"][0] == 2 and (heard["packets.epoch"][:2] >= 1).all()


def test_lists_in_lists_hold_zeros_beyond_their_counts():
    readings = np.zeros(1, FOOTBOT_READING)
    readings["packet_count"], readings["packets"]["arm"] = 2, 1
    readings["packets"]["arm_count"], readings["packets"]["arms"]["task"] = 3, 5
    found = blanked(readings)["packets"][0]
    assert (found["arms"]["task"][:2, :3] == 5).all() and not found["arms"]["task"][:2, 3:].any()
    assert (found["arm"][:2] == 1).all() and not found["arm"][2:].any() and not found["arms"]["task"][2:].any()


def test_who_dies_is_gone_and_the_others_go_on():
    env = made("mark-i3", changes={"deaths": [[2, 1.0]]})
    seen = played(env, 1)
    gone = [number for number, (_, _, ended, _, _) in enumerate(seen[1:], 1) if ended.get("robot_2")]
    assert gone == [11] and "robot_2" not in seen[12][0] and set(seen[-1][0]) == {"robot_1", "robot_3", "robot_4"}
    assert seen[-1][3] == {"robot_1": True, "robot_3": True, "robot_4": True}


def test_agents_are_the_same_in_every_trial_and_seeds_follow_from_the_last_given():
    env = made("mark-i3")
    seeds, identities = [], []
    for given in (5, None, None, 5, None, None):
        observations, infos = env.reset(seed=given)
        assert env.agents == env.possible_agents == ["robot_1", "robot_2", "robot_3", "robot_4"]
        assert infos == {agent: {} for agent in env.agents}
        seeds.append(env.seed)
        identities.append([int(observations[agent]["identity"][0]) for agent in env.agents])
    assert seeds[0] == 5 and seeds[:3] == seeds[3:] and len(set(seeds)) == 3
    assert identities[:3] == identities[3:] and identities[0] != identities[1]


def test_wheels_are_bounded_by_their_limit_and_a_vector_is_as_good_as_names():
    env = made("mark-i3", observe=("proximity", "infrared"), act=("left", "right"))
    space = env.action_space("robot_1")
    assert {name: (box.low[0], box.high[0]) for name, box in space.items()} == dict.fromkeys(
        ("left", "right"), (-0.12, 0.12)
    )
    observations, _ = env.reset(seed=1)
    assert flatten(env.observation_space("robot_1"), observations["robot_1"]).shape == (9,)
    env.step({agent: unflatten(space, np.array([0.05, 7.0])) for agent in env.agents})  # the motors cut 7 m/s
    assert (np.asarray(env.swarm.robots["left_path"]) == pytest.approx(0.005)) and np.allclose(
        env.swarm.robots["right_path"], 0.012
    )


def test_wheels_of_each_caste_are_bounded_by_its_own_limit(monkeypatch):
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2] / "docs" / "examples"))
    env = made("example_04_two_castes:SYSTEM", act=("left",))
    limits = {agent: float(env.action_space(agent)["left"].high[0]) for agent in env.possible_agents}
    assert limits == {"robot_1": 0.12, "robot_2": 0.05, "robot_3": 0.05, "robot_4": 0.05}


def test_a_reward_is_one_for_all_or_one_a_robot():
    seen = played(made("mark-i3", reward=lambda state, events: float(state.clock[0].cycle)), 1, cycles=3)
    assert [step[1]["robot_2"] for step in seen[1:]] == [1.0, 2.0, 3.0]
    seen = played(made("mark-i3", reward=lambda state, events: state.robots["key"] * 10), 1, cycles=1)
    assert seen[1][1] == {"robot_1": 0.0, "robot_2": 10.0, "robot_3": 20.0, "robot_4": 30.0}
    assert set(played(made("mark-i3"), 1, cycles=1)[1][1].values()) == {0.0}


WRONG = [
    (lambda action: None, "robot_2: its action is missing"),
    (lambda action: action | {"height": 1.0}, "robot_2: an action has the fields left, right, colour"),
    (lambda action: action | {"left": [0.1, 0.1]}, r"robot_2: left has shape \(2,\): must be \(1,\)"),
    (lambda action: action | {"colour": [8]}, r"robot_2: colour = \[8\]: must be 0 to 7"),
    (lambda action: action | {"right": [np.nan]}, r"robot_2: right = \[nan\]: must be finite"),
]


@pytest.mark.parametrize(("spoil", "words"), WRONG)
def test_an_action_that_is_none_is_named(spoil, words):
    env = made("mark-i3")
    env.reset(seed=1)
    actions = sampled(env)
    spoiled, before = spoil(actions.pop("robot_2")), env.swarm.commands.tobytes()
    with pytest.raises(ValueError, match=words):
        env.step(actions if spoiled is None else actions | {"robot_2": spoiled})
    assert env.swarm.commands.tobytes() == before and env.swarm.clock[0].cycle == 0


def test_a_behaviour_that_commands_no_number_is_named():
    env = made("mark-i3", act=("left",))

    def rave(reading, memory, command, *tables):
        command.right = np.nan

    env._decide = rave
    env.reset(seed=1)
    with pytest.raises(ValueError, match="robot_1: its behaviour commands right that is no number in cycle 0"):
        env.step(sampled(env))


@pytest.mark.parametrize("reward", [lambda state, events: [1.0, 2.0], lambda state, events: float("nan")])
def test_a_reward_that_is_none_is_named(reward):
    with pytest.raises(ValueError, match=r"the reward is .* must be a finite number, or 4 of them"):
        played(made("mark-i3", reward=reward), 1, cycles=1)


def test_what_cannot_be_is_told(monkeypatch):
    with pytest.raises(UserError, match=r"mark-i3\+kill:1@5 does not say where its robots decide"):
        formicarium.parallel_env("mark-i3+kill:1@5")
    talking = formicarium.parameters("partitioning", robots=2, changes={"social_weight": 0.5})
    with pytest.raises(UserError, match=r"strategy\.social_weight: must be 0"):
        formicarium.parallel_env("partitioning", parameters=talking)
    with pytest.raises(UserError, match=r"act = \['message'\]: there is no field 'message'; choose from ahead, aside"):
        formicarium.parallel_env("coverage", act=["message"])
    with pytest.raises(UserError, match=r"observe = \['place'\]: there is no field 'place'; choose from identity"):
        formicarium.parallel_env("mark-i3", observe=["place"])
    with pytest.raises(UserError, match=r"act = \[\]: it is empty; choose from left, right"):
        formicarium.parallel_env("mark-i3", act=[])
    with pytest.raises(ValueError, match=r"no trial goes on: call reset\(\)"):
        SwarmEnvironment(resolve("mark-i3"), resolve("mark-i3").configure(robots=2)).step({})
    monkeypatch.setattr("formicarium.commands.extras.find_spec", lambda name: None)
    with pytest.raises(UserError, match=r"needs pettingzoo and gymnasium.*formicarium\[rl\]"):
        formicarium.parallel_env("mark-i3")
