"""The T protocol (Table S2): one and only one tail per branch, whoever asks and whatever is lost."""

import math

import numpy as np
import pytest

from formicarium.robots.records import Colour
from formicarium.systems.sequencing.memory import Role, State
from systems.one_robot import OneRobot
from systems.stage import chain, end_in_tail, guardian, keep_packets, put, read, step, tails, wide_stage, written

CERTAIN = {"radio_loss": 0.0, "camera_miss": 0.0}


def invite(state, *runners: tuple[float, float]) -> None:
    """Put guardian 0, acting as tail towards +x, in the middle and following runners at (distance, bearing)."""
    put(state, 0, 0.0, 0.0, math.pi / 2)
    guardian(state, 0, Colour.RED, True)
    for i, (distance, bearing) in enumerate(runners, 1):
        put(state, i, distance * math.cos(bearing), distance * math.sin(bearing), bearing + math.pi / 2)
        state.memories[i].state = State.FOLLOW


TWO = ((0.2, math.radians(14)), (0.2, math.radians(-14)))


def first_join(state, edit=None, patience=60):
    """Run until somebody becomes tail: (who the tail heard first, who was offered the place, who took it)."""
    heard, offered = [], set()

    def listen(state):
        if edit:
            edit(state)
        for n in range(state.readings[0].packet_count):
            message = read(state.readings[0].packets[n].payload)
            if message.request == 1 and message.tail == 0:
                heard.append(int(message.identity))

    for _ in range(patience):
        step(state, 1, listen)
        offered |= {int(state.memories[0].chosen)} - {0}
        joined = np.flatnonzero(state.memories.role == Role.TAIL)
        if len(joined):
            break
    return heard, offered, [int(state.robots[i].identity) for i in joined]


@pytest.mark.parametrize("seed", range(8))
def test_of_two_that_ask_at_once_exactly_the_first_heard_joins(seed):
    """T4."""
    state = wide_stage(3, seed, epuck=CERTAIN)
    invite(state, *TWO)
    heard, offered, joined = first_join(state)
    assert len(set(heard)) == 2
    assert [heard[0]] == joined and offered == {heard[0]}


def test_the_other_leaves_and_ignores_invitations_for_a_while():
    """TS-79, TS-82."""
    robot = OneRobot(0x42).turn_to(State.JOIN)
    invitation = written(identity=33, tail=1, direction=1, branch=1, link_number=2)
    for _ in range(robot.table.request_patience + 2):
        robot.hear(written(identity=0x43, tail=1, request=1, branch=1, link_number=2)).live()
    assert robot.memory.state == State.FOLLOW and robot.memory.role == Role.RUNNER
    for _ in range(robot.table.refuse_time - 5):
        robot.see((Colour.MAGENTA, 0.2, 0.0)).hear(invitation).live()
        assert robot.memory.state == State.FOLLOW
    for _ in range(10):
        robot.see((Colour.MAGENTA, 0.2, 0.0)).hear(invitation).live()
    assert robot.memory.state == State.JOIN


def flip_answers(state):
    """Flip the identity byte of every T_RES in transit."""
    for reading in state.readings:
        for n in range(reading.packet_count):
            message = read(reading.packets[n].payload)
            if message.tail == 1 and message.request == 1:
                reading.packets[n].payload[0] ^= 0xFF


def test_with_the_identity_flipped_in_transit_nobody_joins():
    """T4."""
    for seed in range(4):
        state = wide_stage(3, seed, epuck=CERTAIN)
        invite(state, *TWO)
        heard, offered, joined = first_join(state, flip_answers, patience=120)
        assert heard and offered and not joined
        assert state.memories.role.tolist() == [Role.GUARDIAN, Role.RUNNER, Role.RUNNER]


def test_with_equal_identities_both_join():
    """T4: the expected fault, proof that nothing but the identity tells them apart."""
    state = wide_stage(3, epuck=CERTAIN)
    invite(state, *TWO)
    state.robots[2].identity = state.robots[1].identity
    _, _, joined = first_join(state)
    assert joined == [int(state.robots[1].identity)] * 2


def test_only_who_hears_the_directional_bit_asks():
    """TS-78, TS-79: beside the sector the same tail is heard without T_DIR."""
    state = wide_stage(3, epuck=CERTAIN)
    invite(state, (0.2, math.radians(80)), (0.2, math.radians(180)))
    for _ in range(3):
        step(state)
        assert not (state.memories.state == State.JOIN).any()


def test_only_who_is_near_the_light_asks():
    """TS-82: the radio reaches farther than the invitation counts."""
    for distance, asks in ((0.2, True), (0.3, False)):
        robot = OneRobot().turn_to(State.FOLLOW)
        robot.see((Colour.MAGENTA, distance, 0.0)).hear(written(identity=33, tail=1, direction=1, link_number=2)).live()
        assert (robot.memory.state == State.JOIN) == asks


