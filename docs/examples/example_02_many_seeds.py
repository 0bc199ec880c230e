"""Many seeds, kept on disk: a second call runs only what is missing.

Twelve foragers hand objects over at a cache, or do not, for five minutes; three seeds of each. Rows come back as
columns.
"""

import formicarium

for method in ("never", "always"):
    numbers = formicarium.parameters("partitioning", robots=12, changes={"time_cap": 300, "method": method})
    for seeds in (range(1, 3), range(1, 4)):
        results = formicarium.run_set(
            "partitioning", seeds, parameters=numbers, out=f"{method}-partitioning", workers=1
        )
        print(method, "partitioning, seeds", results.columns["seed"].astype(int).tolist())
    print("  objects stored:", results.columns["stored"].astype(int).tolist())
