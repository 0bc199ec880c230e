"""No dead sensor: whatever a controller may read, there is something to be read."""

import numpy as np
import pytest

from contracts.states import leaves, recorded


def seen(name, cycles, every):
    """Return the readings of all robots at many cycles of one trial, (time, robot)."""
    rows = []
    for state in recorded(name, every):
        rows.append(state.readings)
        if state.clock[0].cycle >= cycles:
            return np.array(rows)[1:]  # nothing has been read before the first cycle


def test_every_field_of_a_reading_varies(name):
    readings = seen(name, cycles=4000, every=3)
    dead = []
    for path, values in leaves(readings):
        rest = values.shape[2:]
        # proximity[8] and payload[4] are sensors one by one; lists of blobs and packets are only lists
        sensors = rest[-1] if len(rest) == path.count(".") else 1
        table = values.reshape(-1, sensors)
        dead += [f"{path}[{k}]" for k in range(sensors) if len(np.unique(table[:, k])) < 2]
    assert dead == []


def test_every_robot_has_its_own_identity_and_a_clock_that_runs(name):
    readings = seen(name, cycles=60, every=1)
    assert (readings["identity"] == readings["identity"][0]).all()
    assert len(np.unique(readings["identity"][0])) == readings.shape[1]
    assert (np.diff(readings["cycle"], axis=0) == 1).all()


def test_no_two_robots_feel_the_same_noise(name):
    readings = seen(name, cycles=400, every=1)
    if "proximity" not in readings.dtype.names:
        pytest.skip(f"robots of {name} have no proximity sensors; their other sensors are noiseless as published")
    proximity = readings["proximity"].reshape(len(readings), -1)
    assert len(np.unique(proximity, axis=1).T) == proximity.shape[1]
