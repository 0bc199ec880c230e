"""The records of the flat world. SI units; x and y in the world's frame, angles counter-clockwise.

All fields are 8 bytes wide, so that compiled and interpreted arithmetic are the same arithmetic.
"""

import numpy as np

# A disc with a drive. The whole state of a world is its bodies: a copy of them is a snapshot.
BODY = np.dtype(
    [
        ("x", "f8"),  # m, of the centre
        ("y", "f8"),  # m
        ("heading", "f8"),  # rad, not wrapped: it counts whole turns
        ("speed_x", "f8"),  # m/s
        ("speed_y", "f8"),  # m/s
        ("turn_rate", "f8"),  # rad/s
        ("radius", "f8"),  # m
        ("mass", "f8"),  # kg
        ("inertia", "f8"),  # kg m2, about the centre
        ("force_limit", "f8"),  # N, the most the linear drive can push; floor friction for a passive disc
        ("torque_limit", "f8"),  # N m, the most the angular drive can turn
        ("forward", "f8"),  # m/s, commanded along the heading; the commanded sideways speed is always 0
        ("turning", "f8"),  # rad/s, commanded
        ("key", "i8"),  # travels with the body and orders its contacts
    ],
    align=True,
)

# A piece of static scenery: a wall face, a face of a box or of a booth. Both sides are solid.
SEGMENT = np.dtype(
    [
        ("ax", "f8"),  # m
        ("ay", "f8"),  # m
        ("bx", "f8"),  # m
        ("by", "f8"),  # m
        ("friction", "f8"),  # coefficient, multiplied by the body's
        ("tall", "i8"),  # 1 if it blocks line of sight at sensor height
        ("group", "i8"),  # 0: wall of the arena; k >= 1: belongs to obstacle k - 1
    ],
    align=True,
)

# A box or booth as seen from afar: a circle round a range of segments.
OBSTACLE = np.dtype(
    [
        ("x", "f8"),  # m, centre of the bounding circle
        ("y", "f8"),  # m
        ("radius", "f8"),  # m, of the bounding circle
        ("first", "i8"),  # its first segment
        ("count", "i8"),  # how many segments it has
    ],
    align=True,
)

# One record per world: what is set before a trial, and the grids that follow from it.
SETTINGS = np.dtype(
    [
        ("cycle_time", "f8"),  # s, one control cycle
        ("substeps", "i8"),  # physics steps in a cycle
        ("iterations", "i8"),  # passes of the contact solver in a sub-step
        ("slop", "f8"),  # m, overlap that is left alone, so that resting contacts rest
        ("bias", "f8"),  # share of an overlap that is left after one second
        ("friction", "f8"),  # coefficient of every body's rim
        ("reach", "f8"),  # m, centre to centre, of the neighbour lists
        ("scenery_reach", "f8"),  # m, from a centre, of the scenery lists
        ("margin", "f8"),  # m, the grids reach so far beyond the first places and the scenery
        ("mending", "f8"),  # 1/s, speed at which overlap is mended, per metre of it
        ("low_x", "f8"),  # m, corner of the grids
        ("low_y", "f8"),  # m
        ("cell", "f8"),  # m, side of a cell of the body grid, at least reach
        ("columns", "i8"),
        ("rows", "i8"),
        ("scenery_cell", "f8"),  # m, side of a cell of the scenery grid
        ("scenery_columns", "i8"),
        ("scenery_rows", "i8"),
        ("tall_walls", "i8"),  # 1 if any wall of the arena blocks line of sight
    ],
    align=True,
)

# Another body within reach.
NEIGHBOUR = np.dtype(
    [
        ("index", "i8"),
        ("dx", "f8"),  # m, from this body to the other, world's frame
        ("dy", "f8"),  # m
        ("distance", "f8"),  # m, centre to centre
    ],
    align=True,
)

# Lists of bodies, one entry per body.
LISTS = np.dtype(
    [
        ("order", "i8"),  # the p-th body by ascending key
        ("rank", "i8"),  # where body i is in that order
        ("cell", "i8"),  # cell of body i in the body grid
        ("member", "i8"),  # the p-th body by cell, then by key
    ],
    align=True,
)

# The working copy of a body within one cycle. The record after the last body is the ground: it never moves.
MOTION = np.dtype(
    [
        ("x", "f8"),
        ("y", "f8"),
        ("heading", "f8"),
        ("speed_x", "f8"),
        ("speed_y", "f8"),
        ("turn_rate", "f8"),
        ("shift_x", "f8"),  # m/s, speed that only mends overlap and is then forgotten
        ("shift_y", "f8"),
        ("radius", "f8"),
        ("inverse_mass", "f8"),  # 1/kg
        ("inverse_inertia", "f8"),  # 1/(kg m2)
        ("target_x", "f8"),  # m/s, what the linear drive strives for
        ("target_y", "f8"),
        ("target_turn", "f8"),  # rad/s
        ("limit", "f8"),  # N s, the most the linear drive gives in a sub-step
        ("turn_limit", "f8"),  # N m s
        ("impulse_x", "f8"),  # N s, given by the linear drive in this sub-step
        ("impulse_y", "f8"),
        ("impulse_turn", "f8"),  # N m s
        ("touched", "i8"),  # 1 if it has a contact in this sub-step
        ("involved", "i8"),  # 1 if it can have a contact in this cycle
        ("listed", "i8"),  # a list of its own: record p names the p-th body that is involved
    ],
    align=True,
)

# Two bodies, or a body and a piece of scenery, that can touch within this cycle.
CONTACT = np.dtype(
    [
        ("first", "i8"),  # body
        ("second", "i8"),  # body, or the ground
        ("segment", "i8"),  # piece of scenery, or -1
        ("normal_x", "f8"),  # unit vector from the first to the second
        ("normal_y", "f8"),
        ("friction", "f8"),  # product of the two coefficients
        ("normal_mass", "f8"),  # kg, felt along the normal
        ("tangent_mass", "f8"),  # kg, felt along the rim
        ("normal_impulse", "f8"),  # N s, so far in this sub-step
        ("tangent_impulse", "f8"),  # N s
        ("parting_speed", "f8"),  # m/s at which overlap is to be mended
        ("parting_impulse", "f8"),  # N s
        ("listed", "i8"),  # a list of its own: record p names the p-th contact that touches now
    ],
    align=True,
)


def records(dtype: np.dtype, count: int | tuple[int, ...]) -> np.recarray:
    """Return zeroed records whose fields are attributes, compiled and interpreted."""
    return np.zeros(count, dtype).view(np.recarray)


def copied(array: np.ndarray, dtype: np.dtype) -> np.recarray:
    """Return a copy whose fields are attributes."""
    return np.array(array, dtype).view(np.recarray)
