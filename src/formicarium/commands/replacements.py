"""Runs that are left out are replaced by runs with the next seeds (TP-46): the further seeds of a study's cells."""

from collections import Counter

from formicarium.campaigns.cells import Job
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.study import Study

MOST = 0.5  # further runs of a cell, as a share of those asked for: of thirty robots hardly a run is without a phantom


def with_replacements(study: Study) -> Study:
    """Return the study with a further seed in a cell for every run of it that is known to be left out.

    A further run may itself be left out: ask again when it is there. What is left out stays among the rows.

    Args:
        study: whose runs are ``consistent`` (1) or left out (0), and whose seeds are counted on from a first one.

    Raises:
        StoreError: if the folder cannot be read.
    """
    rows, grown = Ledger(study.folder).rows(), study
    while True:
        left_out = Counter(row["cell"] for row in tidy(rows, grown.jobs).to_pylist() if row["consistent"] == 0)
        jobs = [_grown(job, left_out[job.cell.number]) for job in study.jobs]
        if jobs == grown.jobs:
            return grown
        grown = study._replace(jobs=jobs)


def _grown(job: Job, left_out: int) -> Job:
    seeds = job.cell.seeds
    further = range(seeds[-1] + 1, seeds[-1] + 1 + min(left_out, int(MOST * len(seeds))))
    return job._replace(cell=job.cell._replace(seeds=(*seeds, *further)))
