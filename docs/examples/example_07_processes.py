"""Every robot's controller as a process of its own, as on real robots: the same trial, byte for byte.

Three robots of task partitioning decide in three Python processes that get nothing but their readings, over a socket.
"""

import pickle

from formicarium.systems.registry import resolve
from formicarium.trial.lockstep import Lockstep

if __name__ == "__main__":
    system = resolve("partitioning")
    here = system.begin(system.configure(robots=3), 1)
    system.advance(here, 600)
    there = pickle.loads(pickle.dumps(here))
    system.advance(here, 30)
    with Lockstep(system.onboard, there) as controllers:
        controllers.advance(30)
        print(len(controllers.processes), "processes,", len(controllers.lost), "lost")
    print("bodies the same:", here.world.bodies.tobytes() == there.world.bodies.tobytes())
    print("memories the same:", here.memories.tobytes() == there.memories.tobytes())
