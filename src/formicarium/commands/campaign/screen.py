"""The terminal, or a file or pipe in its place."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import Console
from rich.markup import escape
from rich.table import Table

if TYPE_CHECKING:  # only to say what is printed
    from formicarium.commands.campaign.comparison import Compared
    from formicarium.statistics.effects import Effect

WIDTH = 250  # characters


def wide_console() -> Console:
    """Return a console that breaks no lines of tables in files and pipes."""
    console = Console()
    return console if console.is_terminal else Console(width=WIDTH)


def print_comparisons(console: Console, found: "Sequence[Compared]") -> None:
    """Print what was compared as a table, a line a target and cell."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    factors = list(found[0].cell)
    titles = ("A", "B", "difference", "Fisher p", "odds ratio", "hazard ratio A/B", "log-rank p", "medians A/B")
    for title in [*factors, "target", *titles]:
        table.add_column(title, justify="left" if title in (*factors, "target") else "right")
    for row in found:
        shares = [f"{reached} of {runs}" for reached, runs in zip(row.reached, row.runs)]
        table.add_row(
            *(str(row.cell[name]) for name in factors),
            row.target,
            *shares,
            _interval(row.difference, percent=True),
            escape(f"{row.fisher_p:.2g} [{row.fisher_holm:.2g}]"),
            _interval(row.odds),
            _interval(row.hazard),
            escape(f"{row.log_rank_p:.2g} [{row.log_rank_holm:.2g}]"),
            _interval(row.medians),
        )
    console.print(table)
    console.print("brackets after an estimate: 95 % interval; after p: adjusted for all tests shown", highlight=False)


def _interval(effect: "Effect", percent: bool = False) -> str:
    words = [f"{number:+.0%}" if percent else f"{number:.2f}" for number in effect]
    value = words[0] if math.isfinite(effect.value) and (percent or effect.value > 0) else "-"
    return f"{value} ({words[1]} to {words[2]})"


def say(console: Console, text: str) -> None:
    """Print a line as it is: no markup, no wrapping."""
    console.print(text, highlight=False, soft_wrap=True, markup=False)
