"""What the observers see, against NumPy, SciPy and brute force."""

import itertools

import numpy as np
import pytest
from scipy.sparse.csgraph import connected_components

from formicarium.contracts.states import copy_of
from formicarium.observers.graphs import Graph, count_cut_robots
from formicarium.observers.spectrum import lambda_2
from systems.coverage.swarm import advance, line, move, swarm
from systems.coverage.test_traps import links_by_hand


def range_graph(state):
    bodies = state.world.bodies
    gap = np.hypot(bodies.x[:, None] - bodies.x, bodies.y[:, None] - bodies.y)
    return (gap <= 3.0) & ~np.eye(len(bodies), dtype=bool)


def scattered(seed, count=14, side=4.0):
    draws = np.random.default_rng(seed)
    places = [(0.0, 0.0, 0.0)]
    while len(places) < count:
        x, y = draws.uniform(-side, side, 2)
        if all((x - a) ** 2 + (y - b) ** 2 > 0.18**2 for a, b, _ in places):
            places.append((x, y, draws.uniform(-3, 3)))
    return places


@pytest.mark.parametrize("seed", range(12))
def test_connection_and_spectrum_agree_with_numpy_and_scipy(seed):
    state = advance(swarm(scattered(seed, side=3.0 + seed / 2), observer={"spectrum_every": 0.1}), 1)
    graphs = {Graph.RANGE: range_graph(state), Graph.SIGHT: links_by_hand(state)}
    for graph, links in graphs.items():
        count, labels = connected_components(links)
        assert state.connections[graph].components == count
        assert state.connections[graph].reached == (labels == labels[0]).sum()
    laplacian = np.diag(graphs[Graph.RANGE].sum(axis=0)) - graphs[Graph.RANGE]
    assert state.survey[0].last_lambda == pytest.approx(np.linalg.eigvalsh(laplacian)[1], abs=1e-9)


def test_lambda_2_of_known_graphs():
    """A path of n robots: 2 - 2 cos(pi / n); all linked: n; one dead leaves n - 1."""
    path = swarm(line(9))
    assert lambda_2(path, path.laplacian, path.rows) == pytest.approx(2.0 - 2.0 * np.cos(np.pi / 9), abs=1e-9)
    crowd = swarm([(0.3 * k, 0.0, 0.0) for k in range(8)])
    assert lambda_2(crowd, crowd.laplacian, crowd.rows) == pytest.approx(8.0)
    crowd.robots.alive[3] = 0
    assert lambda_2(crowd, crowd.laplacian, crowd.rows) == pytest.approx(7.0)


@pytest.mark.parametrize("seed", range(6))
def test_cut_robots_are_those_whose_removal_parts_the_rest(seed):
    state = advance(swarm(scattered(seed, 12, 3.5)), 1)
    links = range_graph(state)
    if connected_components(links)[0] > 1:
        pytest.skip("not connected")
    parting = sum(connected_components(np.delete(np.delete(links, k, 0), k, 1))[0] > 1 for k in range(12))
    world = state.world
    found = count_cut_robots(world.neighbours, world.neighbour_count, state.links, state.places, Graph.RANGE, 0)
    assert found == parting


def test_a_loss_is_timed_to_the_cycle():
    state = advance(swarm(line(4)), 20)
    assert state.connections.lost_cycles.tolist() == [0, 0, 0]
    away = move(state, 3, 40.0, 0.0)
    advance(away, 7)
    assert away.connections[Graph.RANGE].lost_cycles == 7 and away.connections[Graph.RANGE].first_loss == 20
    back = move(away, 3, float(away.world.bodies[2].x) + 2.0, 0.0)
    advance(back, 30)
    assert back.connections[Graph.RANGE].longest_loss == 7 and back.connections[Graph.RANGE].losses == 1
    assert back.connections[Graph.HEARD].longest_loss >= 7


def test_delivered_messages_are_links_only_if_both_ways_are_alive():
    """With all messages lost the range graph is whole and the graph of messages is not."""
    state = advance(swarm(line(4)), 20)
    state.footbot.radio_loss = 1.0
    advance(state, 10)
    assert state.connections[Graph.RANGE].reached == 4 and state.connections[Graph.HEARD].reached == 1


def test_detached_robots_do_not_lengthen_an_arm():
    """Trap 12: only who reaches the master counts; the other length is told apart."""
    state = advance(swarm(setting=2, robots=6), 200)
    away = move(state, 5, 20.0, -20.0)
    advance(away, 30)
    assert away.axes[0].longest < 10.0 and away.axes[0].longest_detached > 28.0


def test_a_latency_is_not_less_than_the_way_takes():
    """ST-61: at most 0.15 m/s from a start at most 1.56 m along the axis."""
    for seed in range(3):
        state = advance(swarm(setting=2, robots=11, seed=seed), 2400)
        for target, first in zip(state.axes[0].target, state.axes[0].first, strict=True):
            assert first < 0 or (first + 1) * 0.1 >= (target - 0.1 - 1.56) / 0.15


def test_losses_are_drawn_for_each_direction_by_itself():
    """A loss of 30 % leaves 2 p (1 - p) = 42 % of the pairs heard one way only."""
    state = swarm([(0.4 * k, 1.5 * (k % 2), 0.0) for k in range(6)], footbot={"radio_loss": 0.3, "occlusion": False})
    heard = []
    advance(state, 1)
    for _ in range(1500):
        cycle = int(state.clock[0].cycle)
        kept = copy_of(state.world).bodies
        advance(state, 1)
        state.world.bodies[:] = kept
        heard.append(state.heard == cycle)
    heard = np.array(heard)
    pairs = list(itertools.combinations(range(6), 2))
    asymmetric = np.mean([heard[:, i, j] != heard[:, j, i] for i, j in pairs])
    assert heard[:, *np.triu_indices(6, 1)].mean() == pytest.approx(0.7, abs=0.02)
    assert asymmetric == pytest.approx(0.42, abs=0.02)


def test_no_field_has_the_name_of_a_method_of_records():
    """Interpreted, ``record.round`` is NumPy's method and not the field."""
    state = swarm(line(3))
    for name, part in state._asdict().items():
        for field in getattr(part, "dtype", np.dtype("i8")).names or ():
            assert not hasattr(np.record, field), (name, field)
