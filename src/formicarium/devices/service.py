"""One control cycle of all booths: barriers, the infrared exchange, the verdict, the lights."""

from formicarium.compiled import compiled
from formicarium.devices.booth import LIGHTS, answer, begin_visit, hear, show_lights, watch_barriers
from formicarium.devices.coordinator import judge
from formicarium.robots.records import SILENCE


@compiled
def serve_booths(booths, lights, coordinator, robots, bodies, commands, table, cycle, cycle_time):
    """Let every booth sense its visitor, listen, judge when the task time is over, and answer."""
    period = max(1, int(table.byte_period / cycle_time + 0.5))
    task_cycles = int(table.task_time / cycle_time + 0.5)
    for b in range(len(booths)):
        booth = booths[b]
        was_occupied = booth.occupied
        deepest = watch_barriers(booth, bodies)
        if booth.occupied == 1 and was_occupied == 0:
            begin_visit(booth, table, deepest, cycle)
        elif booth.occupied == 0 and was_occupied == 1:
            robots[booth.visitor].infrared_heard = SILENCE
            booth.visitor = -1
        if booth.occupied == 1:
            exchange(booth, coordinator, robots, commands, period, task_cycles, cycle)
        show_lights(booth, lights, b * len(LIGHTS))


@compiled
def exchange(booth, coordinator, robots, commands, period, task_cycles, cycle):
    """Hear the visitor's byte, judge its task when it is done, and send a byte when one is due."""
    hear(booth, commands[booth.visitor].infrared)
    if booth.claim > 0 and booth.verdict == 0 and cycle - booth.since >= task_cycles:
        identity = booth.high << 4 | booth.low
        booth.verdict = judge(coordinator, identity, booth.claim, booth.colour)
        booth.judged = cycle
    due = (cycle - booth.since) % period == 0
    robots[booth.visitor].infrared_heard = answer(booth) if due else SILENCE
