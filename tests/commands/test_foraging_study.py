"""``formicarium study partitioning``: from its designs to its figures, made short."""

import tomllib
from importlib import resources

import pytest

from formicarium.commands import foraging, replacements
from formicarium.commands.main import exit_code
from formicarium.studies.foraging import TIMES
from formicarium.studies.foraging_anova import GRID
from formicarium.systems.partitioning.parameters import INTERFACING_TIMES


@pytest.fixture(autouse=True)
def short(monkeypatch, tmp_path):
    """Twenty simulated seconds a run."""
    monkeypatch.chdir(tmp_path)
    original = foraging.Overrides
    monkeypatch.setattr(
        foraging, "Overrides", lambda runs, sources=None: original(runs, ("swarm.time_cap=20",), sources)
    )


def design(name):
    published = resources.files("formicarium.systems.partitioning.published")
    return tomllib.loads(published.joinpath(f"{name}.toml").read_text())


def test_the_designs_are_the_papers():
    factors = design("partitioning-performance")["factors"]
    assert tuple(factors["cache.interfacing_time"]) == INTERFACING_TIMES == TIMES
    assert design("partitioning-scalability")["factors"]["swarm.robots"] == [4, 6, 8, 10, 14, 18, 22, 26, 30]
    anova = design("partitioning-anova")
    assert {name: tuple(levels) for name, levels in anova["factors"].items()} == {
        name: levels for name, (_, levels) in GRID.items()
    }
    assert anova["replicates"] == 15 and "rows" not in anova and "set" not in anova


def test_a_figure_is_run_and_drawn(tmp_path, capsys):
    arguments = ["study", "partitioning", "--figure", "10", "--out", "here"]
    assert exit_code([*arguments, "--collect-only"]) == 2
    assert exit_code([*arguments, "--runs", "1", "--workers", "1"]) == 0
    assert "drawn from 4 of 4 runs" in capsys.readouterr().out
    assert (tmp_path / "here" / "figure-10.png").exists()
    assert len((tmp_path / "here" / "partitioning-adaptivity.csv").read_text().splitlines()) == 5


def test_what_is_left_out_is_replaced_by_the_next_seeds(tmp_path, monkeypatch, capsys):
    """A seed of the first cell and the first that replaces it; the second cell loses more than can be replaced."""
    told = foraging.perform
    bad = {(0, 121001), (0, 121005), *((1, seed) for seed in range(121001, 121100))}

    class Rows:
        def __init__(self, jobs):
            self.jobs = jobs

        def to_pylist(self):
            return [
                {"cell": job.cell.number, "seed": seed, "consistent": int((job.cell.number, seed) not in bad)}
                for job in self.jobs
                for seed in job.cell.seeds
            ]

    monkeypatch.setattr(replacements, "tidy", lambda rows, jobs: Rows(jobs))
    monkeypatch.setattr(foraging, "perform", lambda study, request: performed.append(study) or told(study, request))
    performed = []
    assert exit_code(["study", "partitioning", "--figure", "10", "--runs", "4", "--out", "here", "--workers", "1"]) == 0
    asked = [[len(job.cell.seeds) for job in study.jobs] for study in performed]
    assert asked == [[4, 4, 4, 4], [6, 6, 4, 4]]
    assert performed[1].jobs[0].cell.seeds == tuple(range(121001, 121007))
    assert "drawn from 20 of 20 runs" in capsys.readouterr().out


def test_a_figure_of_the_other_study_is_refused(capsys):
    assert exit_code(["study", "partitioning", "--figure", "S18"]) == 2
    assert "the study partitioning has 3, 4" in capsys.readouterr().err


def test_figures_of_the_implementation_need_no_run(tmp_path, capsys):
    for figure in ("3", "4", "5", "6"):
        assert exit_code(["study", "partitioning", "--figure", figure, "--out", "here"]) == 0
        assert f"figure-{figure}.png" in capsys.readouterr().out
    assert sorted(path.name for path in (tmp_path / "here").iterdir()) == [f"figure-{k}.png" for k in (3, 4, 5, 6)]
