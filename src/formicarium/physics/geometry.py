"""Points, segments and discs in the plane."""

from formicarium.compiled import compiled


@compiled
def place_along(ax, ay, bx, by, x, y):
    """Return where on the segment a-b the point nearest to (x, y) is: 0 at a, 1 at b."""
    along_x = bx - ax
    along_y = by - ay
    square = along_x * along_x + along_y * along_y
    place = ((x - ax) * along_x + (y - ay) * along_y) / square
    return min(1.0, max(0.0, place))


@compiled
def square_distance(ax, ay, bx, by, x, y):
    """Return the square (m2) of the distance from the point (x, y) to the segment a-b."""
    place = place_along(ax, ay, bx, by, x, y)
    dx = ax + place * (bx - ax) - x
    dy = ay + place * (by - ay) - y
    return dx * dx + dy * dy


@compiled
def beyond(ax, ay, bx, by, x, y, reach):
    """Tell at a glance that the segment a-b is farther than ``reach`` (m) from (x, y): by the box that bounds it."""
    return x - reach > max(ax, bx) or x + reach < min(ax, bx) or y - reach > max(ay, by) or y + reach < min(ay, by)


@compiled
def crosses(ax, ay, bx, by, cx, cy, dx, dy):
    """Tell whether the segments a-b and c-d have a point in common; parallel ones never do."""
    along_x = bx - ax
    along_y = by - ay
    other_x = dx - cx
    other_y = dy - cy
    from_x = cx - ax
    from_y = cy - ay
    area = along_x * other_y - along_y * other_x
    first = from_x * other_y - from_y * other_x
    second = from_x * along_y - from_y * along_x
    if area < 0.0:
        area, first, second = -area, -first, -second
    return area > 0.0 and 0.0 <= first <= area and 0.0 <= second <= area
