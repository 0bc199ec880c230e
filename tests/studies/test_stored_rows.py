"""Rows of the study that are committed come out again."""

from pathlib import Path

import pytest

from formicarium.studies.tables import RESULTS, TEXTS, read_compact
from formicarium.systems.registry import resolve

TABLES = Path(__file__).parents[2] / "docs" / "results" / "tables"


@pytest.mark.parametrize(
    "variant, seed, limits",
    [
        ("mark-i3", 81104, {}),
        ("mark-i4", 91306, {}),
        ("mark-ii3", 101208, {}),
        ("mark-ii3", 101101, {"idle_limit": 2000.0, "stall_limit": 30000.0}),  # ended early
        ("mark-ii4", 131302, {}),
    ],
)
def test_a_row_of_the_study_comes_out_again_in_every_column(variant, seed, limits):
    table = read_compact(TABLES / f"{variant.replace('-', '_')}_table_1.csv")
    stored = next(row for row in table if row["seed"] == seed)
    system = resolve(variant)
    outcome = system.run(system.configure(stored["setting"], stored["robots"], swarm=limits), seed).outcome
    again = {name: (outcome.get(name) or None) if name in TEXTS else outcome.get(name) for name in RESULTS}
    assert again == {name: stored[name] for name in RESULTS}
    assert bool(limits) == (stored["hopeless_s"] is not None)
