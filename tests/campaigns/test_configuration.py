"""What decides a run decides its identity, and nothing else does."""

from formicarium.campaigns.configuration import Configuration, difference

ONE = Configuration("walk", {"b": {"x": 1.0, "y": [1, 2]}, "a": 3}, "abcd", "0.1")


def test_the_identity_does_not_depend_on_the_order_of_parameters_or_the_version():
    other = Configuration("walk", {"a": 3, "b": {"y": [1, 2], "x": 1.0}}, "abcd", "0.2")
    assert ONE.identity == other.identity
    assert len(ONE.identity) == 16


def test_the_identity_depends_on_everything_that_decides_results():
    others = [
        ONE._replace(system="run"),
        ONE._replace(sources="abce"),
        ONE._replace(parameters={"b": {"x": 1.5, "y": [1, 2]}, "a": 3}),
    ]
    assert len({ONE.identity, *(other.identity for other in others)}) == 4


def test_a_difference_is_told_in_words():
    changed = ONE._replace(parameters={"b": {"x": 2.0, "y": [1, 2]}, "a": 3})
    assert "b.x = 1.0, now 2.0" in difference(ONE.content(), changed.content())
    assert "runs of walk" in difference(ONE.content(), ONE._replace(system="run").content())
    assert "sources" in difference(ONE.content(), ONE._replace(sources="abce").content())
