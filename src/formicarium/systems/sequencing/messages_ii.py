"""The four-byte message of Mark II, bit by bit (Fig. S16; docs/choices.md tells how its collisions are resolved).

DATA[0]        identity: own, overwritten at each hop; in T_RES the chosen one's, in an inhibition echo the initiator's
DATA[1] bit 0  request: T_REQ of a runner, T_RES of a tail
        bit 1  direction: T_DIR of a tail (only in its sector), verdict of a runner's report
        bit 2  tail
        bits 4:3  number: M4PI; during the election the label that is handed on, 0 for none
        bit 5  inhibit
        bit 6  report: VERDICT of a runner; in what goes round the loop: solved
        bit 7  election
DATA[2] bits 4:0  link_number (LNK_NO) of a link or a tail
        bits 2:0  count (CND) of a guardian
        bits 4:3  colour of the guarded task, less one
        bit 5  in_chain
        bit 6  established (EST); of a guardian: a branch has reached it
        bit 7  guardian
DATA[3]        source (SOURCE_ID): the guardian that originated the message; of a link or tail whose branch is not
               established, and of a guardian acting as tail: the guardian its branch starts from (there is no BRN)
"""

from formicarium.compiled import compiled


@compiled
def encode_ii(message, payload):
    """Write a message into four bytes."""
    payload[0] = message.identity
    payload[1] = (
        message.request
        | message.direction << 1
        | message.tail << 2
        | message.number << 3
        | message.inhibit << 5
        | message.report << 6
        | message.election << 7
    )
    place = message.count | (message.colour - 1) << 3 if message.guardian == 1 else message.link_number
    payload[2] = place | message.in_chain << 5 | message.established << 6 | message.guardian << 7
    payload[3] = message.source


@compiled
def decode_ii(payload, message):
    """Read a message from four bytes; the fields that only Mark I has stay 0, but for the branch."""
    byte = int(payload[1])
    message.identity = int(payload[0])
    message.request = byte & 1
    message.direction = byte >> 1 & 1
    message.tail = byte >> 2 & 1
    message.number = byte >> 3 & 3
    message.inhibit = byte >> 5 & 1
    message.report = byte >> 6 & 1
    message.election = byte >> 7 & 1
    byte = int(payload[2])
    message.guardian = byte >> 7 & 1
    message.established = byte >> 6 & 1
    message.in_chain = byte >> 5 & 1
    message.count = byte & 7 if message.guardian == 1 else 0
    message.colour = (byte >> 3 & 3) + 1 if message.guardian == 1 else 0
    message.link_number = 0 if message.guardian == 1 else byte & 31
    message.source = int(payload[3])
    growing = message.guardian == 1 or message.established == 0
    message.branch = message.source if growing else 0
