"""What a roughing cycle is told."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point


@dataclass(frozen=True, slots=True)
class Roughing:
    """What a roughing cycle is told; amounts mm of radius.

    Attributes:
        depth: Infeed of a stroke.
        escape: Way off the work after a stroke.
        allowance: Finishing allowance along (a, b), signed.
        extra: Further allowance that the strokes leave and the rough finishing takes off.
        pockets: Type II: the shape may go down again.
        finishes: Follow the shape after the last stroke.
        infeed_rapid: Infeed as the first block of the shape has it.
        escape_rapid: The way off at 45 degrees is a rapid.
        clearance: Distance from a pocket's next stroke at which rapid becomes feed.
        follows_flats: Type II: behind a stroke, parts of the shape parallel to it are followed too (R16).
        skips_bottoms: Type II: no path twice, so no strokes along bottoms (NSP).
        returns_straight: From the way off straight to the start of the stroke before (RPA); with infeed at feed the
            last `feeds_last` mm of it.
        returns_rapid: The way back to the level before is rapid (ASU); `returns_merged`: it is left out (ASC).
    """

    depth: float
    escape: float
    allowance: Point = (0.0, 0.0)
    extra: Point = (0.0, 0.0)
    pockets: bool = False
    finishes: bool = True
    infeed_rapid: bool = True
    escape_rapid: bool = False
    clearance: float = 0.0
    returns_rapid: bool = False
    returns_merged: bool = False
    returns_straight: bool = False
    follows_flats: bool = False
    skips_bottoms: bool = False
    feeds_last: float = 0.0
