"""A swarm as an environment for learning: agents are robots. Needs the extra "rl"."""
