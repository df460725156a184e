"""Polynomials of one parameter, as their coefficients from the lowest power on."""

from __future__ import annotations

from itertools import pairwise

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

Coefficients = tuple[float, ...]
#: Highest degree of a fitted polynomial, and the parameters at which it is equal to what it is fitted to.
DEGREE = 5
NODES = tuple(k / DEGREE for k in range(DEGREE + 1))
#: A coefficient that is smaller than this part of the largest one is rounding.
_ROUNDING = 1e-12
_HALVINGS = 80


def value(coefficients: Sequence[float], p: float) -> float:
    """The value at a parameter."""
    result = 0.0
    for coefficient in reversed(coefficients):
        result = result * p + coefficient
    return result


def derivative(coefficients: Sequence[float]) -> Coefficients:
    """The derivative after the parameter."""
    return tuple(power * coefficient for power, coefficient in enumerate(coefficients))[1:] or (0.0,)


def fitted(values: Sequence[float]) -> Coefficients:
    """The polynomial of degree 5 at most through six values, which it has at `NODES`; without powers of rounding."""
    steps, differences = list(values), []
    while steps:
        differences.append(steps[0])
        steps = [b - a for a, b in pairwise(steps)]
    # Newton's form in 5·p: sum of difference k times (s over k).
    result = [0.0] * (DEGREE + 1)
    term = [1.0]
    for k, difference in enumerate(differences):
        for power, coefficient in enumerate(term):
            result[power] += difference * coefficient
        # times (5·p - k) / (k + 1)
        grown = [0.0] * (len(term) + 1)
        for power, coefficient in enumerate(term):
            grown[power] -= coefficient * k / (k + 1)
            grown[power + 1] += coefficient * DEGREE / (k + 1)
        term = grown
    return trimmed(result)


def trimmed(coefficients: Sequence[float]) -> Coefficients:
    """The same without powers that are only rounding."""
    largest = max(map(abs, coefficients))
    count = len(coefficients)
    while count > 1 and abs(coefficients[count - 1]) <= 1e3 * _ROUNDING * largest:
        count -= 1
    return tuple(coefficients[:count])


def turns(coefficients: Sequence[float]) -> list[float]:
    """The parameters between 0 and 1 at which a polynomial turns from growing to shrinking, or back; in order."""
    if len(coefficients) <= 2:
        return []
    slope = derivative(coefficients)
    return [p for p in roots(slope) if 0.0 < p < 1.0]


def roots(coefficients: Sequence[float]) -> list[float]:
    """The parameters from 0 to 1 at which a polynomial is zero, in order; none of one that is zero everywhere."""
    if len(coefficients) <= 1:
        return []
    borders = [0.0, *turns(coefficients), 1.0]
    slack = _ROUNDING * max(map(abs, coefficients))
    found: list[float] = []
    for low, high in pairwise(borders):
        at_low, at_high = value(coefficients, low), value(coefficients, high)
        if abs(at_low) <= slack:
            found.append(low)
        elif abs(at_high) > slack and (at_low < 0.0) != (at_high < 0.0):
            found.append(_between(coefficients, low, high))
    if abs(value(coefficients, 1.0)) <= slack:
        found.append(1.0)
    return found


def solved(coefficients: Sequence[float], wanted: float) -> float:
    """The parameter at which a polynomial that only grows, or only shrinks, has a value; held at 0 and 1."""
    first, last = coefficients[0], sum(coefficients)
    if (wanted - first) * (last - first) <= 0.0:
        return 0.0
    if abs(wanted - first) >= abs(last - first):
        return 1.0
    if len(coefficients) == 2:
        return (wanted - first) / coefficients[1]
    return _between((first - wanted, *coefficients[1:]), 0.0, 1.0)


def _between(coefficients: Sequence[float], low: float, high: float) -> float:
    below = value(coefficients, low) < 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if (value(coefficients, middle) < 0.0) == below:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
