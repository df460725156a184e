"""Single block on controls with custom macro B: what a program and parameters say of it (macro B reference §2)."""

from __future__ import annotations

from polycnc.control.word_address.macro_b.variables import ControlSwitches
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.word_address.executable import SkippedBlock

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step
    from polycnc.control.word_address.block.single_block import Halts
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.language.word_address import WordAddressProgram


def not_where_left_out(channel: MacroChannel, _level: Level[WordAddressProgram], step: Step) -> bool | None:
    """No block that block skip leaves out counts."""
    return False if isinstance(step, SkippedBlock) and step.is_left_out(channel) else None


def not_where_forbidden(channel: MacroChannel, _level: Level[WordAddressProgram], _step: Step) -> bool | None:
    """#3003 bit 0 forbids all halts, but for 6000#7 SBV."""
    forbidden = ControlSwitches.of(channel).values.get("cntl1", 0) & 1
    return False if forbidden and not channel.memory.parameters.SBV else None


def not_behind_calls(channel: MacroChannel, level: Level[WordAddressProgram], _step: Step) -> bool | None:
    """Calls and returns do not count; the end of the program does."""
    return None if channel.level is level else False


def behind_statements(channel: MacroChannel, level: Level[WordAddressProgram], _step: Step) -> bool | None:
    """Behind macro statements with 6000#5 SBM or #7 SBV."""
    if not level.code.is_statement(level.current):
        return None
    return channel.memory.parameters.SBM or channel.memory.parameters.SBV


def behind_words(_channel: MacroChannel, level: Level[WordAddressProgram], _step: Step) -> bool:
    """Behind blocks of words."""
    return level.code.has_words(level.current)


HALTS: tuple[Halts, ...] = (
    not_where_left_out, not_where_forbidden, not_behind_calls, behind_statements, behind_words,
)  # fmt: skip
