"""The bytes that robots and booths exchange at short range (TS-29, with an 8-bit identity in two bytes)."""

HIGH_HALF = 0x80  # robot: upper four bits of its identity
LOW_HALF = 0x90  # robot: lower four bits
CLAIM = 0x20  # robot: this will be my task number n (lower four bits)
HEARD_HIGH = 0x10  # booth: go on with the lower half
HEARD_LOW = 0x11  # booth: identity complete, claim your task
WORKING = 0x12  # booth: claim noted, stay
SUCCESS = 0x7F  # booth: task done, in the right order
NOTED = 0x78  # booth: task done, no verdict before the sequence is complete
FAILURE = 0x70  # booth: task done, out of order
