"""Axis containers: AXCTSWE and AXCTSWED turn a ring of machine axes on, so that channel axes mean others (14.3).

MD12701 and following name the machine axes in the slots of each container, SD41700 by how many slots it turns: the
channel axis of a slot gets the machine axis that was so many slots behind. The axes themselves stand. A program knows
a container as CT1, CT2 …, or by its name in MD12750.

Source: job planning 14.3; Function Manual B3 (machine data).
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.couplings.links import coupled
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.actions import axes as action_axes
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: Containers of a control, and slots of a container.
CONTAINERS, SLOTS = 16, 32
_NAMES, _WIDTH = "$MN_AXCT_NAME_TAB", "$SN_AXCT_SWWIDTH"


@dataclass(slots=True)
class Containers(State, lifetime=Lifetime.POWER):
    """By how many slots each container stands turned, by its number."""

    turned: dict[int, int] = field(default_factory=dict)


def _slots(container: int) -> str:
    """The machine datum with the axes of a container."""
    return f"$MN_AXCT_AXCONF_ASSIGN_TAB{container}"


def names(channel: Channel) -> dict[str, int]:
    """Numbers of the containers that the machine data fill, by what programs call them."""
    data = MachineData.of(channel)
    found = {}
    for number in range(1, CONTAINERS + 1):
        if data.is_set(_slots(number), 0):
            found[f"CT{number}"] = number
            if data.is_set(_NAMES, number - 1):
                found[str(data.read(_NAMES, number - 1)).upper()] = number
    return found


def identifiers(channel: Channel) -> dict[str, Axis]:
    """Identifiers of the containers, which stand where axes may stand."""
    return {name: Axis(name) for name in names(channel)}


def _number(channel: SinumerikChannel, name: str, value: Any) -> int:
    number = names(channel).get(value.name) if isinstance(value, Axis) else None
    if number is None:
        raise AlarmError("14020", text=name)
    return number


def _columns(channel: SinumerikChannel, name: str, container: int) -> list[int]:
    """Columns of the axes in the slots; PC0001 for one that another channel or another control has."""
    data, key = channel.memory.data, _slots(container)
    found = []
    for slot in range(SLOTS):
        axis = str(data.read(key, slot)).upper() if data.is_set(key, slot) else ""
        if not axis:
            break
        column = channel.memory.machine_columns.get(axis.removeprefix("NC1_"))
        if column is None:
            raise not_supported(f"{name} {axis}")
        found.append(column)
    return found


def turn(name: str, channel: SinumerikChannel, args: Arguments) -> None:
    """AXCTSWE(container): turned as soon as the axes stand; AXCTSWED(container) is the same for one channel.

    Raises:
        AlarmError: 14020 for no container, 16797 for an axis that is coupled, PC0001 under a transformation.
    """
    if len(args) != 1:
        raise AlarmError("14020", text=name)
    container = _number(channel, name, args[0])
    columns = _columns(channel, name, container)
    for column in sorted(coupled(channel).intersection(columns)):
        raise AlarmError("16797", axis=channel.axes[column])
    if channel.mode["transformation"]:
        raise not_supported(f"{name} {channel.mode['transformation']}")
    channel.flush()
    channel.synchronise()
    width = channel.memory.data.integer(_WIDTH, container - 1) % len(columns)
    machine, count = channel.coordinates.machine, len(columns)
    places = {column: machine[columns[(slot + width) % count]] for slot, column in enumerate(columns)}
    action_axes.call(channel, name, places)
    turned = Containers.of(channel).turned
    turned[container] = (turned.get(container, 0) + width) % len(columns)


def _turned(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AN_AXCTAS[container]`: by how many slots it stands turned."""
    given = indices[0] if indices else None
    number = _number(channel, "$AN_AXCTAS", given) if isinstance(given, Axis) else arguments.whole(given)
    return Containers.of(channel).turned.get(number, 0)


CONTAINER_VARIABLES: dict[str, RowWithStop] = {"$AN_AXCTAS": (Type.INT, _turned, None, True)}


def _turning(name: str) -> Procedure:
    return lambda channel, args: turn(name, channel, args)


PROCEDURES: dict[str, Procedure] = {name: _turning(name) for name in ("AXCTSWE", "AXCTSWED", "AXCTSWAP")}
