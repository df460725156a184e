"""Undercuts by DIN 509 and DIN 76."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, radians, tan

import pytest

from polycnc.cycles.turning import undercut
from polycnc.cycles.turning.groove import GrooveError
from polycnc.geometry import arcs, offset


@pytest.mark.parametrize("diameter", [4.0, 12.0, 40.0, 100.0])
@pytest.mark.parametrize("form", ["E", "F"])
def test_undercuts_of_shafts_run_smoothly_from_the_cylinder_to_the_shoulder(
    form: str, diameter: float
) -> None:
    shape = undercut.of_shaft(form, diameter)
    edges = [piece.edge for piece in undercut.contour(shape, None if form == "F" else 2.0)]
    assert edges[0].start == (shape.width, 0.0)
    assert edges[-1].end[0] == pytest.approx(0.0)
    for a, b in pairwise(edges):
        assert b.start == pytest.approx(a.end)
        assert offset.turn(a, b) == pytest.approx(0.0, abs=1e-6)
    assert max(edge.end[1] for edge in edges) == pytest.approx(shape.depth)
    assert [
        arcs.radius_of(edge.center, edge.end) for edge in edges if edge.center is not None
    ] == pytest.approx([shape.radius] * 2)


@pytest.mark.parametrize(
    ("diameter", "height"), [(8.0, 1.1), (12.0, 1.4), (40.0, 2.1), (100.0, 3.2)], ids=str
)
def test_the_face_of_form_f_is_as_deep_and_as_high_as_the_standard_has_it(
    diameter: float, height: float
) -> None:
    shape = undercut.of_shaft("F", diameter)
    edges = [piece.edge for piece in undercut.contour(shape, None)]
    rounding = edges[-2]
    assert rounding.center is not None
    assert rounding.center[0] - arcs.radius_of(rounding.center, rounding.end) == pytest.approx(-shape.face)
    assert shape.depth - edges[-1].end[1] == pytest.approx(height, abs=0.06)


@pytest.mark.parametrize("form", "ABCD")
def test_undercuts_of_threads_fit_their_width(form: str) -> None:
    for nominal in undercut.PITCHES:
        found = undercut.of_thread(form, nominal)
        assert found is not None
        shape, surface = found
        edges = [piece.edge for piece in undercut.contour(shape, 2.0)]
        assert edges[-1].end == pytest.approx((0.0, -2.0))
        assert sum(hypot(*arcs.minus(edge.end, edge.start)) for edge in edges) > shape.width
        assert shape.width > shape.depth / tan(radians(shape.slope_deg)) + shape.radius
        base = surface + (shape.depth if form in undercut.INSIDE else -shape.depth)
        assert (base > 0.5 * nominal) is (form in undercut.INSIDE)


@pytest.mark.parametrize("form", "ABCD")
def test_every_pitch_of_the_standard_fits_its_width(form: str) -> None:
    for pitch in undercut.THREADS:
        shape, _ = undercut.of_pitch(form, 20.0, pitch)
        edges = [piece.edge for piece in undercut.contour(shape, 2.0)]
        assert edges[0].start == (shape.width, 0.0)
        for a, b in pairwise(edges):
            assert offset.turn(a, b) == pytest.approx(0.0, abs=1e-6)


def test_finer_pitches_have_smaller_undercuts() -> None:
    rows = [undercut.THREADS[pitch] for pitch in sorted(undercut.THREADS)]
    for finer, coarser in pairwise(rows):
        assert all(a <= b for a, b in zip(finer[:3], coarser[:3], strict=True))
        assert all(a < b for a, b in zip(finer[3], coarser[3], strict=True))


def test_an_undercut_under_stock_for_grinding_is_the_same_below_the_finished_surfaces() -> None:
    """The slopes are led on up to the stock; what grinding leaves is the undercut of the standard."""
    plain = undercut.of_shaft("F", 40.0)
    under = plain._replace(stock=0.3, face_stock=0.2)
    finished = [piece.edge for piece in undercut.contour(plain, None)]
    raw = [piece.edge for piece in undercut.contour(under, None)]
    assert raw[0].start == pytest.approx((plain.width + 0.3 / tan(radians(15.0)), -0.3))
    assert raw[-1].end[0] == pytest.approx(0.2)
    for a, b in ((finished[0], raw[0]), (finished[-1], raw[-1])):
        assert a.departing == pytest.approx(b.departing)
        assert offset.turn(offset.line(a.start, b.end), offset.line(a.start, a.end)) == pytest.approx(
            0.0, abs=1e-9
        )
    assert [edge.center for edge in finished[1:-1]] == [edge.center for edge in raw[1:-1]]


def test_slopes_and_corners_that_do_not_fit_are_refused() -> None:
    for shape in (
        undercut.Undercut(2.0, 2.0, 0.0, 30.0),
        undercut.Undercut(4.0, 2.0, 3.0, 45.0),
        undercut.Undercut(4.0, 2.0, 0.0, 45.0, corner=3.0),
    ):
        with pytest.raises(GrooveError):
            undercut.contour(shape, 1.0)


def test_a_thread_that_has_no_coarse_pitch_has_no_undercut() -> None:
    assert undercut.of_thread("A", 7.0) is None
    assert undercut.of_thread("A", 12.5) is None
