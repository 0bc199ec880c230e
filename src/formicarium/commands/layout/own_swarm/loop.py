"""The main loop: sense, decide, act, move, serve, note."""

from formicarium.compiled import compiled
from formicarium.trial.swarm.phases import act, move, sense, serve

from own_swarm.behaviour import decide
from own_swarm.measures import note


@compiled
def run(state, cycles):
    """Advance a trial by so many control cycles, or until it is finished."""
    clock = state.clock[0]
    for _ in range(cycles):
        if clock.finished == 1:
            return

        # Every robot reads its sensors, all at the same instant.
        sense(state)

        # Every robot decides from its own reading and memory alone.
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(
                    state.readings[i],
                    state.memories[i],
                    state.commands[i],
                    state.behaviour[0],
                    state.epuck[0],
                    state.world.settings[0].cycle_time,
                )

        # Wheels turn, lights and radios change, bodies move and push; booths notice who is inside.
        act(state)
        move(state)
        serve(state)

        # The observer writes down what has happened.
        note(state)
        clock.cycle += 1
