from __future__ import annotations

import pytest

from polycnc.transformation.couplings.graph import CircularCouplingError, in_order
from polycnc.transformation.couplings.laws import Ratio


def test_followers_come_behind_their_leaders() -> None:
    assert in_order({1: [Ratio(2, 1.0)], 2: [Ratio(4, 1.0), Ratio(0, 1.0)], 4: [Ratio(0, 1.0)]}) == [4, 2, 1]


@pytest.mark.parametrize("links", [{1: 1}, {1: 2, 2: 1}, {1: 2, 2: 3, 3: 1}])
def test_no_axis_leads_itself(links: dict[int, int]) -> None:
    with pytest.raises(CircularCouplingError) as circle:
        in_order({following: [Ratio(leading, 1.0)] for following, leading in links.items()})
    assert circle.value.column in links
