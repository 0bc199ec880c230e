"""Do runs that have ended agree with what a ledger holds of them already?"""

from collections.abc import Sequence
from typing import Any

import pyarrow as pa

from formicarium.campaigns import table
from formicarium.campaigns.cells import Key
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.parts import OWN
from formicarium.campaigns.result import Ending, Finished


def agreeing(ledger: Ledger, finished: Sequence[Finished]) -> list[Finished]:
    """Return the runs; those that contradict their stored row, or use a reserved name, have become failures."""
    known = {(run.identity, run.seed) for run in finished} & ledger.done
    stored = _by_key(ledger.rows(), known) if known else {}
    kept = []
    for run in finished:
        reason = ""
        if run.result is not None:
            before = stored.get((run.identity, run.seed))
            reserved = sorted(OWN.keys() & run.result.row.keys())
            if reserved:
                reason = f"its row has a column {reserved[0]!r}, a name that the ledger needs for itself"
            elif before is not None and not table.same(run.result.row, before):
                reason = "it was run again and gave another row than the one stored: it does not repeat"
        kept.append(run._replace(result=None, failure=reason, ending=Ending.FAILED) if reason else run)
    return kept


def _by_key(rows: pa.Table, keys: set[Key]) -> dict[Key, dict[str, Any]]:
    found = {}
    for index, key in enumerate(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist())):
        if key in keys:
            (row,) = rows.slice(index, 1).to_pylist()
            found[key] = {name: value for name, value in row.items() if name not in OWN}
    return found
