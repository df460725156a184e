"""CYCLE951: corners whose sides slope, cut in stock that is looked at all the time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.control.sinumerik.support import codes, run

if TYPE_CHECKING:
    from numpy.typing import NDArray

START = (0.0, 25.0)
END = (-30.0, 10.0)


def way(middle: tuple[float, float], vari: int, depth: float) -> list[tuple[str, float, float]]:
    """Moves (type, Z, radius) of a corner from Z0 X50 to Z-30 X20 without nose and allowances."""
    call = f"CYCLE951(50,0,20,-30,{2 * middle[1]},{middle[0]},1,{depth},0,0,{vari},0,0,0,1,0.2,2,2,0)"
    tools = {1: {"type": 500, "radius": 0, "tip": 3}}
    result = run("G18 G90 DIAMON G95", "T1 D1", "G0 X80 Z10", call, machine="lathe2", tools=tools)
    assert codes(result) == []
    moves: list[Any] = [row for row in result.rows if row["type"] in ("rapid", "feed") and "to" in row]
    return [(row["type"], row["to"]["Z"], 0.5 * row["to"]["X"]) for row in moves]


def finished(middle: tuple[float, float], z: NDArray[np.float64]) -> NDArray[np.float64]:
    """The radius of the part at a place."""
    places = [END[0], middle[0], START[0]]
    return np.interp(z, places, [START[1], middle[1], END[1]])


@settings(max_examples=12)
@given(
    st.tuples(st.floats(-29.9, -0.5), st.floats(10.1, 24.5)),
    st.sampled_from((1, 2)),
    st.floats(1.0, 6.0),
)
def test_a_slanted_corner_is_cut_to_its_sides_and_no_rapid_meets_stock(
    middle: tuple[float, float], direction: int, depth: float
) -> None:
    middle = (round(middle[0], 3), round(middle[1], 3))
    across = direction == 2
    # Stock over a grid along the cuts: heights are radii, or places along Z.
    grid = np.linspace(END[1], START[1], 601) if across else np.linspace(END[0], START[0], 601)
    rest = np.full_like(grid, START[0] if across else START[1])
    moves = way(middle, 20 + direction if depth > 5.9 else 10 + direction, depth)
    at = moves[0][1:]
    for kind, *end in moves[1:]:
        z, x = (np.linspace(a, b, 60) for a, b in zip(at, end, strict=True))
        within = (z < START[0]) & (z > END[0]) & (x < START[1])
        assert np.all((x >= finished(middle, z) - 1e-3)[within])
        rest = _cut(grid, rest, at, (end[0], end[1]), across=across, is_rapid=kind == "rapid")
        at = (end[0], end[1])
    assert at == pytest.approx((1.0, 26.0))
    if not across:
        assert (
            np.count_nonzero(rest > finished(middle, grid) + 0.06) <= 4
        )  # the grid is coarse beside the corner


def _cut(
    grid: NDArray[np.float64],
    rest: NDArray[np.float64],
    start: tuple[float, ...],
    end: tuple[float, float],
    *,
    across: bool,
    is_rapid: bool,
) -> NDArray[np.float64]:
    """What a stroke leaves of the stock; a rapid must not take any."""
    (along0, deep0), (along1, deep1) = ((p[1], p[0]) if across else (p[0], p[1]) for p in (start, end))
    low, high = sorted((along0, along1))
    inside = (grid > low + 1e-9) & (grid < high - 1e-9)
    if not inside.any():
        return rest
    depth = deep0 + (grid - along0) / (along1 - along0) * (deep1 - deep0)
    if is_rapid:
        assert np.all(depth[inside] >= rest[inside] - 1e-6)
    return np.where(inside, np.minimum(rest, depth), rest)
