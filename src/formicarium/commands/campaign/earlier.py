"""Rows that other sources made: which cells of a design they would belong to."""

import json
from collections.abc import Sequence
from typing import Any

from formicarium.campaigns.cells import Job
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.seeds import plain


def earlier(jobs: Sequence[Job], ledger: Ledger) -> dict[str, Job]:
    """Return the configurations that other sources made for the same cells, by identity.

    A cell is the same if the design says the same of it. Its parameters may not be: with the sources, parameters
    come and go and defaults change. (Folders of before this was noted go by the parameters.)
    """
    same = {_text(known): job for job in jobs for known in (job.cell.said, job.configuration.parameters)}
    own = {job.configuration.identity for job in jobs}
    return {
        identity: same[text]
        for identity, content in ledger.configurations().items()
        if identity not in own and (text := _text(content.get("said", content.get("parameters")))) in same
    }


def made_by(sources: str, jobs: Sequence[Job], ledger: Ledger) -> list[Job]:
    """Return the jobs with the configurations that these sources made for them."""
    stored, found = ledger.configurations(), {}
    for identity, job in earlier(jobs, ledger).items():
        if stored[identity]["sources"] == sources:
            found[_text(job.cell.said)] = stored[identity]["parameters"]
    made = []
    for job in jobs:
        parameters = found.get(_text(job.cell.said), job.configuration.parameters)
        made.append(job._replace(configuration=job.configuration._replace(sources=sources, parameters=parameters)))
    return made


def _text(known: Any) -> str:
    return json.dumps(plain(known), sort_keys=True)
