"""Star-shaped eruption of connected swarms (SECS): coverage of tasks without losing the swarm, Panerati et al. 2018."""
