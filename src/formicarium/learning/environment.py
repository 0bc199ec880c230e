"""A system as a PettingZoo environment: every robot is an agent, its Reading the observation, its Command the action.

One step is one control cycle, taken apart as for controllers in processes of their own (``System.onboard``): the world
up to the readings, the robots' decisions, the world from the commands on. The learner stands where the robots decide.
"""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any

import numpy as np
from gymnasium import spaces
from pettingzoo import ParallelEnv

from formicarium.learning.spaces import blanked, boxes_of, columns_of, names_of, plain
from formicarium.streams import generator
from formicarium.systems.registry import System
from formicarium.trial.lockstep import own
from formicarium.trial.simulate import drain

Fields = dict[str, np.ndarray]  # name of a field -> its numbers
Reward = Callable[[Any, np.ndarray], float | np.ndarray]
FIRST = 1  # seed of an environment that never was given one


class SwarmEnvironment(ParallelEnv[str, Fields, Fields]):
    """A swarm whose robots a learner commands. Agents are "robot_1" to "robot_N" in every trial.

    Attributes:
        seed: of the trial that is going on; with it the trial can be had again.
        swarm: the trial's state, for rewards and for looking on; no part of an observation.
    """

    def __init__(
        self,
        system: System,
        parameters: Any,
        reward: Reward | None = None,
        observe: Sequence[str] | None = None,
        act: Sequence[str] | None = None,
    ):
        """Make the environment; see ``formicarium.parallel_env`` for the arguments.

        Raises:
            ValueError: if the system does not say where its robots decide, or a field does not exist.
        """
        if system.onboard is None or system.begin is None:
            raise ValueError(f"{system.name} does not say where its robots decide (System.onboard)")
        self._begin, self._onboard = system.begin, system.onboard
        self._parameters, self._reward = parameters, reward
        self.metadata = {"name": system.name, "render_modes": [], "is_parallelizable": True}
        self.render_mode = None
        self._begin_trial(FIRST)
        self._seeds = generator(FIRST, "later trials")
        readings, commands = np.asarray(self.swarm.readings), np.asarray(self.swarm.commands)
        self._observed = names_of(readings.dtype, observe, "observe")
        self._acted = names_of(plain(commands.dtype), act, "act")
        self._speeds = [name for name in commands.dtype.names or () if commands.dtype[name].base.kind == "f"]
        whole = set(self._acted) == set(names_of(commands.dtype))
        self._decide = None if whole else _function(self._onboard.decide)
        self._boxes = boxes_of(commands.dtype, self._acted, {})
        self.possible_agents = list(self._places)
        self.agents: list[str] = []
        self.observation_spaces = {
            agent: spaces.Dict(tuple(boxes_of(readings.dtype, self._observed, {}).items()))
            for agent in self.possible_agents
        }
        self.action_spaces = {
            agent: spaces.Dict(tuple(boxes_of(commands.dtype, self._acted, self._limits(i)).items()))
            for agent, i in self._places.items()
        }

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Return the space of what an agent senses."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Return the space of what an agent commands."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Fields], dict[str, dict[str, Any]]]:
        """Begin a trial and return what every robot senses first.

        Args:
            seed: decides everything that is random in this trial, and the seeds of the trials that are begun without
                one after it.
            options: there are none.
        """
        if seed is not None:
            self._seeds = generator(seed, "later trials")
        self._begin_trial(int(self._seeds.integers(1 << 31)) if seed is None else seed)
        self._onboard.before(self.swarm)
        self.agents = list(self.possible_agents)
        return self._observations(self.agents), {agent: {} for agent in self.agents}

    def step(
        self, actions: Mapping[str, Mapping[str, Any]]
    ) -> tuple[dict[str, Fields], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        """Let every living robot do what its action says for one control cycle.

        Returns:
            Observations, rewards, terminations (the trial has reached its goal, or the robot has died), truncations
            (the time cap came first) and empty infos, each by agent.

        Raises:
            ValueError: if no trial goes on, or an action is missing or not allowed, and nothing has happened then; if
                a behaviour's speed or a reward is no number.
        """
        if not self.agents:
            raise ValueError("no trial goes on: call reset()")
        acting, state = self.agents, self.swarm
        checked = {agent: self._checked(agent, actions) for agent in acting}
        if self._decide is not None:
            self._let_behaviours_decide(acting)
        columns = columns_of(np.asarray(state.commands), self._acted)
        for agent, values in checked.items():
            for name, value in values.items():
                columns[name][self._places[agent]] = value
        self._onboard.after(state)
        clock, alive = state.clock[0], state.robots["alive"]
        rewards = self._rewards(acting, drain(state))
        ended = {agent: bool(clock.finished or not alive[self._places[agent]]) for agent in acting}
        late = {agent: bool(clock.cycle >= clock.last_cycle and not ended[agent]) for agent in acting}
        self._onboard.before(state)
        self.agents = [agent for agent in acting if not (ended[agent] or late[agent])]
        return self._observations(acting), rewards, ended, late, {agent: {} for agent in acting}

    def _begin_trial(self, seed: int) -> None:
        self.seed = seed
        self.swarm = self._begin(self._parameters, seed)
        keys = np.asarray(self.swarm.robots["key"])
        self._places = {f"robot_{keys[i] + 1}": int(i) for i in np.argsort(keys)}
        tables = self._onboard.tables(self.swarm)
        self._tables = [[own(table, i, len(keys)).view(np.recarray)[0] for table in tables] for i in range(len(keys))]

    def _limits(self, i: int) -> dict[str, float]:
        """Return the speeds that robot ``i``'s wheels are said to reach (m/s) in what it is told; none if none is."""
        told = [table["speed_limit"] for table in self._tables[i] if "speed_limit" in (table.dtype.names or ())]
        return dict.fromkeys(self._speeds, float(told[0])) if told else {}

    def _observations(self, agents: Sequence[str]) -> dict[str, Fields]:
        columns = columns_of(blanked(self.swarm.readings), self._observed)
        return {agent: {name: column[self._places[agent]] for name, column in columns.items()} for agent in agents}

    def _checked(self, agent: str, actions: Mapping[str, Mapping[str, Any]]) -> Fields:
        """Return an agent's action as arrays. Speeds that are too large stay: the robot itself cuts them."""
        if agent not in actions:
            raise ValueError(f"{agent}: its action is missing; every agent of env.agents needs one")
        if actions[agent].keys() != self._boxes.keys():
            raise ValueError(
                f"{agent}: an action has the fields {', '.join(self._boxes)}, not {', '.join(actions[agent])}"
            )
        values = {name: np.asarray(value) for name, value in actions[agent].items()}
        for name, box in self._boxes.items():
            value = values[name]
            if value.shape != box.shape:
                raise ValueError(f"{agent}: {name} has shape {value.shape}: must be {box.shape}")
            if box.dtype.kind == "f" and not np.isfinite(value).all():
                raise ValueError(f"{agent}: {name} = {value.tolist()}: must be finite")
            if box.dtype.kind != "f" and ((value < box.low) | (value > box.high)).any():
                raise ValueError(f"{agent}: {name} = {value.tolist()}: must be {box.low.min()} to {box.high.max()}")
        return values

    def _let_behaviours_decide(self, agents: Sequence[str]) -> None:
        """Fill in every robot's Command as its behaviour wants it; what the learner decides is written over it."""
        assert self._decide is not None
        state = self.swarm
        for i in map(self._places.__getitem__, agents):
            self._decide(state.readings[i], state.memories[i], state.commands[i], *self._tables[i])
        for name, column in columns_of(np.asarray(state.commands), self._speeds).items():
            if not np.isfinite(column).all():
                agent = next(agent for agent, i in self._places.items() if not np.isfinite(column[i]).all())
                cycle = int(state.clock[0].cycle)
                raise ValueError(f"{agent}: its behaviour commands {name} that is no number in cycle {cycle}")

    def _rewards(self, agents: Sequence[str], events: np.ndarray) -> dict[str, float]:
        if self._reward is None:
            return dict.fromkeys(agents, 0.0)
        found, count = np.asarray(self._reward(self.swarm, events), float), len(self._places)
        if found.shape not in ((), (count,)) or not np.isfinite(found).all():
            raise ValueError(f"the reward is {found}: must be a finite number, or {count} of them, one a robot")
        each = np.broadcast_to(found, (count,))
        return {agent: float(each[self._places[agent]]) for agent in agents}


def _function(place: str) -> Callable[..., None]:
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)
