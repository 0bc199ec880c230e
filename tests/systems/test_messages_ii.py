"""The four-byte message of Mark II, bit by bit against Fig. S16 (section 12.2), and who says what."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from formicarium.physics.records import records
from formicarium.robots.infrared import FAILURE, NOTED, SUCCESS
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.guardian_ii import become_guardian_ii
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.messages import MESSAGE
from formicarium.systems.sequencing.messages_ii import decode_ii, encode_ii
from formicarium.systems.sequencing.ring import NOBODY
from systems.one_robot import OneRobot

# Section 12.2: field -> (byte, lowest bit, bits). All 32 bits have a use.
ALL = {
    "identity": (0, 0, 8),
    "request": (1, 0, 1),
    "direction": (1, 1, 1),
    "tail": (1, 2, 1),
    "number": (1, 3, 2),
    "inhibit": (1, 5, 1),
    "report": (1, 6, 1),
    "election": (1, 7, 1),
    "in_chain": (2, 5, 1),
    "established": (2, 6, 1),
    "guardian": (2, 7, 1),
    "source": (3, 0, 8),
}
GUARDIAN = ALL | {"count": (2, 0, 3), "colour": (2, 3, 2)}
OTHERS = ALL | {"link_number": (2, 0, 5)}


def written_ii(**fields: int) -> np.ndarray:
    """Return the four bytes of a message; what is not named is 0."""
    message = records(MESSAGE, 1)[0]
    for name, value in fields.items():
        message[name] = value
    payload = np.zeros(4, np.uint8)
    encode_ii(message, payload)
    return payload


def read_ii(payload) -> dict[str, int]:
    message = records(MESSAGE, 1)[0]
    decode_ii(np.frombuffer(bytes(payload), np.uint8), message)
    return {name: int(message[name]) for name in MESSAGE.names}


def fields_of(places, guardian):
    free = {name: st.integers(0, 2**bits - 1) for name, (_, _, bits) in places.items()}
    free["guardian"] = st.just(guardian)
    if guardian:
        free["colour"] = st.integers(1, 4)
    return st.fixed_dictionaries(free)


def by_hand(places, **fields: int) -> bytes:
    data = [0, 0, 0, 0]
    for name, value in fields.items():
        byte, low, _ = places[name]
        data[byte] += (value - (name == "colour")) * 2**low
    return bytes(data)


@given(st.one_of(fields_of(GUARDIAN, 1), fields_of(OTHERS, 0)))
def test_decoding_undoes_encoding(fields):
    """A1, TS-135."""
    places = GUARDIAN if fields["guardian"] else OTHERS
    payload = written_ii(**fields)
    assert bytes(payload) == by_hand(places, **fields)
    read = read_ii(payload)
    assert {name: read[name] for name in fields} == fields
    growing = fields["guardian"] or not fields["established"]
    assert read["branch"] == (fields["source"] if growing else 0)
    assert not any(read[name] for name in set(MESSAGE.names) - set(fields) - {"branch"})


@given(st.binary(min_size=4, max_size=4))
def test_any_four_bytes_can_be_read_and_are_written_again(data):
    assert bytes(written_ii(**read_ii(list(data)))) == data


def all_bits(places) -> set:
    return {(byte, low + k) for byte, low, bits in places.values() for k in range(bits)}


def test_no_two_fields_share_a_bit():
    for places in (GUARDIAN, OTHERS):
        assert len(all_bits(places)) == sum(bits for _, _, bits in places.values()) == 32


def guardian(identity=0xA5, colour=Colour.GREEN) -> OneRobot:
    robot = OneRobot(identity, mark=2).guard(colour, False)
    become_guardian_ii(robot.memory, identity, robot.reading.cycle)
    robot.memory.colour = colour
    return robot


def said(robot: OneRobot, emitter: int = 0) -> dict[str, int]:
    return {name: value for name, value in read_ii(robot.sent()[emitter]).items() if value}


def test_a_new_guardian_directs_nobody_and_invites_on_its_right():
    """TS-110, TS-112; DATA[3] tells where the branch starts."""
    robot = guardian().live()
    plain = {"identity": 0xA5, "source": 0xA5, "branch": 0xA5, "guardian": 1, "tail": 1, "count": NOBODY, "colour": 2}
    assert said(robot, 3) == plain and said(robot, 9) == plain | {"direction": 1}
    assert robot.command.colour == Colour.CYAN


def test_a_guardian_may_be_reached_while_it_is_still_a_tail():
    """TS-111."""
    robot = guardian().hear(written_ii(identity=0xA5, tail=1, request=1, link_number=4, source=9)).live()
    assert robot.memory.established == 1 and robot.memory.tail == 1
    assert said(robot)["established"] == 1 and said(robot)["tail"] == 1


def test_a_guardian_is_not_reached_by_its_own_branch():
    """U23."""
    robot = guardian().hear(written_ii(identity=0xA5, tail=1, request=1, link_number=4, source=0xA5)).live()
    assert robot.memory.established == 0


def test_an_inhibition_is_repeated_in_every_other_cycle():
    """TS-134: DATA[0] carries the initiator's identity then, else the own one."""
    robot = guardian()
    words = []
    for _ in range(4):
        robot.hear(written_ii(identity=77, inhibit=1)).live()
        words.append((said(robot)["identity"], said(robot).get("inhibit", 0)))
    assert sorted(set(words)) == [(77, 1), (0xA5, 0)]
    assert words[0] == words[2] and words[1] == words[3] and words[0] != words[1]


