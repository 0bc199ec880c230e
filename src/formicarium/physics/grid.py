"""Grids: who is near whom, and which scenery is near a place, without asking everybody."""

import math

import numpy as np

from formicarium.compiled import compiled


@compiled
def cell_number(place, low, cell, count):
    """Return the row or column of a coordinate (m); places beyond the grid belong to its rim."""
    return min(count - 1, max(0, int((place - low) / cell)))


@compiled
def scenery_cell(settings, x, y):
    """Return the scenery cell of a place (m)."""
    column = cell_number(x, settings.low_x, settings.scenery_cell, settings.scenery_columns)
    row = cell_number(y, settings.low_y, settings.scenery_cell, settings.scenery_rows)
    return row * settings.scenery_columns + column


@compiled
def sort_into_cells(world):
    """Write the bodies cell by cell, within a cell by ascending key (a counting sort)."""
    settings = world.settings[0]
    bodies = world.bodies
    lists = world.lists
    first = world.cell_first
    first[:] = 0
    for i in range(len(bodies)):
        column = cell_number(bodies[i].x, settings.low_x, settings.cell, settings.columns)
        row = cell_number(bodies[i].y, settings.low_y, settings.cell, settings.rows)
        lists[i].cell = row * settings.columns + column
        first[lists[i].cell] += 1
    total = 0
    for cell in range(len(first)):
        total += first[cell]
        first[cell] = total
    for place in range(len(bodies) - 1, -1, -1):
        i = lists[place].order
        first[lists[i].cell] -= 1
        lists[first[lists[i].cell]].member = i


@compiled
def find_neighbours(world):
    """List for every body all others within settings.reach, centre to centre.

    The order within a list depends on places and keys, never on the order of bodies in memory.
    """
    sort_into_cells(world)
    settings = world.settings[0]
    bodies = world.bodies
    lists = world.lists
    neighbours = world.neighbours
    count = world.neighbour_count
    columns = settings.columns
    square_reach = settings.reach * settings.reach
    count[:] = 0
    for place in range(len(bodies)):
        i = lists[place].order
        x = bodies[i].x
        y = bodies[i].y
        row = lists[i].cell // columns
        column = lists[i].cell - row * columns
        for near_row in range(max(0, row - 1), min(settings.rows, row + 2)):
            # The cells of a row follow each other, so three cells are one range of members.
            start = world.cell_first[near_row * columns + max(0, column - 1)]
            end = world.cell_first[near_row * columns + min(columns - 1, column + 1) + 1]
            for member in range(start, end):
                j = lists[member].member
                if lists[j].rank <= place:
                    continue
                dx = bodies[j].x - x
                dy = bodies[j].y - y
                square = dx * dx + dy * dy
                if square > square_reach:
                    continue
                distance = math.sqrt(square)
                note_neighbour(neighbours, count, i, j, dx, dy, distance)
                note_neighbour(neighbours, count, j, i, -dx, -dy, distance)


@compiled
def note_neighbour(neighbours, count, i, j, dx, dy, distance):
    """Append j to the neighbours of i."""
    entry = neighbours[i, count[i]]
    entry.index = j
    entry.dx = dx
    entry.dy = dy
    entry.distance = distance
    count[i] += 1


def lists_of_scenery(segments: np.recarray, settings: np.record) -> np.ndarray:
    """Return for each scenery cell the segments within settings.scenery_reach of any point of the cell.

    Compressed rows in one array: those of cell c are scenery[scenery[c]:scenery[c + 1]], in ascending order.
    A few segments slightly farther away are listed too; their users test distances themselves.
    """
    cell = settings.scenery_cell
    columns, rows = settings.scenery_columns, settings.scenery_rows
    x, y = np.meshgrid(
        settings.low_x + (np.arange(columns) + 0.5) * cell, settings.low_y + (np.arange(rows) + 0.5) * cell
    )
    x, y = x.ravel(), y.ravel()
    reach = settings.scenery_reach + cell * math.sqrt(0.5)
    cells, members = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    for number, segment in enumerate(segments):
        along_x, along_y = segment.bx - segment.ax, segment.by - segment.ay
        place = (x - segment.ax) * along_x + (y - segment.ay) * along_y
        place = np.clip(place / (along_x**2 + along_y**2), 0.0, 1.0)
        square = (segment.ax + place * along_x - x) ** 2 + (segment.ay + place * along_y - y) ** 2
        near = np.flatnonzero(square <= reach**2)
        cells.append(near)
        members.append(np.full(len(near), number))
    by_cell, by_number = np.concatenate(cells), np.concatenate(members)
    first = np.zeros(len(x) + 1, np.int64)
    first[1:] = np.cumsum(np.bincount(by_cell, minlength=len(x)))
    return np.concatenate([first + len(first), by_number[np.argsort(by_cell, kind="stable")]])
