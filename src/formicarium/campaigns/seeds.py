"""Seeds: as listed, counted on from a first one, or derived from study, cell and replicate."""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from formicarium.campaigns.design import Design

BITS = 53  # whole numbers of this size survive every reader of tables, also those that know only fractions


def seeds_of(design: Design, factors: Mapping[str, Any], first_seed: int | None) -> tuple[int, ...]:
    """Return the seeds of a cell, one a replicate. More replicates add seeds and change none.

    Args:
        design: of the study.
        factors: of the cell; derived seeds depend on them, not on the place of the cell in the table.
        first_seed: of this row, if it has one of its own.
    """
    if design.seeds is not None and first_seed is None:
        return tuple(design.seeds[: design.count])
    first = design.first_seed if first_seed is None else first_seed
    if first is not None:
        return tuple(range(first, first + design.count))
    return derived_seeds(design.name, factors, design.count)


def derived_seeds(study: str, factors: Mapping[str, Any], count: int) -> tuple[int, ...]:
    """Return seeds that look random and are always the same, 0 to 2^53 - 1: hashes of ``[study, factors, k]``."""
    start = json.dumps([study, plain(factors)], sort_keys=True).removesuffix("]")
    texts = (f"{start}, {replicate}]".encode() for replicate in range(count))
    return tuple(int.from_bytes(hashlib.blake2b(text, digest_size=8).digest()) >> (64 - BITS) for text in texts)


def plain(value: Any) -> Any:
    """Return a value, or what holds values, with 1 for 1.0: they are one value of a factor, files may say either."""
    if isinstance(value, Mapping):
        return {name: plain(inner) for name, inner in value.items()}
    if isinstance(value, list):
        return [plain(inner) for inner in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value
