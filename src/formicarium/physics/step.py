"""One control cycle of the flat world."""

from formicarium.compiled import compiled
from formicarium.physics.contacts import begin, find_contacts, part, press, touch
from formicarium.physics.motion import aim_drives, glide, move, settle


@compiled
def step(world):
    """Advance the world by one control cycle (settings.cycle_time, 0.1 s).

    The neighbour lists must be those of the places the bodies have now: call ``find_neighbours`` after each step
    and after moving a body by hand. Good for speeds up to 0.6 m/s.
    """
    settings = world.settings[0]
    time = settings.cycle_time / settings.substeps

    # Who strives for what, and who can touch whom until the cycle ends?
    aim_drives(world)
    contact_count, involved_count = find_contacts(world)

    # Bodies far from everything need no sub-steps of their own.
    glide(world)

    for _ in range(settings.substeps):
        # Places follow from old speeds; then drives and contacts find new speeds.
        move(world, involved_count, time)
        touching_count, deepest = touch(world, contact_count)
        begin(world, involved_count, touching_count)
        if touching_count > 0:
            for _ in range(settings.iterations):
                press(world, involved_count, touching_count)
        if deepest > settings.slop:
            part(world, involved_count, touching_count, time)

    settle(world)
