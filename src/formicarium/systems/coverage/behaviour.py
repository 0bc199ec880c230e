"""One cycle of one robot. It sees its Reading and its Memory and writes its Command and message, and nothing else."""

from formicarium.compiled import compiled
from formicarium.control.turning import drive_towards
from formicarium.systems.coverage.arms import choose_arm
from formicarium.systems.coverage.branching import bytes_more, grow, say_place, take_part, turn_off
from formicarium.systems.coverage.election import hear_leader, is_root, rally
from formicarium.systems.coverage.eruption import be_lost, erupt, find_reference, take_directions
from formicarium.systems.coverage.flocking import flock
from formicarium.systems.coverage.forces import clear, press
from formicarium.systems.coverage.keeping import note_links, restrain_wheels, restrain_wish
from formicarium.systems.coverage.listening import (
    carry,
    count_behind,
    find_way,
    hear_phase,
    hear_reached,
    stay_master,
)
from formicarium.systems.coverage.master import lead
from formicarium.systems.coverage.memory import Mode, Shape, Stage
from formicarium.systems.coverage.messages import speak
from formicarium.systems.coverage.placing import find_place
from formicarium.systems.coverage.tubes import find_tips

SAFE = 2  # place of "safe" among the variants
FLOCKING = 1  # place of "flocking" among the kinds of rendez-vous


@compiled
def decide(reading, memory, command, table, chart, footbot):
    """Listen, remember, decide, speak.

    Args:
        reading: READING record, what the robot heard and sensed now.
        memory: MEMORY record, changed in place.
        command: COMMAND record with the message, written.
        table: record of BehaviourTable.
        chart: CHART record, what it was told before the trial.
        footbot: record of the robot's own table.
    """
    listen(reading, memory, table, chart)
    if memory.master == 1:
        lead(reading, memory, command, table, chart, footbot)
    elif memory.term > 0 and memory.office == 0:
        rally(reading, memory, command, table, footbot)
    elif memory.mode == Mode.FLOCK:
        keep_up(reading, memory, command, table, footbot)
    elif memory.mode == Mode.ERUPT or memory.mode == Mode.HOLD:
        if chart.formation.kind == Shape.STAR:
            erupt(reading, memory, command, table, chart, footbot)
        else:
            grow(reading, memory, command, table, chart.formation, footbot)
    elif memory.mode == Mode.GATHER:
        gather(reading, memory, command, table, footbot)
    else:
        memory.stage = Stage.WAITING
        clear(command)
    drive(reading, memory, command, table, chart, footbot)
    command.colour = memory.arm
    speak(reading, memory, command, footbot.message_bytes - bytes_more(memory, chart.formation))
    if chart.formation.kind != Shape.STAR:
        say_place(memory, command, chart.formation)


@compiled
def listen(reading, memory, table, chart):
    """Take in what was heard: who leads, phase, way to the master, arms, reference, place, and what is reached."""
    carry(reading, memory)
    if memory.term > 0:
        hear_leader(reading, memory, table, chart)
    hear_phase(reading, memory)
    if chart.formation.kind == Shape.NETWORK:
        find_tips(reading, memory, table, chart)
    if is_root(memory, reading.identity):
        stay_master(memory, reading.cycle)
    else:
        find_way(reading, memory, table, chart)
        choose_arm(reading, memory, table)
        if chart.formation.kind == Shape.STAR:
            find_reference(reading, memory)
            take_directions(reading, memory, table)
        else:
            take_part(reading, memory, table, chart.formation)
            take_directions(reading, memory, table)
            turn_off(memory, chart.formation)
        find_place(reading, memory, table)
    count_behind(reading, memory)
    hear_reached(reading, memory, table)


@compiled
def keep_up(reading, memory, command, table, footbot):
    """Flock, unless there is no way to the master any more."""
    if memory.linked == 1:
        memory.stage = Stage.FLOCKING
        flock(reading, memory, command, table, footbot.speed)
    else:
        be_lost(reading, memory, command, table, footbot)


@compiled
def gather(reading, memory, command, table, footbot):
    """Draw near to all others, unless there is no way to the master any more."""
    if memory.linked == 1:
        memory.stage = Stage.GATHERING
        if table.rendezvous == FLOCKING:
            flock(reading, memory, command, table, footbot.speed)
            return
        press(reading, memory, command, table, memory.spacing, 0, footbot.speed)
    else:
        be_lost(reading, memory, command, table, footbot)


@compiled
def drive(reading, memory, command, table, chart, footbot):
    """Make wheel speeds of the wanted velocity; the safe variant shortens both."""
    limit = table.safe_share * footbot.radio_range
    if table.variant == SAFE:
        note_links(reading, memory, table, limit)
        restrain_wish(memory, command, footbot, limit, reading.cycle, chart.cycle_time)
    memory.turning = drive_towards(command, memory.turning, footbot.speed)
    if table.variant == SAFE:
        restrain_wheels(memory, command, footbot, limit, reading.cycle, chart.cycle_time)
