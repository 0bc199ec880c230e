"""How far every cell of a campaign is, and what the folder holds besides."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from rich.table import Table

from formicarium.campaigns.cells import Job
from formicarium.campaigns.ledger import Ledger
from formicarium.commands.campaign.study import Study, factor_names


class CellStanding(NamedTuple):
    """How far one cell is."""

    job: Job
    done: int
    failed: int
    missing: int
    outdated: int  # rows of the same parameters that other sources made; they do not count


def standing_of(study: Study, ledger: Ledger) -> list[CellStanding]:
    """Count the runs of every cell; the ledger has been refreshed."""
    failures = ledger.failures()
    configurations = ledger.configurations()
    rows = Counter(identity for identity, _ in ledger.done)
    outdated: Counter[str] = Counter()
    for identity, content in configurations.items():
        outdated[_parameters(content)] += rows[identity]
    found = []
    for job in study.jobs:
        keys = job.keys
        done = sum(ledger.has(key, study.design.keep) for key in keys)
        failed = sum(key in failures and not ledger.has(key, study.design.keep) for key in keys)
        known = job.configuration.identity in configurations
        own = rows[job.configuration.identity] if known else 0
        other = outdated[_parameters(job.configuration.content())] - own
        found.append(CellStanding(job, done, failed, len(keys) - done - failed, other))
    return found


def other_rows(study: Study, ledger: Ledger) -> Mapping[str, int]:
    """Return how many rows of the ledger belong to no cell of the design, by the reason in words."""
    configurations = ledger.configurations()
    wanted = {job.configuration.identity: set(job.cell.seeds) for job in study.jobs}
    parameters = {_parameters(job.configuration.content()) for job in study.jobs}
    found: Counter[str] = Counter()
    for identity, seed in ledger.done:
        if identity in wanted:
            found["of seeds that are not in the design"] += seed not in wanted[identity]
        elif identity in configurations and _parameters(configurations[identity]) in parameters:
            found[f"made by other sources (--sources {configurations[identity]['sources']})"] += 1
        else:
            found["of cells that are not in the design"] += 1
    return {reason: count for reason, count in sorted(found.items()) if count}


def _parameters(content: Mapping[str, Any]) -> str:
    return json.dumps([content.get("system"), content.get("parameters")], sort_keys=True)


def cells_table(study: Study, cells: Sequence[CellStanding], seeds: bool = False) -> Table:
    """Lay the cells out as a table for the terminal."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    factors = factor_names(study.jobs)
    outdated = any(cell.outdated for cell in cells)
    titles = ["cell", *factors, *(["seeds"] if seeds else []), "done", "failed", "missing"]
    for title in titles + (["outdated"] if outdated else []):
        table.add_column(title, justify="left" if title in factors else "right")
    for cell in cells:
        values = [str(cell.job.cell.factors.get(name, "")) for name in factors]
        shown = [_span(cell.job.cell.seeds)] if seeds else []
        counts = [cell.done, cell.failed, cell.missing] + ([cell.outdated] if outdated else [])
        table.add_row(str(cell.job.cell.number), *values, *shown, *map(str, counts))
    return table


def _span(seeds: Sequence[int]) -> str:
    if len(seeds) > 2 and list(seeds) == list(range(seeds[0], seeds[0] + len(seeds))):
        return f"{seeds[0]} to {seeds[-1]}"
    return str(seeds[0]) + (", ..." if len(seeds) > 1 else "")
