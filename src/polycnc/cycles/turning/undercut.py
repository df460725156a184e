"""Undercuts in front of a shoulder: forms E and F by DIN 509, thread undercuts A to D by DIN 76-1.

Source: DIN 509 (shafts under usual load), DIN 76-1 (metric threads of coarse pitch); SINUMERIK CYCLE94, CYCLE96.

An undercut is told in (a, t): `a` from the shoulder along the cylinder, `t` into the material from the surface of the
cylinder. It runs down a slope to its depth, along it, and round into the shoulder. Form F goes into the face of the
shoulder as well and leaves it on a slope of 8 degrees.
"""

from __future__ import annotations

from math import cos, radians, sin, tan

from polycnc.cycles.turning.contour import Piece
from polycnc.cycles.turning.groove import Corner, GrooveError, with_corner
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset

if TYPE_CHECKING:
    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point


class Undercut(NamedTuple):
    """Dimensions of an undercut; mm.

    Attributes:
        width: From the shoulder to where the slope leaves the cylinder.
        depth: Below the surface of the cylinder.
        radius: Of the corner between slope and base.
        slope_deg: Of the way down from the cylinder.
        face: Depth into the shoulder, 0 for none.
        corner: Radius at the shoulder; None for the same.
        stock: Above the finished cylinder, which is cut later: the slope begins on it.
        face_stock: In front of the finished face of the shoulder.
    """

    width: float
    depth: float
    radius: float
    slope_deg: float
    face: float = 0.0
    corner: float | None = None
    stock: float = 0.0
    face_stock: float = 0.0

    @property
    def reach(self) -> float:
        """From the shoulder to where the slope leaves the material that is there."""
        return self.width + self.stock / tan(radians(self.slope_deg))


_SLOPE_OF_SHAFT, _SLOPE_OF_THREAD, _SLOPE_OF_FACE = 15.0, 30.0, radians(8.0)
#: DIN 509: the largest diameter of each row; width f, depth t1, radius r, depth t2 of the face.
SHAFTS = (
    (10.0, 2.0, 0.2, 0.4, 0.1),
    (18.0, 2.0, 0.2, 0.6, 0.1),
    (80.0, 2.5, 0.3, 0.6, 0.2),
    (float("inf"), 4.0, 0.4, 1.0, 0.3),
)
#: DIN 13: coarse pitch of metric threads by nominal diameter.
PITCHES = {
    3: 0.5, 4: 0.7, 5: 0.8, 6: 1.0, 8: 1.25, 10: 1.5, 12: 1.75, 14: 2.0, 16: 2.0, 18: 2.5, 20: 2.5, 22: 2.5, 24: 3.0,
    27: 3.0, 30: 3.5, 33: 3.5, 36: 4.0, 39: 4.0, 42: 4.5, 45: 4.5, 48: 5.0, 52: 5.0, 56: 5.5, 60: 5.5, 64: 6.0, 68: 6.0,
}  # fmt: skip
#: DIN 76-1 by pitch: what the base is smaller than the nominal diameter outside, and larger inside, both on the
#: diameter; radius; greatest width g2 of the forms A, B, C, D.
THREADS = {
    0.2: (0.3, 0.1, 0.1, (0.7, 0.5, 1.2, 0.9)),
    0.25: (0.4, 0.1, 0.12, (0.9, 0.6, 1.4, 1.0)),
    0.3: (0.5, 0.1, 0.16, (1.05, 0.75, 1.6, 1.25)),
    0.35: (0.6, 0.2, 0.16, (1.2, 0.9, 1.9, 1.4)),
    0.4: (0.7, 0.2, 0.2, (1.4, 1.0, 2.2, 1.6)),
    0.45: (0.7, 0.2, 0.2, (1.6, 1.1, 2.4, 1.7)),
    0.5: (0.8, 0.3, 0.2, (1.75, 1.25, 2.7, 2.0)),
    0.6: (1.0, 0.3, 0.4, (2.1, 1.5, 3.3, 2.4)),
    0.7: (1.1, 0.3, 0.4, (2.45, 1.75, 3.8, 2.75)),
    0.75: (1.2, 0.3, 0.4, (2.6, 1.9, 4.0, 2.9)),
    0.8: (1.3, 0.3, 0.4, (2.8, 2.0, 4.2, 3.0)),
    1.0: (1.6, 0.5, 0.6, (3.5, 2.5, 5.2, 3.7)),
    1.25: (2.0, 0.5, 0.6, (4.4, 3.2, 6.7, 4.9)),
    1.5: (2.3, 0.5, 0.8, (5.2, 3.8, 7.8, 5.6)),
    1.75: (2.6, 0.5, 1.0, (6.1, 4.3, 9.1, 6.4)),
    2.0: (3.0, 0.5, 1.0, (7.0, 5.0, 10.3, 7.3)),
    2.5: (3.6, 0.5, 1.2, (8.7, 6.3, 13.0, 9.3)),
    3.0: (4.4, 0.5, 1.6, (10.5, 7.5, 15.2, 10.7)),
    3.5: (5.0, 0.5, 1.6, (12.0, 9.0, 17.7, 12.7)),
    4.0: (5.7, 0.5, 2.0, (14.0, 10.0, 20.0, 14.0)),
    4.5: (6.4, 0.5, 2.0, (16.0, 11.0, 23.0, 16.0)),
    5.0: (7.0, 0.5, 2.5, (17.5, 12.5, 26.0, 18.5)),
    5.5: (7.7, 0.5, 3.2, (19.0, 14.0, 28.0, 20.0)),
    6.0: (8.3, 0.5, 3.2, (21.0, 15.0, 30.0, 21.0)),
}
#: A core hole is smaller than the nominal diameter by this part of the pitch (DIN 13: D1 = D - 1.0825 P).
_CORE = 1.0825
#: Forms of DIN 76-1 that lie inside.
INSIDE = ("C", "D")


