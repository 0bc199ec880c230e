"""Colours, letters and type of all figures: one look, readable without colour."""

from typing import NamedTuple

INK = "#22262b"
PALE_INK = "#7a828c"
PAPER = "#ffffff"
FLOOR = "#f4f2ee"
GRID = "#e3e1dc"
# Curves of one figure, in order; apart for colour-blind readers (Okabe and Ito).
CURVES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")

# The colours that a Scene may name.
NAMED = {
    "wall": "#4a4f57",
    "red": "#d6352c",
    "green": "#2b9348",
    "blue": "#2364c8",
    "orange": "#f08a00",
    "yellow": "#e8c400",
    "magenta": "#c2268f",
    "cyan": "#16a3b8",
    "object": "#8a5a2b",
}


class RoleStyle(NamedTuple):
    """How robots of one role are drawn."""

    fill: str
    letter: str  # drawn on the robot; empty: the carried number is drawn instead
    ink: str  # of letter and heading
    chained: bool  # part of the chain: joined to its neighbours by a band


_KNOWN = {
    "runner": RoleStyle("#d9dce0", "", INK, False),
    "guardian": RoleStyle("#35c9de", "G", INK, True),
    "link": RoleStyle("#f7d43c", "L", INK, True),
    "tail": RoleStyle("#d43ba3", "T", PAPER, True),
    "harvest": RoleStyle("#b5e48c", "H", INK, False),
    "cache": RoleStyle("#ffb703", "C", INK, False),
    "corridor": RoleStyle("#f4f4f4", "=", INK, False),
    "store": RoleStyle("#8ecae6", "S", INK, False),
    "master": RoleStyle("#d43ba3", "M", PAPER, False),
    "waiting": RoleStyle("#f4f4f4", "", INK, False),
    "flocking": RoleStyle("#8ecae6", "", INK, False),
    "spiralling": RoleStyle("#ffb703", "", INK, False),
    "in an arm": RoleStyle("#b5e48c", "", INK, False),
    "holding": RoleStyle("#2b9348", "", PAPER, False),
    "lost": RoleStyle("#d6352c", "", PAPER, False),
    "gathering": RoleStyle("#cdb4db", "", INK, False),
    "dead": RoleStyle("#3d4249", "×", PAPER, False),
}
_OTHERS = ("#8ecae6", "#ffb703", "#b5e48c", "#cdb4db", "#f4a582", "#92c5de")


def role_styles(roles: tuple[str, ...]) -> list[RoleStyle]:
    """Return a style for every role; roles that nobody thought of get a colour and their first letter."""
    others = iter(_OTHERS * (len(roles) // len(_OTHERS) + 1))
    return [_KNOWN.get(role) or RoleStyle(next(others), role[:1].upper(), INK, False) for role in roles]


def colour(name: str) -> str:
    """Return the colour of a name in a Scene; other names are left to matplotlib."""
    return NAMED.get(name, name)


def clock(seconds: float) -> str:
    """Write a time of a trial as minutes and seconds: "12:05"."""
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"
