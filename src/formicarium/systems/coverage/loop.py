"""The main loop of the coverage system: sense, decide, act, move, note; and first who fails."""

from formicarium.compiled import compiled
from formicarium.systems.coverage.behaviour import decide
from formicarium.systems.coverage.failures import fail
from formicarium.systems.coverage.measures import note
from formicarium.trial.situated import act, move, sense


@compiled
def run(state, cycles):
    """Advance a trial by so many control cycles, or until it is over or a master waits for a new plan."""
    clock = state.clock[0]
    for _ in range(cycles):
        if clock.finished == 1 or state.survey[0].asked == 1:
            return

        # Some fail, in trials that ask for it.
        fail(state)

        # Everybody hears what was said in the last cycle, with range and bearing.
        sense(state)

        # Every robot decides from its own reading and memory alone, and speaks.
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(
                    state.readings[i],
                    state.memories[i],
                    state.commands[i],
                    state.behaviour[0],
                    state.charts[i],
                    state.footbot[0],
                )

        # Bodies move and are in each other's way and line of sight.
        act(state)
        move(state)

        # The observers write down what has happened.
        note(state)
        clock.cycle += 1
