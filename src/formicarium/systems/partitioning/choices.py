"""A robot's two decisions and its patience, on its own clock: what is timed, and when (TP-20 to TP-24)."""

from formicarium.compiled import compiled
from formicarium.streams import advanced, uniform
from formicarium.systems.partitioning.hierarchy import (
    choose_in_tree,
    cost_of_first,
    cost_of_second,
    renew_way,
    way_of,
)
from formicarium.systems.partitioning.memory import NEVER, Area, Deed, Estimate, Label
from formicarium.systems.partitioning.parameters import ALWAYS_PARTITION, NEVER_PARTITION
from formicarium.systems.partitioning.strategy import (
    explored,
    giving_up_probability,
    partition_probability,
    renewed,
    steepness_of,
)


@compiled
def choose(reading, memory, strategy, chart):
    """Decide between cache and corridor; start the timer."""
    if strategy.hierarchical == 1:
        choose_in_tree(memory, strategy)
    else:
        choose_cache(reading, memory, strategy, chart)
    memory.timer = reading.cycle
    memory.set_out = memory.area
    memory.waiting = 0
    memory.wait_began = NEVER


@compiled
def choose_cache(reading, memory, strategy, chart):
    """Decide with P_p, equation 1; the corridor leads to the other end."""
    memory.choices = advanced(memory.choices)
    memory.far = Area.NEST if memory.loaded == 1 else Area.SOURCE
    if strategy.method == NEVER_PARTITION:
        memory.probability = 0.0
    elif strategy.method == ALWAYS_PARTITION:
        memory.probability = 1.0
    else:
        memory.probability = partition_probability(
            memory.whole,
            memory.harvest,
            memory.store + memory.middle,
            steepness_of(strategy, memory.stay),
            strategy.least_probability,
        )
        explore(reading, memory, strategy, chart)
    memory.label = Label.CACHE if uniform(memory.choices) < memory.probability else Label.CORRIDOR


@compiled
def explore(reading, memory, strategy, chart):
    """Mind the ages of one's times (TP-O5): the corridor measures t_NP and leads to the other side's sub-task."""
    here, there = Estimate.STORE, Estimate.HARVEST
    if memory.loaded == 1:
        here, there = Estimate.HARVEST, Estimate.STORE
    if memory.area == Area.MIDDLE:
        here = Estimate.MIDDLE
    corridor_age = max(age_of(reading, memory, chart, Estimate.WHOLE), age_of(reading, memory, chart, there))
    memory.probability = explored(memory.probability, corridor_age, age_of(reading, memory, chart, here), strategy)


@compiled
def age_of(reading, memory, chart, estimate):
    """Return how long ago (s) a time was last measured; a first guess is as old as the trial."""
    return (reading.cycle - max(0, memory.measured_at[estimate])) * chart.cycle_time


@compiled
def note_measurement(reading, memory, estimate):
    """Remember which time has just been renewed, and when."""
    memory.updated = estimate
    memory.measured_at[estimate] = reading.cycle


@compiled
def note_stay(reading, memory, strategy, chart):
    """Average the stays in cache booths: the robot's own measure of the interfacing time (TP-O4)."""
    seconds = (reading.cycle - memory.since) * chart.cycle_time
    memory.stay = seconds if memory.stay < 0.0 else renewed(memory.stay, seconds, strategy.alpha)


@compiled
def close_timer(reading, memory, strategy, chart, at_nest):
    """Renew the estimate that the trip just ended is a measurement of (TP-21).

    From one harvest to the next through the cache: phi_1; from one store to the next: phi_2. Through the corridor:
    twice the crossing is t_NP (TP-22). After giving up: none.
    """
    memory.updated = Estimate.NONE
    memory.measured = 0.0
    if memory.timer == NEVER:
        return
    seconds = (reading.cycle - memory.timer) * chart.cycle_time
    if strategy.hierarchical == 1 and close_way(reading, memory, strategy, seconds):
        return
    if memory.label == Label.CORRIDOR and memory.set_out == Area.MIDDLE:
        return  # neither a crossing nor a sub-task
    if memory.label == Label.CORRIDOR:
        note_measurement(reading, memory, Estimate.WHOLE)
        memory.measured = 2.0 * seconds
        memory.whole = renewed(memory.whole, memory.measured, strategy.alpha)
    elif memory.label == Label.CACHE and memory.area == Area.MIDDLE:
        if memory.set_out == Area.MIDDLE:
            note_measurement(reading, memory, Estimate.MIDDLE)
            memory.measured = seconds
            memory.middle = renewed(memory.middle, seconds, strategy.alpha)
    elif memory.label == Label.CACHE and at_nest:
        note_measurement(reading, memory, Estimate.STORE)
        memory.measured = seconds
        memory.store = renewed(memory.store, seconds, strategy.alpha)
    elif memory.label == Label.CACHE:
        note_measurement(reading, memory, Estimate.HARVEST)
        memory.measured = seconds
        memory.harvest = renewed(memory.harvest, seconds, strategy.alpha)


