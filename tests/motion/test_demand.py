"""Rows of a tip are bounded as each of them is alone, to the bit, however they are cut into chunks."""

from __future__ import annotations

from math import nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.geometry.frames import rotation
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.motion import Settings
from polycnc.motion.planner import Planner
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from tests.examples import examples
from tests.motion.paths import Build

HEAD = load_machine("mill5-bc-head")
AXES = HEAD.channel_axes(1)
ROW = st.tuples(
    st.sampled_from([Kind.FEED, Kind.FEED, Kind.FEED, Kind.RAPID, Kind.DWELL]),
    *[st.floats(-30.0, 30.0)] * 3,
    *[st.floats(-1.0, 1.0) | st.floats(-120.0, 120.0)] * 2,
    st.integers(0, 2),
)


def tip(length: float) -> ToolCentrePoint:
    """Control of the tip of a tool along Z."""
    return ToolCentrePoint(Kinematics.of(HEAD), AXES, (0, 1, 2), (0.0,) * 5, (0.0, 0.0, -length))


@pytest.mark.parametrize("acceleration", [AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED])
@settings(max_examples=examples(15), deadline=None)
@given(st.lists(ROW, min_size=2, max_size=8))
def test_many_rows_are_bounded_as_each_of_them_is(
    acceleration: AccelerationMode, rows: list[tuple[Kind, float, float, float, float, float, int]]
) -> None:
    contexts = (
        Context(transformation=tip(100.0)),
        Context(transformation=tip(100.0), offsets=(1.5, -2.25, 3.1, 0.0, 10.0)),
        Context(transformation=tip(55.5), frame=rotation(2, 33.3), offsets=(0.1, 0.2, 0.3, 0.0, 0.0)),
    )

    def planned(chunk_rows: int) -> bytes:
        build = Build(AXES, chunk_rows=chunk_rows)
        for kind, *end, number in rows:
            build.context = contexts[number]
            build.row(
                kind,
                *end,
                feed=nan if kind is Kind.RAPID else 50.0,
                curve=(0.5, 0.0) if kind is Kind.DWELL else (),
            )
            build.row(Kind.FEED, *end, feed=50.0)
            build.row(Kind.FEED, *(value + 0.01 for value in end), feed=50.0)
        lead = Settings(acceleration=acceleration)
        return Planner(build.toolpath, HEAD, settings=lead).finish().row_s.tobytes()

    assert planned(1) == planned(5) == planned(1000)
