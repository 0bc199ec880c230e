"""A set: one function, many seeds, one folder. Runs that are there are loaded, the others are produced."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from formicarium.campaigns.interruption import held_back
from formicarium.campaigns.result import Function, Watch
from formicarium.campaigns.store import Store
from formicarium.campaigns.workers import finished_runs

# Tables that the run of a seed must leave, each with metadata that it must carry.
Wanted = Callable[[int], Mapping[str, Mapping[str, str]]]


class SetReport(NamedTuple):
    """What was done for a set."""

    loaded: tuple[int, ...]  # seeds that were there already
    produced: tuple[int, ...]  # seeds that were run now, sorted
    failures: Mapping[int, str]  # seed -> traceback


def run_set(
    function: Function,
    seeds: Sequence[int],
    store: Store,
    *,
    workers: int | None = None,
    wanted: Wanted = lambda seed: {},
    progress: Callable[[int, int], None] | None = None,
    watch: Watch | None = None,
) -> SetReport:
    """Run ``function`` for every seed that the store lacks; results do not depend on ``workers``.

    Args:
        function: what to repeat.
        seeds: of the set.
        store: where results go, each as soon as its run has ended.
        workers: processes to share the runs; as many as there are cores if None. A single run, or a single
            worker, stays in this process.
        wanted: tables a run must have left to count as done.
        progress: told after every run how many of the set have ended, and of how many.
        watch: told the progress inside a run, if runs stay in this process.

    Raises:
        KeyboardInterrupt: on Ctrl-C; every run that had ended is kept.
        StoreError: if a file is damaged or cannot be written; every run kept before stays.
    """
    told = progress or (lambda done, total: None)
    missing = [seed for seed in seeds if not store.has(seed, wanted(seed))]
    loaded = tuple(seed for seed in seeds if seed not in set(missing))
    failures: dict[int, str] = {}
    produced: list[int] = []
    told(len(loaded), len(seeds))
    for finished in finished_runs(function, missing, workers or os.cpu_count() or 1, watch):
        with held_back():
            kept = store.add(finished)
        if kept.failure:
            failures[kept.seed] = kept.failure
        else:
            produced.append(kept.seed)
        told(len(loaded) + len(produced) + len(failures), len(seeds))
    return SetReport(loaded, tuple(sorted(produced)), dict(sorted(failures.items())))
