from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from polycnc.transformation.couplings.laws import ByCurve, Ratio


class Parabola:
    """A curve that is none of a table."""

    def followed(self, leading: float) -> tuple[float, float]:
        return leading * leading, 2.0 * leading

    def kinks(self, low: float, high: float) -> Iterable[float]:
        return ()


def test_a_ratio_counts_from_where_it_was_switched_on() -> None:
    law = Ratio(0, -2.0, 10.0)
    assert law.share(13.0) == -6.0
    assert law.share(np.array([10.0, 9.0])).tolist() == [0.0, 2.0]
    assert law.slope(np.array([1.0, 2.0])).tolist() == [-2.0, -2.0]


def test_a_curve_gives_the_place_but_for_its_base() -> None:
    law = ByCurve(0, Parabola(), base=4.0)
    assert (law.share(3.0), law.slope(3.0)) == (5.0, 6.0)
    assert law.share(np.array([0.0, 2.0])).tolist() == [-4.0, 0.0]


@pytest.mark.parametrize(("rises", "expected"), [(True, [0.0, 0.0, 5.0]), (False, [-3.0, 0.0, 0.0])])
def test_a_curve_may_lead_from_some_place_on(rises: bool, expected: list[float]) -> None:
    law = ByCurve(0, Parabola(), base=4.0, from_place=2.0, rises=rises)
    assert law.share(np.array([1.0, 2.0, 3.0])).tolist() == expected
