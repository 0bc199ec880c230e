"""The swarm as a system that can be run, watched, replayed, swept and tested."""

from formicarium.systems.own import Swarm, assemble

from own_swarm.arena import make_arena
from own_swarm.behaviour import MEMORY, Role, decide
from own_swarm.loop import run
from own_swarm.measures import EventKind, note, outcome
from own_swarm.parameters import Parameters

SYSTEM = assemble(
    Swarm(
        name="own-swarm",
        summary="A swarm of one's own: e-pucks that gather",
        parameters=Parameters,
        arena=make_arena,
        memory=MEMORY,
        loop=run,
        outcome=outcome,
        kinds=EventKind,
        roles=Role,
        decide=decide,  # with note: to run every robot as a process of its own (formicarium onboard)
        note=note,
        times={"time_gathered_s": "gathered"},  # columns of the row that are run times, for distributions
    )
)