def test_a_guardian_heeds_no_request_from_outside_its_sector():
    """A T_REQ names no addressee: one meant for another tail must not start a branch to the wrong side."""
    robot = OneRobot().guard(Colour.RED, True)
    robot.hear(written(identity=0x42, request=1), 0.2, math.pi / 2).live()
    assert robot.memory.state == State.OPEN and robot.memory.chosen == 0


def test_a_magenta_light_relieves_only_while_an_offer_is_pending_and_only_in_the_sector():
    """TS-80."""
    robot = OneRobot().lead()
    assert robot.see((Colour.MAGENTA, 0.17, 0.0)).live().memory.role == Role.TAIL
    robot.memory.chosen = 0x42
    robot.turn_to(State.OFFER)
    assert robot.see((Colour.MAGENTA, 0.17, 1.6)).live().memory.role == Role.TAIL
    assert robot.see((Colour.MAGENTA, 0.31, 0.0)).live().memory.role == Role.TAIL
    assert robot.see((Colour.MAGENTA, 0.17, 0.0)).live().memory.role == Role.LINK


def test_an_offer_that_nobody_takes_expires():
    """TS-82."""
    robot = OneRobot().lead()
    robot.hear(written(identity=0x42, request=1)).live()
    for _ in range(robot.table.offer_patience):
        assert robot.live().memory.state == State.OFFER
    for _ in range(2):
        robot.live()
    assert robot.memory.state == State.OPEN and robot.memory.role == Role.TAIL


def test_the_first_guardian_gives_up_the_tail_and_is_in_the_chain():
    """TS-48: G1 becomes G4 when its first link is acknowledged."""
    robot = OneRobot().guard(Colour.RED, True)
    robot.hear(written(identity=0x42, request=1), 0.2, -math.pi / 2).live()
    robot.hear(written(identity=0x42, tail=1, branch=1, link_number=1), 0.2, -math.pi / 2).live()
    m = robot.memory
    assert (m.tail, m.in_chain, m.state, m.role) == (0, 1, State.STAY, Role.GUARDIAN)
    assert robot.command.colour == Colour.CYAN and robot.message().tail == 0 and robot.message().in_chain == 1


def recover(seed: int, at_guardian: bool, loss: float = 0.3) -> tuple[float, float, bool]:
    """Let a runner join under packet loss: (seconds with two tails, without any, whether it joined in 15 s).

    A runner whose requests are lost goes on its way and refuses for a while (TS-82): then it has not joined, and
    the old tail must still be the only one.
    """
    state = wide_stage(4, seed, epuck={"radio_loss": loss})
    spacing = float(state.behaviour[0].spacing)
    if at_guardian:
        invite(state, (0.2, math.radians(seed % 21 - 10)))
        runner = 1
    else:
        chain(state, 2, spacing)
        end_in_tail(state, 2)
        put(state, 3, 2 * spacing + 0.19, 0.02 * (seed % 5 - 2), math.pi / 2)
        state.memories[3].state = State.FOLLOW
        runner = 3
    assert tails(state) == 1
    two = none = 0

    def count(state):
        nonlocal two, none
        two += tails(state) > 1
        none += tails(state) == 0

    for _ in range(150):
        step(state, 1, None, count)
        if state.memories[runner].role == Role.TAIL:
            break
    step(state, 50, None, count)
    return 0.1 * two, 0.1 * none, bool(state.memories[runner].role == Role.TAIL)


def check_recoveries(seeds) -> None:
    outcomes = [recover(seed, seed % 2 == 0) for seed in seeds]
    assert max(two for two, _, _ in outcomes) <= 5.0
    assert max(none for _, none, _ in outcomes) == 0.0
    assert sum(joined for _, _, joined in outcomes) >= 0.98 * len(outcomes)


def test_under_30_percent_packet_loss_there_is_always_one_tail_and_never_two_for_long():
    """TS-83, 60 joins at guardians and at tails."""
    check_recoveries(range(60))


@pytest.mark.long
def test_under_30_percent_packet_loss_500_times():
    check_recoveries(range(1000, 1500))


def without_acknowledgements(state):
    """Lose every message of a new tail on its way to the old one."""
    keep_packets(state.readings[0], lambda message: message.tail == 0 or message.guardian == 1)


def test_a_lost_acknowledgement_is_made_good_by_sight():
    """TS-80, TS-83."""
    state = wide_stage(2, epuck=CERTAIN)
    invite(state, (0.2, 0.0))
    step(state, 30, without_acknowledgements)
    assert state.memories[1].role == Role.TAIL and tails(state) == 1


