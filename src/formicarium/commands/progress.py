"""Progress on the terminal: runs done of a set, simulated time inside a single run."""

import contextlib
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, ProgressColumn, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.progress import Progress as Bars


def bars(console: Console, *more: ProgressColumn) -> Bars:
    """Return bars that are gone when the work is done: what, how far in words, the time."""
    words = [TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[words]}"), TimeElapsedColumn()]
    return Bars(SpinnerColumn(), *words, *more, console=console, transient=True, refresh_per_second=2)


class Progress:
    """Bars that are there while work is done and gone afterwards."""

    def __init__(self, console: Console, name: str, runs: int):
        """Prepare the bars for a set of ``runs`` runs."""
        self._bars = bars(console, TimeRemainingColumn())
        self._single = runs == 1
        self._set = self._bars.add_task(name, total=runs, words="starting", visible=not self._single)
        self._inside = self._bars.add_task(
            name if self._single else "this run", total=None, words="starting", visible=self._single
        )

    def __enter__(self) -> "Progress":
        """Show the bars."""
        self._bars.start()
        return self

    def __exit__(self, *_: Any) -> None:
        """Take the bars away."""
        with contextlib.suppress(KeyboardInterrupt):
            self._bars.stop()

    def runs(self, done: int, total: int) -> None:
        """Show how many runs of the set have ended."""
        self._bars.update(self._set, completed=done, total=total, words=f"{done} of {total} runs")

    def inside(self, done: float, total: float) -> None:
        """Show how far a run (simulated seconds) or a movie (frames) has got."""
        words = f"{done:,.0f} of {total:,.0f}" + (" s" if isinstance(total, float) else "")
        self._bars.update(self._inside, completed=done, total=total, words=words, visible=True)

    def note(self, what: str) -> None:
        """Say what is done now."""
        self._bars.update(self._inside, description=what, completed=0, total=None, words="", visible=True)
