"""Where results go if nobody says."""

from pathlib import Path

import pytest

from formicarium.commands.folders import results_folder


@pytest.mark.parametrize(
    ("system", "here", "on_windows"),
    [
        ("mark-i3", "mark-i3", "mark-i3"),
        ("mark-i3+kill:3@120+block:0@300", "mark-i3+kill:3@120+block:0@300", "mark-i3+kill-3-120+block-0-300"),
    ],
)
def test_a_default_folder_can_be_made_on_every_system(system, here, on_windows):
    identity = "0123456789abcdef"
    assert results_folder(system, identity, windows=False) == Path("formicarium-results") / f"{here}-01234567"
    assert results_folder(system, identity, windows=True) == Path("formicarium-results") / f"{on_windows}-01234567"
