"""CYCLE940: undercuts of every form in stock that is looked at all the time."""

from __future__ import annotations

from math import radians, tan
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.control.sinumerik.support import codes, run

if TYPE_CHECKING:
    from numpy.typing import NDArray

#: By _LAGE: position of the cutting edge, which way the cylinder lies from the shoulder, and the infeed.
PLACES = {0: (4, -1.0, -1.0), 1: (3, 1.0, -1.0), 2: (1, -1.0, 1.0), 3: (2, 1.0, 1.0)}
SURFACE, SHOULDER = 20.0, -50.0


class Part:
    """A cylinder in front of a shoulder: heights above its surface, over places in front of the shoulder."""

    def __init__(self, lage: int, width: float, depth: float, angle: float) -> None:
        _, self.onwards, self.towards = PLACES[lage]
        self.places = np.linspace(0.0, width + 3.0, 400)
        self.rest = np.zeros_like(self.places)
        self.width, self.depth, self.slope = width, depth, tan(radians(angle))

    def of(self, row: Any) -> tuple[float, float]:
        """A row as place and depth."""
        z, x = row["to"]["Z"], 0.5 * row["to"]["X"]
        return self.onwards * (z - SHOULDER), self.towards * (x - SURFACE)

    def finished(self, place: NDArray[np.float64]) -> NDArray[np.float64]:
        """The undercut with sharp corners, which no cut passes; an upright side may be met at its very place."""
        return np.clip((self.width + 1e-9 - place) * self.slope, 0.0, self.depth)

    def stroke(self, start: tuple[float, float], end: tuple[float, float], *, is_rapid: bool) -> None:
        """A stroke of the tool's point."""
        a, t = (np.linspace(p, q, 80) for p, q in zip(start, end, strict=True))
        assert np.all(a >= -1e-6)
        assert np.all(t <= self.finished(a) + 1e-4)
        low, high = sorted((start[0], end[0]))
        inside = (self.places > low + 1e-9) & (self.places < high - 1e-9)
        if inside.any():
            depth = start[1] + (self.places - start[0]) / (end[0] - start[0]) * (end[1] - start[1])
            if is_rapid:
                assert np.all(depth[inside] <= self.rest[inside] + 1e-4)
            self.rest = np.where(inside, np.maximum(self.rest, depth), self.rest)


@settings(max_examples=15)
@example(0, (1.0, 90.0, 0.0, 0.0), 2.0, 1, (1.0, 0.0))
@given(
    st.sampled_from(sorted(PLACES)),
    st.tuples(st.floats(0.5, 4.0), st.floats(20.0, 90.0), st.floats(0.0, 0.5), st.floats(0.0, 0.5)),
    st.floats(1.5, 6.0),
    st.sampled_from((1, 2, 3, 11, 13)),
    st.tuples(st.floats(0.3, 2.0), st.floats(0.0, 0.2)),
)
def test_the_free_form_is_cut_to_its_sides_and_no_rapid_meets_stock(
    lage: int, shape: tuple[float, ...], base: float, vari: int, how: tuple[float, float]
) -> None:
    depth, angle, first, second = (round(value, 3) for value in shape)
    width = round(base + depth / tan(radians(angle)), 3)
    call = (
        f'CYCLE940(40,-50,"T",{lage},1,0.1,{vari},{depth},{width},{first},{second},{angle},0,{how[0]:.3f},0,'
        f"{how[1]:.3f},{how[1]:.3f},,,,2,111)"
    )
    start = "G0 X60 Z-30" if PLACES[lage][2] < 0.0 else "G0 X10 Z-30"
    tools = {1: {"type": 510, "radius": 0, "tip": PLACES[lage][0]}}
    result = run("G18 G90 DIAMON G95", "T1 D1", start, call, machine="lathe2", tools=tools)
    assert codes(result) == []
    part = Part(lage, width, depth, angle)
    rows = [row for row in result.rows if row["type"] in ("rapid", "feed", "cw", "ccw") and "to" in row][1:]
    at = part.of(rows[0])
    for row in rows[1:]:
        end = part.of(row)
        if row["type"] in ("rapid", "feed"):
            part.stroke(at, end, is_rapid=row["type"] == "rapid")
        at = end
    assert at == pytest.approx((width + 1.0, -1.0), abs=1e-3)
    if vari % 10 != 1:
        middle = (part.places > second + 0.1) & (part.places < base - first - 0.1)
        assert np.all(part.rest[middle] >= depth - 1e-3)
