"""Engraving: CYCLE60 (strokes: `polycnc.cycles.milling.engraving`)."""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.levels import levels
from polycnc.control.sinumerik.cycles.milling import feed_of, perform
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.milling.engraving import Circle, Inscription, Line, gap_of_width, strokes
from polycnc.cycles.milling.letters import drawn
from polycnc.cycles.milling.stroke import Place
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Digits of _VARI from the right: points by radius and angle; line or circle; where the reference point lies along the
#: text and across it; what _DF is; the centre by radius and angle; mirrored.
POLAR, SHAPE, ALONG, ACROSS, SIZE, POLAR_CENTER, MIRRORED = 0, 1, 3, 4, 5, 6, 7
ON_A_LINE, OUTSIDE, INSIDE = 0, 1, 2
GAP, WHOLE_WIDTH, OPENING = 0, 1, 2
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
            PC0001 for a letter that is not drawn, points by radius and angle, mirrored texts.
    """
    require_tool(moves)
    shape, size = a.digit("_VARI", SHAPE), a.digit("_VARI", SIZE)
    along, across = a.digit("_VARI", ALONG), a.digit("_VARI", ACROSS)
    if not _is_known(shape, size) or max(along, across) >= len(_BEFORE):
        raise AlarmError("61002")
    if any(a.digit("_VARI", place) for place in (POLAR, POLAR_CENTER, MIRRORED)):
        raise not_supported("CYCLE60 _VARI")
    text, height = a.text("_TEXT"), abs(a["_WID"])
    missing = next((letter for letter in text if drawn(letter) is None), "")
    if missing:
        raise not_supported(f"CYCLE60 {missing}")
    found = levels(moves, a)
    if found is None or not text.strip():
        return
    if not height:
        raise AlarmError("61118")
    path: Line | Circle = Line(Place((a["_PA"], a["_PO"]), a["_STA"]))
    if shape != ON_A_LINE:
        path = Circle((a["_CP1"], a["_CP2"]), (a["_PA"], a["_PO"]), inwards=shape == INSIDE)
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
    )
    perform(moves, strokes(inscription))
