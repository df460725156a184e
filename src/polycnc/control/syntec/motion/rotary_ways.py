"""Ways of rotary axes to absolute words, by their types (Pr221 on; manual 2.19.4 and 2.37.3).

The table of types stands in the manual of parameters. Types 2 and 5 turn as a linear axis goes: they follow a path in
normal direction control (2.83). Which way the others take, the shortest or one by the sign, is not known here.
"""

from __future__ import annotations

from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

FIRST = 221
#: Types whose ways are not known.
OTHER_WAYS = (1, 3, 4)
#: Codes that take axis words for a way to machine positions.
_TO_MACHINE = frozenset(("G28", "G29", "G30", "G53"))


def _types(channel: SyntecChannel) -> dict[int, int]:
    """The axes with a type of `OTHER_WAYS`: their numbers in the machine, by columns."""
    types, machine = channel.memory.parameters.axis_types, channel.machine
    numbers = {i: machine.axis_number(axis.name) for i, axis in enumerate(channel.axis_data) if axis.rotary}
    return {column: number for column, number in numbers.items() if types[number - 1] in OTHER_WAYS}


def _rests(channel: SyntecChannel) -> bool:
    return not _types(channel)


def _refuse(builder: Builder, plan: Plan) -> Step | None:
    """PC0001 for an absolute word of such an axis."""
    types = _types(builder.channel)
    for word in plan.axis_words:
        if word.axis in types and not word.incremental:
            raise _not_known(types[word.axis], word.address)
    return None


def _check(builder: Builder) -> None:
    """The same for words that a code takes to the machine's positions."""
    if not any(row.code in _TO_MACHINE for row in builder.codes):
        return
    types = _types(builder.channel)
    for address in builder.slots:
        target = builder.control.axis_of_address(builder.channel, address, builder)
        if target is not None and target[0] in types and not target[1]:
            raise _not_known(types[target[0]], address)


def _not_known(axis: int, address: str) -> AlarmError:
    return AlarmError("PC0001", hint="hint.not-supported", address=address, code=f"Pr{FIRST - 1 + axis}")


#: Absolute words of rotary axes whose ways are not known.
RULE = Rule("ways of rotary axes", rests=_rests, check=_check, motion=_refuse)
