"""Threads take the revolutions that their leads need."""

from __future__ import annotations

from math import sqrt

import pytest

from tests.control.fanuc.lathe.support import alarms, run


def turns(block: str) -> float:
    """Revolutions that a thread of 48 mm makes, at 30 a minute, where acceleration counts for little."""
    result = run(f"G97 S30 M3\nG0 X40. Z0\n{block}\nM30")
    assert alarms(result) == []
    return result.plan.times.cutting_s * 0.5


def test_a_constant_lead_counts_along_the_long_axis() -> None:
    assert turns("G32 X80. Z-48. F2.") == pytest.approx(24.0, rel=0.01)
    assert turns("G32 X136. Z-20. F2.") == pytest.approx(24.0, rel=0.01)


def test_a_growing_lead_needs_fewer_revolutions() -> None:
    # Leads from 2 to sqrt(2² + 2·1·48) = 10 mm.
    assert turns("G34 Z-48. F2. K1.") == pytest.approx(8.0, rel=0.01)


def test_a_shrinking_lead_needs_more_revolutions() -> None:
    last = sqrt(4.0**2 - 2.0 * 0.1 * 48.0)
    assert turns("G34 Z-48. F4. K-0.1") == pytest.approx((4.0 - last) / 0.1, rel=0.01)
