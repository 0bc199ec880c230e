"""A tree of tasks, each of which decides on its own whether to be cut (TP-O2), beyond the paper.

Three areas in a row have a first and a second cache between them. Tasks by what they are done between:

    source to nest         the whole task: done in one, or cut at the first or at the second cache
    source to second cache                 done in one, or cut at the first
    first cache to nest                    done in one, or cut at the second
    source to first, first to second, second to nest: these are not cut

A robot has its own time for each. A task that can be cut is cut with the probability of equation 1, its own time
against the cost of its two parts; and what it costs is what that decision makes it cost on average. Where the whole
task is cut is drawn by equation 1 too, one cache's parts against the other's.
"""

from formicarium.compiled import compiled
from formicarium.streams import advanced, uniform
from formicarium.systems.partitioning.memory import Area, Label, Way
from formicarium.systems.partitioning.parameters import ALWAYS_PARTITION, NEVER_PARTITION
from formicarium.systems.partitioning.strategy import partition_probability, renewed, steepness_of


@compiled
def to_second(memory):
    """Return one's time (s) from the source to the second cache and back, past the first."""
    return memory.ways[Way.SOURCE_TO_SECOND] + memory.ways[Way.SECOND_TO_SOURCE]


@compiled
def from_first(memory):
    """Return one's time (s) from the first cache to the nest and back, past the second."""
    return memory.ways[Way.FIRST_TO_NEST] + memory.ways[Way.NEST_TO_FIRST]


@compiled
def between(memory):
    """Return one's time (s) from the first cache to the second and back."""
    return memory.ways[Way.FIRST_TO_SECOND] + memory.ways[Way.SECOND_TO_FIRST]


@compiled
def cost(whole, parts, steepness, least):
    """Return what a task costs (s) that is cut with P_p: P_p parts + (1 - P_p) whole."""
    probability = partition_probability(whole, parts, 0.0, steepness, least)
    return probability * parts + (1.0 - probability) * whole


@compiled
def cost_of_first(memory, strategy):
    """Return what the whole task costs (s) if it is cut at the first cache."""
    steepness = steepness_of(strategy, memory.stay)
    rest = cost(from_first(memory), between(memory) + memory.store, steepness, strategy.least_probability)
    return memory.harvest + rest


@compiled
def cost_of_second(memory, strategy):
    """Return what the whole task costs (s) if it is cut at the second cache."""
    steepness = steepness_of(strategy, memory.stay)
    rest = cost(to_second(memory), memory.harvest + between(memory), steepness, strategy.least_probability)
    return rest + memory.store


@compiled
def cut_probability(memory, strategy, whole, parts):
    """Return with what probability a task is cut (equation 1)."""
    if strategy.method == NEVER_PARTITION:
        return 0.0
    if strategy.method == ALWAYS_PARTITION:
        return 1.0
    return partition_probability(whole, parts, 0.0, steepness_of(strategy, memory.stay), strategy.least_probability)


@compiled
def part_probability(memory, strategy, towards_source):
    """Return the same for two of the three areas, which are cut at the cache between them."""
    if towards_source:
        return cut_probability(memory, strategy, to_second(memory), memory.harvest + between(memory))
    return cut_probability(memory, strategy, from_first(memory), between(memory) + memory.store)


@compiled
def happens(memory, probability):
    """Draw one of the robot's decisions."""
    memory.choices = advanced(memory.choices)
    return uniform(memory.choices) < probability


@compiled
def choose_in_tree(memory, strategy):
    """Decide from the whole task down to the part that begins where the robot stands; ``far`` is the corridor's end.

    With an object: where to leave it. Without one: where to fetch the next.
    """
    loaded = memory.loaded == 1
    memory.far = Area.NEST if loaded else Area.SOURCE
    if memory.area == Area.MIDDLE:
        memory.probability = part_probability(memory, strategy, not loaded)
        cut = happens(memory, memory.probability)
    else:
        first, second = cost_of_first(memory, strategy), cost_of_second(memory, strategy)
        parts = cost(second, first, steepness_of(strategy, memory.stay), strategy.least_probability)
        memory.probability = cut_probability(memory, strategy, memory.whole, parts)
        cut = happens(memory, memory.probability)
        if cut and happens(memory, cut_probability(memory, strategy, second, first)) != loaded:
            memory.far = Area.MIDDLE  # cut at the cache that is not beside the robot, which leaves a part to decide on
            cut = happens(memory, part_probability(memory, strategy, loaded))
    memory.label = Label.CACHE if cut else Label.CORRIDOR


@compiled
def turn_away(memory, strategy):
    """Return where who has given up a cache goes through the corridor: to the other cache, or all the way."""
    loaded = memory.loaded == 1
    end = Area.NEST if loaded else Area.SOURCE
    if memory.area == Area.MIDDLE:
        return end
    parts = to_second(memory) + memory.store if loaded else memory.harvest + from_first(memory)
    return Area.MIDDLE if happens(memory, cut_probability(memory, strategy, memory.whole, parts)) else end


@compiled
def way_of(memory, here, to_pick):
    """Return the Way of a trip that began in the middle area or ends at a cache there, -1 for any other.

    Args:
        memory: MEMORY record; ``set_out`` is where the trip began.
        here: Area in which it ends.
        to_pick: true if it ends at the first cache, in which objects are picked up.
    """
    if here == Area.MIDDLE:
        if memory.set_out == Area.SOURCE:
            return Way.SOURCE_TO_SECOND
        if memory.set_out == Area.NEST:
            return Way.NEST_TO_FIRST
        return Way.SECOND_TO_FIRST if to_pick else Way.FIRST_TO_SECOND
    if memory.set_out != Area.MIDDLE:
        return -1
    return Way.SECOND_TO_SOURCE if here == Area.SOURCE else Way.FIRST_TO_NEST


@compiled
def renew_way(memory, strategy, way, seconds):
    """Renew the time of a way (equation 2)."""
    memory.ways[way] = renewed(memory.ways[way], seconds, strategy.alpha)
