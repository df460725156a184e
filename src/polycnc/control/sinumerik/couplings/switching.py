"""Switching couplings on and off: in their place on the path, with the coordinates that follow (job planning 9)."""

from __future__ import annotations

from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings.links import OF_MACHINE, Couplings, put
from polycnc.control.sinumerik.curve_tables import definition
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames import active
from polycnc.control.sinumerik.tools import stages
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.graph import CircularCouplingError, in_order

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.couplings.links import Kind, Link
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.transformations.data_sets import Build


def begin(channel: SinumerikChannel, name: str) -> None:
    """A coupling changes: everything that has been programmed so far is written.

    Raises:
        AlarmError: 10942 in a curve table, PC0001 under radius compensation.
    """
    definition.refuse(channel, name)
    if channel.mode["compensation"] != "G40":
        raise not_supported(f"{name} {channel.mode['compensation']}")
    channel.flush()
    if stages.active_cutter(channel) is not None:
        raise not_supported(f"{name} G40")


def change(channel: SinumerikChannel, column: int, links: list[Link]) -> None:
    """These lead an axis from now on, behind `begin`; the axes do not move, the coordinates follow.

    Raises:
        AlarmError: 16778 for an axis that would lead itself, PC0001 for one that actions may move beside the path, and
            for one that the transformation leads.
    """
    state = Couplings.of(channel)
    refuse_transformed(channel, (column,) if links else ())
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


def refuse_transformed(channel: SinumerikChannel, columns: Iterable[int]) -> None:
    """PC0001 for axes of the transformation, which follow no others."""
    kind = channel.mode[seat.GROUP]
    for column in sorted(seat.transformed(channel).intersection(columns)) if kind else ():
        raise not_supported(f"{kind}: TRAILON LEADON EGON {channel.axes[column]}")


def check_change(channel: SinumerikChannel, build: Build | None) -> None:
    """PC0001 for couplings by axes whose meaning a transformation changes: C of TRANSMIT, and its virtual Y."""
    builds = (build, seat.Transformations.of(channel).build)
    used = frozenset[int]().union(*(each.used for each in builds if each is not None))
    for links in Couplings.of(channel).links.values():
        for link in links:
            if link.kind not in OF_MACHINE and link.law.leading in used:
                raise not_supported(f"TRAILON LEADON EGON: {channel.axes[link.law.leading]}")


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
