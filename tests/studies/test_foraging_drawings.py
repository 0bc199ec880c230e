"""Figures 3 to 6 are drawn from the implementation: what they show is what the paper and its statements say."""

import pytest
from matplotlib.image import imread

from formicarium.studies.diagram import Arc
from formicarium.studies.foraging_machine import arcs, machine
from formicarium.studies.foraging_plans import figure_4, figure_5, figure_6
from formicarium.systems.partitioning.memory import State
from formicarium.views.diagrams import draw_machine, draw_plans

# TP-30, both sides; a booth that is lost leads back to where it was looked for.
SIDE = [
    ("GO_SOURCE", "ENTER_SOURCE", ""),
    ("ENTER_SOURCE", "GO_SOURCE", ""),
    ("ENTER_SOURCE", "TO_CACHE_DROP", "P_p"),
    ("ENTER_SOURCE", "CORRIDOR_TO_NEST", "1 - P_p"),
    ("TO_CACHE_DROP", "ENTER_DROP", ""),
    ("TO_CACHE_DROP", "WAIT_DROP", ""),
    ("WAIT_DROP", "ENTER_DROP", ""),
    ("WAIT_DROP", "CORRIDOR_TO_NEST", "P_g"),
    ("ENTER_DROP", "WAIT_DROP", ""),
    ("ENTER_DROP", "TO_CACHE_DROP", ""),
    ("ENTER_DROP", "DROPPING", ""),
    ("DROPPING", "GO_SOURCE", ""),
    ("CORRIDOR_TO_NEST", "GO_NEST", ""),
]
OTHER = {"SOURCE": "NEST", "NEST": "SOURCE", "DROP": "PICK", "DROPPING": "PICKING"}


def mirrored(name):
    return "_".join(OTHER.get(word, word) for word in name.split("_"))


def test_the_state_machine_is_that_of_figure_3():
    """Six choices, three a side; all else follows of itself (TP-30, TP-31)."""
    table = SIDE + [(mirrored(start), mirrored(end), label) for start, end, label in SIDE]
    assert set(arcs()) == {Arc(*row) for row in table} and len(arcs()) == len(table)
    assert sum(bool(arc.label) for arc in arcs()) == 6


def test_every_state_has_a_place():
    assert set(machine().places) == {state.name for state in State} == set(machine().colours)


def test_a_pair_shows_the_colours_of_figure_5():
    shown = [[area.colour for area in plan.areas if area.colour != "wall"] for plan in figure_5().plans]
    dark = "#e6e4df"
    assert shown == [["blue", dark], ["red", dark], [dark, "green"], [dark, "red"], ["blue", dark]]
    loads = [[disc.loaded for disc in plan.discs] for plan in figure_5().plans]
    assert loads == [[True], [False], [False, False], [True], [True]]


def test_the_arena_has_its_booths_floor_path_and_robots():
    (plan,) = figure_6().plans
    colours = [area.colour for area in plan.areas]
    assert (colours.count("green"), colours.count("blue")) == (4, 4 + 3)
    assert sum(colour.startswith("floor") for colour in colours) == 10 and colours.count("floor 1.00") == 3
    assert len(plan.discs) == 10 and sum(disc.x < 0.8 for disc in plan.discs) == 5
    assert plan.dots[0][:2] == (0.8, 0.0)


@pytest.mark.parametrize("number", ["3", "4", "5", "6"])
def test_each_is_drawn(number, tmp_path):
    path = tmp_path / f"figure-{number}.png"
    if number == "3":
        draw_machine(machine(), path)
    else:
        draw_plans({"4": figure_4, "5": figure_5, "6": figure_6}[number](), path)
    assert imread(path).std() > 0.05