def searching(label=2, upi=0) -> OneRobot:
    robot = guardian()
    m = robot.memory
    m.tail, m.in_chain, m.established, m.state, m.chosen = 0, 1, 1, State.STAY, 31
    m.ring.out, m.ring.label, m.ring.upi, m.ring.number = 1, label, upi, upi % 4
    return robot


def report(**fields) -> np.ndarray:
    return written_ii(**{"identity": 3, "report": 1} | fields)


def test_a_failure_leads_to_the_next_permutation_once():
    """TS-120, TS-127: however often it is repeated."""
    robot = searching(label=2, upi=1)
    for _ in range(5):
        robot.hear(report(number=1)).live()
    assert robot.memory.ring.upi == 2
    words = said(robot)
    assert (words["number"], words.get("count", 0), words["source"]) == (2, 0, 0xA5)  # bac: b first


def test_a_verdict_on_another_permutation_is_not_counted():
    """TS-127."""
    robot = searching(upi=5)  # M4PI 1
    for number in (0, 2, 3):
        robot.hear(report(number=number)).live()
    assert robot.memory.ring.upi == 5


def test_a_verdict_from_afar_is_not_counted():
    """T15."""
    robot = searching().hear(report(number=0), distance=0.6).live()
    assert robot.memory.ring.upi == 0


def test_a_success_ends_the_search():
    """TS-121, U39: failures are ignored from then on."""
    robot = searching(upi=4).hear(report(number=0, direction=1)).live()
    assert said(robot)["report"] == 1
    robot.hear(report(number=0)).live()
    assert robot.memory.ring.upi == 4 and robot.memory.ring.solved == 1


def loop_word(**fields) -> np.ndarray:
    return written_ii(**{"identity": 31, "link_number": 1, "established": 1, "source": 8} | fields)


def test_a_step_from_the_loop_is_taken_from_the_own_first_link_alone():
    robot = searching()
    robot.hear(loop_word(number=1, identity=32)).live()
    robot.hear(loop_word(number=1, inhibit=1)).live()
    robot.hear(loop_word(number=1, established=0)).live()
    assert robot.memory.ring.upi == 0
    robot.hear(loop_word(number=1)).live()
    assert robot.memory.ring.upi == 1 and said(robot)["source"] == 8


