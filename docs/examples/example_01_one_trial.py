"""One trial from Python: a row of results, events and frames as arrays.

Twenty simulated e-pucks of TS-Swarm Mark I3 build a chain for a minute.
"""

import formicarium
from formicarium.systems.registry import resolve

numbers = formicarium.parameters("mark-i3", robots=20, changes={"time_cap": 60})
trial = formicarium.run_trial("mark-i3", seed=7, parameters=numbers, frames_every=1.0)

print("simulated:", trial.outcome["duration_s"], "s")
kinds = resolve("mark-i3").kinds
for kind in sorted(set(trial.events["kind"].tolist())):
    print(f"{kinds[kind]}: {(trial.events['kind'] == kind).sum()}")
assert trial.frames is not None
print("frames, robots:", trial.frames.x.shape)
