"""An arena from a file: what is drawn is there, what is wrong is named with file, key and value."""

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.physics.scenery import obstacles_of
from formicarium.trial.setup import WALL_MARGIN, NoRoom
from formicarium.trial.swarm.arena import Arena, ArenaTable, BadArena, read_arena
from formicarium.trial.swarm.state import free_places, make_booths, make_lamps

ROOM = """
outline = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
start = [-0.9, -0.9, 0.9, 0.9]
[[obstacle]]
corners = [[0.2, 0.2], [0.6, 0.2], [0.4, 0.6]]
[[wall]]
line = [[-0.8, 0.5], [-0.2, 0.5], [-0.2, 0.8]]
[[booth]]
at = [0.6, -0.6]
direction = 90
colour = "green"
[[lamp]]
at = [0, 0]
reach = 3
[[floor]]
rectangle = [-1, -1, 0, 1]
shade = 0.5
"""


def test_everything_that_is_drawn_is_there():
    arena = read_arena(ROOM)
    segments = arena.segments()
    assert len(obstacles_of(segments)) == 4  # booth, obstacle, two legs of the wall
    outer = segments[segments.group == 0]
    assert len(outer) == 4 and not outer.tall.any() and segments[segments.group > 0].tall.all()
    booths, lights = make_booths(arena)
    assert booths[0].colour == 2 and (booths[0].cosine, booths[0].sine) == pytest.approx((0, 1)) and len(lights) == 3
    assert make_lamps(arena)[0].intensity == 3.0 and arena.patches()[0].shade == 0.5


def test_robots_start_inside_and_off_everything_solid():
    places = free_places(60, read_arena(ROOM), 1)
    x, y = places[:, 0], places[:, 1]
    assert (np.abs(x) <= 1 - WALL_MARGIN).all() and (np.abs(y) <= 1 - WALL_MARGIN).all()
    inside = (y > 0.2 - WALL_MARGIN) & (y < 0.6) & (np.abs(x - 0.4) < (0.6 - y) / 2)  # of the triangle
    assert not inside.any()
    gaps = np.hypot(x[:, None] - x, y[:, None] - y) + np.eye(60)
    assert gaps.min() >= 0.08
    with pytest.raises(NoRoom, match="room for about"):
        free_places(250, Arena(outline=((0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5))), 1)


def test_walls_of_a_hall_with_a_corner_hide_what_is_behind_them():
    hall = Arena(outline=((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)))
    assert hall.segments().tall.all()


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (ROOM.replace("shade = 0.5", "shade = 1.5"), "floor.0.shade.*less than or equal to 1.*1.5"),
        (ROOM.replace("reach", "range"), "lamp.0.range"),
        (ROOM.replace('"green"', '"pink"'), "booth.0.colour.*pink"),
        (ROOM.replace("[-0.8, 0.5], [-0.2, 0.5]", "[-0.2, 0.5], [-0.2, 0.5]"), "wall.0.line.*equal points"),
        ("outline = [[0, 0], [1, 0], [2, 0]]", "encloses less"),
        ("outline = [[0, 0], [300, 0], [300, 200]]", "lengths are metres"),
        ("outline = [", "no TOML"),
        ("", "outline.*required"),
    ],
)
def test_what_is_wrong_is_named(text, why):
    with pytest.raises(BadArena, match=f"(?s)^hall.toml.*{why}"):
        read_arena(text, "hall.toml")


def test_the_text_of_a_file_becomes_part_of_the_run(tmp_path):
    file = tmp_path / "room.toml"
    file.write_text(ROOM)
    table = ArenaTable(plan=str(file))
    file.unlink()
    assert ArenaTable.model_validate_json(table.model_dump_json()).plan == table.plan == ROOM
    with pytest.raises(ValidationError, match="cannot read the arena"):
        ArenaTable(plan=str(file))
