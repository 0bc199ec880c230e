"""Made-up runs for the cells of Table 1."""

import tomllib
from importlib import resources

from formicarium.studies.cells import LEVELS, VARIANTS, StudyCell

PUBLISHED = resources.files("formicarium.systems.sequencing.published")


def design(variant):
    return tomllib.loads(PUBLISHED.joinpath(f"{variant}-table-1.toml").read_text(encoding="utf-8"))


# variant -> setting -> robots of every level
TABLE_1 = {
    variant: [[row["robots"] for row in design(variant)["rows"][8 * k : 8 * k + 8]] for k in range(5)]
    for variant in VARIANTS
}


def run(success, members, cap, seed=1, **others):
    """A run that did ten sequences at half of 2,400 s or of its cap, or built a chain and did one."""
    half = min(cap, 2400.0) / 2
    row = {"seed": seed, "sources": "0123", "success": int(success), "hopeless_s": None}
    row |= {"time_chain_s": 0.2 * half, "time_1_s": 0.4 * half, "time_5_s": None, "time_10_s": None, "duration_s": cap}
    row |= {"members": members, "members_at_completion": members, "cause": "runners stuck"}
    row |= {"guardians": 3, "links": members - 4, "tails": 1, "branch_links": "6 5 6"}
    row |= {"upi_correct": seed % 6, "failed_sequences": seed % 6, "no_answers": 0, "protocol_faults": 0}
    row |= {"disagreements": 0, "unfounded": 0, "mixed": 0}
    if success:
        row |= {"time_5_s": 0.7 * half, "time_10_s": half, "duration_s": half, "cause": None}
    return row | others


def cell(setting, level, successes, runs=30, members=None, cap=None, variant="mark-i3", **others):
    paper = VARIANTS[variant]
    side, cap = paper.side * 2 ** (setting / 2), cap or paper.time_caps[setting]
    chain = 20 * side if members is None else members
    rows = [run(k < successes, chain, cap, k + 1, **others) for k in range(runs)]
    return StudyCell(variant, setting, side, TABLE_1[variant][setting][LEVELS.index(level)], cap, rows)


def study(successes=lambda setting, level: 28, **others):
    return [cell(k, level, successes(k, level), **others) for k in range(5) for level in LEVELS]
