"""A study as a table: what is repeated, which factors vary, how often, with which seeds.

Factors listed under ``factors`` are crossed with each other; ``rows`` is a table whose columns vary together.
With both, every row is crossed with all factors.
"""

import json
import math
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from formicarium.campaigns.errors import DesignError

MOST_SEED = 2**63 - 1


def _finite_number(value: Any) -> Any:
    if isinstance(value, float) and math.isnan(value):
        raise ValueError("nan is no value to compare runs by")
    return value


Plain = Annotated[bool | int | float | str, AfterValidator(_finite_number)]
Value = Plain | list[Plain]  # of a factor
Seed = Annotated[int, Field(ge=0, le=MOST_SEED)]
Name = Annotated[str, Field(min_length=1)]


class Design(BaseModel):
    """A study: the cells of its table, each repeated with seeds of its own."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$", max_length=100)  # derived seeds depend on it
    system: str = Field(min_length=1)  # what is repeated
    replicates: int | None = Field(None, ge=1)  # runs of each cell
    first_seed: Seed | None = None  # replicate r of every cell has seed first_seed + r
    seeds: list[Seed] | None = Field(None, min_length=1)  # of the replicates of every cell
    fixed: dict[Name, Value] = Field(default_factory=dict, alias="set")  # the same in every cell
    factors: dict[Name, Annotated[list[Value], Field(min_length=1)]] = Field(default_factory=dict)
    rows: list[dict[Name, Value]] = Field(default_factory=list)
    keep: list[str] = Field(default_factory=list)  # tables of each run to keep beside its row
    time_limit: float | None = Field(None, gt=0)  # wall-clock seconds of one run

    @model_validator(mode="after")
    def _consistent(self) -> "Design":
        if self.seeds is not None:
            if self.first_seed is not None:
                raise ValueError("'seeds' and 'first_seed' exclude each other")
            twice = sorted({seed for seed in self.seeds if self.seeds.count(seed) > 1})
            if twice:
                raise ValueError(f"'seeds' lists {twice[0]} more than once: the same run would count twice")
            if self.replicates is not None and self.replicates > len(self.seeds):
                raise ValueError(f"'replicates' is {self.replicates}, but 'seeds' lists {len(self.seeds)}")
        elif self.replicates is None:
            raise ValueError("'replicates' is missing: say how often each cell is run, or list its 'seeds'")
        if self.first_seed is not None and self.first_seed + self.count > MOST_SEED:
            raise ValueError(f"'first_seed' = {self.first_seed}: the last seed would be above 2^63 - 1")
        if "rows" in self.model_fields_set and not self.rows:
            raise ValueError("'rows' is an empty table: there is nothing to run")
        _check_rows(self.rows)
        for name in self.factors:
            places = [place for place, known in (("rows", self.rows[:1]), ("set", [self.fixed])) if name in _all(known)]
            if places:
                raise ValueError(f"'{name}' is in 'factors' and in '{places[0]}': say it once")
        both = sorted(_all(self.rows) & set(self.fixed))
        if both:
            raise ValueError(f"'{both[0]}' is in 'rows' and in 'set': say it once")
        return self

    @property
    def count(self) -> int:
        """Runs of each cell."""
        return self.replicates if self.replicates is not None else len(self.seeds or ())

    def content(self) -> dict[str, Any]:
        """Return the design as plain values, as a file would hold it."""
        return self.model_dump(by_alias=True, exclude_defaults=True)


def _all(tables: list[dict[str, Any]]) -> set[str]:
    return {name for table in tables for name in table}


def _check_rows(rows: list[dict[str, Any]]) -> None:
    columns = set(rows[0]) - {"first_seed"} if rows else set()
    for number, row in enumerate(rows):
        for name in sorted(columns ^ (set(row) - {"first_seed"})):
            has = "has no" if name in columns else "alone has"
            raise ValueError(f"rows[{number}] {has} '{name}': all rows need the same columns")
        seed = row.get("first_seed", 0)
        if not isinstance(seed, int) or isinstance(seed, bool) or not 0 <= seed <= MOST_SEED // 2:
            raise ValueError(f"rows[{number}].first_seed = {seed!r}: must be a whole number from 0 to 2^62")


def make_design(content: Mapping[str, Any], source: str = "design") -> Design:
    """Check a design given as plain values.

    Args:
        content: as a TOML file would hold it; from Python also ranges, tuples and arrays for lists.
        source: named in messages, for example the file.

    Raises:
        DesignError: with every key that is wrong, its value and the reason.
    """
    try:
        return Design.model_validate(_plain(content))
    except ValidationError as error:
        told = dict.fromkeys(_in_words(problem) for problem in error.errors())
        raise DesignError("\n".join(f"{source}: {line}" for line in told)) from error


def _plain(content: Any) -> Any:
    if isinstance(content, Mapping):
        return {name: _plain(value) for name, value in content.items()}
    if isinstance(content, list | tuple | range):
        return [_plain(value) for value in content]
    return content.tolist() if isinstance(content, np.ndarray | np.generic) else content


def _in_words(problem: Any) -> str:
    steps = [step for step in problem["loc"] if isinstance(step, int) or not _is_type(step)]
    place = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps).lstrip(".")
    message = problem["msg"].removeprefix("Value error, ")
    if problem["type"] == "extra_forbidden":
        known = [field.alias or name for name, field in Design.model_fields.items()]
        near = get_close_matches(place, known, n=1, cutoff=0.5)
        return f"{place}: no such key.{f' Did you mean {near[0]}?' if near else ''} Keys: {', '.join(known)}"
    if problem["type"] == "missing":
        return f"{place}: is missing"
    if not place:
        return message
    message = {"dict_type": "must be a table: names with values", "list_type": "must be a list"}.get(
        problem["type"], message
    )
    if _is_value(steps):
        message = "must be a number, a text, true or false, or a list of those"
    return f"{place} = {json.dumps(problem['input'], default=str)}: {message}"


def _is_type(step: str) -> bool:
    # Steps that pydantic adds for the members of a union, and for validators.
    return step in ("bool", "int", "float", "str") or "[" in step


def _is_value(steps: list[Any]) -> bool:
    return len(steps) >= 2 and ((steps[0] in ("factors", "rows") and len(steps) >= 3) or steps[0] == "set")
