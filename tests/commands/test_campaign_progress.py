"""The progress of a campaign in words, on a terminal and in a log."""

import io

import pytest
from rich.console import Console

from formicarium.campaigns.coordinator import Standing
from formicarium.commands.campaign import progress
from formicarium.commands.campaign.progress import CampaignProgress, duration, in_words

STANDING = Standing(total=600, done=120, failed=1, running=2, elsewhere=3, produced=60, seconds=30.0)


def test_done_failed_running_rate_and_time_left():
    assert in_words(STANDING) == "120 of 600 done, 1 failed, 2 running, 3 elsewhere, 2.0/s, 4 min left"
    slow = STANDING._replace(failed=0, elsewhere=0, produced=1)
    assert in_words(slow) == "120 of 600 done, 2 running, 2.0/min, 4 h 0 min left"
    assert in_words(slow._replace(produced=0)) == "120 of 600 done, 2 running"


@pytest.mark.parametrize(("seconds", "words"), [(12, "12 s"), (59.7, "60 s"), (150, "2 min"), (7300, "2 h 2 min")])
def test_durations_are_for_people(seconds, words):
    assert duration(seconds) == words


def test_a_terminal_shows_a_bar_and_a_log_a_line_a_minute(monkeypatch):
    for terminal in (True, False):
        console = Console(file=io.StringIO(), force_terminal=terminal, width=120)
        monkeypatch.setattr(progress, "LOGGED", 0.0)
        with CampaignProgress(console, "study") as shown:
            shown.show(STANDING)
        assert "120 of 600 done" in console.file.getvalue()
        assert ("\x1b" in console.file.getvalue()) == terminal
