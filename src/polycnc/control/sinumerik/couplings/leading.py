"""LEADON, LEADOF: a curve table says where an axis is for each place of another one (job planning 9.3).

The following axis is within MD37200 of its place when they are coupled, or it stays until the leading axis brings its
place to where it is.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings import generated, switching
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link, places
from polycnc.control.sinumerik.couplings.stage import SynchronisationStage
from polycnc.control.sinumerik.curve_tables.memory import table_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel


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
    followers = generated.MasterValues.of(channel).led
    if following in followers:
        if (followers[following].leading, followers[following].table) == (leading, table):
            return
        raise AlarmError("16797", axis=channel.axes[following])
    if generated.is_generated(channel, leading) and not Couplings.of(channel).links.get(following):
        generated.lead(channel, following, leading, table)
        return
    links, state = [], Couplings.of(channel)
    for link in state.links.get(following, []):
        if link.kind is not Kind.LEAD:
            links.append(link)
        elif (link.law.leading, link.table) == (leading, table.number):
            return
        else:
            raise AlarmError("16797", axis=channel.axes[following])
    switching.begin(channel, "LEADON")
    machine = places(channel)
    wanted = table.followed(machine[leading]).place
    tolerance = channel.memory.data.number("$MA_COUPLE_POS_TOL_COARSE", channel.axes[following])
    waits = abs(wanted - machine[following]) > tolerance
    law = ByCurve(leading, table, wanted)
    if not waits:
        stands = channel.coordinates.machine
        stands[following] += wanted - machine[following]
        channel.coordinates.arrive_machine(stands)
    switching.change(channel, following, [*links, Link(Kind.LEAD, law, table.number, waits)])
    if waits:
        channel.path.put(SynchronisationStage(channel))


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """LEADOF(following[,leading]): the coupling ends, the axis stays where it is."""
    column = arguments.column(channel, args[0]) if len(args) in (1, 2) and args[0] is not None else -1
    follower = generated.MasterValues.of(channel).led.get(column)
    if follower is not None:
        if len(args) == 1 or args[1] is None or arguments.column(channel, args[1]) == follower.leading:
            generated.leave(channel, column)
        return
    switching.end(channel, args, "LEADOF", Kind.LEAD)


PROCEDURES: dict[str, Procedure] = {"LEADON": switch_on, "LEADOF": switch_off}