def test_guardians_accept_one_or_two_steps_ahead_and_ignore_one_behind():
    """TS-126."""
    for own in range(6):
        for ahead, after in ((0, own), (1, own + 1), (2, own + 2), (3, own)):
            robot = searching(upi=own).hear(loop_word(number=(own + ahead) % 4)).live()
            assert robot.memory.ring.upi == after


# The runner


def runner(count=1, step=0, **numbers) -> OneRobot:
    robot = OneRobot(0x42, mark=2, **numbers).turn_to(State.FOLLOW)
    robot.memory["count"], robot.memory.step, robot.memory.step_heard = count, step, robot.reading.cycle
    return robot


def meet(robot: OneRobot, colour=Colour.GREEN, **fields) -> OneRobot:
    """Let it meet a guardian whose booth is in view."""
    advert = written_ii(**{"identity": 9, "guardian": 1, "in_chain": 1, "colour": colour, "source": 9} | fields)
    return robot.hear(advert).see((Colour.CYAN, 0.2, 0.0), (colour, 0.3, 0.1)).live()


def test_a_runner_performs_if_it_has_done_as_many_tasks_as_the_guardian_says():
    """TS-119."""
    for count in range(3):
        for wanted in (0, 1, 2, NOBODY):
            robot = meet(runner(count), count=wanted)
            assert (robot.memory.state == State.APPROACH) == (wanted == count)


def test_a_runner_starts_again_with_a_newer_permutation_and_skips_a_guardian_that_lags():
    """TS-104, TS-127."""
    for step in range(4):
        for ahead, count, adopted in ((0, 2, 0), (1, 0, 1), (2, 0, 2), (3, 2, 0)):
            robot = meet(runner(2, step), count=5, number=(step + ahead) % 4)
            assert robot.memory["count"] == count and robot.memory.step == (step + adopted) % 4


def test_a_runner_that_has_done_nothing_takes_any_permutation():
    robot = meet(runner(0, 1), count=0, number=0)
    assert robot.memory.step == 0 and robot.memory.state == State.APPROACH


def test_a_runner_that_was_away_for_long_starts_again():
    """TS-128: four steps may have gone by."""
    robot = runner(2, 1)
    robot.reading.cycle += robot.table.step_memory + 1
    assert meet(robot, count=2, number=1).memory["count"] == 0


def visit(robot: OneRobot, byte: int) -> OneRobot:
    """Let it hear the booth's last byte in the bay."""
    robot.memory.colour, robot.memory.candidate = Colour.GREEN, 0
    robot.turn_to(State.EXCHANGE)
    robot.reading.infrared = byte
    return robot.live()


def test_a_noted_task_counts_and_is_not_reported():
    """TS-104, U55."""
    robot = visit(runner(1, 2), NOTED)
    assert robot.memory["count"] == 2 and robot.memory.notifying == 0


def test_the_verdict_is_reported_with_its_permutation():
    for byte, verdict in ((SUCCESS, 1), (FAILURE, 0)):
        robot = visit(runner(2, 3), byte)
        assert robot.memory["count"] == 0 and robot.memory.notifying == 1
        words = read_ii(robot.turn_to(State.LEAVE).live().sent()[0])
        assert (words["report"], words["direction"], words["number"], words["identity"]) == (1, verdict, 3, 0x42)
        assert words["guardian"] == words["tail"] == words["link_number"] == 0  # TS-132


def test_a_report_ends_when_the_guardian_has_gone_on_or_is_done():
    """U54."""
    for news in ({"number": 0}, {"number": 3, "report": 1}):
        robot = visit(runner(2, 3), FAILURE).turn_to(State.FOLLOW)
        for _ in range(robot.table.notify_least + 2):
            meet(robot, **news, count=5)
        assert robot.memory.notifying == 0
        robot = visit(runner(2, 3), FAILURE).turn_to(State.FOLLOW)
        for _ in range(robot.table.notify_least + 2):
            meet(robot, number=3, count=5)
        assert robot.memory.notifying == 1


