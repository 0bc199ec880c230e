"""Figures and statements of the coverage study, from the runs that are there."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from formicarium.statistics.intervals import wilson
from formicarium.statistics.means import mean_of
from formicarium.studies.chart import Chart, Panel, Trace
from formicarium.studies.prominences import (
    Row,
    finite,
    median,
    never_parted,
    picked,
    reached,
    table_1,
    table_1_rows,
)

LENGTH = "greatest connected length (m)"
KEPT = 0.75  # share of the faithful length that the safe variant must have
WHOLE = 0.99  # share of trials in which it must never part


class Statement(NamedTuple):
    """What the paper says or what was asked for, with what our runs say."""

    statement: str
    finding: str
    verdict: str


def trace(label: str, cells: Sequence[tuple[float, Sequence[Row]]], name: str) -> Trace:
    """Return means of a column over a number, with their intervals."""
    there = [(place, [float(row[name]) for row in rows if row[name] is not None]) for place, rows in cells]
    there = [(place, values) for place, values in there if values]
    return Trace(label, [place for place, _ in there], [mean_of(values) for _, values in there])


def note(rows: Sequence[Row]) -> str:
    """Say on how many runs a figure stands."""
    return f"{len(rows)} runs; bars: 95 % intervals of means"


def levels(rows: Sequence[Row], name: str) -> list:
    """Return the levels of a factor, in order."""
    return sorted({row[name] for row in rows})


def figure_table_1(rows: Sequence[Row]) -> Chart:
    """Greatest length against the number of backbone robots, a trace a delta, beside the paper's brackets."""
    panels = []
    for spacing in levels(rows, "spacing_m"):
        own = [(n - 1.0, picked(rows, spacing_m=spacing, robots=n)) for n in levels(rows, "robots")]
        traces = [trace("ours", own, "length_m"), trace("ours, at the end", own, "length_end_m")]
        paper = {c.backbone: c.length for c in table_1() if c.spacing == spacing and c.length is not None}
        if paper:
            traces.append(Trace("the paper's bracket", list(paper), [mean_of([length]) for length in paper.values()]))
        panels.append(Panel(f"δ = {spacing:g} m", "backbone robots", LENGTH, traces))
    return Chart("figure-table-1", "Table I: how far one arm gets in 900 s", note(rows), panels)


def figure_arms(rows: Sequence[Row]) -> Chart:
    """Greatest length against the number of arms."""
    traces = [
        trace(f"δ = {s:g} m", [(t, picked(rows, spacing_m=s, tasks=t)) for t in levels(rows, "tasks")], "length_m")
        for s in levels(rows, "spacing_m")
    ]
    return Chart(
        "figure-arms", "25 backbone robots in 1, 3 and 5 arms", note(rows), [Panel("", "arms", LENGTH, traces)]
    )


def figure_safe(rows: Sequence[Row]) -> Chart:
    """Greatest length of the safe and the faithful variant, with noise."""
    panels = []
    for spacing in levels(rows, "spacing_m"):
        traces = [
            trace(
                variant,
                [(n - 1.0, picked(rows, spacing_m=spacing, robots=n, variant=variant)) for n in levels(rows, "robots")],
                "length_m",
            )
            for variant in levels(rows, "variant")
        ]
        panels.append(Panel(f"δ = {spacing:g} m", "backbone robots", LENGTH, traces))
    return Chart("figure-safe", "Safe and faithful, 10 % lost, 2°, 2 cm", note(rows), panels)


def figure_drops(rows: Sequence[Row]) -> Chart:
    """Length and share of time parted against the share of messages lost."""
    panels = []
    for name, up in (("length_m", LENGTH), ("lost_share_range", "share of time parted")):
        traces = [
            trace(
                variant,
                [
                    (100.0 * loss, picked(rows, variant=variant, footbot__radio_loss=loss))
                    for loss in levels(rows, "footbot.radio_loss")
                ],
                name,
            )
            for variant in levels(rows, "variant")
        ]
        panels.append(Panel("", "messages lost (%)", up, traces))
    return Chart("figure-drops", "Lost messages: 20 backbone robots, δ = 2.4 m", note(rows), panels)


