"""Task partitioning: a foraging swarm that decides for itself whether to split its work (Pini et al. 2011)."""
