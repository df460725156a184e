"""Which codes call programs on FANUC controls (parameters 6050 to 6059, 6071 to 6089, 6001#5)."""

from __future__ import annotations

from functools import lru_cache

from polycnc.control.word_address.macro_b.code_calls import CodeCall, CodeCalls
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters

#: G codes and M codes that no parameter can register.
NEVER_G = frozenset({0, 5, 65, 66, 67})
NEVER_M = frozenset({0, 1, 2, 30, 98, 99})
#: M codes that end, call or leave a program.
PROGRAM_M = frozenset({2, 30, 98, 99, 198})


@lru_cache(maxsize=64)
def registered_codes(parameters: FanucParameters[FanucAxisParameters]) -> CodeCalls:
    """The codes that parameters register; of two calls of an M code that of a subprogram counts."""
    g = {
        f"G{abs(code)}": CodeCall(program, "modal" if code < 0 else "macro")
        for program, code in enumerate(parameters.g_codes_of_macros, 9010)
        if abs(code) not in NEVER_G
    }
    macros = {code: CodeCall(program) for program, code in enumerate(parameters.m_codes_of_macros, 9020)}
    subprograms = {
        code: CodeCall(program, "sub") for program, code in enumerate(parameters.m_codes_of_subprograms, 9001)
    }
    m = {code: call for code, call in (macros | subprograms).items() if code not in NEVER_M}
    return CodeCalls(g, m, CodeCall(9000, "sub") if parameters.TCS else None)
