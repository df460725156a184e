from __future__ import annotations

import re
from xml.etree import ElementTree

from polycnc.toolpath.plot import RAPID_COLOUR, TOOL_COLOURS, VIEWS, AxisLabel, svg
from polycnc.toolpath.strokes import Stroke

SVG = "{http://www.w3.org/2000/svg}"


def drawing(*strokes: Stroke, view: str = "xy", title: str = "part") -> ElementTree.Element:
    return ElementTree.fromstring(svg(strokes, VIEWS[view], title))


def paths(root: ElementTree.Element, colour: str) -> list[str]:
    return [path.get("d", "") for path in root.iter(f"{SVG}path") if path.get("stroke") == colour]


def ends(path: str) -> list[tuple[float, float]]:
    pairs = re.findall(r"(-?[\d.]+),(-?[\d.]+)", path)
    return [(float(x), float(y)) for x, y in pairs]


CUT = Stroke("T1", rapid=False, points=[(0, 0, 0), (100, 50, 0)])
FAST = Stroke("T1", rapid=True, points=[(0, 0, 50), (0, 0, 0)])


def test_x_points_right_and_y_points_up() -> None:
    (path,) = [p for p in paths(drawing(CUT), TOOL_COLOURS[0]) if len(ends(p)) == 2]
    (x0, y0), (x1, y1) = ends(path)
    assert x1 > x0
    assert y1 < y0
    assert (x1 - x0) / (y0 - y1) == 2.0


def test_rapids_are_dashed_and_feeds_are_not() -> None:
    root = drawing(CUT, FAST, view="xz")
    for path in root.iter(f"{SVG}path"):
        if path.get("fill") == "none":
            assert (path.get("stroke-dasharray") is not None) == (path.get("stroke") == RAPID_COLOUR)
    assert len(paths(root, RAPID_COLOUR)) == 2  # the stroke, and its line in the legend


def test_each_tool_has_a_colour_and_a_line_in_the_legend() -> None:
    root = drawing(CUT, Stroke("DRILL", rapid=False, points=[(0, 0, 0), (5, 5, 0)]))
    assert paths(root, TOOL_COLOURS[1])
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert "T1" in texts
    assert "DRILL" in texts


def test_three_views_share_one_scale() -> None:
    root = drawing(CUT, FAST, view="three")
    groups = {group.get("id"): group for group in root.iter(f"{SVG}g") if group.get("id")}
    assert set(groups) == {"view-xy", "view-xz", "view-yz"}
    widths = {}
    for name in ("view-xy", "view-xz"):
        (path,) = [
            p.get("d", "") for p in groups[name].iter(f"{SVG}path") if p.get("stroke") == TOOL_COLOURS[0]
        ]
        points = ends(path)
        widths[name] = points[1][0] - points[0][0]
    assert widths["view-xy"] == widths["view-xz"]


def test_axes_are_named_with_their_unit() -> None:
    texts = [text.text for text in drawing(CUT, view="zx").iter(f"{SVG}text")]
    assert "Z (mm)" in texts
    assert "X (mm)" in texts


def test_diameter_axes_are_labelled_and_numbered_in_diameters() -> None:
    labels = (AxisLabel("X", 2.0), AxisLabel("Y"), AxisLabel("Z"))
    stroke = Stroke("T1", rapid=False, points=[(0, 0, 0), (50, 0, 100)])
    root = ElementTree.fromstring(svg([stroke], VIEWS["zx"], "shaft", labels))
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert "X ⌀ (mm)" in texts
    assert texts.count("100") == 2  # Z 100, and the diameter of 100 that is drawn 50 high


def test_the_drawing_is_fitted_around_the_cutting() -> None:
    home = Stroke("T1", rapid=True, points=[(100, 50, 0), (9000, 9000, 9000)])
    (near,) = [p for p in paths(drawing(CUT), TOOL_COLOURS[0]) if len(ends(p)) == 2]
    (far,) = [p for p in paths(drawing(CUT, home), TOOL_COLOURS[0]) if len(ends(p)) == 2]
    assert near == far


def test_a_title_with_special_characters_stays_readable_xml() -> None:
    root = drawing(CUT, title="<a & b>")
    assert "<a & b>" in [text.text for text in root.iter(f"{SVG}text")]


def test_a_path_without_motion_is_drawn_empty() -> None:
    root = drawing()
    assert root.tag == f"{SVG}svg"


def test_points_that_nobody_could_tell_apart_are_left_out() -> None:
    points = [(k / 1000, 0.0, 0.0) for k in range(100_001)]
    path = max(paths(drawing(Stroke("T1", rapid=False, points=points)), TOOL_COLOURS[0]), key=len)
    assert 1000 < len(ends(path)) < 5000 + 2
    assert len(ends(path)) < len(points)


HOLES = (
    Stroke("T2", rapid=False, points=[(10, 10, 2), (10, 10, -8)]),
    Stroke("T2", rapid=False, points=[(90, 40, 2), (90, 40, -8)]),
)


def test_a_drilled_hole_is_a_circle_where_it_is_seen_along_the_drill() -> None:
    root = drawing(CUT, *HOLES, HOLES[0], view="xy")
    circles = list(root.iter(f"{SVG}circle"))
    assert len(circles) == 2
    assert {circle.get("stroke") for circle in circles} == {TOOL_COLOURS[1]}
    assert list(drawing(CUT, *HOLES, view="xz").iter(f"{SVG}circle")) == []


def test_a_rapid_along_the_view_is_no_hole() -> None:
    assert list(drawing(CUT, FAST, view="xy").iter(f"{SVG}circle")) == []
