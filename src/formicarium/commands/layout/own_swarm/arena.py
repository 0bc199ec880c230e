"""What stands still. `--set plan=FILE.toml` reads it from a file instead."""

from formicarium.trial.swarm.arena import Arena

from own_swarm.parameters import Parameters


def make_arena(parameters: Parameters) -> Arena:
    """Return the arena: metres, corners in order."""
    half = 0.5 * parameters.arena.side
    return Arena(outline=((-half, -half), (half, -half), (half, half), (-half, half)))