def test_a_failure_before_the_last_task_has_nothing_to_report():
    """The coordinator's record is another than the robot's (TS-30)."""
    robot = visit(runner(1), FAILURE)
    assert robot.memory["count"] == 0 and robot.memory.notifying == 0


# Tail and link


def leading(**numbers) -> OneRobot:
    return OneRobot(33, mark=2, **numbers).lead(branch=0xC8, link_number=5)


def advertised(robot, **fields) -> OneRobot:
    """Let a tail see a guardian straight ahead."""
    advert = written_ii(**{"identity": 9, "guardian": 1, "tail": 1, "colour": 1, "source": 9} | fields)
    return robot.hear(advert).see((Colour.CYAN, 0.18, 0.0)).live()


def test_a_tail_docks_at_a_guardian_that_no_branch_has_reached():
    """TS-86, U23: not at one that has been, nor at the one its branch starts from."""
    assert advertised(leading()).memory.state == State.DOCK
    assert advertised(leading(), established=1).memory.state == State.OPEN
    assert advertised(leading(), identity=0xC8, source=0xC8).memory.state == State.OPEN


def test_a_tail_says_where_its_branch_starts():
    words = said(leading().live(), 3)
    assert words == {"identity": 33, "tail": 1, "link_number": 5, "source": 0xC8, "branch": 0xC8}


def offering() -> OneRobot:
    robot = leading().turn_to(State.OFFER)
    robot.memory.chosen, robot.memory.sector = 0x42, 0.0
    return robot


def test_an_acknowledgement_counts_on_the_own_branch_alone():
    """Two tails may choose the same runner: its request names none."""
    robot = offering().hear(written_ii(identity=0x42, tail=1, link_number=6, source=0xC9)).live()
    assert robot.memory.role == Role.TAIL
    robot = offering().hear(written_ii(identity=0x42, tail=1, link_number=6, source=0xC8)).live()
    assert robot.memory.role == Role.LINK


def waiting(cycles: int, *heard) -> OneRobot:
    """Let it offer for so long with a magenta light in its sector, then with these words in the air for a cycle."""
    robot = offering()
    for n in range(cycles):
        for words in heard if n == cycles // 2 else ():
            robot.hear(words)
        robot.see((Colour.MAGENTA, 0.18, 0.0)).live()
    return robot


def test_a_magenta_light_ends_an_offer_only_if_it_can_be_nobody_elses():
    """TS-80, C18: after a while without an answer, and without another branch's tail in the air."""
    patience = offering().table.light_patience
    assert waiting(patience).memory.role == Role.TAIL
    assert waiting(patience + 2).memory.role == Role.LINK
    stranger = written_ii(identity=50, tail=1, link_number=2, source=0xC9)
    assert waiting(patience + 2, stranger).memory.role == Role.TAIL
    own = written_ii(identity=51, tail=1, link_number=6, source=0xC8)
    assert waiting(patience + 2, own).memory.role == Role.LINK


def asking(branch=0xC8) -> OneRobot:
    """Return a runner that has answered the invitation of a branch."""
    robot = OneRobot(0x42, mark=2).turn_to(State.FOLLOW)
    robot.hear(written_ii(identity=33, tail=1, direction=1, link_number=5, source=branch))
    return robot.see((Colour.MAGENTA, 0.2, 0.0)).live()


def test_a_runner_joins_the_branch_that_invited_it():
    """A request names no tail, so another branch's tail, out of reach, may answer it."""
    for source, role in ((0xC9, Role.RUNNER), (0xC8, Role.TAIL)):
        robot = asking()
        assert robot.memory.state == State.JOIN
        robot.hear(written_ii(identity=0x42, tail=1, request=1, link_number=5, source=source)).live()
        assert robot.memory.role == role
    assert robot.memory.branch == 0xC8 and robot.memory.link_number == 6


