"""Single block on SYNTEC: what macros say of it, and blocks of macro files."""

from __future__ import annotations

from polycnc.control.syntec.macros.variables import SpaceState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.blocks import TypedBlock

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step
    from polycnc.control.syntec.family import SyntecChannel

#: A macro sets bit 0 of it while single block is not to halt.
HALTS_FORBIDDEN = 1502


def not_where_forbidden(channel: SyntecChannel, _level: Level, _step: Step) -> bool | None:
    """#1502 bit 0 forbids all halts."""
    return False if SpaceState.of(channel).words.get(HALTS_FORBIDDEN, 0) & 1 else None


def behind_typed_blocks(channel: SyntecChannel, level: Level, step: Step) -> bool | None:
    """Behind a block of words of a macro file; calls and returns do not count."""
    return channel.level is level and not channel.finished if isinstance(step, TypedBlock) else None
