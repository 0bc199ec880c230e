"""The published matrices and curves, where they are: they belong to others and are not part of the project."""

import os
from pathlib import Path

import numpy as np
import pytest

from formicarium.connectivity.files import read_graphs

PLACES = [os.environ.get("FORMICARIUM_REFERENCE_DATA", ""), Path(__file__).parents[3] / "shared" / "data"]
NAMES = {"PI1": "bertrand", "PI2": "dilorenzo", "Wave": "sahai"}


def reference(name):
    for place in PLACES:
        path = Path(place) / "sgt" / name
        if place and path.exists():
            return path
    pytest.skip(f"the reference data are neither beside this checkout nor in FORMICARIUM_REFERENCE_DATA: no {name}")


def published_graphs():
    return [graph.adjacency for graph in read_graphs(reference("A10s.mat"))]


def published_curve(method, drop):
    """Return iterations, mean errors and standard deviations over graphs."""
    table = np.loadtxt(reference(f"errorvssteps-{NAMES[method]}-1-{drop}.dat"), skiprows=1)
    return table[:, 0].astype(int), table[:, 1], table[:, 3]