def of_shaft(form: str, diameter: float) -> Undercut:
    """Form E or F at a finished diameter of more than 3 mm."""
    _, width, depth, radius, face = next(row for row in SHAFTS if diameter <= row[0])
    return Undercut(width, depth, radius, _SLOPE_OF_SHAFT, face if form == "F" else 0.0)


def of_thread(form: str, nominal: float) -> tuple[Undercut, float] | None:
    """Form A to D of a metric thread of coarse pitch, as `of_pitch`; None for no coarse thread."""
    pitch = PITCHES.get(round(nominal)) if abs(nominal - round(nominal)) <= 1e-6 else None
    return None if pitch is None else of_pitch(form, nominal, pitch)


def of_pitch(form: str, nominal: float, pitch: float, slope_deg: float = 0.0) -> tuple[Undercut, float]:
    """Form A to D of a metric thread, and the radius of the surface it begins on.

    That surface is the nominal diameter outside, the core hole inside.

    Args:
        form: As named.
        nominal: Diameter of the thread, mm.
        pitch: One that has a row in `THREADS`.
        slope_deg: Of the way down; 0 for that of the standard.
    """
    smaller, larger, radius, widths = THREADS[pitch]
    width, slope = widths["ABCD".index(form)], slope_deg or _SLOPE_OF_THREAD
    if form not in INSIDE:
        return Undercut(width, 0.5 * smaller, radius, slope), 0.5 * nominal
    core = nominal - _CORE * pitch
    return Undercut(width, 0.5 * (nominal + larger - core), radius, slope), 0.5 * core


def contour(undercut: Undercut, out: float | None) -> Contour:
    """The undercut from the cylinder to the shoulder, in (a, t), and on along the face by `out` above the cylinder.

    Without `out` form F ends where its slope leaves the face.

    Raises:
        GrooveError: Slope and corners do not fit its width.
    """
    depth, slope = undercut.depth, radians(undercut.slope_deg)
    foot = (undercut.width - depth / tan(slope), depth)
    if not undercut.face:
        corner, end = (0.0, depth), (undercut.face_stock, -(out or 0.0))
    else:
        corner, end = _into_face(undercut)
    if foot[0] <= corner[0]:
        raise GrooveError("slope")
    radii = (undercut.radius, undercut.radius if undercut.corner is None else undercut.corner)
    pieces: Contour = [Piece(offset.line((undercut.reach, -undercut.stock), foot))]
    for a, b, radius in zip((foot, corner), (corner, end), radii, strict=True):
        pieces = with_corner(pieces, Piece(offset.line(a, b)), Corner(radius=radius))
    if undercut.face and out is not None and -out < end[1]:
        pieces.append(Piece(offset.line(end, (end[0], -out))))
    return pieces


def _into_face(undercut: Undercut) -> tuple[Point, Point]:
    """Where base and slope of the face meet, and where that slope ends: the rounding between them is `face` deep."""
    depth, radius = undercut.depth, undercut.radius
    c, s, slope = cos(_SLOPE_OF_FACE), sin(_SLOPE_OF_FACE), tan(_SLOPE_OF_FACE)
    touch = (radius * (1.0 - c) - undercut.face, depth - radius * (1.0 + s))
    end = undercut.face_stock
    return (touch[0] - (depth - touch[1]) * slope, depth), (end, touch[1] + (touch[0] - end) / slope)
