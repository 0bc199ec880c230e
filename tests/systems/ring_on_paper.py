"""A closed loop without geometry: memories of guardians and links, and four bytes from each to its predecessor."""

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.records import records
from formicarium.robots.records import COMMAND, READING, ROBOT
from formicarium.streams import advanced, stream, uniform
from formicarium.systems.sequencing import guardian_ii, link
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.messages_ii import decode_ii
from formicarium.systems.sequencing.parameters import BehaviourTable
from formicarium.systems.sequencing.ring import hear_report
from formicarium.systems.sequencing.setup import make_memories


@compiled
def advance(memories, readings, commands, words, successor, draws, loss, table, cycles):
    """Let everybody say its words and hear those of its successor, ``loss`` of them lost; return the greatest lag."""
    lag = 0
    for _ in range(cycles):
        for i in range(len(memories)):
            for n in range(4):
                words[i, n] = commands[i].payload[0, n]
        for i in range(len(memories)):
            reading = readings[i]
            memory = memories[i]
            draws[i] = advanced(draws[i])
            reading.packet_count = 0
            if successor[i] >= 0 and uniform(draws[i]) >= loss:
                decode_ii(words[successor[i]], memory.heard[0])
                reading.packet_count = 1
            if memory.role == Role.GUARDIAN:
                guardian_ii.hear_loop(reading, memory, table)
                guardian_ii.speak(reading, memory, commands[i], table)
            else:
                link.hear_successor(reading, memory)
                link.speak(reading, memory, commands[i], table)
            reading.cycle += 1
        least = 1_000_000
        most = 0
        for i in range(len(memories)):
            if memories[i].role == Role.GUARDIAN:
                least = min(least, memories[i].ring.upi)
                most = max(most, memories[i].ring.upi)
        lag = max(lag, most - least)
    return lag


class RingOnPaper:
    """Guardian k at index ``guardians[k]``; its branch's links follow it, then the next guardian, anticlockwise."""

    def __init__(self, links: list[int], identities: list[int], loss: float = 0.0, seed: int = 0) -> None:
        count = len(links) + sum(links)
        self.guardians = [k + sum(links[:k]) for k in range(len(links))]
        robots = records(ROBOT, count)
        robots.identity = identities[:count]
        self.identity = [int(identity) for identity in robots.identity]
        self.memories = make_memories(robots, seed)
        self.readings, self.commands = records(READING, count), records(COMMAND, count)
        self.readings.identity = robots.identity
        self.words = np.zeros((count, 4), np.uint8)
        self.successor = (np.arange(count) + 1) % count
        self.draws = np.array([stream(seed, "loss", i) for i in range(count)])
        self.loss, self.lag = loss, 0
        self.table = BehaviourTable(tasks=len(links), mark=2).record()[0]
        for i in range(count):
            m = self.memories[i]
            m.role = Role.GUARDIAN if i in self.guardians else Role.LINK
            m.state, m.established, m.in_chain = State.STAY, 1, 1
            m.chosen = self.identity[self.successor[i]]
            m.ring.source = self.identity[i]
            m.colour = 1
            m.link_number = 0 if i in self.guardians else i - max(g for g in self.guardians if g <= i)

    def run(self, cycles: int = 1) -> None:
        lag = advance(
            *(self.memories, self.readings, self.commands, self.words),
            *(self.successor, self.draws, self.loss, self.table, cycles),
        )
        self.lag = max(self.lag, lag)

    def ring(self, k: int):
        return self.memories[self.guardians[k]].ring

    def labels(self) -> list[int]:
        return [int(self.ring(k).label) for k in range(len(self.guardians))]

    def searching(self) -> bool:
        return all(self.ring(k).label > 0 and self.ring(k).election == 0 for k in range(len(self.guardians)))

    def steps(self) -> list[int]:
        return [int(self.ring(k).upi) for k in range(len(self.guardians))]

    def conditions(self) -> list[int]:
        return [int(self.memories[g].condition) for g in self.guardians]

    def report(self, k: int, success: bool, number: int) -> None:
        """Let a runner tell guardian k the verdict on the permutation of that M4PI."""
        hear_report(self.ring(k), success, number, self.identity[self.guardians[k]])

    def cut(self, i: int) -> None:
        """Take robot i away: its predecessor hears nothing any more."""
        self.successor[(i - 1) % len(self.successor)] = -1
