"""Which codes call programs on MELDAS (parameters #7001 to #7303: code, type and program of each)."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from polycnc.control.word_address.macro_b.code_calls import CodeCall, CodeCalls

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.machine.setup.values import Parameters

#: Type in a parameter to the kind of call: as M98, G65, G66, G66.1.
KINDS = ("sub", "macro", "modal", "each")
#: M codes that no parameter can register.
NEVER_M = frozenset({0, 1, 2, 30, 96, 97, 98, 99})
#: Cycles that users write ("user control cycle" of the G table); each calls O1000nnn0 of its own.
USER_CYCLES = (70, 71, 72, 75, 77, 78, 79)
FIRST_CYCLE_PROGRAM = 100_000_000


def registered_codes(channel: Channel) -> CodeCalls:
    """The codes that the parameters of a channel register."""
    return _registered(channel.setup.parameters)


@lru_cache(maxsize=64)
def _registered(parameters: Parameters) -> CodeCalls:
    g = {f"G{number}": CodeCall(FIRST_CYCLE_PROGRAM + 10 * number) for number in USER_CYCLES}
    m: dict[int, CodeCall] = {}
    for i in range(10):
        if call := _call(parameters, 7200 + 10 * i):
            g[f"G{int(parameters.number(7201 + 10 * i))}"] = call
        if call := _call(parameters, 7000 + 10 * i):
            number = int(parameters.number(7001 + 10 * i))
            if number not in NEVER_M:
                m[number] = call
    return CodeCalls(g, m, _call(parameters, 7310))


def _call(parameters: Parameters, base: int) -> CodeCall | None:
    """The call whose type and program stand at `base` + 2 and + 3."""
    program = int(parameters.number(base + 3))
    kind = int(parameters.number(base + 2))
    return CodeCall(program, KINDS[kind]) if program and 0 <= kind < len(KINDS) else None
