"""The paper's method: equations 1 to 4, on a robot's own three estimates."""

import math

from formicarium.compiled import compiled


@compiled
def logistic(exponent):
    """Return 1 / (1 + exp(-exponent)) without overflow (TP-12)."""
    if exponent >= 0.0:
        return 1.0 / (1.0 + math.exp(-exponent))
    power = math.exp(exponent)
    return power / (1.0 + power)


@compiled
def partition_probability(whole, harvest, store, steepness, least):
    """Return P_p, equation 1, kept ``least`` from 0 and 1.

    1 / (1 + exp(-S (t_NP / (t_1 + t_2) - 1)))  if t_NP > t_1 + t_2,
    1 / (1 + exp(-S (1 - (t_1 + t_2) / t_NP)))  otherwise.
    """
    parts = harvest + store
    advantage = whole / parts - 1.0 if whole > parts else 1.0 - parts / whole
    return min(1.0 - least, max(least, logistic(steepness * advantage)))


@compiled
def renewed(estimate, measured, alpha):
    """Return the estimate after a measurement, equation 2: (1 - alpha) t + alpha t_M."""
    return (1.0 - alpha) * estimate + alpha * measured


@compiled
def giving_up_probability(waited, own, harvest, store, steepness, offset):
    """Return P_g, equations 3 and 4: 1 / (1 + exp(Theta)), Theta = K ((w - t_i) / (t_1 + t_2) + O).

    With K < 0 it grows with the time waited (TP-15).
    """
    return logistic(-steepness * ((waited - own) / (harvest + store) + offset))


@compiled
def steepness_of(strategy, stay):
    """Return S: fixed, or after the robot's own stays in cache booths (TP-O4): S_most / (1 + stay / time)."""
    if strategy.steepness_most > 0.0 and stay >= 0.0:
        return strategy.steepness_most / (1.0 + stay / strategy.steepness_time)
    return strategy.steepness


@compiled
def explored(probability, corridor_age, cache_age, strategy):
    """Return P_p, kept so far from certainty that what was measured long ago is measured again (TP-O5).

    Args:
        probability: P_p of equation 1.
        corridor_age: s since what the corridor leads to was measured.
        cache_age: s since what the cache leads to was.
        strategy: record of StrategyTable.
    """
    if strategy.exploration_age > 0.0:
        if corridor_age > strategy.exploration_age:
            probability = min(probability, 1.0 - strategy.exploration_share)
        if cache_age > strategy.exploration_age:
            probability = max(probability, strategy.exploration_share)
    return probability


@compiled
def blended(own, heard, age, strategy):
    """Return an estimate after hearing a neighbour's, which counts the less the older it is (TP-O3).

    (1 - w) t + w t_heard, w = beta / (1 + age / social_age).
    """
    return renewed(own, heard, strategy.social_weight / (1.0 + age / strategy.social_age))
