"""Milled threads: every stroke keeps the pitch, and the cutter keeps off what it must not cut."""

from __future__ import annotations

from math import hypot, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.milling.stroke import Place
from polycnc.cycles.milling.thread import ToothedThread, mill_with_teeth
from polycnc.geometry import arcs
from polycnc.toolpath import Kind


@given(
    st.integers(1, 6),
    st.floats(0.5, 4.0),
    st.floats(1.0, 30.0),
    st.booleans(),
    st.booleans(),
    st.booleans(),
)
def test_turns_keep_pitch_and_radius_and_reach_all_of_the_thread(
    teeth: int, lead: float, length: float, rises: bool, ccw: bool, inside: bool
) -> None:
    thread = ToothedThread(
        Place((10.0, 5.0)),
        [8.0, 9.0] if inside else [21.0, 20.0],
        lead,
        teeth,
        0.0,
        -length,
        rises,
        ccw,
        0.0 if inside else 30.0,
        100.0,
        2.0,
        50.0,
    )
    at, w = (0.0, 0.0), 50.0
    cut: list[tuple[float, float]] = []
    for stroke in mill_with_teeth(thread):
        point, level = stroke.point or at, w if stroke.w is None else stroke.w
        if stroke.kind is Kind.RAPID:
            # In the plane the cutter goes at the height of the start alone, in depth beside the thread.
            assert stroke.point is None or w == 50.0
        else:
            assert stroke.center is not None
            sweep = abs(arcs.sweep_angle(at, point, stroke.center, stroke.kind is Kind.CCW))
            assert abs(level - w) == pytest.approx(lead * sweep / (2.0 * pi))
            assert (level > w) is rises
            for part in range(9):
                middle = arcs.point_on_arc(at, point, stroke.center, stroke.kind is Kind.CCW, part / 8)
                away = hypot(middle[0] - 10.0, middle[1] - 5.0)
                assert away <= 9.0 + 1e-9 if inside else away >= 20.0 - 1e-9
            if stroke.center == (10.0, 5.0):
                assert (stroke.kind is Kind.CCW) is ccw
                cut.append((min(w, level), max(w, level) + (teeth - 1) * lead))
        at, w = point, level
    # Each tooth cuts the pitch that its turn goes through.
    assert min(low for low, _ in cut) == pytest.approx(-length)
    reached = -length
    for low, high in sorted(cut):
        assert low <= reached + 1e-6
        reached = max(reached, high)
    assert reached >= -1e-6
