"""The closed loop at the level of its logic: election, labels, steps, with half of all packets lost (A5)."""

import numpy as np
import pytest

from formicarium.streams import generator
from formicarium.systems.sequencing.permutations import permutations
from formicarium.systems.sequencing.ring import NOBODY, RING
from systems.ring_on_paper import RingOnPaper

RINGS = 400


def some_ring(seed: int, loss: float = 0.5, tasks: int | None = None) -> tuple[RingOnPaper, np.random.Generator]:
    draws = generator(seed, "rings")
    links = draws.integers(1, 9, size=tasks or draws.integers(2, 5)).tolist()
    return RingOnPaper(links, draws.permutation(np.arange(1, 256)).tolist(), loss, seed), draws


def elected(ring: RingOnPaper, cycles: int = 3000) -> RingOnPaper:
    for _ in range(cycles // 10):
        ring.run(10)
        if ring.searching():
            return ring
    raise AssertionError(f"no order after {cycles} cycles: {ring.labels()}")


EXECUTION = 70  # cycles that a task takes in a booth at least


def try_permutation(ring: RingOnPaper, draws: np.random.Generator, upi: int, right: bool) -> None:
    """Let a runner do all tasks, then report the verdict a few times."""
    ring.run(EXECUTION * len(ring.guardians))
    last = ring.conditions().index(len(ring.guardians) - 1)
    for _ in range(3):
        ring.report(last, right, upi % 4)
        ring.run(int(draws.integers(1, 10)))


@pytest.mark.parametrize("first", range(0, RINGS, 100))
def test_labels_run_clockwise_from_the_largest_identity_and_guardians_keep_together(first):
    """A5, T12, TS-114, TS-115, TS-126: guardians never differ by more than a step, and all end at the right one."""
    for seed in range(first, first + 100):
        ring, draws = some_ring(seed)
        tasks = len(ring.guardians)
        assert ring.labels() == [0] * tasks
        elected(ring)
        identities = [ring.identity[g] for g in ring.guardians]
        leader = int(np.argmax(identities))
        # Branches run anticlockwise from k to k + 1, so clockwise of the leader is leader - 1.
        assert [ring.labels()[(leader - k) % tasks] for k in range(tasks)] == list(range(tasks, 0, -1))
        assert sorted(ring.conditions()) == list(range(tasks))
        right = int(draws.integers(2 * permutations(tasks)))
        for upi in range(right + 1):
            assert set(ring.steps()) == {upi}
            try_permutation(ring, draws, upi, upi == right)
            ring.run(300)
        assert all(ring.ring(k).solved for k in range(tasks))
        for k in range(tasks):
            ring.report(k, False, right % 4)  # the search is over
        ring.run(50)
        assert set(ring.steps()) == {right} and ring.lag <= 1


def test_before_the_loop_is_closed_nobody_is_elected():
    """T11, T28, TS-113: cut anywhere before the election, no guardian gets a label."""
    for seed in range(40):
        ring, draws = some_ring(seed, loss=0.2)
        ring.cut(int(draws.integers(len(ring.memories))))
        ring.run(1500)
        assert set(ring.labels()) == {0} and set(ring.conditions()) == {NOBODY}


def test_an_election_needs_every_guardian_to_be_in_and_out():
    for flag in ("established", "out"):
        ring, _ = some_ring(3, loss=0.0, tasks=3)
        one = ring.memories[ring.guardians[1]]
        if flag == "established":
            one.established = 0
        else:
            ring.memories[ring.guardians[1] + 1].established = 0  # its first link does not say EST
            ring.memories[ring.guardians[1] + 1].chosen = 0
        ring.run(500)
        assert ring.labels() == [0, 0, 0]
        assert ring.memories[ring.guardians[1]].ring.election == 0


def test_guardians_beyond_a_gap_keep_the_old_step():
    """T11: a link is taken away after the election; nothing else tells them."""
    for seed in range(40):
        ring, draws = some_ring(seed, loss=0.2)
        elected(ring)
        source = int(draws.integers(len(ring.guardians)))
        ring.cut((ring.guardians[source] - 1) % len(ring.memories))  # the end of the branch that ended there
        ring.report(source, False, 0)
        ring.run(800)
        assert [step for k, step in enumerate(ring.steps()) if k != source] == [0] * (len(ring.guardians) - 1)
        assert ring.steps()[source] == 1


def test_news_take_a_cycle_for_every_hop():
    """T10: no loss, so exactly one."""
    for seed in range(20):
        ring, draws = some_ring(seed, loss=0.0)
        elected(ring)
        ring.run(100)
        tasks, count = len(ring.guardians), len(ring.memories)
        source = int(draws.integers(tasks))
        ring.report(source, False, 0)
        ring.run(1)  # said
        hops = {k: (ring.guardians[source] - ring.guardians[k]) % count for k in range(tasks)}  # clockwise
        for cycle in range(1, count + 1):
            ring.run(1)
            assert ring.steps() == [1 if hops[k] <= cycle else 0 for k in range(tasks)]


def test_the_election_is_seen_on_the_air():
    """T12: a hop says its own identity, the source is a guardian's, small ones end, the largest comes back."""
    ring, _ = some_ring(11, loss=0.0, tasks=4)
    said = [set() for _ in ring.memories]
    for _ in range(400):
        ring.run(1)
        for i, command in enumerate(ring.commands):
            word = command.payload[0]
            assert word[0] == ring.identity[i]
            if word[1] & 0x80:
                said[i].add((int(word[3]), int(word[1]) >> 3 & 3))
    identities = [ring.identity[g] for g in ring.guardians]
    leader = int(np.argmax(identities))
    for k, g in enumerate(ring.guardians):
        assert (identities[k], 0) in said[g] and (identities[k], 0) in said[g - 1]  # said, and relayed by the next link
        assert {source for source, _ in said[g]} <= {s for s in identities if s >= identities[k]}
    assert all((max(identities), 0) in words for words in said)
    assert {number for _, number in said[ring.guardians[(leader - 1) % 4]] if number} == {2}  # took 3, hands on 2


def test_the_leader_does_not_depend_on_the_place_in_the_ring():
    places = [int(np.argmax(elected(some_ring(seed, 0.0, 3)[0]).labels())) for seed in range(60)]
    assert set(places) == {0, 1, 2}


def test_a_guardian_remembers_its_own_label_a_counter_and_flags():
    """T13: no list of permutations, no label or colour of another."""
    assert RING.names == ("election", "number", "solved", "source", "out", "label", "upi")
    assert all(RING[name].shape == () for name in RING.names)
    ring, _ = some_ring(5, loss=0.3, tasks=4)
    elected(ring)
    for label, g in zip(ring.labels(), ring.guardians, strict=True):
        words = ring.memories[g].ring
        others = {ring.identity[other] for other in ring.guardians} - {ring.identity[g], int(words.source)}
        assert words.label == label and words.source == max(ring.identity[g] for g in ring.guardians)
        assert not others & {int(words[name]) for name in ("number", "label", "upi", "solved")} or label in others


def test_a_loop_of_too_few_guardians_elects_but_finds_no_order():
    """Three tasks and two guardians in the loop: one label is left over, and nobody directs anybody."""
    ring, _ = some_ring(8, loss=0.0, tasks=2)
    ring.table.tasks = 3
    ring.run(1000)
    assert sorted(ring.labels()) == [2, 3] and set(ring.conditions()) == {NOBODY}
