"""Roughing of CYCLE952 parallel to the contour (cuts: `polycnc.cycles.plunging`).

Source: SINUMERIK Operate, contour turning (stock removal); the manuals at hand give the parameter list alone.
"""

from __future__ import annotations

from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.turning.blanks import NOTHING
from polycnc.control.sinumerik.cycles.turning.contour_grooves import height, perform
from polycnc.control.sinumerik.cycles.turning.work import onwards
from polycnc.cycles.plunging import cuts
from polycnc.cycles.plunging.cuts import Use
from polycnc.cycles.plunging.profile import Profile, envelope, layers, level, profile, shifted_layers, upright
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.turning.blanks import Turning
    from polycnc.control.sinumerik.cycles.turning.work import Work
    from polycnc.cycles.turning.contour import Contour

#: Digit of _AMODE: the infeed is told by _DX and _DZ, not by _D.
BY_AXES = 0


def rough(work: Work, a: Arguments, turning: Turning, path: Contour, blank: Contour | None) -> None:
    """Cuts along the contour, one below the other, the last one along the path that leaves the allowances.

    Args:
        work: The cuts.
        a: Arguments of the call.
        turning: What is turned.
        path: Of the tool's point, from the front of the blank to the wall behind the contour, up to its top.
        blank: Where the tool's point meets a blank that is no cylinder.

    Raises:
        AlarmError: 61606 for a contour that runs back, 61610 without infeed.
    """
    direction = onwards(turning.part)
    front, top = path[0].edge.start[0], height(work, work.touching(turning.top))
    try:
        floor = profile(upright(path, work.towards), top, open_at=-direction)
        stock = level(top, floor.begin, floor.end)
        if blank is not None:
            outline = profile(upright(blank, work.towards), NOTHING)
            curves = [*outline.curves, *level(NOTHING, floor.begin, floor.end).curves]
            stock = Profile(envelope(curves))
    except ValueError:
        raise AlarmError("61606") from None
    if a.digit("_AMODE", BY_AXES):
        way = work.pair(a["_DZ"], a["_DX"])
        found = shifted_layers(floor, stock, (-direction * way[0], way[1]))
    else:
        found = layers(floor, stock, a["_D"])
    feeds = dict.fromkeys(Use, feed_of(a, "_F"))
    over = top + turning.lift
    for layer in found:
        strokes = cuts.follow_on(cuts.Work(layer, stock, turning.lift, over), direction, front)
        perform(work, strokes, feeds)
