"""The main loop of the sequencing system: sense, decide, act, move, serve, note."""

from formicarium.compiled import compiled
from formicarium.devices.service import serve_booths
from formicarium.systems.sequencing.behaviour import decide
from formicarium.systems.sequencing.measures import note
from formicarium.systems.sequencing.runner import run as run_errands
from formicarium.trial.phases import act, move, sense


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
                )

        # Wheels turn, lights and radios change, bodies move and push.
        act(state)
        move(state)

        # The booths notice who is inside and answer.
        serve_booths(
            state.booths,
            state.lights,
            state.coordinator[0],
            state.robots,
            state.world.bodies,
            state.commands,
            state.booth_table[0],
            clock.cycle,
            state.world.settings[0].cycle_time,
        )

        # The observers write down what has happened.
        note(state)
        clock.cycle += 1


def apart(state):
    """Return what a cold start can compile beside the rest, by the time that it takes: half of the whole."""
    robot = (state.readings[0], state.memories[0], state.commands[0], state.behaviour[0], state.epuck[0])
    return (run_errands, robot), (note, (state,)), (move, (state,))
