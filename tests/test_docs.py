"""What the documents show exists, and what they tell a user to type works."""

import re
import shlex
from pathlib import Path

import pytest

from formicarium.commands.main import exit_code, main
from formicarium.commands.published import store
from formicarium.commands.run import run

ROOT = Path(__file__).parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
LINK = re.compile(r"\]\(([^)#]+?)\)")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_of_a_page_leads_somewhere(page):
    links = [link for link in LINK.findall(page.read_text()) if "://" not in link]
    missing = [link for link in links if not (page.parent / link).exists()]
    assert not missing


def shown_commands():
    """Return every formicarium command of the README and of the help of run."""
    texts = (ROOT / "README.md").read_text() + (run.__doc__ or "")
    found = re.findall(r"^(?:python -m pip install \S+ && | {8})?(formicarium [^#\n]+)", texts, re.MULTILINE)
    return sorted({line.strip() for line in found})


def test_commands_are_shown():
    assert len(shown_commands()) >= 8


@pytest.mark.parametrize("line", shown_commands())
def test_every_command_that_is_shown_works(line, tmp_path, monkeypatch):
    """Made short: at most two runs of twenty simulated seconds; pages are not served."""
    monkeypatch.chdir(tmp_path)
    for place in ("showing", "replaying"):
        monkeypatch.setattr(f"formicarium.commands.{place}.show", lambda *_: 0)
    words = shlex.split(line)[1:]
    if "seven" in words and words[0] != "run":
        made = ["run", "mark-i3", "--seed", "7", "--record", "--out", "seven", "--set", "time_cap=20", "--workers", "1"]
        assert exit_code(made) == 0
    if words[0] == "schedule" or "--map" in words:
        (tmp_path / "tasks.csv").write_text("name,x,y\nwell,3,1\nmill,-2,4\n", encoding="utf-8")
    if words[0] == "run":
        if "--runs" in words:
            words[words.index("--runs") + 1] = "2"
        words += ["--set", "time_cap=20", "--workers", "1"]
    if words[0] == "study":
        words[words.index("--runs") + 1] = "1"
        monkeypatch.setattr(store, "MORE", ("swarm.time_cap=20",))
    with pytest.raises(SystemExit) as end:
        main(words)
    assert end.value.code in (0, None)
    if words[0] == "run":
        assert list(tmp_path.rglob("runs.parquet"))
