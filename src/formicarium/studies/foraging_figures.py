"""Figures 7 to 11 of Pini et al. 2011, and one on giving up, from the runs that are there."""

from collections.abc import Sequence

import numpy as np

from formicarium.statistics.means import mean_of
from formicarium.statistics.pooling import pooled_percentiles
from formicarium.studies import foraging_anova
from formicarium.studies.chart import Chart, Panel, Spread, Stack, Trace
from formicarium.studies.foraging import HOURS, METHODS, SWITCH, TIMES, Row, column, consistent, picked, share_by_hour

SHARES = (5, 25, 50, 75, 95)  # percentiles that a row has of each measured time
OBJECTS = "objects per robot"
INTERFACING = "interfacing time Π (s)"


def _note(rows: Sequence[Row]) -> str:
    kept = consistent(rows)
    out = len(rows) - len(kept)
    return f"{len(kept)} runs; {out} with phantom or lost objects left out; bars: 95 % intervals"


def _trace(label: str, cells: Sequence[tuple[float, Sequence[Row]]], name: str = "objects_per_robot") -> Trace:
    found = [(place, column(rows, name)) for place, rows in cells]
    there = [(place, mean_of(values)) for place, values in found if values]
    return Trace(label, [place for place, _ in there], [mean for _, mean in there])


def figure_7(rows: Sequence[Row]) -> Chart:
    """Objects per robot against the interfacing time, three methods."""
    traces = [
        _trace(name, [(t, consistent(picked(rows, method=name, interfacing_time_s=t))) for t in TIMES])
        for name in METHODS
    ]
    return Chart("figure-7", "Performance", _note(rows), [Panel("", INTERFACING, OBJECTS, traces)])


def figure_8(rows: Sequence[Row]) -> Chart:
    """What robots of the adaptive method do: mean over runs of each run's shares."""
    stacks = []
    for t in TIMES:
        cell = consistent(picked(rows, method="adaptive", interfacing_time_s=t))
        if cell:
            names = ("share_used", "share_gave_up", "share_corridor")
            stacks.append(Stack(f"{t:g}", [100.0 * float(np.mean(column(cell, name))) for name in names]))
    keys = ("cache used", "cache chosen, given up", "corridor chosen")
    return Chart(
        "figure-8", "Actions, adaptive", _note(rows), [Panel("", INTERFACING, "actions (%)", stacks=stacks)], keys
    )


def figure_9(rows: Sequence[Row]) -> Chart:
    """Measured times, not estimates, of all runs of a cell in one heap."""
    panels = []
    for t in (0.0, 25.0, 50.0):
        spreads = []
        for method, names in (("never", "n"), ("always", "hs"), ("adaptive", "nhs")):
            cell = consistent(picked(rows, method=method, interfacing_time_s=t))
            for letter, name in (("n", "whole"), ("h", "harvest"), ("s", "store")):
                if letter in names and cell:
                    timed = [row for row in cell if row[f"{name}_measured"]]
                    if timed:
                        found = [[row[f"{name}_p{share}_s"] for share in SHARES] for row in timed]
                        values = pooled_percentiles(SHARES, found, [row[f"{name}_measured"] for row in timed])
                        words = {"n": "t_NP", "h": "harvest", "s": "store"}[letter]
                        spreads.append(Spread(f"{method}\n{words}", values))
        panels.append(Panel(f"Π = {t:g} s", "", "time (s): 5, 25, 50, 75, 95 %", spreads=spreads))
    return Chart("figure-9", "Measured times", _note(rows), panels)


def figure_10(rows: Sequence[Row]) -> Chart:
    """Shares of cache and corridor by the hour, with a change at half time."""
    panels = []
    for before, after in ((200.0, 0.0), (0.0, 200.0)):
        cell = consistent(picked(rows, interfacing_time_s=before, cache__switched_time=after))
        if not cell:
            continue
        shares = np.array([share_by_hour(row)[:HOURS] for row in cell])
        traces = []
        for number, label in enumerate(("cache used", "corridor, or cache given up")):
            means = [mean_of(100.0 * shares[:, hour, number]) for hour in range(shares.shape[1])]
            traces.append(Trace(label, [hour + 1.0 for hour in range(len(means))], means))
        title = f"Π from {before:g} to {after:g} s"
        limit = (SWITCH / 3600.0, "8 h 20")
        panels.append(Panel(title, "hour, end of the window", "actions (%)", traces, limit=limit))
    return Chart("figure-10", "Adaptivity", _note(rows), panels)


def figure_11(rows: Sequence[Row]) -> Chart:
    """Objects per robot against the size of the swarm."""
    panels = []
    for t in sorted({row["interfacing_time_s"] for row in rows}):
        sizes = sorted({row["robots"] for row in rows})
        traces = [
            _trace(
                name,
                [(n, consistent(picked(rows, method=name, interfacing_time_s=t, robots=n))) for n in sizes],
            )
            for name in METHODS
        ]
        panels.append(Panel(f"Π = {t:g} s", "robots", OBJECTS, traces))
    return Chart("figure-11", "Scalability", _note(rows), panels)


def figure_giving_up(rows: Sequence[Row]) -> Chart:
    """Objects per robot against the period of the draws to give up."""
    periods = sorted({row["strategy.giveup_draw_period"] for row in rows})
    traces = []
    for t in (0.0, 50.0, 200.0):
        cells = [
            (
                float(np.log10(period)),
                consistent(
                    picked(
                        rows,
                        interfacing_time_s=t,
                        cache__switch_time=-1.0,
                        strategy__giveup_draw_period=period,
                    )
                ),
            )
            for period in periods
        ]
        traces.append(_trace(f"Π = {t:g} s", cells))
    across = "log10 of the period between two draws of P_g (s)"
    return Chart("figure-giving-up", "Giving up", _note(rows), [Panel("", across, OBJECTS, traces)])


def figure_anova(rows: Sequence[Row]) -> Chart:
    """Objects per robot against each parameter of Table 1 at every Π: main effects and interactions with Π."""
    kept, panels = consistent(rows), []
    for name, (letter, levels) in foraging_anova.GRID.items():
        if name == foraging_anova.INTERFACING:
            continue
        traces = []
        for t in foraging_anova.TIMES:
            there = [x for x in levels if picked(kept, cache__interfacing_time=t, **{name.replace(".", "__"): x})]
            means = [
                foraging_anova.level_mean(kept, cache__interfacing_time=t, **{name.replace(".", "__"): x})
                for x in there
            ]
            traces.append(Trace(f"Π = {t:g} s", there, means))
        panels.append(Panel("", letter, OBJECTS, traces))
    return Chart("figure-anova", "Parameters of the method (Table 1)", _note(rows), panels)