def test_a_runner_that_goes_round_a_guardian_does_not_lead_a_branch_past_it():
    for guardian_at, state in ((0.12, State.FOLLOW), (0.25, State.JOIN)):
        robot = OneRobot(0x42, mark=2).turn_to(State.FOLLOW)
        robot.hear(written_ii(identity=33, tail=1, direction=1, link_number=5, source=0xC8))
        robot.see((Colour.MAGENTA, 0.2, 0.0), (Colour.CYAN, guardian_at, 2.0)).live()
        assert robot.memory.state == state


def test_a_tail_looks_for_a_guardian_before_it_hears_requests():
    request = written_ii(identity=0x42, request=1)
    assert advertised(leading().hear(request)).memory.state == State.DOCK
    assert leading().hear(request).live().memory.state == State.OFFER


def docking(distance: float) -> OneRobot:
    robot = leading()
    advert = written_ii(identity=9, guardian=1, tail=1, colour=1, source=9)
    return robot.hear(advert).see((Colour.CYAN, distance, 0.0)).live()


def test_a_docking_tail_pulls_before_it_recruits():
    """TS-87, U21: the gap is too wide for one robot."""
    robot = docking(0.3)
    advert = written_ii(identity=9, guardian=1, tail=1, colour=1, source=9)
    pulled = 0
    for _ in range(robot.table.pull_patience + 5):
        robot.hear(advert).see((Colour.CYAN, 0.3, 0.0)).live()
        pulled += robot.motion()[0] > 0.005
    assert robot.memory.state == State.DOCK and pulled > 10
    assert read_ii(robot.sent()[0])["direction"] == 1 and read_ii(robot.sent()[6])["direction"] == 0


def test_a_tail_does_not_take_the_word_to_another_branch_for_its_own():
    """The guardian it aligns with says EST before it has been asked: it has been reached by another."""
    robot = docking(0.18)
    reached = written_ii(identity=9, guardian=1, tail=1, established=1, colour=1, source=9)
    for _ in range(3):
        robot.hear(reached).see((Colour.CYAN, 0.18, 0.0)).live()
    assert robot.memory.role == Role.TAIL and robot.memory.state == State.OPEN


def test_a_tail_that_has_asked_becomes_a_link_when_the_guardian_says_est():
    robot = docking(0.18)
    advert = written_ii(identity=9, guardian=1, tail=1, colour=1, source=9)
    for _ in range(robot.table.dock_hold + 2):
        robot.hear(advert).see((Colour.CYAN, 0.18, 0.0)).live()
    words = read_ii(robot.sent()[0])
    assert (words["tail"], words["request"], words["identity"], words["source"]) == (1, 1, 9, 0xC8)
    robot.hear(written_ii(identity=9, guardian=1, tail=1, established=1, colour=1, source=9)).live()
    assert robot.memory.role == Role.LINK and robot.memory.established == 1 and robot.memory.chosen == 9


def linked(established: int) -> OneRobot:
    robot = leading().turn_to(State.STAY)
    robot.memory.role, robot.memory.chosen, robot.memory.established = Role.LINK, 34, established
    return robot


def test_a_link_is_established_by_its_successor_alone():
    """U51: known by its identity, since there is no BRN."""
    assert (
        linked(0).hear(written_ii(identity=35, link_number=6, established=1, source=1)).live().memory.established == 0
    )
    assert (
        linked(0).hear(written_ii(identity=34, link_number=6, established=1, source=1)).live().memory.established == 1
    )
    guardian = written_ii(identity=34, guardian=1, established=1, colour=1, source=34)
    assert linked(0).hear(guardian).live().memory.established == 1


def test_an_established_link_repeats_its_successor_with_its_own_identity():
    """TS-125."""
    heard = {"identity": 34, "link_number": 6, "established": 1, "election": 1, "number": 2, "report": 1, "source": 77}
    robot = linked(1).hear(written_ii(**heard)).live()
    assert said(robot) == heard | {"identity": 33, "link_number": 5}
    robot.hear(written_ii(**heard | {"identity": 36, "source": 78})).live()
    assert said(robot)["source"] == 77
