"""Machining cycles: the table of their signatures, and how a call runs as a program level of its own.

On the control a cycle is a subprogram with SAVE, SBLOF and DISPLOF. Here its blocks come from a generator: it moves
the tool and yields where one of its blocks ends. So a cycle may stop with M0, call what MCALL has set, or run a
contour program, and goes on behind it; what it shows is the block of its caller.

Source: SINUMERIK standard cycles, manual of the cycles (signatures, sequences, alarms 61000 to 62999).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from polycnc.channel.stack import Level
from polycnc.control.sinumerik import (
    auxiliary,
    cycles_contour,
    cycles_drilling,
    cycles_milling,
    cycles_patterns,
    cycles_settings,
    cycles_surfaces,
    cycles_swivel,
    cycles_turning,
    stages,
)
from polycnc.control.sinumerik.cycles_arguments import Arguments
from polycnc.language.sinumerik.sections import count_levels, end_of_subprogram
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.control.sinumerik.memory import Memory

#: The plane of a cycle by the units of _DMODE; 0 and others: that of the caller.
PLANES = {1: "G17", 2: "G18", 3: "G19"}


class Cycle(NamedTuple):
    """A row of the table.

    Attributes:
        signature: Names of the parameters in their order.
        blocks: What the cycle does.
        saves: G functions and programmable frame of the caller are in force again afterwards.
    """

    signature: str
    blocks: Callable[[Channel, Arguments], Iterator[None]]
    saves: bool = True


_SL = "_GMODE _DMODE _AMODE"
_HOLE = "RTP RFP SDIS DP DPR"
#: Milling cycles of the second generation: the depth is _DP alone.
_MILL = "RTP RFP SDIS DP"
_SL_MILL = f"_UMODE _FS _ZFS {_SL}"
_PITCHES = "_PITM _PTAB _PTABA"
CYCLES: dict[str, Cycle] = {
    "CYCLE81": Cycle(f"{_HOLE} DTB {_SL}", cycles_drilling.drill),
    "CYCLE82": Cycle(f"{_HOLE} DTB {_SL} _VARI S_ZA S_FA S_ZD S_FD", cycles_drilling.drill),
    "CYCLE83": Cycle(
        f"{_HOLE} FDEP FDPR DAM DTB DTS FRF VARI _AXN _MDEP _VRT _DTD _DIS1 {_SL}", cycles_drilling.deep_hole
    ),
    "CYCLE84": Cycle(
        f"{_HOLE} DTB SDAC MPIT PIT POSS SST SST1 _AXN _PITA _TECHNO _VARI _DAM _VRT {_PITCHES} {_SL}",
        cycles_drilling.rigid_tapping,
    ),
    "CYCLE840": Cycle(
        f"{_HOLE} DTB SDR SDAC ENC MPIT PIT _AXN _PITA _TECHNO {_PITCHES} {_SL}",
        cycles_drilling.tapping_with_chuck,
    ),
    "CYCLE85": Cycle(f"{_HOLE} DTB FFR RFF {_SL}", cycles_drilling.ream),
    "CYCLE86": Cycle(f"{_HOLE} DTB SDIR RPA RPO RPAP POSS {_SL}", cycles_drilling.bore_and_lift),
    "CYCLE87": Cycle(f"{_HOLE} SDIR", cycles_drilling.bore_and_halt),
    "CYCLE88": Cycle(f"{_HOLE} DTB SDIR", cycles_drilling.bore_and_halt),
    "CYCLE89": Cycle(f"{_HOLE} DTB", cycles_drilling.bore),
    "HOLES1": Cycle("SPCA SPCO STA1 FDIS DBH NUM _VARI _UMODE _HIDE _NSP _DMODE", cycles_patterns.row),
    "HOLES2": Cycle("CPA CPO RAD STA1 INDA NUM _VARI _UMODE _HIDE _NSP _DMODE", cycles_patterns.circle),
    "CYCLE801": Cycle(
        "_SPCA _SPCO _STA _DIS1 _DIS2 _NUM1 _NUM2 _VARI _UMODE _ANG1 _ANG2 _HIDE _NSP _DMODE",
        cycles_patterns.grid,
    ),
    "POCKET1": Cycle(
        f"{_HOLE} LENG WID CRAD CPA CPO STA1 FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF",
        cycles_milling.older_pocket,
    ),
    "POCKET2": Cycle(
        f"{_HOLE} PRAD CPA CPO FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF", cycles_milling.older_pocket
    ),
    "POCKET3": Cycle(
        f"{_MILL} _LENG _WID _CRAD _PA _PO _STA _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA _AP1 _AP2 _AD"
        f" _RAD1 _DP1 {_SL_MILL}",
        cycles_milling.pocket3,
    ),
    "POCKET4": Cycle(
        f"{_MILL} _PRAD _PA _PO _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA _AP1 _AD _RAD1 _DP1 {_SL_MILL}",
        cycles_milling.pocket4,
    ),
    "SLOT1": Cycle(
        f"{_HOLE} NUM LENG WID CPA CPO RAD STA1 INDA FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF _FALD _STA2"
        f" _DP1 {_SL_MILL}",
        cycles_milling.slot1,
    ),
    "SLOT2": Cycle(
        f"{_HOLE} NUM AFSL WID CPA CPO RAD STA1 INDA FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF _FFCP"
        f" {_SL_MILL}",
        cycles_milling.slot2,
    ),
    "LONGHOLE": Cycle(
        f"{_HOLE} NUM LENG CPA CPO RAD STA1 INDA FFD FFP1 MID {_SL_MILL}", cycles_milling.long_hole
    ),
    "CYCLE61": Cycle(
        f"{_MILL} _PA _PO _LENG _WID _MID _MIDA _FALD _FFP1 _VARI _LIM _DMODE _AMODE", cycles_surfaces.face
    ),
    "CYCLE62": Cycle("_KNAME _TYPE _LAB1 _LAB2", cycles_contour.choose),
    "CYCLE71": Cycle(
        f"{_MILL} _PA _PO _LENG _WID _STA _MID _MIDA _FDP _FALD _FFP1 _VARI _FDP1", cycles_surfaces.face
    ),
    "CYCLE72": Cycle(
        f"_KNAME {_MILL} _MID _FAL _FALD _FFP1 _FFD _VARI _RL _AS1 _LP1 _FF3 _AS2 _LP2 {_SL_MILL}",
        cycles_surfaces.path,
    ),
    "CYCLE76": Cycle(
        f"{_HOLE} _LENG _WID _CRAD _PA _PO _STA _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _AP1 _AP2"
        f" _FS _ZFS {_SL}",
        cycles_surfaces.spigot,
    ),
    "CYCLE77": Cycle(
        f"{_HOLE} _PRAD _PA _PO _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _AP1 _FS _ZFS {_SL}",
        cycles_surfaces.spigot,
    ),
    "CYCLE79": Cycle(
        f"{_MILL} _NUM _SWL _PA _PO _STA _RC _AP1 _MIDA _MID _FAL _FALD _FFP1 _CDIR _VARI _FS _ZFS {_SL}",
        cycles_surfaces.polygon,
    ),
    "CYCLE90": Cycle(f"{_HOLE} DIATH KDIAM PIT FFR CDIR TYPTH CPA CPO", cycles_surfaces.thread),
    "CYCLE93": Cycle(
        "SPD SPL WIDG DIAG STA1 ANG1 ANG2 RCO1 RCO2 RCI1 RCI2 FAL1 FAL2 IDEP DTB VARI _VRT _DN",
        cycles_turning.groove,
    ),
    "CYCLE94": Cycle("SPD SPL FORM _VARI", cycles_turning.undercut),
    "CYCLE96": Cycle("DIATH SPL FORM _VARI", cycles_turning.undercut),
    "CYCLE95": Cycle("NPP MID FALZ FALX FAL FF1 FF2 FF3 VARI DT DAM _VRT", cycles_turning.stock_removal),
    "CYCLE97": Cycle(
        "PIT MPIT SPL FPL DM1 DM2 APP ROP TDEP FAL IANG NSP NRC NID VARI NUMT _VRT", cycles_turning.thread
    ),
    "CYCLE98": Cycle(
        "PO1 DM1 PO2 DM2 PO3 DM3 PO4 DM4 APP ROP TDEP FAL IANG NSP NRC NID PP1 PP2 PP3 VARI NUMT _VRT",
        cycles_turning.thread_chain,
    ),
    "CYCLE800": Cycle(
        "_FR _TC _ST _MODE _X0 _Y0 _Z0 _A _B _C _X1 _Y1 _Z1 _DIR _FR_I _DMODE",
        cycles_swivel.swivel,
        saves=False,
    ),
    "CYCLE832": Cycle("S_TOL S_TOLM S_OTOL", cycles_settings.high_speed, saves=False),
    "CYCLE802": Cycle(
        "_XA _YA " + " ".join(f"_X{i} _Y{i}" for i in range(9)) + " _VARI _UMODE _DMODE",
        cycles_patterns.points,
    ),
}


class CycleProgram:
    """A running cycle as the program of its level; line and name are those of the calling block.

    Args:
        channel: The channel, with the caller as its running level.
        blocks: The cycle.
        column: Column of the call.
    """

    def __init__(self, channel: Channel, blocks: Iterator[None], column: int) -> None:
        caller = channel.level
        self.program = caller.code.program
        self.steps: Sequence[Step | None] = ()
        self._line = channel.line
        self._column = column
        self._blocks = blocks
        self._acted = False

    def step(self, index: int) -> Step | None:  # noqa: ARG002 - every block of a cycle is the next one
        """The next block."""
        return self._advance

    def line(self, index: int) -> int:  # noqa: ARG002 - DISPLOF: the calling block stands for all
        """The line of the call."""
        return self._line

    def column(self, index: int, address: str) -> int:  # noqa: ARG002 - there is no text
        """The column of the call."""
        return self._column

    def text(self, index: int) -> str:  # noqa: ARG002 - there is no text
        """Nothing: the blocks of a cycle have no text of their own."""
        return ""

    def _advance(self, channel: Channel) -> None:
        """One block; for single block operation the end acts if any block of the cycle did."""
        memory: Memory = channel.memory
        mark = channel.toolpath.mark()
        try:
            next(self._blocks)
            memory.acted = channel.toolpath.mark() != mark
            self._acted = self._acted or memory.acted
        except StopIteration:
            memory.acted = self._acted or channel.toolpath.mark() != mark
            end_of_subprogram(channel)
        except AlarmError as alarm:
            alarm.column = alarm.column or self._column
            raise


def start(channel: Channel, name: str, values: tuple[Any, ...], column: int) -> None:
    """Begin a cycle on a level of its own; 14012 if there is none left."""
    cycle = CYCLES[name]
    arguments = Arguments(channel, name, tuple(cycle.signature.split()), values)
    count_levels(channel)
    channel.flush()
    caller = channel.level
    code = CycleProgram(channel, _in_plane(channel, cycle, arguments), column)
    level = Level(code, program_number=caller.program_number, kind="cycle", locals=caller.locals)
    level.data["single_block"] = False
    level.data["sblof_in_proc"] = caller.data.get("single_block", True)
    if cycle.saves:
        level.data["saved"] = channel.control.save(channel)
    channel.stack.append(level)
    channel.level = level


def _in_plane(channel: Channel, cycle: Cycle, arguments: Arguments) -> Iterator[None]:
    """The blocks of a cycle in the plane that _DMODE asks for."""
    memory: Memory = channel.memory
    plane = PLANES.get(arguments.digit("_DMODE", 0))
    if plane is not None and plane != channel.mode["plane"] and cycle.saves:
        channel.mode = channel.mode.with_code("plane", plane)
        stages.change_plane(channel)
        auxiliary.tool_changed(channel)
    if cycle.saves and channel.mode["side"] != "G40":
        raise AlarmError("61815", text=arguments.cycle)
    memory.previous = None
    yield from cycle.blocks(channel, arguments)
