"""Where single block operation halts.

SBL1 halts behind blocks that do something on the machine, SBL2 behind every block, SBL3 too, whatever SBLOF says.
A level with SBLOF in its PROC halts at its M17; RET and calls never do. Interrupt routines run through if MD10702 bit 1
or MD20117 say so; SBLON brings the halts back only in the first case. Nothing halts in a section of DELAYFSTON.
Source: job planning 1.25.2.5 (SBLOF, SBLON), 8.4.
"""

from __future__ import annotations

import re

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import Wait, Why
from polycnc.control.sinumerik.signals import sections
from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.interface import NcExecutable

#: MD10702 bit 1: interrupt routines of the user run through, until SBLON.
IGNORE_ROUTINES = 1 << 1
#: MD10702 bit 12: no halt in the block of SBLON under SBL2.
IGNORE_SBLON = 1 << 12
_SBLON = regex(r"\bSBLON\b", re.IGNORECASE)


@dataclass(slots=True)
class RunningBlock(State, lifetime=Lifetime.BLOCK):
    """The running block has done something on the machine."""

    acted: bool = False


def begin_routine(channel: SinumerikChannel, level: Level) -> None:
    """An interrupt routine begins: whether single block acts in it."""
    if channel.memory.data.integer("$MN_IGNORE_SINGLEBLOCK_MASK") & IGNORE_ROUTINES:
        level.data["single_block"] = False


def halt_behind_rest(channel: SinumerikChannel) -> None:
    """The rest of an interrupted block has been made behind its routine: the halt of that block."""
    level = channel.level
    if channel.single_block and (level.data.get("single_block", True) or _kind(channel) == "SBL3"):
        channel.wait = channel.wait or Wait(Why.SINGLE_BLOCK, level.block_name())


def _kind(channel: SinumerikChannel) -> str:
    return str(channel.setup.switches.single_block)


def _runs_through(channel: SinumerikChannel) -> bool:
    """MD20117, while an interrupt routine runs."""
    if not channel.memory.data.integer("$MC_IGNORE_SINGLEBLOCK_ASUP"):
        return False
    return any(level.kind is LevelKind.INTERRUPT for level in channel.stack)


def halts(channel: SinumerikChannel, level: Level[NcExecutable]) -> bool:
    """Whether single block halts behind the block that a level has just run."""
    block = RunningBlock.of(channel)
    acted, block.acted = block.acted, False
    kind = channel.setup.switches.single_block
    if _runs_through(channel) or sections.delays_stops(channel):
        return False
    is_on = level.data.get("single_block", True) or kind == "SBL3"
    if not any(level is each for each in channel.stack):
        return acted and (is_on or bool(level.data.get("sblof_in_proc")))
    if not is_on or channel.level is not level:
        return False
    if kind not in ("SBL2", "SBL3"):
        return acted
    ignores = channel.memory.data.integer("$MN_IGNORE_SINGLEBLOCK_MASK") & IGNORE_SBLON
    return not (ignores and _SBLON.search(level.code.text(level.current)))