@compiled
def close_way(reading, memory, strategy, seconds):
    """Renew the time of a way in a tree of tasks; tell whether the trip just ended was one (TP-O2)."""
    way = way_of(memory, memory.area, memory.loaded == 1)  # who has an object in the middle has just picked it up
    if way < 0:
        return False
    if memory.label != Label.GAVE_UP:
        note_measurement(reading, memory, Estimate.WAY)
        memory.measured = seconds
        renew_way(memory, strategy, way, seconds)
    return True


@compiled
def draw_cycles(strategy, chart):
    """Return the cycles between two draws of P_g."""
    return max(1, int(strategy.giveup_draw_period / chart.cycle_time + 0.5))


@compiled
def start_wait(reading, memory, strategy, chart):
    """Begin to wait at the cache: the clock w of equation 3 starts; the first draw is a period away (U3)."""
    memory.waiting = 1
    memory.wait_began = reading.cycle
    memory.draws_made = 0
    memory.draw_due = reading.cycle + draw_cycles(strategy, chart)
    memory.patience = advanced(memory.patience)
    memory.limit = uniform(memory.patience)


@compiled
def gives_up(reading, memory, strategy, chart, to_pick):
    """Draw whether to give up, if a draw is due; on giving up, renew an estimate that the wait has exceeded (TP-23)."""
    waited = (reading.cycle - memory.wait_began) * chart.cycle_time
    if strategy.method == ALWAYS_PARTITION:
        return False
    own, parts = awaited(memory, strategy, to_pick)
    probability = giving_up_probability(waited, own, parts, 0.0, strategy.giveup_steepness, strategy.giveup_offset)
    if strategy.threshold == 1:
        leaves = probability >= memory.limit
    else:
        if reading.cycle < memory.draw_due:
            return False
        # Draws that fell due while the robot was making for a booth are not made up for.
        memory.draw_due = reading.cycle + draw_cycles(strategy, chart)
        memory.draws_made += 1
        memory.patience = advanced(memory.patience)
        leaves = uniform(memory.patience) < probability
    if not leaves:
        return False
    memory.updated = Estimate.NONE
    memory.measured = waited
    if waited > own:
        renew_awaited(reading, memory, strategy, to_pick, waited)
    memory.probability = probability
    memory.label = Label.GAVE_UP
    memory.waiting = 0
    note_deed(memory, Deed.GAVE_UP, reading.cycle)
    return True


@compiled
def awaited(memory, strategy, to_pick):
    """Return one's time (s) for what one waits to go on with, and that of all the parts of the whole task."""
    if strategy.hierarchical == 1:
        at_first = (memory.area == Area.MIDDLE) == to_pick
        parts = cost_of_first(memory, strategy) if at_first else cost_of_second(memory, strategy)
    else:
        parts = memory.harvest + (memory.store + memory.middle)
    if memory.area == Area.MIDDLE and strategy.hierarchical == 1:
        own = memory.ways[way_of(memory, Area.MIDDLE, to_pick)]
    elif memory.area == Area.MIDDLE:
        own = memory.middle
    else:
        own = memory.store if to_pick else memory.harvest
    return own, parts


@compiled
def renew_awaited(reading, memory, strategy, to_pick, waited):
    """Renew the time that the wait has exceeded."""
    if memory.area == Area.MIDDLE and strategy.hierarchical == 1:
        note_measurement(reading, memory, Estimate.WAY)
        renew_way(memory, strategy, way_of(memory, Area.MIDDLE, to_pick), waited)
    elif memory.area == Area.MIDDLE:
        note_measurement(reading, memory, Estimate.MIDDLE)
        memory.middle = renewed(memory.middle, waited, strategy.alpha)
    elif to_pick:
        note_measurement(reading, memory, Estimate.STORE)
        memory.store = renewed(memory.store, waited, strategy.alpha)
    else:
        note_measurement(reading, memory, Estimate.HARVEST)
        memory.harvest = renewed(memory.harvest, waited, strategy.alpha)


@compiled
def note_deed(memory, deed, cycle):
    """Leave word of what was just done, for whoever looks into the memory from outside."""
    memory.deed = deed
    memory.deed_cycle = cycle
