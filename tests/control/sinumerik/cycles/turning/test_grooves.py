"""CYCLE93 on slanted contours in all eight seats, in stock that is looked at in the axes of the machine."""

from __future__ import annotations

from math import radians, tan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from polycnc.geometry import arcs
from tests.control.sinumerik.support import codes, run

if TYPE_CHECKING:
    from numpy.typing import NDArray

SPD, SPL = 80.0, -40.0
#: By VARI: along X (a face), the way of the width from the start, the infeed, along the coordinates of the machine.
SEATS = {
    1: (False, 1.0, -1.0), 2: (True, -1.0, 1.0), 3: (False, 1.0, 1.0), 4: (True, 1.0, 1.0),
    5: (False, -1.0, -1.0), 6: (True, -1.0, -1.0), 7: (False, -1.0, 1.0), 8: (True, 1.0, -1.0),
}  # fmt: skip
#: Position of the left or inner edge, by the infeed along X and Z.
TIPS = {(False, -1.0): 3, (False, 1.0): 2, (True, 1.0): 4, (True, -1.0): 3}


class Call(NamedTuple):
    vari: int
    angle: float
    width: float
    depth: float
    walls: tuple[float, float]
    radius: float
    tool: float
    infeed: float


class Groove:
    """The groove of a call as drawn, over places along its axis, and what is left of the stock."""

    def __init__(self, call: Call) -> None:
        self.across, self.onwards, self.inwards = SEATS[call.vari]
        self.tool = call.tool
        self.start = (0.5 * SPD, SPL) if self.across else (SPL, 0.5 * SPD)
        # How the contour goes in the machine, and with it how it goes down for each mm of the groove.
        self.lean = tan(radians(90.0 - call.angle)) if self.across else tan(radians(call.angle))
        slope = self.lean * self.onwards * self.inwards
        first, second = (tan(radians(wall)) for wall in call.walls)
        feet = first * call.depth / (1.0 - slope * first), second * call.depth / (1.0 + slope * second)
        self.top = call.width + sum(feet)
        w = np.linspace(-2.0, self.top + 2.0, 300)
        depth = np.full_like(w, call.depth)
        if first:
            depth = np.minimum(depth, (w / first - slope * w))
        if second:
            depth = np.minimum(depth, (slope * self.top + (self.top - w) / second - slope * w))
        depth = np.where((w > 0.0) & (w < self.top), depth, 0.0)
        self.places = self.start[0] + self.onwards * w
        rim = self.start[1] + self.lean * (self.places - self.start[0])
        # A rounded rim takes more than sharp corners show.
        rounded = np.minimum(np.abs(w), np.abs(w - self.top)) < 2.0 * call.radius
        finished = self.inwards * rim + depth
        order = np.argsort(self.places)
        self.places, self.finished, self.rest = (
            self.places[order],
            finished[order],
            (self.inwards * rim)[order],
        )
        self.bounds = (finished + np.where(rounded, 2.0 * call.radius, 0.0))[order]
        self.middle = self.start[0] + self.onwards * (feet[0] + 0.5 * call.width)

    def of(self, point: dict[str, float]) -> tuple[float, float]:
        """A point of the machine along the groove and into the material."""
        z, x = point["Z"], 0.5 * point["X"]
        return (x, self.inwards * z) if self.across else (z, self.inwards * x)

    def cut(self, way: NDArray[np.float64], *, is_rapid: bool) -> None:
        """A stroke as points of the left or inner edge."""
        low, high = self.places.min() + self.tool, self.places.max() - self.tool
        for along, deep in way:
            if is_rapid and not low < along < high:
                continue
            first, last = np.searchsorted(self.places, (along + 1e-5, along + self.tool - 1e-5))
            bounds = self.rest if is_rapid else self.bounds
            assert np.all(deep <= bounds[first:last] + 1e-4)
            if not is_rapid:
                np.maximum(self.rest[first:last], deep, out=self.rest[first:last])


def rows_of(call: Call) -> list[Any]:
    tip = TIPS[SEATS[call.vari][0], SEATS[call.vari][2]]
    second = f"$TC_DP3[1,2]={call.tool}" if SEATS[call.vari][0] else f"$TC_DP4[1,2]={call.tool}"
    outside = {
        (False, -1.0): "X140 Z-40",
        (False, 1.0): "X20 Z-40",
        (True, 1.0): "X80 Z-100",
        (True, -1.0): "X80 Z40",
    }
    result = run(
        "G18 G90 DIAMON G95 F0.1",
        f"$TC_DP1[1,2]=520 $TC_DP2[1,2]=4 {second}",
        "T1 D1",
        f"G0 {outside[SEATS[call.vari][0], SEATS[call.vari][2]]}",
        f"CYCLE93({SPD},{SPL},{call.width},{call.depth},{call.angle},{call.walls[0]},{call.walls[1]},{call.radius},"
        f"{call.radius},0,0,0,0,{call.infeed},0,{call.vari},0,2)",
        machine="lathe2",
        tools={1: {"type": 520, "radius": 0, "tip": tip, "x": 0, "z": 0}},
    )
    if codes(result) == [("61603", 5)]:
        reject()
    assert codes(result) == []
    return [row for row in result.rows if row["type"] in ("rapid", "feed", "cw", "ccw") and "to" in row]


@settings(max_examples=8)
@given(
    st.builds(
        Call,
        st.sampled_from(sorted(SEATS)),
        st.integers(-30, 30),
        st.sampled_from((4.0, 5.5, 8.0)),
        st.sampled_from((3.0, 5.0)),
        st.tuples(st.sampled_from((0.0, 10.0, 40.0)), st.sampled_from((0.0, 10.0, 40.0))),
        st.sampled_from((0.0, 0.4)),
        st.sampled_from((2.0, 3.0, 4.0)),
        st.sampled_from((0.0, 1.5)),
    )
)
def test_a_slanted_groove_lies_where_the_call_says_in_every_seat(call: Call) -> None:
    call = call._replace(angle=(90.0 + call.angle if SEATS[call.vari][0] else call.angle % 180))
    rows = rows_of(call)
    groove = Groove(call)
    at = groove.of(rows[0]["to"])
    for row in rows[1:]:
        end = groove.of(row["to"])
        if row["type"] in ("cw", "ccw"):
            # Between its ends an arc of a rim stays on the side of the material that both of them have.
            center = groove.of(row["center"])
            assert arcs.radius_of(center, at) - arcs.radius_of(center, end) < 1e-6
        elif at[0] == end[0]:
            groove.cut(np.array([end]), is_rapid=row["type"] == "rapid")
        else:
            parts = np.linspace(0.0, 1.0, 20)[:, None]
            groove.cut(np.array(at) + parts * (np.array(end) - np.array(at)), is_rapid=row["type"] == "rapid")
        at = end
    middle = np.abs(groove.places - groove.middle) < 0.1
    assert np.all(groove.rest[middle] >= groove.finished[middle] - call.tool * abs(groove.lean) - 1e-3)
