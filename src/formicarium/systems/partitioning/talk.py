"""Robots that tell their neighbours what they have measured (TP-O3): beyond the paper, whose robots do not talk."""

from formicarium.compiled import compiled
from formicarium.systems.partitioning.memory import NEVER, Estimate
from formicarium.systems.partitioning.strategy import blended


@compiled
def speak(reading, memory, voice, strategy, chart):
    """Say one's three times and their ages, once a period; whose turn it is follows from the identities."""
    period = max(1, int(strategy.social_period / chart.cycle_time + 0.5))
    voice.speaking = 1 if (reading.cycle + 37 * reading.identity) % period == 0 else 0
    said = voice.said
    said.identity = reading.identity
    said.times[Estimate.HARVEST] = memory.harvest
    said.times[Estimate.STORE] = memory.store
    said.times[Estimate.WHOLE] = memory.whole
    for estimate in (Estimate.HARVEST, Estimate.STORE, Estimate.WHOLE):
        measured_at = memory.measured_at[estimate]
        said.ages[estimate] = -1.0 if measured_at == NEVER else (reading.cycle - measured_at) * chart.cycle_time


@compiled
def listen(memory, voice, strategy):
    """Blend what neighbours have measured into one's own times; first guesses are no news. Ages stay one's own."""
    for k in range(voice.heard_count):
        words = voice.heard[k]
        if words.ages[Estimate.HARVEST] >= 0.0:
            memory.harvest = blended(
                memory.harvest, words.times[Estimate.HARVEST], words.ages[Estimate.HARVEST], strategy
            )
        if words.ages[Estimate.STORE] >= 0.0:
            memory.store = blended(memory.store, words.times[Estimate.STORE], words.ages[Estimate.STORE], strategy)
        if words.ages[Estimate.WHOLE] >= 0.0:
            memory.whole = blended(memory.whole, words.times[Estimate.WHOLE], words.ages[Estimate.WHOLE], strategy)