def test_an_acknowledgement_lost_for_long_by_a_blind_tail_still_counts_when_it_comes():
    """TS-83: camera and radio fail, the offer runs out, the old tail invites again; then one message gets through."""
    state = wide_stage(2, epuck=CERTAIN)
    invite(state, (0.2, 0.0))

    def blind(state):
        without_acknowledgements(state)
        state.readings[0].blob_count = 0

    step(state, 60, blind)
    assert state.memories[1].role == Role.TAIL and tails(state) == 2
    assert state.memories[0].state == State.OPEN
    step(state, 5)
    assert tails(state) == 1 and state.memories[0].tail == 0


def test_the_place_in_the_branch_counts_up_to_what_five_bits_hold():
    """TS-72."""
    for before, after in ((0, 1), (7, 8), (30, 31), (31, 31)):
        robot = OneRobot(0x42).turn_to(State.JOIN)
        answer = dict(identity=0x42, request=1, tail=1, branch=1, link_number=before, guardian=int(before == 0))
        robot.hear(written(**answer)).live()
        assert (robot.memory.role, robot.memory.link_number, robot.memory.branch) == (Role.TAIL, after, 1)


def test_a_runner_may_join_with_tasks_done_and_forgets_them():
    """U35, TS-104."""
    robot = OneRobot(0x42).turn_to(State.JOIN)
    robot.memory.count = 2
    assert robot.hear(written(identity=0x42, request=1, tail=1, link_number=1)).live().memory.role == Role.TAIL
    assert robot.memory.count == 0


ARRIVAL = {"identity": 7, "request": 1, "tail": 1, "link_number": 6}


@pytest.mark.parametrize(("branch", "goes_on"), [(1, True), (2, False)])
def test_a_guardian_that_is_reached_joins_and_goes_on_unless_it_is_the_last(branch, goes_on):
    """TS-48, TS-50, TS-87: EST, IN_CHAIN, BRN one more; G2 becomes G3 while tasks remain, else G4."""
    robot = OneRobot(7).guard(Colour.GREEN, False).hear(written(branch=branch, **ARRIVAL)).live()
    message = robot.message()
    assert (message.established, message.in_chain, message.branch) == (1, 1, branch + 1)
    assert bool(message.tail) == goes_on and message.identity == 7
    robot.hear(written(branch=branch, **ARRIVAL)).live()  # repeated: nothing more happens
    assert robot.message().branch == branch + 1


def test_a_guardian_is_not_reached_by_a_message_to_somebody_else():
    robot = OneRobot(8).guard(Colour.GREEN, False).hear(written(branch=1, **ARRIVAL)).live()
    assert robot.message().in_chain == 0


def test_a_tail_docks_at_a_guardian_that_no_chain_has_reached():
    """TS-86: not at its own origin, not at one in the chain, not behind it."""
    ahead, behind = 0.3, math.pi - 0.3
    for fields, bearing, docks in (
        ({"in_chain": 0}, ahead, True),
        ({"in_chain": 1}, ahead, False),
        ({"in_chain": 0, "tail": 1}, ahead, False),
        ({"in_chain": 0}, behind, False),
    ):
        robot = OneRobot().lead()
        for _ in range(3):
            advert = written(identity=60, guardian=1, colour=Colour.BLUE, count=1, **fields)
            robot.see((Colour.CYAN, 0.2, bearing), (Colour.YELLOW, robot.table.spacing, math.pi))
            robot.hear(advert, 0.2, bearing).live()
        assert (robot.memory.state == State.DOCK) == docks


def test_sight_alone_or_radio_alone_finds_no_guardian():
    """TS-86, T9."""
    advert = written(identity=60, guardian=1, colour=Colour.BLUE, count=1)
    for shown in (False, True):
        robot = OneRobot().lead()
        for _ in range(5):
            if shown:
                robot.see((Colour.CYAN, 0.2, 0.3))
            else:
                robot.hear(advert, 0.2, 0.3)
            assert robot.live().memory.state == State.OPEN


def test_a_docking_tail_hands_over_and_becomes_an_established_link():
    """TS-87: T_RES with the guardian's identity; on EST with BRN + 1 the tail is a link."""
    robot = OneRobot().lead(branch=1, link_number=6)
    spacing = robot.table.spacing
    for _ in range(int(robot.table.dock_hold) + 20):
        robot.see((Colour.CYAN, spacing, 0.0), (Colour.YELLOW, spacing, math.pi))
        robot.hear(written(identity=60, guardian=1, colour=Colour.BLUE, count=1), spacing, 0.0).live()
    message = robot.message()
    assert (message.tail, message.request, message.identity, message.branch) == (1, 1, 60, 1)
    answer = written(identity=60, guardian=1, colour=Colour.BLUE, count=1, established=1, in_chain=1, branch=2, tail=1)
    robot.see((Colour.CYAN, spacing, 0.0), (Colour.YELLOW, spacing, math.pi)).hear(answer, spacing, 0.0).live()
    assert robot.memory.role == Role.LINK and robot.memory.established == 1
    assert robot.message().established == 1 and robot.message().tail == 0
