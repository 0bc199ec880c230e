"""Fig. 2 of Panerati et al. 2018 and its table, from the runs that are there."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from formicarium.connectivity.parameters import DROPS, METHODS
from formicarium.connectivity.scores import ONE_PERCENT, TEN_PERCENT, Reached, reached
from formicarium.studies.curves import CurvePanel, CurveSheet, Line, Marks
from formicarium.studies.estimators import from_text

LOSSES = (0.0, 0.01, 0.05, 0.1)  # of Fig. 2
PANELS = (("author", "directed"), ("author", "symmetric"), ("honest", "directed"), ("honest", "symmetric"))
BEST = (("PI1", "honest, maximum"), ("Wave", "honest, long window"))
LIMITS = ((TEN_PERCENT, "10 %"), (ONE_PERCENT, "1 %"))
SHOWN_TO = {"PI1": 2001, "PI2": 8001, "Wave": 2001}  # iterations, as in the paper
SPAN = (1e-3, 10.0)

Row = Mapping[str, Any]
Published = Mapping[tuple[str, float], tuple[np.ndarray, np.ndarray]]  # (method, drop) -> iterations, errors


def chosen(rows: Sequence[Row], method: str, variant: str, drops: str, drop: float) -> list[Row]:
    """Return the runs of one cell."""
    wanted = {"method": method, "variant": variant, "links.drops": drops, "links.drop": drop}
    return [row for row in rows if all(row[name] == value for name, value in wanted.items())]


def curve(cell: Sequence[Row], every: int, column: str = "errors") -> tuple[np.ndarray, np.ndarray]:
    """Return iterations and the runs' errors, (S,) and (runs, S)."""
    errors = np.array([from_text(row[column]) for row in cell])
    return 1 + every * np.arange(errors.shape[1]), errors


def figure_2(rows: Sequence[Row], every: int, published: Published) -> CurveSheet:
    """Errors of three estimators: as published and honest, with losses each way by itself and both ways together."""
    titles = {"author": "as published", "honest": "honest"}
    panels = []
    for variant, drops in PANELS:
        row_of_panels = []
        for method in METHODS:
            column = "paper_errors" if variant == "author" else "errors"
            up = "relative error" + (f" of {'omega2' if column == 'paper_errors' else 'mu2'}" * (method == "Wave"))
            lines = _lines(rows, method, variant, drops, every, column)
            marks = [
                Marks("", *published[method, drop], shade)
                for shade, drop in enumerate(LOSSES)
                if (variant, drops) == ("author", "directed") and (method, drop) in published
            ]
            title = f"{method}, {titles[variant]}, losses {drops}"
            row_of_panels.append(CurvePanel(title, "iterations", up, lines, marks, LIMITS, SPAN))
        panels.append(row_of_panels)
    points = "; circles: the paper's own" if published else ""
    return CurveSheet("Fig. 2: estimates of connectivity", f"{_note(rows)}{points}", panels)


def figure_best(rows: Sequence[Row], every: int) -> CurveSheet:
    """The honest estimators at their best, with every model of a loss."""
    panels = [
        [
            CurvePanel(
                f"{method}, {variant}, losses {drops}", "iterations", "relative error",
                _lines(rows, method, variant, drops, every, "errors"), (), LIMITS, SPAN,
            )
            for drops in DROPS
        ]
        for method, variant in BEST
    ]  # fmt: skip
    return CurveSheet("Honest estimators at their best", _note(rows), panels)


def _lines(rows: Sequence[Row], method: str, variant: str, drops: str, every: int, column: str) -> list[Line]:
    lines = []
    for shade, drop in enumerate(LOSSES):
        cell = chosen(rows, method, variant, drops, drop)
        if cell:
            steps, errors = curve(cell, every, column)
            kept = steps <= SHOWN_TO[method]
            band = None
            if len(cell) > 1:
                low, high = np.percentile(errors, (2.5, 97.5), axis=0)
                band = (low[kept], high[kept])
            lines.append(Line(f"p = {drop:g}", steps[kept], errors.mean(axis=0)[kept], shade, band))
    return lines


def _note(rows: Sequence[Row]) -> str:
    count = max((len(chosen(rows, m, "honest", "directed", 0.05)) for m in METHODS), default=0)
    graphs = f"{rows[0]['graphs']} graphs of {rows[0]['nodes']} nodes" if rows else "no runs"
    return f"mean over {graphs} of the median node, {count} runs; bands: 95 % of the runs"


def table_of_cells(rows: Sequence[Row], every: int) -> list[dict[str, Any]]:
    """Return a row a cell: when the mean error came down to 10 % and 1 %, and where it ended."""
    keys = list(dict.fromkeys((r["method"], r["variant"], r["links.drops"], r["links.drop"]) for r in rows))
    table = []
    for key in keys:
        cell = chosen(rows, *key)
        steps, errors = curve(cell, every)
        mean = errors.mean(axis=0)
        ten, one = (reached(steps, mean, limit) for limit in (TEN_PERCENT, ONE_PERCENT))
        table.append(
            dict(zip(("method", "variant", "drops", "drop"), key, strict=True))
            | {
                "global_memory": cell[0]["uses_global_memory"],
                "runs": len(cell),
                "iterations": int(steps[-1]),
                "ten_percent_first": ten.first,
                "ten_percent_stays": ten.stays,
                "one_percent_first": one.first,
                "one_percent_stays": one.stays,
                "least_error": float(mean.min()),
                "error_last_third": float(mean[-max(1, len(mean) // 3) :].mean()),
            }
        )
    return table


def report(cells: Sequence[Mapping[str, Any]]) -> str:
    """Return the table in Markdown: iterations to 10 % and to 1 %, by estimator, model of a loss, probability."""
    lines = ["# Estimators of connectivity: iterations to 10 % / to 1 % of the exact value, from there to the end", ""]
    lines += [
        "In brackets: when it first was, though it did not stay. -: never. After the semicolon: the mean error over "
        "the last third of the run. *: nodes read global memory.",
        "",
        "| estimator | losses | " + " | ".join(f"p = {drop:g}" for drop in LOSSES) + " |",
        "|---|---|" + "---|" * len(LOSSES),
    ]
    for method, variant, drops in dict.fromkeys((c["method"], c["variant"], c["drops"]) for c in cells):
        words, star = [], ""
        for drop in LOSSES:
            found = [
                c for c in cells if (c["method"], c["variant"], c["drops"], c["drop"]) == (method, variant, drops, drop)
            ]
            if not found:
                words.append("")
                continue
            (cell,) = found
            star = "*" if cell["global_memory"] else ""
            ten, one = (Reached(cell[f"{n}_percent_first"], cell[f"{n}_percent_stays"]) for n in ("ten", "one"))
            words.append(f"{_short(ten)} / {_short(one)}; {100 * cell['error_last_third']:.2g} %")
        lines.append(f"| {method}, {variant}{star} | {drops} | " + " | ".join(words) + " |")
    return "\n".join(lines) + "\n"


def _short(when: Reached) -> str:
    if when.stays is not None:
        return str(when.stays)
    return "-" if when.first is None else f"({when.first})"
