"""The main loop of the partitioning system: sense, decide, act, move, serve, note."""

from formicarium.compiled import compiled
from formicarium.devices.depot import serve_depots
from formicarium.robots.simulated.speech import sense_speech
from formicarium.systems.partitioning.behaviour import decide
from formicarium.systems.partitioning.measures import note
from formicarium.systems.partitioning.talk import listen, speak
from formicarium.trial.wheeled import act, move, sense


@compiled
def run(state, cycles):
    """Advance a trial by so many control cycles."""
    for _ in range(cycles):
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
                    state.strategy[0],
                    state.chart[0],
                    state.epuck[0],
                )

        # Robots that talk hear what their neighbours have measured: an option, the paper's do not.
        if state.strategy[0].social_weight > 0.0:
            talk(state)

        # Wheels turn, bodies push, source, nest and cache notice who is inside, observers write it down.
        go_on(state)


@compiled
def go_on(state):
    """Let the world go on from what the robots command, to the next cycle."""
    clock = state.clock[0]
    act(state)
    move(state)
    serve_depots(
        state.depots,
        state.pairs,
        state.lights,
        state.grips,
        state.world.bodies,
        state.interfacing,
        clock.cycle,
        state.world.settings[0].cycle_time,
    )
    note(state)
    clock.cycle += 1


@compiled
def talk(state):
    """Let all speak, then all hear, then all make something of it."""
    strategy, chart = state.strategy[0], state.chart[0]
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            speak(state.readings[i], state.memories[i], state.voices[i], strategy, chart)
    for i in range(len(state.robots)):
        sense_speech(state.world, i, state.robots, state.voices, strategy.social_range)
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            listen(state.memories[i], state.voices[i], strategy)
