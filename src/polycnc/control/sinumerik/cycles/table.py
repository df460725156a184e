"""The table of the machining cycles: the signature of each, and the function that plans its blocks.

Source: SINUMERIK standard cycles, manual of the cycles (signatures, sequences, alarms 61000 to 62999).
"""

from __future__ import annotations

from polycnc.control.sinumerik.cycles import (
    deep_holes,
    drilling,
    engraving,
    high_speed_settings,
    milled_threads,
    milling,
    patterns,
    surfaces,
    swivel,
)
from polycnc.control.sinumerik.cycles.contours import pockets, reading
from polycnc.control.sinumerik.cycles.turning import (
    contours,
    corner,
    grooves,
    parting,
    stock_removal,
    threads,
    undercuts,
)
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves


class Cycle(NamedTuple):
    """A row of the table.

    Attributes:
        signature: The parameters in their order (`arguments`).
        plan: Notes what the cycle does, block by block.
        saves: G functions and programmable frame of the caller are in force again afterwards.
    """

    signature: str
    plan: Callable[[Moves, Arguments], None]
    saves: bool = True


_SL = "_GMODE _DMODE _AMODE"
_HOLE = "RTP RFP SDIS DP DPR"
#: Milling cycles of the second generation: the depth is _DP alone.
_MILL = "RTP RFP SDIS DP"
_SL_MILL = f"_UMODE _FS _ZFS {_SL}"
_PITCHES = "_PITM _PTAB _PTABA"
CYCLES: dict[str, Cycle] = {
    "CYCLE81": Cycle(f"{_HOLE} DTB {_SL}", drilling.drill),
    "CYCLE82": Cycle(f"{_HOLE} DTB {_SL} _VARI S_ZA S_FA S_ZD S_FD", drilling.drill),
    "CYCLE83": Cycle(
        f"{_HOLE} FDEP FDPR DAM DTB DTS FRF VARI _AXN _MDEP _VRT _DTD _DIS1 {_SL}", deep_holes.deep_hole
    ),
    "CYCLE830": Cycle(
        f"RTP RFP SDIS DP FDEP _DAM DTB DTS FRF VARI _MDEP _VRT _DTD _DIS1 {deep_holes.REST} {_SL}"
        f" {deep_holes.REST_OF_MODES}",
        deep_holes.deep_hole_2,
    ),
    "CYCLE84": Cycle(
        f"{_HOLE} DTB SDAC MPIT PIT POSS SST SST1 _AXN _PITA _TECHNO _VARI _DAM _VRT {_PITCHES} {_SL}",
        drilling.rigid_tapping,
    ),
    "CYCLE840": Cycle(
        f"{_HOLE} DTB SDR SDAC ENC MPIT PIT _AXN _PITA _TECHNO {_PITCHES} {_SL}",
        drilling.tapping_with_chuck,
    ),
    "CYCLE85": Cycle(f"{_HOLE} DTB FFR RFF {_SL}", drilling.ream),
    "CYCLE86": Cycle(f"{_HOLE} DTB SDIR RPA RPO RPAP POSS {_SL}", drilling.bore_and_lift),
    "CYCLE87": Cycle(f"{_HOLE} SDIR", drilling.bore_and_halt),
    "CYCLE88": Cycle(f"{_HOLE} DTB SDIR", drilling.bore_and_halt),
    "CYCLE89": Cycle(f"{_HOLE} DTB", drilling.bore),
    "HOLES1": Cycle("SPCA SPCO STA1 FDIS DBH NUM _VARI _UMODE _HIDE _NSP _DMODE", patterns.row),
    "HOLES2": Cycle("CPA CPO RAD STA1 INDA NUM _VARI _UMODE _HIDE _NSP _DMODE", patterns.circle),
    "CYCLE801": Cycle(
        "_SPCA _SPCO _STA _DIS1 _DIS2 _NUM1 _NUM2 _VARI _UMODE _ANG1 _ANG2 _HIDE _NSP _DMODE",
        patterns.grid,
    ),
    "POCKET1": Cycle(
        f"{_HOLE} LENG WID CRAD CPA CPO STA1 FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF",
        milling.older_pocket,
    ),
    "POCKET2": Cycle(f"{_HOLE} PRAD CPA CPO FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF", milling.older_pocket),
    "POCKET3": Cycle(
        f"{_MILL} _LENG _WID _CRAD _PA _PO _STA _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA _AP1 _AP2 _AD"
        f" _RAD1 _DP1 {_SL_MILL}",
        milling.pocket3,
    ),
    "POCKET4": Cycle(
        f"{_MILL} _PRAD _PA _PO _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA _AP1 _AD _RAD1 _DP1 {_SL_MILL}",
        milling.pocket4,
    ),
    "SLOT1": Cycle(
        f"{_HOLE} NUM LENG WID CPA CPO RAD STA1 INDA FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF _FALD _STA2"
        f" _DP1 {_SL_MILL}",
        milling.slot1,
    ),
    "SLOT2": Cycle(
        f"{_HOLE} NUM AFSL WID CPA CPO RAD STA1 INDA FFD FFP1 MID CDIR FAL VARI MIDF FFP2 SSF _FFCP"
        f" {_SL_MILL}",
        milling.slot2,
    ),
    "LONGHOLE": Cycle(f"{_HOLE} NUM LENG CPA CPO RAD STA1 INDA FFD FFP1 MID {_SL_MILL}", milling.long_hole),
    "CYCLE60": Cycle(
        f"_TEXT {_HOLE} _PA _PO _STA _CP1 _CP2 _WID _DF _FFD _FFP1 _VARI _CODEP _UMODE {_SL}",
        engraving.engrave,
    ),
    "CYCLE61": Cycle(
        f"{_MILL} _PA _PO _LENG _WID _MID _MIDA _FALD _FFP1 _VARI _LIM _DMODE _AMODE", surfaces.face
    ),
    "CYCLE62": Cycle("_KNAME _TYPE _LAB1 _LAB2", reading.choose),
    "CYCLE63": Cycle(
        f"_PRG _VARI {_MILL} _F _FZ _DXY _DZ _UXY _UZ _CDIR _XS _YS _ER _EP _EW _FS _ZFS _TR _DR _UMODE {_SL}",
        pockets.mill,
    ),
    "CYCLE64": Cycle(f"_PRG _VARI {_MILL} _F _DXY _UXY _UZ _CDIR _TR _DR _UMODE {_SL}", pockets.predrill),
    "CYCLE70": Cycle(
        f"{_MILL} _DIATH _H1 _FAL _PIT _NT _MID _FFR _TYPTH _PA _PO _NSP _VARI _PITA {_PITCHES} {_SL}",
        milled_threads.thread_with_teeth,
    ),
    "CYCLE71": Cycle(
        f"{_MILL} _PA _PO _LENG _WID _STA _MID _MIDA _FDP _FALD _FFP1 _VARI _FDP1", surfaces.face
    ),
    "CYCLE72": Cycle(
        f"_KNAME {_MILL} _MID _FAL _FALD _FFP1 _FFD _VARI _RL _AS1 _LP1 _FF3 _AS2 _LP2 {_SL_MILL}",
        surfaces.path,
    ),
    "CYCLE76": Cycle(
        f"{_HOLE} _LENG _WID _CRAD _PA _PO _STA _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _AP1 _AP2"
        f" _FS _ZFS {_SL}",
        surfaces.spigot,
    ),
    "CYCLE77": Cycle(
        f"{_HOLE} _PRAD _PA _PO _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _AP1 _FS _ZFS {_SL}",
        surfaces.spigot,
    ),
    "CYCLE78": Cycle(
        f"{_MILL} _ADPR _FDPR _LDPR _DIAM _PIT _PITA _DAM:number _MDEP _VARI _CDIR _GE _FFD _FRDP:feed _FFR _FFP2"
        f" _FFA:number {_PITCHES} {_SL}",
        milled_threads.drill_and_mill,
    ),
    "CYCLE79": Cycle(
        f"{_MILL} _NUM _SWL _PA _PO _STA _RC _AP1 _MIDA _MID _FAL _FALD _FFP1 _CDIR _VARI _FS _ZFS {_SL}",
        surfaces.polygon,
    ),
    "CYCLE90": Cycle(f"{_HOLE} DIATH KDIAM PIT FFR CDIR TYPTH CPA CPO", milled_threads.thread),
    "CYCLE899": Cycle(
        f"{_MILL} _LENG _WID _PA _PO _STA _MID _MIDA _FAL _FALD _FFP1 _CDIR _VARI {_SL} _UMODE _FS _ZFS",
        milling.open_slot,
    ),
    "CYCLE92": Cycle(
        "_SPD _SPL _DIAG1:diameter _DIAG2:diameter _RC _SDIS _SV1:number _SV2:number _SDAC:number _FF1 _FF2 _SS2:number"
        " _DIAGM:diameter _VARI _DN _DMODE _AMODE",
        parting.part_off,
    ),
    "CYCLE93": Cycle(
        "SPD SPL WIDG DIAG STA1 ANG1 ANG2 RCO1 RCO2 RCI1 RCI2 FAL1 FAL2 IDEP DTB VARI _VRT _DN",
        grooves.groove,
    ),
    "CYCLE930": Cycle(
        "_SPD _SPL _WIDG _WIDG2 _DIAG _DIAG2 _STA _ANG1 _ANG2 _RCO1 _RCI1 _RCI2 _RCO2 _FAL _IDEP1 _SDIS _VARI _DN"
        " _NUM _DBH _FF1 _NR _FALX _FALZ _DMODE _AMODE",
        grooves.grooves,
    ),
    "CYCLE94": Cycle("SPD SPL FORM _VARI", undercuts.undercut),
    "CYCLE96": Cycle("DIATH SPL FORM _VARI", undercuts.undercut),
    "CYCLE940": Cycle(
        "_SPD _SPL _FORM _LAGE _SDIS _FFP:feed _VARI _EPD:length _EPL _R1 _R2 _STA _VRT _MID _FAL _FALX _FALZ"
        " _PITI:number _PTAB _PTABA _DMODE _AMODE",
        undercuts.undercut_of_mask,
    ),
    "CYCLE95": Cycle("NPP MID FALZ FALX FAL FF1 FF2 FF3 VARI DT DAM _VRT", stock_removal.stock_removal),
    "CYCLE97": Cycle(
        "PIT MPIT SPL FPL DM1 DM2 APP ROP TDEP FAL IANG NSP NRC NID VARI NUMT _VRT", threads.thread
    ),
    "CYCLE98": Cycle(
        "PO1 DM1 PO2 DM2 PO3 DM3 PO4 DM4 APP ROP TDEP FAL IANG NSP NRC NID PP1 PP2 PP3 VARI NUMT _VRT"
        " _MID _GDEP _IFLANK _PITA _PITM1:text _PITM2:text _PITM3:text _DMODE _AMODE",
        threads.thread_chain,
    ),
    "CYCLE99": Cycle(
        "_SPL _DM1 _FPL _DM2 _APP _ROP _TDEP _FAL _IANG _NSP _NRC _NID _PIT _VARI _NUMT _SDIS _MID _GDEP _PIT1 _FDEP"
        " _GST _GUD _IFLANK _PITA _PITM _PTAB _PTABA _DMODE _AMODE",
        threads.thread_of_plane,
    ),
    "CYCLE951": Cycle(
        "_SPD _SPL _EPD _EPL _ZPD _ZPL _LAGE _MID _FALX _FALZ _VARI _RF1 _RF2 _RF3 _SDIS _FF1 _NR _DMODE _AMODE",
        corner.corner,
    ),
    "CYCLE952": Cycle(
        "_PRG _CON _CONR _VARI _F _FR:feed _RP:diameter _D _DX _DZ _UX _UZ _U _U1 _BL _XD _ZD _XA:diameter _ZA"
        " _XB:diameter _ZB _XDA:diameter _XDB:diameter _N _DP _DI _SC _DN _GMODE _DMODE _AMODE _PK _DCH _FS:feed",
        contours.turn,
    ),
    "CYCLE800": Cycle(
        "_FR _TC _ST _MODE _X0 _Y0 _Z0 _A _B _C _X1 _Y1 _Z1 _DIR _FR_I _DMODE",
        swivel.swivel,
        saves=False,
    ),
    "CYCLE832": Cycle("S_TOL S_TOLM S_OTOL", high_speed_settings.high_speed, saves=False),
    "CYCLE802": Cycle(
        "_XA _YA " + " ".join(f"_X{i} _Y{i}" for i in range(9)) + " _VARI _UMODE _DMODE",
        patterns.points,
    ),
}
