"""Adapters between places of a magazine and their tools: lengths `$TC_ADPT1[n]` to 3, `$TC_ADPTT[n]` how they turn.

`$TC_MPP7` tells the adapter of a place. All of them are kept, as tool archives write them. A tool from a place whose
adapter has lengths, or turns the tool, is PC0001: the manuals at hand name adapters alone, so neither is it known
whether their lengths take the place of `$TC_DP21` to 23, nor what the numbers of `$TC_ADPTT` turn.
"""

from __future__ import annotations

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: The adapter and the tool of a place.
ADAPTER, TOOL = "$TC_MPP7", "$TC_MPP6"
LENGTHS, TURN = ("$TC_ADPT1", "$TC_ADPT2", "$TC_ADPT3"), "$TC_ADPTT"
#: `$TC_ADPTT` that leaves a tool as it is.
AS_IT_IS = (0, 1)


def check(channel: SinumerikChannel) -> None:
    """PC0001 where the active edge belongs to a tool from a place with an adapter that changes it."""
    values, tools = Stored.of(channel).values, channel.memory.tools
    for (name, place), number in values.items() if tools.edge is not None else ():
        if name == ADAPTER and number and values.get((TOOL, place)) == tools.active:
            adapter = (int(number),)
            lengths = any(values.get((length, adapter)) for length in LENGTHS)
            if lengths or values.get((TURN, adapter), 0) not in AS_IT_IS:
                raise not_supported(f"{ADAPTER} {TURN}")


def _datum(name: str) -> Row:
    """A datum of an adapter."""

    def place(indices: Indices) -> tuple[int]:
        if len(indices) != 1 or not isinstance(indices[0], (int, float)):
            raise AlarmError("12400", text=name)
        return (int(indices[0]),)

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        value: float = Stored.of(channel).values.get((name, place(indices)), 0)
        return value

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        Stored.of(channel).values[name, place(indices)] = value

    return (Type.INT if name == TURN else Type.REAL), read, write


ADAPTER_VARIABLES: dict[str, Row] = {name: _datum(name) for name in (*LENGTHS, TURN)}
