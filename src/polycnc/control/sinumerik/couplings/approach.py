"""A following axis goes to its synchronous place before a gear is on: beside the path, where it is enabled (9.4.2).

The machine's controller enables it by "enable following axis overlay" (DB31 ff., DBX26.4).
"""

from __future__ import annotations

from polycnc.channel.moves.travel import check_straight
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

_FIRST_AXIS = 31


def approach(channel: SinumerikChannel, column: int, way: float) -> None:
    """An axis goes a way beside the path; what follows waits until it stands.

    Raises:
        AlarmError: 16771 where the machine's controller does not enable it, 10720 for a place beyond its travel,
            PC0001 while another coupling acts.
        PreprocessingStop: The program is not yet executed in time.
    """
    if abs(way) <= NO_WAY:
        return
    if not channel.setup.switches.plc.get(f"DB{_FIRST_AXIS + column}.DBX26.4"):
        raise AlarmError("16771", axis=channel.axes[column])
    if Couplings.of(channel).laws():
        raise not_supported("EGONSYN TRAILON LEADON EGON")
    clocked = channel.on_clock()
    channel.synchronise()
    machine = channel.coordinates.machine
    machine[column] += way
    target, speed = machine[column], action_axes.speed_of(channel, column)
    coordinates = channel.coordinates
    check_straight(channel, Kind.RAPID, coordinates.position, coordinates.from_machine(machine))

    def start() -> None:
        clocked.position_beside(column, target, speed)

    def moves() -> bool:
        return clocked.commanded(column).moves

    coordinates.arrive_machine(machine)
    channel.event(Deed("EGONSYN", None, start, is_silent=False, places=((column, target),)))
    channel.event(Deed("EGONSYN", None, _nothing, is_silent=False, awaits=moves))


def _nothing() -> None:
    """Nothing but waiting."""
