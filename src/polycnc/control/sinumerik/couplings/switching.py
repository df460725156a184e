"""Switching couplings on and off: in their place on the path, with the coordinates that follow (job planning 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings.links import Couplings, put
from polycnc.control.sinumerik.curve_tables import definition
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames import active
from polycnc.control.sinumerik.tools import stages
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.graph import CircularCouplingError, in_order

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.couplings.links import Kind, Link
    from polycnc.control.sinumerik.family import SinumerikChannel


def begin(channel: SinumerikChannel, name: str) -> None:
    """A coupling changes: everything that has been programmed so far is written.

    Raises:
        AlarmError: 10942 in a curve table, PC0001 under a transformation or radius compensation.
    """
    definition.refuse(channel, name)
    for group, off in (("transformation", ""), ("compensation", "G40")):
        if channel.mode[group] != off:
            raise not_supported(f"{name} {channel.mode[group]}")
    channel.flush()
    if stages.active_cutter(channel) is not None:
        raise not_supported(f"{name} G40")


def change(channel: SinumerikChannel, column: int, links: list[Link]) -> None:
    """These lead an axis from now on, behind `begin`; the axes do not move, the coordinates follow.

    Raises:
        AlarmError: 16778 for an axis that would lead itself, PC0001 for one that actions may move beside the path.
    """
    state = Couplings.of(channel)
    every = {**state.links, column: links}
    try:
        in_order({each: [link.law for link in of] for each, of in every.items()})
    except CircularCouplingError as error:
        raise AlarmError("16778", axis=channel.axes[error.column]) from None
    moved = ActionAxes.of(channel).may_move
    for each in sorted(moved.intersection((column, *(link.law.leading for link in links)))) if links else ():
        raise not_supported(f"TRAILON LEADON EGON: {channel.axes[each]} POS MOV")
    put(channel, column, links)
    settle(channel)


def end(channel: SinumerikChannel, args: Arguments, name: str, kind: Kind) -> None:
    """Couplings of a kind end: those of the first axis to the others named, all where none is; the axis stays.

    Raises:
        AlarmError: 14020 for a wrong number of axes, and what `begin` raises.
    """
    if not 1 <= len(args) <= 3 or args[0] is None:
        raise AlarmError("14020", text=name)
    following, *leading = (arguments.column(channel, axis) for axis in args if axis is not None)
    begin(channel, name)
    links = Couplings.of(channel).links.get(following, [])
    stay = [link for link in links if link.kind is not kind or (leading and link.law.leading not in leading)]
    if len(stay) != len(links):
        change(channel, following, stay)


def settle(channel: SinumerikChannel) -> None:
    """The coordinates are as the couplings say; the axes do not move."""
    active.apply(channel)
    channel.context_changed()
