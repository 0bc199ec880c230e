"""A booth that asks nothing: it shows its colour, notices who is inside, and is dark as long as somebody is."""

from formicarium.compiled import compiled
from formicarium.devices.booth import LIGHTS, show_lights, watch_barriers


@compiled
def serve_shelters(booths, lights, bodies, cycle):
    """Let every booth watch its light barriers and switch its lights; the lights of booth b come first but 3 b."""
    for b in range(len(booths)):
        booth = booths[b]
        was_occupied = booth.occupied
        deepest = watch_barriers(booth, bodies)
        if booth.occupied == 1 and was_occupied == 0:
            booth.visitor = deepest
            booth.since = cycle
        elif booth.occupied == 0 and was_occupied == 1:
            booth.visitor = -1
        show_lights(booth, lights, b * len(LIGHTS))
