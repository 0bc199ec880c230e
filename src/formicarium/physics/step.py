"""One control cycle of the flat world."""

from formicarium.compiled import compiled
from formicarium.physics.contacts import RESTING, find_contacts, part, press, touch
from formicarium.physics.motion import aim_drives, glide, move, settle


@compiled
def step(world):
    """Advance the world by one control cycle (settings.cycle_time, 0.1 s).

    The neighbour lists must be those of the places the bodies have now: call ``find_neighbours`` after each
    step and after moving a body by hand. Good for speeds up to 0.6 m/s.
    """
    settings = world.settings[0]
    solver = world.solver
    iterations = settings.iterations
    time = settings.cycle_time / settings.substeps

    # What does every drive strive for, and who can touch whom until the cycle ends?
    aim_drives(world)
    contact_count, involved_count = find_contacts(world)

    # Bodies far from everything take all their sub-steps at once.
    glide(solver, settings.substeps, time)

    for _ in range(settings.substeps):
        # Old speeds give new places; there, drives and contacts give new speeds.
        move(solver, involved_count, time)
        touching_count, deepest = touch(solver, world.segments, settings, contact_count)
        press(solver, involved_count, touching_count, iterations)
        if deepest > RESTING * settings.slop:
            part(solver, involved_count, touching_count, iterations, time)

    settle(world)
