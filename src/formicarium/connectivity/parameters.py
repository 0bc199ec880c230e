"""Every number of the estimators, with unit, bounds and reason.

[paper]: Panerati et al., "From swarms to stars: task coverage in robot swarms with connectivity constraints", ICRA
2018. [scripts]: what its published scripts do. ST-..: numbered statements. [choice]: ours, where both are silent.
"""

from typing import Any, Literal

import numpy as np

from formicarium.connectivity.records import RULES, Clock, Drops, Method, Rows, Source
from formicarium.tables import Table, number

METHODS = ("PI1", "PI2", "Wave")
DROPS = ("directed", "symmetric", "hold-last")

GLOBAL = "global: somebody who sees all nodes; consensus: their own"


class EstimatorTable(Table):
    """One estimator. As given here it is honest: a node knows K, its own memory and what it hears."""

    method: Literal["PI1", "PI2", "Wave"] = number(
        "PI1", "", "Bertrand & Moonen, Di Lorenzo & Barbarossa, Sahai et al."
    )
    clock: Literal["rounds", "global"] = number(
        "rounds", "", "what ends a consensus. rounds: a fixed number; global: max - min over all nodes [scripts, ST-6]"
    )
    norm: Literal["consensus", "maximum", "global"] = number(
        "consensus", "", f"whence nodes have ||f||. {GLOBAL} [scripts]; maximum: the largest |f|, flooded [choice]"
    )
    mean: Literal["consensus", "global"] = number("consensus", "", f"whence nodes of PI2 have it. {GLOBAL} [scripts]")
    start: Literal["random", "index"] = number(
        "random", "", "of f. random: each node draws from -1..1; index: k/K, divided by its norm [scripts, ST-5]"
    )
    rows: Literal["own", "mirrored"] = number(
        "own", "", "of Wave. mirrored: a pair's first node's losses count for both, but not in d [scripts, ST-13]"
    )
    law: Literal["corrected", "printed"] = number("corrected", "", "of Wave; as printed it grows without bound [ST-10]")
    readout: Literal["bin", "interpolated"] = number(
        "interpolated",
        "",
        "of Wave. bin: the second peak's place in the spectrum [scripts]; interpolated: between bins",
    )
    rounds_per_node: float = number(20.0, "1", "rounds of one average consensus over K [tuned on other graphs]", gt=0)
    flood_per_node: float = number(1.0, "1", "rounds of one flood of a maximum over K: as far as a path [choice]", gt=0)
    tolerance: float = number(
        0.01, "1", "of the global clock; absolute, f is not normalised then [scripts, ST-6]", gt=0
    )
    mixing: float = number(0.8, "1", "gamma of consensus times K - 1 [scripts, ST-6]", gt=0, lt=1)
    diffusions: int = number(100, "1", "iterations of step B of PI1 [scripts, ST-7]", ge=1)
    alpha_per_node: float = number(3.0, "1", "divisor of L in step B of PI1, over K [scripts, ST-7]", gt=1)
    step: float = number(0.8, "1", "epsilon of PI2 times K [scripts, ST-8]", gt=0, lt=1)
    wave_speed: float = number(0.8, "1", "c of Wave; bounded below the root of 2 [scripts, ST-10]", gt=0, lt=1.414)
    window: int = number(100, "1", "samples that Wave's spectrum is taken of [scripts, ST-11]", ge=8)

    @property
    def uses_global_memory(self) -> bool:
        """Whether nodes are told what no neighbour can tell them."""
        if self.method == "Wave":
            return self.rows == "mirrored"
        return "global" in (self.clock, self.norm, *((self.mean,) if self.method == "PI2" else ()))

    def rounds(self, nodes: int) -> int:
        """Return the rounds of an average consensus among so many nodes."""
        return max(1, round(self.rounds_per_node * nodes))

    def record(self, nodes: int = 1) -> Any:
        """Return RULES for so many nodes."""
        rules = np.zeros(1, RULES).view(np.recarray)[0]
        rules.method = Method[self.method.upper()]
        rules.nodes = nodes
        rules.clock = Clock[self.clock.upper()]
        rules.norm_source = Source[self.norm.upper()]
        rules.mean_source = Source[self.mean.upper()]
        rules.rows = Rows[self.rows.upper()] if self.method == "Wave" else Rows.OWN
        rules.printed = self.law == "printed"
        rules.rounds = self.rounds(nodes)
        rules.flood = max(1, round(self.flood_per_node * nodes))
        rules.tolerance = self.tolerance
        rules.mixing = self.mixing / max(1, nodes - 1)
        rules.diffusions = self.diffusions
        rules.alpha = self.alpha_per_node * nodes
        rules.epsilon = self.step / nodes
        rules.wave_speed = self.wave_speed
        return rules


class LinksTable(Table):
    """How packets are lost."""

    drop: float = number(0.0, "1", "probability that a packet is lost [paper]", ge=0, le=1)
    drops: Literal["directed", "symmetric", "hold-last"] = number(
        "directed",
        "",
        "directed: each way by itself [scripts]; symmetric: both ways together; hold-last: directed, and the last "
        "packet that came goes on counting [choice, ST-13]",
    )

    @property
    def number(self) -> Drops:
        """The model as compiled code knows it."""
        return Drops[self.drops.upper().replace("-", "_")]


AUTHOR = {
    "clock": "global",
    "norm": "global",
    "mean": "global",
    "start": "index",
    "rows": "mirrored",
    "readout": "bin",
}


def estimator(method: str, mode: str = "honest", **changes: Any) -> EstimatorTable:
    """Return an estimator.

    Args:
        method: one of METHODS.
        mode: "honest", or "author" for what the published scripts do, with all their artefacts.
        changes: fields of EstimatorTable to change.

    Raises:
        ValueError: if a name or number is not allowed.
    """
    if mode not in ("honest", "author"):
        raise ValueError(f"mode {mode!r} is not honest or author")
    return EstimatorTable.model_validate({"method": method, **(AUTHOR if mode == "author" else {}), **changes})
