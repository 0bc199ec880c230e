"""What a person did that cannot be done."""

from collections.abc import Iterable
from difflib import get_close_matches


class UserError(Exception):
    """Bad input: the message names what is wrong and the way out; shown without a traceback, exit code 2."""


def near(name: str, known: Iterable[str]) -> str:
    """Return ' Did you mean "x"?' for names like ``name``, or nothing."""
    matches = get_close_matches(name, list(known), n=3, cutoff=0.5)
    return f" Did you mean {' or '.join(matches)}?" if matches else ""
