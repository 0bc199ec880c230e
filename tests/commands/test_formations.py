"""``formicarium study`` of what arms grow into beyond the paper and of estimators aboard, made short."""

import tomllib
from importlib import resources

import pytest
from matplotlib.image import imread

from formicarium.commands import aboard, formations
from formicarium.commands.main import exit_code
from formicarium.studies.formations import cells_of, report


def design(package, name):
    return tomllib.loads((resources.files(f"formicarium.{package}.published") / f"{name}.toml").read_text())


def test_every_design_has_twenty_seeds_of_its_own():
    found = [design("systems.coverage", name) for names in formations.DESIGNS.values() for name in names]
    found.append(design("studies", aboard.DESIGN))
    assert all(one["replicates"] == 20 for one in found)
    firsts = [one["first_seed"] for one in found]
    assert len(set(firsts)) == len(firsts) and all(first % 1000 == 1 for first in firsts)


@pytest.mark.parametrize(
    ("figure", "counts"),
    [
        pytest.param("fractal", (4, 1), marks=pytest.mark.long),
        ("network", (4, 2)),
    ],
)
def test_a_study_of_formations_is_run_and_drawn(figure, counts, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(formations, "SHORTER", ("swarm.time_cap=10",))
    words = ["study", "coverage", "--figure", figure, "--out", "here", "--workers", "1"]
    assert exit_code([*words, "--collect-only"]) == 2
    assert exit_code([*words, "--runs", "1"]) == 0
    assert f"drawn from {sum(counts)} of {sum(counts)} runs" in capsys.readouterr().out
    for name, count in zip(formations.DESIGNS[figure], counts, strict=True):
        assert len((tmp_path / "here" / f"{name}.csv").read_text().splitlines()) == count + 1
        assert "| never parted |" in (tmp_path / "here" / f"{name}.md").read_text()
        assert imread(tmp_path / "here" / f"{name}.png").std() > 0.01
    assert exit_code([*words, "--runs", "2", "--collect-only"]) == 1


def test_the_study_of_estimators_aboard_is_run_and_drawn(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(aboard, "SHORTER", ("eruption.swarm.time_cap=10",))
    words = ["study", "connectivity", "--figure", "aboard", "--out", "here", "--runs", "1", "--workers", "1"]
    assert exit_code(words) == 0
    assert "drawn from 2 of 2 runs" in capsys.readouterr().out
    assert imread(tmp_path / "here" / "aboard.png").std() > 0.01
    assert len((tmp_path / "here" / "aboard.csv").read_text().splitlines()) == 11
    assert "| lag (s) |" in (tmp_path / "here" / "aboard.md").read_text()


def test_cells_count_what_has_no_value_and_never_average_over_it():
    rows = [
        {"n": 2, "losses_range": k, "lost_share_range": 0.1 * k, "longest_loss_range_s": 1.0 * k, "size": size}
        for k, size in enumerate((5.0, None, 7.0))
    ]
    (cell,) = cells_of(rows, ["n"], {"size": "size (m)"})
    assert (cell["runs"], cell["never_parted"], cell["size_runs"], cell["size_median"]) == (3, 1, 2, 6.0)
    assert "| size (m) | 6 (5 to 7, 2 runs) |" in report([cell], ["n"], {"size": "size (m)"}, "title")
