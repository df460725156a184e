"""The data type FRAME: chains, components, and what is read back."""

from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame, cfine, cmirror, crot, cscale, ctrans

SHIFTS = st.floats(-500.0, 500.0)
ANGLES = st.floats(-179.0, 179.0)
FACTORS = st.floats(0.1, 5.0)


@st.composite
def frames(draw: st.DrawFn) -> NcFrame:
    """Frames of all elementary kinds, chained; one scale for all axes, so that components exist."""
    factor = draw(FACTORS)
    shift = ctrans({"X": draw(SHIFTS), "Y": draw(SHIFTS), "A": draw(SHIFTS)})
    turn = crot({"X": draw(ANGLES), "Y": draw(st.floats(-89.0, 89.0)), "Z": draw(ANGLES)})
    mirror = cmirror(draw(st.sets(st.sampled_from("XYZ"))))
    return shift @ cfine({"Z": draw(SHIFTS)}) @ turn @ cscale(dict.fromkeys("XYZ", factor)) @ mirror


@given(frames(), frames(), st.tuples(SHIFTS, SHIFTS, SHIFTS))
def test_a_chain_maps_as_its_parts_one_after_the_other(
    outer: NcFrame, inner: NcFrame, point: tuple[float, float, float]
) -> None:
    chained = (outer @ inner).frame.apply(*point)
    assert chained == pytest.approx(outer.frame.apply(*inner.frame.apply(*point)), rel=1e-9, abs=1e-6)


@given(frames(), st.tuples(SHIFTS, SHIFTS, SHIFTS))
def test_the_inverse_undoes_the_frame(frame: NcFrame, point: tuple[float, float, float]) -> None:
    there = frame.frame.apply(*point)
    assert frame.inverse().frame.apply(*there) == pytest.approx(point, abs=1e-6)


@given(frames())
def test_the_components_make_the_frame_again(frame: NcFrame) -> None:
    again = NEUTRAL
    for component in ("TR", "FI", "SC", "MI"):
        for axis in ("X", "Y", "Z", "A"):
            again = again.with_component(axis, component, frame.component(axis, component))
    again = ctrans({}) @ again
    turned = crot({axis: frame.component(axis, "RT") for axis in "XYZ"})
    for i, row in enumerate((turned @ NcFrame(matrix=again.matrix)).matrix):
        assert row == pytest.approx(frame.matrix[i], abs=1e-6)
    assert again.coarse == pytest.approx(frame.coarse)
    assert again.others["A"].coarse == pytest.approx(frame.others["A"].coarse)


@given(ANGLES, st.floats(-89.0, 89.0), ANGLES)
def test_angles_are_read_back_as_written(x: float, y: float, z: float) -> None:
    assert crot({"X": x, "Y": y, "Z": z}).angles == pytest.approx((x, y, z), abs=1e-6)


def test_a_mirror_after_a_rotation_keeps_both() -> None:
    frame = crot({"Z": 30.0}) @ cmirror(["X"])
    assert frame.component("Z", "RT") == pytest.approx(30.0)
    assert (frame.component("X", "MI"), frame.component("Y", "MI")) == (1.0, 0.0)


@given(frames(), SHIFTS)
def test_writing_a_component_changes_no_other(frame: NcFrame, value: float) -> None:
    assume(abs(value) < 80.0)
    changed = frame.with_component("Y", "RT", value)
    assert changed.component("Y", "RT") == pytest.approx(value, abs=1e-6)
    assert changed.component("X", "RT") == pytest.approx(frame.component("X", "RT"), abs=1e-6)
    assert changed.coarse == frame.coarse
    assert changed.mirrored == frame.mirrored


def test_a_rotation_of_an_axis_outside_the_geometry_is_refused() -> None:
    with pytest.raises(ValueError, match="geometry"):
        crot({"A": 5.0})
    with pytest.raises(ValueError, match="zero"):
        cscale({"X": 0.0})


def test_folding_adds_the_fine_part() -> None:
    frame = (ctrans({"X": 10.0, "A": 1.0}) @ cfine({"X": 0.1, "A": 0.2})).folded()
    assert frame.component("X", "TR") == pytest.approx(10.1)
    assert frame.component("X", "FI") == 0.0
    assert frame.component("A", "TR") == pytest.approx(1.2)
