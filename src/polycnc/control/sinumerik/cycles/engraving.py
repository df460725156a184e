"""Engraving: CYCLE60 (strokes: `polycnc.cycles.milling.engraving`)."""

from __future__ import annotations

import re
from math import radians

from polycnc.control.sinumerik.cycles.levels import levels
from polycnc.control.sinumerik.cycles.milling import check_start_point, feed_of, perform
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.milling.engraving import Circle, Inscription, Line, gap_of_width, strokes
from polycnc.cycles.milling.letters import drawn
from polycnc.cycles.milling.stroke import Place
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: Digits of _VARI from the right: points by radius and angle; line or circle; where the reference point lies along the
#: text and across it; what _DF is; the centre by radius and angle; mirrored.
POLAR, SHAPE, ALONG, ACROSS, SIZE, POLAR_CENTER, MIRRORED = 0, 1, 3, 4, 5, 6, 7
ON_A_LINE, OUTSIDE, INSIDE = 0, 1, 2
GAP, WHOLE_WIDTH, OPENING = 0, 1, 2
#: The last digit: 0 is that of older calls.
ON, OFF = 1, 2
#: What the control writes instead of it: date, time, counts, variables, line ends.
_WRITTEN_BY_CONTROL = re.compile(r"<[^<>]+>")
#: Parts of the text before its reference point: it is left, in the middle, right; below, in the middle, above.
_BEFORE = (0.0, 0.5, 1.0)


def _is_known(shape: int, size: int) -> bool:
    """Whether _VARI names a shape, and _DF is a size that this has."""
    sizes = (GAP, WHOLE_WIDTH) if shape == ON_A_LINE else (GAP, OPENING)
    return shape in (ON_A_LINE, OUTSIDE, INSIDE) and size in sizes


def engrave(moves: Moves, a: Arguments) -> None:
    """CYCLE60: engrave a text of height _WID on a line or along a circle.

    Raises:
        AlarmError: 61000 without tool offset, 61002 for _VARI, 61003 without feeds, 61118 for a text without height;
            PC0001 for a letter that is not drawn, for date, time, counts and variables, and for a mere start point.
    """
    require_tool(moves)
    check_start_point(a)
    shape, size = a.digit("_VARI", SHAPE), a.digit("_VARI", SIZE)
    along, across = a.digit("_VARI", ALONG), a.digit("_VARI", ACROSS)
    if not _is_known(shape, size) or max(along, across) >= len(_BEFORE):
        raise AlarmError("61002")
    if a.digit("_VARI", POLAR) > 1 or a.digit("_VARI", POLAR_CENTER) > 1 or a.digit("_VARI", MIRRORED) > OFF:
        raise AlarmError("61002")
    text, height = a.text("_TEXT"), abs(a["_WID"])
    written = _WRITTEN_BY_CONTROL.search(text)
    missing = written[0] if written else next((letter for letter in text if drawn(letter) is None), "")
    if missing:
        raise not_supported(f"CYCLE60 {missing}")
    found = levels(moves, a)
    if found is None or not text.strip():
        return
    if not height:
        raise AlarmError("61118")
    start = _point(a, "_PA", "_PO", POLAR)
    path: Line | Circle = Line(Place(start, a["_STA"]))
    if shape != ON_A_LINE:
        path = Circle(_point(a, "_CP1", "_CP2", POLAR_CENTER), start, inwards=shape == INSIDE)
        if path.radius <= NO_WAY or (shape == INSIDE and path.radius <= height):
            raise AlarmError("61118")
    gap = a["_DF"]
    if size == WHOLE_WIDTH:
        gap = gap_of_width(len(text), height, abs(a["_DF"]))
    elif size == OPENING and isinstance(path, Circle):
        gap = gap_of_width(len(text), height, radians(abs(a.plain("_DF"))) * path.radius)
    inscription = Inscription(
        text,
        path,
        height,
        gap,
        (_BEFORE[along], _BEFORE[across]),
        infeed=feed_of(a, "_FFD"),
        feed=feed_of(a, "_FFP1"),
        safe=found.safe,
        retract=found.retract,
        depth=found.depth,
        mirrored=a.digit("_VARI", MIRRORED) == ON,
    )
    perform(moves, strokes(inscription))


def _point(a: Arguments, first: str, second: str, place: int) -> Point:
    """A point by its coordinates, or by radius and angle about the zero point."""
    if not a.digit("_VARI", place):
        return a[first], a[second]
    cosine, sine = cos_sin_deg(a.plain(second))
    return a[first] * cosine, a[first] * sine
