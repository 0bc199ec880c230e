"""How connected a swarm is, exactly, and what its robots can find out of that by messages to neighbours alone."""

import numpy as np

import formicarium

angles = np.arange(12) * (2 * np.pi / 12)
ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)  # m; every robot hears two on either side
swarm = formicarium.connectivity_of(ring, reach=1.1, method="PI1", iterations=2001)
expected = sum(2 - 2 * np.cos(2 * np.pi * k / 12) for k in (1, 2))
print(f"lambda2 {swarm.lambda2:.4f}; of such a ring the formula says {expected:.4f}")
print("hops across:", swarm.diameter, " robots that must fail to part it:", swarm.vertex_connectivity)
assert swarm.estimates is not None
errors = np.abs(swarm.estimates.values[[200, 500, 2000]] / swarm.lambda2 - 1)  # of (iteration, robot)
for iteration, worst in zip((200, 500, 2000), errors.max(axis=1)):
    print(f"after {iteration} iterations the worst robot is off by {100 * worst:.0f} %")
