from __future__ import annotations

import pytest

from polycnc.geometry.frames import rotation
from polycnc.transformation.couplings.coupled import Coupled, Shown
from polycnc.transformation.couplings.laws import Ratio
from polycnc.transformation.seated import Seated

CHAIN = Coupled.of({3: [Ratio(1, 2.0, 5.0), Ratio(0, 1.0)], 4: [Ratio(3, -1.0)]}, (0, 1, 2))


def test_shares_go_from_axis_to_axis() -> None:
    assert CHAIN.to_machine([1.0, 6.0, 0.0, 10.0, 0.5]) == [1.0, 6.0, 0.0, 13.0, -12.5]
    assert CHAIN.to_work([1.0, 6.0, 0.0, 13.0, -12.5]) == [1.0, 6.0, 0.0, 10.0, 0.5]
    assert CHAIN.jacobian([0.0] * 5)[4] == [-1.0, -2.0, 0.0, -1.0, 1.0]


def test_what_is_shown_holds_the_shares_and_lies_behind_the_frame() -> None:
    led = Seated(CHAIN, rotation(2, 90.0))
    shown = Shown(led, Seated(Coupled((), (0, 1, 2)), rotation(2, 90.0)))
    own = [1.0, 0.0, 0.0, 0.0, 0.0]  # X of the work is Y of the machine
    assert shown.to_work(own) == pytest.approx([1.0, 0.0, 0.0, -8.0, 8.0])
    assert shown.to_machine(shown.to_work(own)) == pytest.approx(own)
    assert shown.geometry == (0, 1, 2)
