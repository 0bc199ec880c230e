"""``formicarium study NAME``: a published study again, from its runs to its figures."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from formicarium.commands.whole import Whole

Switch = Annotated[bool, Parameter(negative="")]
Several = Annotated[tuple[str, ...], Parameter(negative="")]

SEQUENCING = ("2", "3", "4", "5", "6", "7", "S15", "S17", "S18", "S19", "all")
TAKEN_BY = {
    "--setting": "sequencing",
    "--check": "sequencing",
    "--from-tables": "sequencing",
    "--reference": "connectivity",
}


Name = Literal["sequencing", "partitioning", "connectivity", "coverage", "scheduling"]
Figure = Literal[
    "2", "3", "4", "5", "6", "7", "S15", "S17", "S18", "S19", "8", "9", "10", "11", "giving-up", "anova", "options",
    "hierarchy", "table-1", "arms", "safe", "drops", "occlusion", "laboratory", "scale", "tours", "missions",
    "mission-sizes", "planning-range", "fractal", "network", "aboard", "table-2-time", "table-2-travel", "paper-model",
    "hundred-tasks", "all",
]  # fmt: skip


def study(
    name: Name,
    /,
    *,
    figure: Figure = "all",
    out: str = "formicarium-results",
    runs: Whole | None = None,
    setting: Annotated[tuple[Literal["0", "1", "2", "3", "4"], ...], Parameter(negative="")] = (),
    workers: Whole | None = None,
    collect_only: Switch = False,
    check: Whole | None = None,
    sources: Several = (),
    from_tables: str | None = None,
    reference: str | None = None,
) -> int:
    """Run a published study, or go on with it, and draw its figures beside the paper's numbers.

    The runs are campaigns inside the folder; a figure of sequencing runs only the
    cells that it shows, and what is done is loaded. Beside them: the figures, tables
    of cells and report.md (what the paper says, tested); of sequencing also
    report.html, table-s3.csv and tables/ (a row a run). Exit code 0 if every run of
    the figure is there, 1 if not.

    Examples:

        formicarium study sequencing --figure 4 --runs 5
        formicarium study sequencing --out study
        formicarium study sequencing --out study --figure 7 --setting 4 --runs 10
        formicarium study sequencing --out study --collect-only
        formicarium study sequencing --out study --collect-only --check 20
        formicarium study partitioning --figure 7 --runs 3
        formicarium study connectivity --runs 5
        formicarium study coverage --figure table-1 --runs 5
        formicarium study scheduling --figure table-2-time

    Parameters
    ----------
    name
        The study: sequencing (Garattoni & Birattari 2018), partitioning (Pini et al. 2011), or of
        Panerati et al. 2018 connectivity (the estimators), coverage (the controller) or
        scheduling (720 instances; needs the extra "scheduling").
    figure
        The paper's number of the figure: 2 to 7 (5 is 5A and 5B, 7 is 7A and 7B), S15, S17, S18,
        S19 of sequencing; 3 to 11, giving-up, anova (Table 1), options and hierarchy (beyond
        the paper, not in all) of partitioning; 2 of connectivity, and aboard (not in all: on the messages of an
        eruption); 4, 5, table-1, arms, safe, drops, occlusion, laboratory, scale, tours,
        planning-range, and missions, mission-sizes, fractal and network (not in all) of coverage; table-2-time,
        table-2-travel (with figures 7 and 8), paper-model (in HiGHS, one instance in ten),
        hundred-tasks and scale (up to 1,000) of scheduling.
    out
        Folder of the campaigns, figures, tables and report.
    runs
        Runs of each cell, instead of the design's.
    setting
        Of sequencing: run the cells of this setting alone (several times: of these);
        figures and report still show all that is there.
    workers
        Processes that share the runs; one a core if not given.
    collect_only
        Run nothing that is missing: draw from what is there, also while it is being run.
    check
        Of sequencing: run one in so many of the runs that are there again, with its log,
        with doubled noise, and to the cap where it was ended early; the report says what
        came of it.
    sources
        Take the rows that these sources made (hashes, as in the rows; of several, for
        each campaign the one with most rows); runs nothing.
    from_tables
        Draw from tables/ as an earlier study wrote them, for example from
        docs/results/tables, instead of from campaigns; runs nothing.
    reference
        Of connectivity: folder of the published A10s.mat and errorvssteps-*.dat; the study
        then runs on the first ten of these graphs and draws the paper's curves as points.
    """
    from formicarium.commands.errors import UserError

    given = {"--setting": setting, "--check": check is not None, "--from-tables": from_tables, "--reference": reference}
    for option, owner in TAKEN_BY.items():
        if given[option] and name != owner:
            raise UserError(f"{option}: of the study {owner} alone; leave it out, or name that study")
    if check is not None and check < 1:
        raise UserError(f"--check {check}: must be at least 1")
    if check is not None and (sources or from_tables):
        raise UserError("--check: runs rows again with today's sources; leave out --sources and --from-tables")
    if name == "partitioning":
        return _partitioning(figure, Path(out), runs, workers, collect_only, sources)
    if name == "connectivity":
        return _connectivity(figure, Path(out), runs, workers, collect_only, sources, reference)
    if name == "coverage":
        return _coverage(figure, Path(out), runs, workers, collect_only, sources)
    if name == "scheduling":
        return _scheduling(figure, Path(out), runs, workers, collect_only, sources)
    from formicarium.commands.published.answers import check_study, draw_study, run_study
    from formicarium.commands.published.store import NEEDS, Asked

    if figure not in SEQUENCING:
        raise UserError(f"--figure {figure}: the study sequencing has {', '.join(SEQUENCING)}")
    if check is not None and figure not in NEEDS:
        raise UserError(f"--check: figure {figure} is drawn without runs; {', '.join(NEEDS)} have some")
    tables = Path(from_tables) if from_tables is not None else None
    asked = Asked(figure, Path(out), runs, workers, sources, tuple(map(int, setting)), tables)
    runs_nothing = collect_only or sources or tables is not None
    code = 0 if runs_nothing else run_study(asked)
    if check is not None:
        code = max(code, check_study(asked, check))
    return max(code, draw_study(asked))


def _partitioning(
    figure: str, out: Path, runs: int | None, workers: int | None, collect_only: bool, sources: tuple[str, ...]
) -> int:
    from formicarium.commands import foraging
    from formicarium.commands.errors import UserError

    if figure not in foraging.DESIGNS:
        raise UserError(f"--figure {figure}: the study partitioning has {', '.join(foraging.DESIGNS)}")
    if len(sources) > 1:
        raise UserError("--sources: the study partitioning takes one")
    code = 0 if collect_only or sources else foraging.run_study(figure, out, runs, workers)
    return max(code, foraging.draw_study(figure, out, runs, sources[0] if sources else None))


def _connectivity(
    figure: str,
    out: Path,
    runs: int | None,
    workers: int | None,
    collect_only: bool,
    sources: tuple[str, ...],
    reference: str | None,
) -> int:
    from formicarium.commands import aboard, connectivity_study
    from formicarium.commands.errors import UserError

    runs_nothing = collect_only or sources
    if figure == "aboard":
        code = 0 if runs_nothing else aboard.run_study(out, runs, workers)
        return max(code, aboard.draw_study(out, runs, sources[0] if sources else None))
    if figure not in connectivity_study.FIGURES:
        raise UserError(
            f"--figure {figure}: the study connectivity has {', '.join(connectivity_study.FIGURES)}, aboard"
        )
    if len(sources) > 1:
        raise UserError("--sources: the study connectivity takes one")
    code = 0 if runs_nothing else connectivity_study.run_study(out, runs, workers, reference)
    return max(code, connectivity_study.draw_study(out, runs, reference, sources[0] if sources else None))


def _coverage(
    figure: str, out: Path, runs: int | None, workers: int | None, collect_only: bool, sources: tuple[str, ...]
) -> int:
    from formicarium.commands import formations, missions, prominences
    from formicarium.commands.errors import UserError

    known = (*prominences.DESIGNS, *missions.DESIGNS, *formations.DESIGNS)
    if figure not in known:
        raise UserError(f"--figure {figure}: the study coverage has {', '.join(known)}")
    if len(sources) > 1:
        raise UserError("--sources: the study coverage takes one")
    rows_of = sources[0] if sources else None
    study = next(known for known in (prominences, missions, formations) if figure in known.DESIGNS)
    code = 0 if collect_only or sources else study.run_study(figure, out, runs, workers)
    return max(code, study.draw_study(figure, out, runs, rows_of))


def _scheduling(
    figure: str, out: Path, runs: int | None, workers: int | None, collect_only: bool, sources: tuple[str, ...]
) -> int:
    from formicarium.commands.errors import UserError
    from formicarium.commands.extras import require

    require("scheduling", "formicarium study scheduling")
    from formicarium.commands import table_ii

    if figure not in table_ii.TABLES:
        raise UserError(f"--figure {figure}: the study scheduling has {', '.join(table_ii.TABLES)}")
    if len(sources) > 1:
        raise UserError("--sources: the study scheduling takes one")
    code = 0 if collect_only or sources else table_ii.run_study(figure, out, runs, workers)
    return max(code, table_ii.draw_study(figure, out, runs, sources[0] if sources else None))
