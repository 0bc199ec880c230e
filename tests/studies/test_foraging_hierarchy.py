"""The tree of tasks on made-up rows: which cache is chosen, and when the swarm cuts at the cheap one only."""

import numpy as np
import pytest
from matplotlib.image import imread

from formicarium.studies.foraging_hierarchy import cells, cuts_at_the_cheap_one_only, figure_hierarchy, section
from formicarium.views.charts import draw_chart


def rows(cheap=0.8, dear=0.2, runs=6, noise=0.01):
    made, draws = [], np.random.default_rng(4)
    for period in (0.1, 10.0):
        for extra in (200.0, -200.0):
            for seed in range(runs):
                shares = {name: draws.normal(mean, noise) for name, mean in (("cheap", cheap), ("dear", dear))}
                first, second = ("cheap", "dear") if extra > 0 else ("dear", "cheap")
                made.append(
                    {
                        "method": "adaptive",
                        "consistent": 1,
                        "seed": seed,
                        "objects_per_robot": 100.0 + seed,
                        "strategy.hierarchical": True,
                        "strategy.giveup_draw_period": period,
                        "cache.second_extra": extra,
                        "chosen_first": shares[first],
                        "chosen_second": shares[second],
                        "over_first": 0.5,
                        "over_second": 0.1,
                    }
                )
    return made


@pytest.mark.parametrize(
    ("made", "verdict"),
    [
        (rows(), True),
        (rows(dear=0.7), False),
        (rows(cheap=0.3), False),
        (rows(cheap=0.5, noise=0.2), None),
        (rows(runs=1), None),
        ([], None),
    ],
)
def test_the_cheap_cache_is_chosen_more_often_than_not_and_the_dear_one_less(made, verdict):
    assert cuts_at_the_cheap_one_only(made, 10.0)[1] is verdict


def test_the_cheap_cache_is_told_from_the_dear_one_on_either_side():
    words, _ = cuts_at_the_cheap_one_only(rows(noise=0.0), 0.1)
    assert words == (
        "the first cache cheap: chosen 80 % (80 to 80), the dear one 20 % (20 to 20); "
        "the second cache cheap: chosen 80 % (80 to 80), the dear one 20 % (20 to 20)"
    )


def test_table_and_figure_show_every_cell(tmp_path):
    made = rows()
    plain = {"strategy.hierarchical": False, "chosen_first": 0.0, "chosen_second": 0.0, "over_first": 0.0}
    made.append(made[0] | plain | {"method": "never"})
    made.append(made[0] | plain | {"method": "always", "consistent": 0})
    assert [cell.method for cell in cells(made)[:2]] == ["never", "always"]
    lines = section(made)
    assert sum(line.startswith("| ") for line in lines) == 1 + 6
    assert "| always | 0, 200 | 1 | 1 | | | | | |" in lines
    assert {line.count("|") for line in lines if line.startswith("|")} == {10}
    assert sum(": **holds**;" in line for line in lines) == 2
    assert imread(draw_chart(figure_hierarchy(made), tmp_path / "figure.png")).std() > 0.01
