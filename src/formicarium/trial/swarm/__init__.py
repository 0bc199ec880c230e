"""What every swarm of a reader's own needs and nobody should write twice: arena, parameters, state, phases, notes."""