def figure_occlusion(rows: Sequence[Row]) -> Chart:
    """Length with and without bodies in the line of sight."""
    panels = []
    for spacing in levels(rows, "spacing_m"):
        traces = []
        for radius in levels(rows, "footbot.radius"):
            for blocked in (True, False):
                cells = [
                    (
                        n - 1.0,
                        picked(rows, spacing_m=spacing, robots=n, footbot__radius=radius, footbot__occlusion=blocked),
                    )
                    for n in levels(rows, "robots")
                ]
                word = "hide" if blocked else "do not hide"
                traces.append(trace(f"{200 * radius:g} cm, bodies {word}", cells, "length_m"))
        panels.append(Panel(f"δ = {spacing:g} m", "backbone robots", LENGTH, traces))
    return Chart("figure-occlusion", "Bodies in the line of sight", note(rows), panels)


def figure_scale(rows: Sequence[Row]) -> Chart:
    """Length and cut robots against the size of the swarm."""
    panels = []
    for name, up in (("length_m", LENGTH), ("bytes_mean", "bytes a message")):
        traces = [
            trace(v, [(n, picked(rows, robots=n, variant=v)) for n in levels(rows, "robots")], name)
            for v in levels(rows, "variant")
        ]
        panels.append(Panel("", "robots, in three arms", up, traces))
    return Chart("figure-scale", "From 5 to 100 robots, 300 s", note(rows), panels)


def statements_table_1(rows: Sequence[Row]) -> list[Statement]:
    """Hold Table I's pattern against our runs (ST-62)."""
    cells = [cell for cell in table_1_rows(rows) if cell["runs"]]
    if not cells:
        return []
    same = [cell for cell in cells if cell["verdict"] == "as in the paper"]
    here = [cell for cell in cells if cell["verdict"] == "reached here alone"]
    there = [cell for cell in cells if cell["verdict"] == "reached in the paper alone"]
    off = [cell for cell in cells if "sooner" in cell["verdict"]]
    lengths = {
        (s, n): median(picked(rows, spacing_m=s, robots=n), "length_m")
        for s in levels(rows, "spacing_m")
        for n in levels(rows, "robots")
    }
    by_robots = all(
        lengths[s, a] <= lengths[s, b]
        for s in levels(rows, "spacing_m")
        for a, b in zip(levels(rows, "robots"), levels(rows, "robots")[1:])
    )
    by_spacing = all(
        lengths[a, n] <= lengths[b, n]
        for n in levels(rows, "robots")
        for a, b in zip(levels(rows, "spacing_m"), levels(rows, "spacing_m")[1:])
    )
    return [
        Statement(
            "Table I: cells reached and not reached, latencies within a factor of three",
            f"{len(same)} of {len(cells)} cells as in the paper; reached here alone: {named(here)}; reached in the "
            f"paper alone: {named(there)}; more than three times off: {named(off)}",
            "holds" if len(same) == len(cells) else "holds in part",
        ),
        Statement(
            "the greatest length grows with the number of robots",
            "; ".join(
                f"δ {s:g}: " + ", ".join(f"{lengths[s, n]:.1f}" for n in levels(rows, "robots"))
                for s in levels(rows, "spacing_m")
            ),
            "holds" if by_robots else "fails",
        ),
        Statement("and with delta", "the same lengths", "holds" if by_spacing else "fails"),
    ]


def named(cells: Sequence[dict]) -> str:
    """Write cells as "delta/robots/target"."""
    return ", ".join(f"{c['spacing_m']:g}/{c['backbone']}/{c['target'].replace('r', '√')}" for c in cells) or "none"


