"""How far every cell of a campaign is, and what the folder holds besides."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from rich.table import Table

from formicarium.campaigns.cells import Job
from formicarium.campaigns.ledger import Ledger
from formicarium.commands.campaign.earlier import earlier
from formicarium.commands.campaign.study import Study, factor_names


class CellStanding(NamedTuple):
    """How far one cell is."""

    job: Job
    done: int
    failed: int
    missing: int
    outdated: int  # rows that other sources made; they do not count


def standing_of(study: Study, ledger: Ledger) -> list[CellStanding]:
    """Count the runs of every cell; the ledger has been refreshed."""
    failures = ledger.failures()
    rows = Counter(identity for identity, _ in ledger.done)
    outdated: Counter[int] = Counter()
    for identity, job in earlier(study.jobs, ledger).items():
        outdated[job.cell.number] += rows[identity]
    found = []
    for job in study.jobs:
        keys = job.keys
        done = sum(ledger.has(key, study.design.keep) for key in keys)
        failed = sum(key in failures and not ledger.has(key, study.design.keep) for key in keys)
        found.append(CellStanding(job, done, failed, len(keys) - done - failed, outdated[job.cell.number]))
    return found


def other_rows(study: Study, ledger: Ledger) -> Mapping[str, int]:
    """Return how many rows of the ledger belong to no cell of the design, by the reason in words."""
    makers = {identity: content.get("sources") for identity, content in ledger.configurations().items()}
    wanted = {job.configuration.identity: set(job.cell.seeds) for job in study.jobs}
    today = {job.configuration.sources for job in study.jobs}
    others = earlier(study.jobs, ledger)
    found: Counter[str] = Counter()
    for identity, seed in ledger.done:
        if identity in wanted:
            found["of seeds that are not in the design"] += seed not in wanted[identity]
        elif identity in others:
            found[f"made by other sources (--sources {makers[identity]})"] += 1
        elif identity in makers and makers[identity] not in today:
            found[f"of other parameters, made by other sources ({makers[identity]})"] += 1
        else:
            found["of cells that are not in the design"] += 1
    return {reason: count for reason, count in sorted(found.items()) if count}


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
