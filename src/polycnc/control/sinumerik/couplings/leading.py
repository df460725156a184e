"""LEADON, LEADOF: a curve table says where an axis is for each place of another one (job planning 9.3).

The following axis is within MD37200 of its place when they are coupled, or it stays until the leading axis brings its
place to where it is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings import switching
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link
from polycnc.control.sinumerik.couplings.stage import SynchronisationStage
from polycnc.control.sinumerik.curve_tables.memory import table_of
from polycnc.control.sinumerik.errors import not_supported
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel

#: `$SA_LEAD_TYPE`: master values that somebody writes.
GENERATED = 2


def switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """LEADON(following,leading,n).

    Raises:
        AlarmError: 16776 for a table that is not there, 16785 for the same axis twice, 16797 for an axis that a
            master value leads already, 16778 for an axis that would lead itself.
    """
    if len(args) != 3 or None in args:
        raise AlarmError("14020", text="LEADON")
    following, leading = (arguments.column(channel, axis) for axis in args[:2])
    table = table_of(channel, arguments.whole(args[2]))
    if following == leading:
        raise AlarmError("16785", axis=channel.axes[following])
    if channel.memory.data.integer("$SA_LEAD_TYPE", channel.axes[leading]) == GENERATED:
        raise not_supported("LEADON $SA_LEAD_TYPE=2")
    links, state = [], Couplings.of(channel)
    for link in state.links.get(following, []):
        if link.kind is not Kind.LEAD:
            links.append(link)
        elif (link.law.leading, link.table) == (leading, table.number):
            return
        else:
            raise AlarmError("16797", axis=channel.axes[following])
    switching.begin(channel, "LEADON")
    machine = channel.coordinates.machine
    wanted = table.followed(machine[leading]).place
    tolerance = channel.memory.data.number("$MA_COUPLE_POS_TOL_COARSE", channel.axes[following])
    waits = abs(wanted - machine[following]) > tolerance
    law = ByCurve(leading, table, wanted)
    if not waits:
        machine[following] = wanted
        channel.coordinates.arrive_machine(machine)
    switching.change(channel, following, [*links, Link(Kind.LEAD, law, table.number, waits)])
    if waits:
        channel.path.put(SynchronisationStage(channel))


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """LEADOF(following[,leading]): the coupling ends, the axis stays where it is."""
    switching.end(channel, args, "LEADOF", Kind.LEAD)


PROCEDURES: dict[str, Procedure] = {"LEADON": switch_on, "LEADOF": switch_off}
