"""Progress of a campaign on the terminal; in a log file, a line a minute."""

import contextlib
import time
from typing import Any

from rich.console import Console

from formicarium.campaigns.coordinator import Standing
from formicarium.commands.progress import bars

LOGGED = 60.0  # seconds between two lines where there is no terminal


class CampaignProgress:
    """One bar: done, failed, running, rate and time left."""

    def __init__(self, console: Console, name: str):
        """Prepare the bar."""
        self._console = console
        self._name = name
        self._logged = time.monotonic()
        self._bars = bars(console)
        self._task = self._bars.add_task(name, total=None, words="starting")

    def __enter__(self) -> "CampaignProgress":
        """Show the bar."""
        if self._console.is_terminal:
            self._bars.start()
        return self

    def __exit__(self, *_: Any) -> None:
        """Take the bar away."""
        with contextlib.suppress(KeyboardInterrupt):
            self._bars.stop()

    def show(self, standing: Standing) -> None:
        """Show how far it is."""
        if self._console.is_terminal:
            words = in_words(standing)
            self._bars.update(self._task, completed=standing.done + standing.failed, total=standing.total, words=words)
        elif time.monotonic() - self._logged >= LOGGED:
            self._logged = time.monotonic()
            self._console.print(f"{self._name}: {in_words(standing)}", highlight=False, soft_wrap=True)


def in_words(standing: Standing) -> str:
    """Say how far it is: "120 of 600 done, 1 failed, 2 running, 1.5/s, 5 min left"."""
    words = [f"{standing.done:,} of {standing.total:,} done"]
    if standing.failed:
        words.append(f"{standing.failed:,} failed")
    words.append(f"{standing.running} running")
    if standing.elsewhere:
        words.append(f"{standing.elsewhere} elsewhere")
    if standing.produced and standing.seconds > 0:
        rate = standing.produced / standing.seconds
        left = (standing.total - standing.done - standing.failed) / rate
        words.append(f"{rate:.1f}/s" if rate >= 1 else f"{rate * 60:.1f}/min")
        words.append(f"{duration(left)} left")
    return ", ".join(words)


def duration(seconds: float) -> str:
    """Write a duration for people: "45 s", "12 min", "3 h 20 min"."""
    if seconds < 60:
        return f"{seconds:.0f} s"
    hours, minutes = divmod(round(seconds / 60), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"
