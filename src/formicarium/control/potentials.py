"""The Lennard-Jones potential (Panerati et al. 2018, equation 2; ST-27 to ST-29)."""

import math

from formicarium.compiled import compiled

CENTIMETRES = 100.0  # in a metre


@compiled
def squared(number):
    """Return x x: compiled x ** 2 is that too, but interpreted it is the library's power, which may differ by a bit."""
    return number * number


@compiled
def lennard_jones(distance, spacing, depth):
    """Return the force away from a neighbour, here a velocity: F = (4 eps / x) ((tau / x)^4 - (tau / x)^2), m/s.

    Minus the slope of V(x) = eps ((tau / x)^4 - 2 (tau / x)^2), which is lowest, -eps, at x = tau. This is equation 2
    with a = 4, b = 2 and the exponents put right.

    Args:
        distance: x, m.
        spacing: tau, m.
        depth: eps, m2/s; the paper's 10^6 cm2/s are 100 m2/s.
    """
    square = squared(spacing / distance)
    return 4.0 * depth / distance * (square * square - square)


@compiled
def lennard_jones_printed(distance, spacing, depth):
    """Return equation 2 as it is printed: F = eps ((a tau^a / x^(a+1))^a - 2 (b tau / x^(b+1))^b), m/s away.

    In centimetres, the unit of the paper's numbers: the printed powers depend on it. Nowhere near tau does it change
    its sign, so it only pushes.
    """
    x = distance * CENTIMETRES
    tau = spacing * CENTIMETRES
    first = 4.0 * squared(squared(tau)) / (x * squared(squared(x)))
    second = 2.0 * tau / (x * squared(x))
    return depth * squared(CENTIMETRES) * (squared(squared(first)) - 2.0 * squared(second)) / CENTIMETRES


@compiled
def smooth_depth(rate, spacing):
    """Return the depth at which the force near tau is rate (x - tau): V'' = 8 eps / tau^2."""
    return rate * spacing * spacing / 8.0


@compiled
def saturated(speed, limit):
    """Return a speed that nears its limit smoothly, m/s."""
    return limit * math.tanh(speed / limit)
