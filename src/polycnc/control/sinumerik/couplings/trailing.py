"""TRAILON, TRAILOF: coupled motion (job planning 9.1).

A following axis goes, beside its own way, those of at most two leading axes, each times its factor, from where they are
when they are coupled. A following axis may lead others.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings import switching
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link, places
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel

MOST_LEADING = 2


def switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """TRAILON(following,leading[,factor]): the factor is 1 where it is left out.

    Raises:
        AlarmError: 16779 for a third leading axis, 16785 for the same axis twice, 16778 for an axis that would lead
            itself.
    """
    following, leading, factor = _read(channel, args)
    switching.begin(channel, "TRAILON")
    links = Couplings.of(channel).links.get(following, [])
    others = [link for link in links if link.kind is not Kind.TRAIL or link.law.leading != leading]
    if sum(link.kind is Kind.TRAIL for link in others) >= MOST_LEADING:
        raise AlarmError("16779", axis=channel.axes[following])
    origin = places(channel)[leading]
    switching.change(channel, following, [*others, Link(Kind.TRAIL, Ratio(leading, factor, origin))])


def _read(channel: SinumerikChannel, args: Arguments) -> tuple[int, int, float]:
    if not 2 <= len(args) <= 3 or None in args[:2]:
        raise AlarmError("14020", text="TRAILON")
    following, leading = (arguments.column(channel, axis) for axis in args[:2])
    if following == leading:
        raise AlarmError("16785", axis=channel.axes[following])
    factor = args[2] if len(args) > 2 else None
    return following, leading, 1.0 if factor is None else arguments.real(factor)


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """TRAILOF(following[,leading[,leading 2]]): couplings to these axes end, all where none is named."""
    switching.end(channel, args, "TRAILOF", Kind.TRAIL)


PROCEDURES: dict[str, Procedure] = {"TRAILON": switch_on, "TRAILOF": switch_off}
