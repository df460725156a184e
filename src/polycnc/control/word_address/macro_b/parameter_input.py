"""G10 L50 and L52 … G11: blocks that set parameters (FANUC macro B §10.2)."""

from __future__ import annotations

from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.memory import ParameterTable
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.setup.values import ParameterKey

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import MacroChannel

#: L numbers that begin the input of parameters.
LEVELS = (50, 52)


def begin(channel: MacroChannel) -> None:
    """G10 L50, L52: the blocks from here to G11 name parameters."""
    channel.mode = channel.mode.with_code("data_input", "G10")


def end(channel: MacroChannel, _words: Words) -> None:
    """G11: no more parameters are set by blocks."""
    channel.mode = channel.mode.with_code("data_input", "G11")


def plan_parameter_block(builder: Builder, plan: Plan) -> Step | None:
    """`N number [P axis] [Q bit] R value` while the input of parameters is on."""
    if (
        builder.before.codes.get("data_input") != "G10"
        or builder.codes
        or builder.m_codes
        or not builder.slots
    ):
        return None
    for address in builder.slots:
        if address not in "PQR":
            raise builder.control.fail("parameter_words", address=address)

    def act(channel: MacroChannel, values: list[float]) -> None:
        words = Words(plan, values)
        level = channel.level
        number, value = level.code.sequence(level.current), words.typed("R")
        axis = words.integer("P") if "P" in words else None
        bit = words.integer("Q") if "Q" in words else None
        if not number or value is None:
            raise words.fail("parameter_words", "N")
        if axis is not None and not 0 <= axis <= len(channel.axes):
            raise words.fail("parameter_words", "P")
        if bit is not None and not 0 <= bit <= 7:
            raise words.fail("parameter_words", "Q")
        name = channel.axes[axis - 1] if axis else None
        set_parameter(channel, ParameterKey(number, bit, None, name), value)

    return act


def set_parameter(
    channel: MacroChannel, key: ParameterKey, value: float, *, keeps_plans: bool = False
) -> None:
    """Give a parameter another value; whatever rests on the old one is worked out anew.

    Args:
        channel: The channel.
        key: The parameter.
        value: Its new value.
        keeps_plans: No plan of a block rests on the parameter.
    """
    whole = int(value) if value == int(value) else value
    memory = channel.memory
    memory.parameters = memory.parameters.having(key, whole)
    channel.setup = replace(channel.setup, parameters=memory.parameters)
    ParameterTable.of(channel).changed[key] = whole
    if not keeps_plans:
        channel.modes.forget_plans()
    channel.control.parameters_changed(channel)
