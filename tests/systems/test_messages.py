"""The four-byte message, bit by bit against Fig. S2 (section 12.1), and who says what."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from formicarium.control.speech import in_sector
from formicarium.physics.records import records
from formicarium.robots.records import COMMAND, PACKET, Colour
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.messages import MESSAGE, encode, from_runner, is_notification
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.study import MARK_I3
from systems.one_robot import OneRobot
from systems.stage import read, written

# Section 12.1: field -> (byte, lowest bit, bits). DATA[1][7] and DATA[3][7] carry nothing.
PLACES = {
    "identity": (0, 0, 8),
    "request": (1, 0, 1),
    "direction": (1, 1, 1),
    "tail": (1, 2, 1),
    "inhibit": (1, 3, 1),
    "branch": (1, 4, 3),
    "link_number": (2, 0, 5),
    "in_chain": (2, 5, 1),
    "established": (2, 6, 1),
    "confident": (2, 7, 1),
    "count": (3, 0, 3),
    "colour": (3, 3, 3),
    "guardian": (3, 6, 1),
}
messages = st.fixed_dictionaries({name: st.integers(0, 2**bits - 1) for name, (_, _, bits) in PLACES.items()})


def by_hand(**fields: int) -> bytes:
    """Put fields into four bytes by the table of section 12.1."""
    data = [0, 0, 0, 0]
    for name, value in fields.items():
        byte, low, bits = PLACES[name]
        assert 0 <= value < 2**bits
        data[byte] += value * 2**low
    return bytes(data)


def test_the_message_has_exactly_the_fields_of_figure_s2():
    assert set(MESSAGE.names) == set(PLACES) | {"number", "report", "election", "source"}  # these are Mark II's


@given(messages)
def test_decoding_undoes_encoding(fields):
    payload = written(**fields)
    assert bytes(payload) == by_hand(**fields)
    assert {name: int(read(payload)[name]) for name in MESSAGE.names} == dict.fromkeys(MESSAGE.names, 0) | fields


@given(st.binary(min_size=4, max_size=4))
def test_any_four_bytes_can_be_read(data):
    again = written(**{name: int(read(list(data))[name]) for name in PLACES})
    assert list(again) == [data[0], data[1] & 0x7F, data[2], data[3] & 0x7F]


def test_a_packet_is_four_bytes_and_so_is_what_each_of_twelve_emitters_sends():
    assert PACKET["payload"].shape == (4,) and COMMAND["payload"].shape == (12, 4)
    assert PACKET["payload"].base == COMMAND["payload"].base == np.uint8


def said_everywhere(robot: OneRobot) -> bytes:
    sent = robot.sent()
    assert set(sent) == set(range(12)) and len(set(sent.values())) == 1
    return sent[0]


def test_a_waiting_guardian_advertises_its_condition_and_colour():
    robot = OneRobot(0xA5).guard(Colour.GREEN, False).live()
    assert said_everywhere(robot) == bytes([0xA5, 0x00, 0x00, 0b0_1_010_001]) == by_hand(
        identity=0xA5, count=1, colour=2, guardian=1
    )  # fmt: skip
    assert robot.command.colour == Colour.CYAN


def test_a_guardian_in_the_chain_says_so():
    robot = OneRobot(0x10).guard(Colour.BLUE, False)
    m = robot.memory
    m.in_chain, m.established, m.branch, m.confident, m.condition = 1, 1, 3, 1, 2
    assert said_everywhere(robot.live()) == bytes([0x10, 0b0_011_0000, 0b111_00000, 0b0_1_011_010])


def test_the_first_guardian_invites_only_on_its_right():
    robot = OneRobot(9).guard(Colour.RED, True).live()
    plain = by_hand(identity=9, tail=1, branch=1, confident=1, colour=1, guardian=1)
    invitation = by_hand(identity=9, direction=1, tail=1, branch=1, confident=1, colour=1, guardian=1)
    assert plain == bytes([9, 0x14, 0x80, 0x48]) and invitation == bytes([9, 0x16, 0x80, 0x48])
    right = {k for k in range(12) if in_sector(np.radians(30.0 * k), -np.pi / 2, robot.table.sector_half_width + 1e-9)}
    assert 9 in right and 0 not in right and 3 not in right and 6 not in right
    assert robot.sent() == {k: invitation if k in right else plain for k in range(12)}


def test_a_tail_invites_only_in_the_prolongation_of_its_branch():
    robot = OneRobot(33).lead(branch=2, link_number=5).live()
    plain, invitation = bytes([33, 0x24, 0x05, 0]), bytes([33, 0x26, 0x05, 0])
    ahead = {k for k in range(12) if in_sector(np.radians(30.0 * k), 0.0, robot.table.sector_half_width + 1e-9)}
    assert 0 in ahead and not ahead & {3, 6, 9}
    assert robot.sent() == {k: invitation if k in ahead else plain for k in range(12)}
    assert robot.command.colour == Colour.MAGENTA


INVITATION = by_hand(identity=33, direction=1, tail=1, branch=2, link_number=5)


def test_a_runner_that_hears_an_invitation_stops_and_requests():
    robot = OneRobot(0x42).turn_to(State.FOLLOW)
    robot.hear(list(INVITATION)).see((Colour.MAGENTA, 0.2, 0.0)).live()
    assert robot.motion() == (0.0, 0.0) or robot.memory.state == State.JOIN
    robot.see((Colour.MAGENTA, 0.2, 0.0)).live()
    assert said_everywhere(robot) == bytes([0x42, 0x01, 0, 0]) == by_hand(identity=0x42, request=1)
    assert robot.motion() == (0.0, 0.0) and robot.command.colour == Colour.OFF


def test_the_tail_answers_the_first_request_with_its_sender():
    robot = OneRobot(33).lead(branch=2, link_number=5)
    robot.hear(by_hand_list(identity=0x42, request=1)).hear(by_hand_list(identity=0x43, request=1)).live()
    robot.live()
    assert said_everywhere(robot) == bytes([0x42, 0x25, 0x05, 0])


def by_hand_list(**fields):
    return list(by_hand(**fields))


def test_the_guardian_answers_as_a_tail_does():
    robot = OneRobot(9).guard(Colour.RED, True)
    robot.hear(by_hand_list(identity=0x42, request=1), bearing=-np.pi / 2).live().live()
    assert said_everywhere(robot) == bytes([0x42, 0x15, 0x80, 0x48])


def test_the_chosen_runner_becomes_tail_one_number_further_and_acknowledges():
    robot = OneRobot(0x42).turn_to(State.JOIN)
    robot.hear(by_hand_list(identity=0x42, request=1, tail=1, branch=2, link_number=5)).live()
    assert robot.memory.role == Role.TAIL
    robot.live()
    acknowledgement = said_everywhere(robot)
    assert acknowledgement == bytes([0x42, 0x24, 0x06, 0])
    assert robot.command.colour == Colour.MAGENTA


def test_the_new_tail_says_nothing_more_as_a_runner():
    robot = OneRobot(0x42).turn_to(State.JOIN)
    robot.memory.inhibiting_until = robot.reading.cycle + 10
    robot.hear(by_hand_list(identity=0x42, request=1, tail=1, branch=2, link_number=5)).live()
    assert robot.memory.role == Role.TAIL
    assert not any(from_runner(read(data)) for data in robot.sent().values())


def test_a_link_sends_its_place_and_whether_the_branch_is_established():
    robot = OneRobot(0x77).lead(branch=2, link_number=6)
    robot.memory.role, robot.memory.state = Role.LINK, State.STAY
    assert said_everywhere(robot.live()) == bytes([0x77, 0x20, 0x06, 0])
    robot.memory.established = 1
    assert said_everywhere(robot.live()) == bytes([0x77, 0x20, 0x46, 0])
    assert robot.command.colour == Colour.YELLOW


@pytest.mark.parametrize(("reported", "verdict", "golden"), [(2, 1, [5, 2, 0, 2]), (1, 0, [5, 0, 0, 1])])
def test_a_runner_notifies_of_its_count_and_the_verdict(reported, verdict, golden):
    robot = OneRobot(5).turn_to(State.FOLLOW)
    m = robot.memory
    m.notifying, m.reported, m.verdict, m.verdict_heard, m.colour = 1, reported, verdict, robot.reading.cycle, 2
    assert said_everywhere(robot.live()) == bytes(golden) == by_hand(identity=5, direction=verdict, count=reported)
    assert is_notification(read(golden))


def test_a_runner_on_its_way_to_a_task_inhibits():
    robot = OneRobot(0xFE).turn_to(State.APPROACH)
    m = robot.memory
    m.colour, m.target.known, m.target.x, m.target.seen = Colour.RED, 1, 0.3, robot.reading.cycle
    assert said_everywhere(robot.live()) == bytes([0xFE, 0x08, 0, 0])


def test_a_guardian_repeats_an_inhibition_with_the_initiators_identity():
    robot = OneRobot(0x10).guard(Colour.BLUE, False)
    robot.hear([0xFE, 0x08, 0, 0]).live().live()
    assert said_everywhere(robot) == bytes([0xFE, 0x08, 0, 0b0_1_011_001])


def test_nobody_repeats_an_echo_as_if_it_were_the_initiator():
    robot = OneRobot(0x10).guard(Colour.BLUE, False)
    robot.hear([0xFE, 0x08, 0, 0b0_1_010_001]).live().live()
    assert said_everywhere(robot) == bytes([0x10, 0, 0, 0b0_1_011_001])


@given(messages)
def test_a_notification_is_a_runners_message_without_request_and_with_a_count(fields):
    message = records(MESSAGE, 1)[0]
    for name, value in fields.items():
        message[name] = value
    runner = fields["guardian"] == fields["tail"] == fields["link_number"] == 0
    assert from_runner(message) == runner
    assert is_notification(message) == (runner and fields["request"] == 0 and fields["count"] != 0)


def test_a_quiet_runner_sends_nothing():
    assert OneRobot().live().sent() == {}


def test_encoding_writes_all_four_bytes():
    payload = np.full(4, 0xFF, np.uint8)
    encode(records(MESSAGE, 1)[0], payload)
    assert payload.tolist() == [0, 0, 0, 0]


@pytest.fixture(scope="module")
def spoken():
    """All different messages of three trials of 500 s, as (role of the sender, message, mask of emitters)."""
    heard = []
    for seed in (3, 4, 5):
        trial = MARK_I3.run(mark_i3_parameters(swarm={"log_messages": True, "time_cap": 500.0}), seed)
        roles: dict[int, tuple[int, int]] = {}
        for event in trial.events:  # sorted by cycle, robot, kind
            who, cycle = int(event["robot"]), int(event["cycle"])
            if event["kind"] == EventKind.ROLE:
                roles[who] = (int(event["value"]), cycle)
            elif event["kind"] == EventKind.MESSAGE:
                role, since = roles.get(who, (0, -1))
                if since != cycle:  # the cycle of a change belongs to both roles
                    heard.append((role, int(event["subject"]), int(event["value"])))
    return [(role, read(list(n.to_bytes(4, "big"))), n.to_bytes(4, "big"), mask) for role, n, mask in set(heard)]


def test_in_a_trial_everybody_says_only_what_its_role_may_say(spoken):
    seen = {role for role, *_ in spoken}
    assert seen == {Role.RUNNER, Role.GUARDIAN, Role.LINK, Role.TAIL}
    for role, message, data, _ in spoken:
        assert bytes(written(**{name: int(message[name]) for name in PLACES})) == data  # the two spare bits are 0
        assert from_runner(message) == (role == Role.RUNNER)
        assert message.guardian == (role == Role.GUARDIAN)
        if role == Role.GUARDIAN:
            assert message.colour in (1, 2, 3) and message.count in (0, 1, 2) and message.link_number == 0
            assert message.tail == 1 or (message.request == 0 and message.direction == 0)
        elif role == Role.TAIL:
            assert message.tail == 1 and 1 <= message.link_number <= 31 and message.branch in (1, 2)
            assert not (message.inhibit or message.in_chain or message.established or message.confident)
            assert message.count == message.colour == 0
        elif role == Role.LINK:
            assert 1 <= message.link_number <= 31 and message.branch in (1, 2)
            assert not (message.request or message.direction or message.tail or message.inhibit or message.confident)
            assert message.count == message.colour == 0
        else:
            assert message.branch == message.colour == 0
            assert not (message.in_chain or message.established or message.confident)
            assert message.count == 0 or message.request == 0


def test_in_a_trial_invitations_go_out_through_a_few_emitters_only(spoken):
    for _, message, _, mask in spoken:
        emitters = mask.bit_count()
        if message.tail == 1 and message.direction == 1:
            assert 1 <= emitters <= 4
        elif message.tail == 0:
            assert emitters == 12
