"""Which codes call programs on MELDAS (parameters #7001 to #7303: code, type and program of each)."""

from __future__ import annotations

from functools import lru_cache

from polycnc.control.word_address.macro_b.code_calls import CodeCall, CodeCalls
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.meldas.parameters import MeldasParameters

#: Type in a parameter to the kind of call: as M98, G65, G66, G66.1.
KINDS = ("sub", "macro", "modal", "each")
#: M codes that no parameter can register.
NEVER_M = frozenset({0, 1, 2, 30, 96, 97, 98, 99})
#: Cycles that users write ("user control cycle" of the G table); each calls O1000nnn0 of its own.
USER_CYCLES = (70, 71, 72, 75, 77, 78, 79)
FIRST_CYCLE_PROGRAM = 100_000_000


@lru_cache(maxsize=64)
def registered_codes(parameters: MeldasParameters) -> CodeCalls:
    """The codes that parameters register."""
    p = parameters
    g = {f"G{number}": CodeCall(FIRST_CYCLE_PROGRAM + 10 * number) for number in USER_CYCLES}
    for code, kind, program in zip(p.g_call_codes, p.g_call_types, p.g_call_programs, strict=True):
        if call := _call(kind, program):
            g[f"G{code}"] = call
    m: dict[int, CodeCall] = {}
    for code, kind, program in zip(p.m_call_codes, p.m_call_types, p.m_call_programs, strict=True):
        if code not in NEVER_M and (call := _call(kind, program)):
            m[code] = call
    return CodeCalls(g, m, _call(p.t_call_type, p.t_call_program))


def _call(kind: int, program: int) -> CodeCall | None:
    """The call of a program by its type; None where there is no program or no such type."""
    return CodeCall(program, KINDS[kind]) if program and 0 <= kind < len(KINDS) else None