def statements_safe(rows: Sequence[Row]) -> list[Statement]:
    """Hold the safe variant against what is asked of it (ST-46)."""
    safe, faithful = picked(rows, variant="safe"), picked(rows, variant="faithful")
    if not safe or not faithful:
        return []
    share = wilson(never_parted(safe), len(safe))
    ratios = {}
    for spacing in levels(rows, "spacing_m"):
        for robots in levels(rows, "robots"):
            own, other = (picked(part, spacing_m=spacing, robots=robots) for part in (safe, faithful))
            if own and other:
                ratios[spacing, robots - 1] = median(own, "length_m") / median(other, "length_m")
    worst = min(ratios, key=lambda cell: ratios[cell])
    parted = [row for row in faithful if row["losses_range"]]
    most = max((row["longest_loss_range_s"] for row in parted), default=0.0)
    share_most = 100.0 * max(row["lost_share_range"] for row in faithful)
    return [
        Statement(
            "safe: the range graph is whole at every step in at least 99 % of the trials",
            f"{share.successes} of {share.runs} ({100 * share.low:.1f} to {100 * share.high:.1f} %)",
            "holds" if share.value >= WHOLE else "fails",
        ),
        Statement(
            "safe: its median length is at least 75 % of the faithful variant's in each cell",
            f"{100 * min(ratios.values()):.0f} to {100 * max(ratios.values()):.0f} %, least at δ {worst[0]:g} m with "
            f"{worst[1]} backbone robots",
            "holds" if min(ratios.values()) >= KEPT else "fails",
        ),
        Statement(
            "the paper: the swarm never loses connectivity (faithful variant, the same noise)",
            f"parted in {len(parted)} of {len(faithful)} runs, for {share_most:.1f} % of the time at most, {most:.1f} "
            "s at a time at most",
            "holds" if not parted else "fails",
        ),
    ]


def statements_drops(rows: Sequence[Row]) -> list[Statement]:
    """A few lost messages do not matter (ST-66)."""
    found = []
    for variant in levels(rows, "variant"):
        own = picked(rows, variant=variant)
        base = median(picked(own, footbot__radio_loss=0.0), "length_m")
        texts = []
        for loss in levels(own, "footbot.radio_loss"):
            cell = picked(own, footbot__radio_loss=loss)
            parted = len(cell) - never_parted(cell)
            texts.append(f"{100 * loss:.0f} %: {median(cell, 'length_m'):.1f} m, parted in {parted}")
        ten = picked(own, footbot__radio_loss=0.1)
        holds = bool(ten) and median(ten, "length_m") >= 0.9 * base
        found.append(
            Statement(f"a few lost messages do not matter, {variant}", "; ".join(texts), "holds" if holds else "fails")
        )
    return found


def statements_density(rows: Sequence[Row]) -> list[Statement]:
    """Long arms keep more than 0.66 robots a metre; is that redundancy? (ST-66)."""
    long = [row for row in rows if row["length_m"] > 20.0]
    if not long:
        return []
    density = median(long, "density_m")
    firm = [row["long_arm_firm_share"] for row in long if row["long_arm_firm_share"] is not None]
    return [
        Statement(
            "arms of more than 20 m keep more than 0.66 robots a metre",
            f"{len(long)} runs with such an arm: median {density:.2f} robots a metre when longest",
            "holds" if density > 0.66 else "fails",
        ),
        Statement(
            "and have redundant links: no robot's loss parts the swarm",
            f"true for {100 * float(np.mean(firm)) if firm else math.nan:.1f} % of the time with such an arm",
            "holds" if firm and np.mean(firm) > 0.99 else "fails",
        ),
    ]


def summary(rows: Sequence[Row], target: str) -> str:
    """Write success and median latency of a cell."""
    late = finite(median(rows, f"latency_{target}_s"))
    return f"{reached(rows, target)}/{len(rows)}" + (f", {late:.0f} s" if late is not None else "")
