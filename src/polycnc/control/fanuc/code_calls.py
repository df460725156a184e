"""Which codes call programs on FANUC controls (parameters 6050 to 6059, 6071 to 6089, 6001#5)."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from polycnc.control.word_address.macro_b.code_calls import CodeCall, CodeCalls

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.machine.setup.values import Parameters

#: G codes and M codes that no parameter can register.
NEVER_G = frozenset({0, 5, 65, 66, 67})
NEVER_M = frozenset({0, 1, 2, 30, 98, 99})
#: M codes that end, call or leave a program.
PROGRAM_M = frozenset({2, 30, 98, 99, 198})


def registered_codes(channel: Channel) -> CodeCalls:
    """The codes that the parameters of a channel register."""
    return _registered(channel.setup.parameters)


@lru_cache(maxsize=64)
def _registered(parameters: Parameters) -> CodeCalls:
    g: dict[str, CodeCall] = {}
    m: dict[int, CodeCall] = {}
    for i in range(10):
        code = int(parameters.number(6050 + i))
        if abs(code) not in NEVER_G:
            g[f"G{abs(code)}"] = CodeCall(9010 + i, "modal" if code < 0 else "macro")
        code = int(parameters.number(6080 + i))
        if code not in NEVER_M:
            m[code] = CodeCall(9020 + i)
    for i in range(1, 10):
        code = int(parameters.number(6070 + i))
        if code not in NEVER_M:
            m[code] = CodeCall(9000 + i, "sub")
    return CodeCalls(g, m, CodeCall(9000, "sub") if parameters.bit(6001, 5) else None)
