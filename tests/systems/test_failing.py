"""Failures go with the name of a system, and are part of what a run is."""

import numpy as np
import pytest

from formicarium.commands.campaign.study import study_of
from formicarium.commands.errors import UserError
from formicarium.commands.known import parameters_of
from formicarium.commands.sources import sources_of
from formicarium.commands.work import configuration_of
from formicarium.systems.registry import UnknownSystem, resolve

NAME = "mark-i3+kill:3@20+block:0@5+unblock:0@15"


def small(system, seconds=30.0):
    parameters = system.configure(robots=5)
    return parameters.model_copy(update={"swarm": parameters.swarm.model_copy(update={"time_cap": seconds})})


def test_a_robot_dies_and_a_booth_is_dark_when_the_name_says_so():
    system = resolve(NAME)
    trial = system.run(small(system), 4, frames_every=1.0)
    died = trial.events[trial.events["kind"] == system.kinds.index("died")]
    state = system.begin(small(system), 4)
    third = int(state.robots.identity[state.robots.key == 2][0])
    assert died["robot"].tolist() == [third] and died["cycle"].tolist() == [200]
    assert trial.outcome["duration_s"] == 30.0
    dark = trial.frames.cycle[trial.frames.lit[:, 0] == 0]
    assert set(range(60, 150, 10)) <= set(dark.tolist()) and 40 not in dark and 160 not in dark
    assert trial.frames.role[trial.frames.cycle > 200, list(trial.frames.identity).index(third)].tolist() == [4] * 10


def test_a_rate_kills_about_as_many_as_it_says():
    system = resolve("mark-i3+rate:0.02")
    plain = resolve("mark-i3")
    deaths = [system.begin(plain.configure(robots=50), seed).robots.dies_at for seed in range(20)]
    share = np.mean(np.concatenate(deaths) < 500)  # 1 - exp(-0.02 * 50) = 0.632, standard deviation 0.015
    assert abs(share - 0.632) < 0.05


def test_failures_are_part_of_the_identity_and_the_sources_are_those_of_the_system():
    system, plain = resolve(NAME), resolve("mark-i3")
    assert system.name == NAME and sources_of(system) == sources_of(plain)
    assert configuration_of(system, small(plain)).identity != configuration_of(plain, small(plain)).identity


@pytest.mark.parametrize("text", ["kil:3@20", "kill:0@20", "kill:3", "kill:3@nan", "rate:-1", "", "block:-1@3"])
def test_what_cannot_be_read_is_shown_how(text):
    with pytest.raises(UnknownSystem, match="kill:ROBOT@SECONDS"):
        resolve(f"mark-i3+{text}")


def test_a_system_that_shows_no_state_cannot_fail():
    with pytest.raises(UnknownSystem, match="nothing can fail in it"):
        resolve("random_walk:RANDOM_WALK+kill:1@2")


@pytest.mark.parametrize(
    ("failure", "said"), [("kill:6@20", "there is no robot 6, they are 1 to 5"), ("block:9@20", "there is no booth 9")]
)
def test_what_is_not_there_cannot_fail_and_is_told_before_the_first_run(failure, said):
    system = resolve(f"mark-i3+{failure}")
    with pytest.raises(UserError, match=said):
        parameters_of(system, None, 5, ())
    with pytest.raises(UserError, match=said):
        parameters_of(system, None, 20, ("swarm.robots=5",))
    design = {"name": "dark", "system": system.name, "replicates": 1, "set": {"robots": 5}}
    with pytest.raises(UserError, match=said):
        study_of(design, "dark.toml", None)
    assert parameters_of(resolve("mark-i3+kill:22@20"), None, None, ("swarm.robots=25",)).swarm.robots == 25
    assert resolve("mark-i3+kill:22@20").configure().swarm.robots == 20  # of which describe tells
