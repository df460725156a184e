"""M and G codes of the machine's builder: those that its machine file declares, and M codes that nobody knows.

An M code that neither the control nor the machine file knows is an event all the same, and takes the words of its block
that nothing else takes along. A G code has to be declared.
"""

from __future__ import annotations

from polycnc.control.machine_words import plc_of, refuse
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.auxiliary.interlocks import guarded, unlisted
from polycnc.control.word_address.block.codes import GCode, MCode, Order
from polycnc.control.word_address.block.plan import NOT_YET, sent_words
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError
from polycnc.toolpath.events import BuilderCode

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Handler
    from polycnc.control.word_address.block.words import Words
    from polycnc.machine.model import GFunction, MFunction

#: What an M function of a machine file does in any control.
ACTS: Mapping[str, Handler] = {
    "spindle_clockwise": functions.spindle_clockwise,
    "spindle_counter_clockwise": functions.spindle_counter_clockwise,
    "spindle_stop": functions.spindle_stop,
    "tool_change": functions.change_tool,
}


def m_row(channel: Channel, known: MCode | None, number: int) -> MCode:
    """The row of an M code behind the machine's interlocks; `known` is that of the control's table."""
    function = channel.machine.m_functions.get(number)
    row = known or MCode(number, open=function is None)
    if function is not None:
        row = _declared(channel, row, function, told=known is not None)
    plc = plc_of(channel)
    if known is not None or function is not None or plc.knows(f"M{number}"):
        return guarded(row, plc)
    return unlisted(row, plc)


def _declared(channel: Channel, row: MCode, function: MFunction, *, told: bool) -> MCode:
    """A row with what the machine file says of its code; the control's table says when it acts, if it knows it."""
    if function.does:
        acts: Mapping[str, Handler] = channel.control.acts
        if function.does not in acts:
            raise AlarmError(NOT_YET, hint="hint.not-supported", code=f"M{row.code} ({function.does})")
        turns = function.does.startswith("spindle_")
        row = replace(row, handler=acts[function.does], turns=turns)
    if function.takes is not None:
        row = replace(row, takes=" ".join((row.takes, *function.takes)).strip())
    return row if told else replace(row, after=function.timing == "after", open=function.takes is None)


def g_rows(channel: Channel) -> dict[str, GCode]:
    """Rows of the G codes that the machine file declares as events."""
    functions_of_machine = channel.machine.g_functions.values()
    return {each.code: _g_row(each) for each in functions_of_machine if not each.calls}


def _g_row(function: GFunction) -> GCode:
    def act(channel: Channel, words: Words) -> None:
        refuse(channel, function.code)
        sent = [address for address in function.takes or () if address in words] + list(words.plan.rest)
        values: dict[str, float] = sent_words(words.plan, sent, words.values)
        channel.event(BuilderCode(function.code, values or None))

    takes, is_open = " ".join(function.takes or ()), function.takes is None
    return GCode(function.code, handler=act, takes=takes, open=is_open, order=Order.CALL)


def undeclared(code: str) -> dict[str, Any]:
    """What the alarm of a G code says that neither the control nor the machine file knows."""
    return {"hint": "hint.declare-g", "code": code, "number": code[1:]}
