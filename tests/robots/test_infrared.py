"""The bytes of the short-range exchange tell everything apart that must be told apart."""

from formicarium.robots import infrared
from formicarium.robots.records import SILENCE


def test_every_identity_fits_into_two_bytes_and_comes_out_again():
    sent = {(infrared.HIGH_HALF | n >> 4, infrared.LOW_HALF | n & 0x0F) for n in range(256)}
    assert len(sent) == 256
    assert all(0 <= byte <= 255 for pair in sent for byte in pair)
    assert {(high & 0x0F) << 4 | low & 0x0F for high, low in sent} == set(range(256))


def test_no_two_words_share_a_byte():
    spoken = [{infrared.HIGH_HALF | n for n in range(16)}, {infrared.LOW_HALF | n for n in range(16)}]
    spoken += [{infrared.CLAIM | n for n in range(16)}]
    answers = ("HEARD_HIGH", "HEARD_LOW", "WORKING", "SUCCESS", "FAILURE")
    spoken += [{getattr(infrared, name)} for name in answers] + [{SILENCE}]
    assert len(set.union(*spoken)) == sum(len(words) for words in spoken)
