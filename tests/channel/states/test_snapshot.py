"""Snapshots: what a program does from a block on is the same however often one goes back there.

A control is added by a `Language`: blocks of which random programs are made. Together they should use every feature
that has state of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from random import Random
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.channel import Channel
from polycnc.channel.group import ChannelGroup
from polycnc.channel.states.snapshot import Snapshot, SnapshotError
from polycnc.channel.states.state import plain_states, plain_tables
from polycnc.channel.waits import Wait, Why
from polycnc.control.registry import control
from polycnc.control.word_address.auxiliary.functions import Clocks
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.language.bulk.kernels import scan
from polycnc.language.bulk.settings import Bulk
from polycnc.machine import load_machine, parse_setup
from polycnc.program import Form, ProgramStore


@dataclass(frozen=True)
class Language:
    """What random programs of a control are made of: `blocks` in any order, between `head` and `tail`."""

    head: str
    blocks: tuple[str, ...]
    tail: str = "M30"
    files: dict[str, str] = field(default_factory=dict)
    setup: dict[str, Any] = field(default_factory=dict)
    machine: str = ""


MILL_FILES = {
    "O2": "O2\nG91 G1 X1.\nG90\n#102=#102+1\nM99\n",
    "O3": "O3\n#103=#1+#103\nG1 Z#2\nM99\n",
    "O4": "O4\n#104=#5041\nG91 G0 Z5.\nG90\nM99\n",
}
MILL = Language(
    "O1\nM96 P4\nG90 G54 G17 G0 X0 Y0 Z20. S800 M3 F300.",
    (
        "G1 X10. Y5.", "G0 Z5.", "G3 X0 Y-5. R15.", "G91 G1 X1. Y-1.\nG90", "#100=#100+1.5", "T2",
        "G41 D1 G1 X5. Y10.\nX20.\nY30.", "G40 G1 X0 Y0", "G43 H2 Z15.", "G49",
        "G83 X10. Y10. Z-10. R2. Q3. F100.", "X20.", "G80", "G84 X5. Z-5. R2. F80.\nG80",
        "M98 P2", "G65 P3 A1. B2.", "G66 P3 A2. B1.\nX8.\nG67",
        "#101=0\nWHILE[#101LT3]DO1\nG1 X#101\n#101=#101+1\nEND1", "G68 X0 Y0 R30.", "G69", "M0", "M1",
        "G10 L2 P1 X1.", "G55", "G54", "G52 X1.", "G92 X3.", "G16\nG1 X10. Y30.\nG15", "G28 Z0", "G95 F.2", "G94 F100.",
        "G9 G1 X3.", "G4 P100", "G20\nX.5\nG21", "#3001=0", "M8", "N5 G1 X[#100]", "G51 X0 Y0 P2.", "G50",
        "G54.1 P3 G0 X1.", "G44 H1\nZ9.", "H2\nZ7.", "D2", "#1=#1+2.", "#500=#500+1.", "G10 L10 P2 R25.", "G51.1 X2.",
        "G50.1", "G31 X20. F100.",
    ),
    files=MILL_FILES,
    setup={
        "tools": {1: {"radius": 2.0}, 2: {"length": 30.0}},
        "switches": {"interrupts": [{"input": 1, "line": 5, "at": {"X": 4}}]},
    },
)  # fmt: skip
ROUGHING = """G71 U2. R1.
G71 P10 Q20 U.5 W.1 F.3
N10 G0 X20.
G1 Z-10. F.1
X40. Z-30.
N20 X60.
G70 P10 Q20"""
FACING = """G72 W2. R1.
G72 P30 Q40 U.5 W.1 F.3
N30 G0 Z-20. X60.
#105=#105+1
G1 X40. F.1
N40 X20. Z0
G0 X60. Z5."""
PATTERN = """G73 U2. W1. R2
G73 P50 Q60 U.5 W.1 F.3
N50 G0 X20. Z2.
G1 Z-10. F.1
N60 X50. Z-20.
G0 X60. Z5."""
COMPENSATED = """G0 G42 X60. Z5.
G71 U2. R1.
G71 P70 Q80 U.5 W.1 F.3
N70 G0 X20.
G1 Z-10. F.1
G2 X30. Z-15. R5.
N80 G1 X60.
G40 G0 X70. Z10."""
LATHE = Language(
    "O1\nM96 P4\nT0101\nG50 S2000\nG97 S500 M3\nG0 X60. Z5.",
    (
        "G1 X50. Z0 F.2", "G0 X60. Z5.", "G96 S100", "G97 S400", "U-2. W-1.", "G2 U4. W-2. R3. F.1", "T0202", "T0200",
        "G42 G1 X40. Z2. F.2\nZ-10.\nX50. Z-15.", "G40 G0 X70. Z10.", "G92 X30. Z-20. F1.5", "G90 X40. Z-10. F.2\nX38.",
        "G76 P010060 Q100 R.1\nG76 X28. Z-20. P900 Q300 F1.5", ROUGHING, "G83 Z-20. R-3. Q2000 F.1", "G80 G0 Z10.",
        "M98 P2", "#100=#100+1.5", "#101=0\nWHILE[#101LT3]DO1\nG0 X[60.+#101]\n#101=#101+1\nEND1", "M0", "G4 U.1",
        "G10 L2 P1 Z1.", "G55", "G54", "G52 Z1.", "G28 U0", "G99", "G98 F50.", "G32 Z-5. F1.",
        FACING, PATTERN, COMPENSATED, "G74 R1.\nG74 X40. Z-10. P2000 Q3000 F.1",
        "G75 R1.\nG75 X40. Z-6. P2000 Q3000 F.1", "G65 P3 A1. B2.", "G66 P3 A2. B1.\nG0 X62.\nG67",
        "G1 X50. Z0 F.2\nX60. K-1.\nZ-10.", "G32 Z-5. F1.\nX62. Z-8.\nG0 Z5.", "G34 Z-9. F1. K.1",
        "G94 X40. Z-3. F.1", "G84 Z-8. R-3. F1.\nG80", "G85 Z-8. R-3. F.1 K2\nG80", "G10 P1 X.5",
        "G10 P10001 X1. R.8", "#2001=#2001+.1", "G50 X61.", "G10 L52\nN5114 R2.\nG11",
        "G22 X200. Z200. I-200. K-200.\nG23", "G20\nG21", "T0101\nG0 X61.", "G18",
    ),
    files={
        "O2": "O2\nG0 U1.\n#102=#102+1\nM99\n",
        "O3": "O3\n#103=#1+#103\nG0 W#2\nM99\n",
        "O4": "O4\n#104=#5041\nG0 U2.\nM99\n",
    },
    setup={
        "tools": {1: {"radius": 0.4, "tip": 3, "x": 5.0}, 2: {"x": 10.0, "z": 3.0}},
        "switches": {"interrupts": [{"input": 1, "line": 7, "at": {"X": 25}}]},
    },
)  # fmt: skip
MELDAS = replace(MILL, head=MILL.head.replace("M96 P4\n", ""))
SYNTEC = replace(
    MELDAS,
    blocks=(
        *(each for each in MILL.blocks if not each.startswith(("G20", "G68"))),
        "@1=@1+2",
        "#401=#401+1",
        "#2001=#2001+1",
        "#1080=3",
        "G70\nX.5\nG71",
        "G54 P17 G0 X1.",
        "G92.1 X1. R30.",
        "G68.2 X1. Z2. K10.\nG53.1",
        "G69",
        "G2.4 X5. Y5.\nX9. Y0",
        "G31.10 X3. F50.\nG31.11",
        "G10 L1000 P6000 R7",
        "G93 G1 X3. F2.\nG94",
        "G10 L801 P400 Q100",
        "A5.",
        "G54.4 P1",
        "S1=200",
        "G10.9 X1",
        "G81 X3. Z-5. R2. F90. F2=200",
        "G12.1",
        "G52 Y2.",
    ),
)
SINUMERIK_FILES = {
    "_N_L1_SPF": "G91 G1 X1\nG90\nR1=R1+1\nM17\n",
    "_N_PART_SPF": "PROC PART(REAL A, VAR REAL B) SAVE\nDEF REAL STEP=A\nG18 G91\nB=B+STEP\nG1 X1\nRET\n",
    "_N_LIFT_SPF": "PROC LIFT SAVE\nG0 Z20\nR9=R9+1\nREPOSL\nM17\n",
    "_N_CON_SPF": "G1 X20 Y0\nX40\nG3 X50 Y10 CR=10\nG1 Y30\nM17\n",
}
SINUMERIK = Language(
    "DEF REAL DEPTH=-3, FOUND[4]\nDEF INT COUNT\nG90 G54 G17 G94 T1 D1 M6\nG0 X0 Y0 Z20 S800 M3 F300",
    (
        "G1 X10 Y5", "G0 Z5", "X=R1+COUNT Y=IC(2)", "G3 X0 Y-5 CR=15", "CIP X5 Y5 I1=3 J1=4", "G1 X1 Y2\nCT X8 Y9",
        "G91 G1 X1 Y-1\nG90", "R1=R1+1.5 R2=$P_EP[X]", "COUNT=COUNT+1", "FOUND[1]=DEPTH*2\nFOUND=REP(R1)", "T2 D1 M6",
        "G41 G1 X5 Y10\nX20\nY30", "G40 G1 X0 Y0", "G1 X0 Y0 CHF=1\nX10 RND=2\nY10", "RNDM=1\nX5\nY8\nX1\nRNDM=0",
        "G41 G1 X9 Y1\nX30 RND=9\nG40\nY20",
        "CYCLE81(5,0,1,-4)", "CYCLE83(5,0,1,-20,,-5,,2,,,1,0)", "CYCLE84(5,0,1,-10,,,3,,1.5,0,400)",
        "MCALL CYCLE82(5,0,1,-4,,1)", "HOLES1(0,0,30,5,8,3)", "HOLES2(0,0,10,0,0,4)", "X20", "MCALL L1\nX3\nMCALL",
        "POCKET4(10,0,2,-4,9,0,0,4,0,0,500,100,2,11)", 'CYCLE72("CON",10,0,2,-4,4,0,0,500,100,1,42,1,8,900,1,8)',
        "CYCLE832(0.05,1)", "CYCLE832()", "L1", "L1 P2", "PART(2,R1)", "IF R1>2\nX1\nELSE\nX2\nENDIF",
        "FOR COUNT=1 TO 3\nG1 X=COUNT\nENDFOR", "COUNT=0\nWHILE COUNT<2\nX=COUNT\nCOUNT=COUNT+1\nENDWHILE",
        "PLACE: X4\nG1 Y4\nREPEAT PLACE P=2", "TRANS X5", "AROT Z30", "SCALE X2", "MIRROR X0", "ROT", "TRANS",
        "G55", "G54",
        "$P_UIFR[1,X,TR]=$P_UIFR[1,X,TR]+1\nG54", "SUPA G0 X1", "G110 X1 Y2", "G1 AP=30 RP=12", "G95 F.2", "G94 F100",
        "G9 G1 X3", "G4 F.5", "M0", "M1", "SETINT(1) PRIO=1 LIFT", "DISABLE(1)", "ENABLE(1)", "CLRINT(1)",
        'MSG("HERE")',
        "STOPRE", "WALIMON\nG25 X-50\nG26 X90", "WALIMOF", "$TC_DP3[1,1]=$TC_DP3[1,1]+1", "OFFN=.5", "$AC_MARKER[1]=3",
        "BSPLINE X1 Y2\nX3 Y5\nX8 Y2\nX9 Y9\nG1 X0", "G641 ADIS=.3", "FRC=50 G1 X4 RND=1\nY4",
        "G147 G41 DISR=3 X9 Y9\nG1 X20\nX30\nG40 X35",
        "ANG=30\nG1 X40 Y40 ANG=60", "CYCLE800()", "G1 X7 FB=20", "POS[Z]=8", "G700 X.5\nG710",
        "$TC_CARR8[1]=1 $TC_CARR13[1]=30\nTCARR=1\nX3 Z2", "TCOFR\nCUTMOD=-1\nTOROT", "TOFFON(Z,.5)\nX4\nTOFFOF(Z)",
        "TOROTOF TCOABS\nTCARR=0\nFTOCON\nFTOCOF", "$TC_SCP13[1,1]=.5\nTOWMCS T1 D1 DL=1\nX6\nD1",
        "PON SPP=3", "SON X6", "PUNCHACC(1,50,5,100)", "SPOF", "SPN=2 X9\nSPP=0",
        "$TC_DP1[2,1]=400 $TC_TPG3[2]=9\nTMON(2)", "TMOF(0)",
    ),
    files=SINUMERIK_FILES,
    setup={
        "tools": {1: {"radius": 2.0}, 2: {"radius": 3.0, "length": 30.0}},
        "parameters": {"$MC_PUNCHNIB_ACTIVATION": 1},
        "switches": {"interrupts": [{"input": 1, "line": 6, "at": {"X": 4}}]},
    },
)  # fmt: skip
#: Transformations of SINUMERIK, each on a machine that has them.
TRANSFORMED = {
    "geometry axes": Language(
        "G90 G17 G94 T1 D1\nG1 X0 Y0 Z0 F3000",
        (
            "GEOAX(1,U)", "GEOAX(2,V,3,ZZ)", "GEOAX(0,V)", "GEOAX()", "X5 U=3", "Y5", "G91 Z1\nG90", "TRANS X2",
            "ROT Z20", "G18", "G17", "G3 X-5 CR=9", "G41 X9 Y9\nX20\nG40 X30", "T2 D1", "RND=1 X8\nY8", "M0",
        ),
        setup={"tools": {1: {"radius": 2.0, "length": 50.0}, 2: {"radius": 3.0, "length": 30.0}}},
        machine="mill6-uvw",
    ),
    "five axes": Language(
        "G90 G17 G94 T1 D1\nTRAORI\nG1 X0 Y0 Z0 F3000",
        (
            "X5 A3=1 C3=2", "Y5 A3=0 B3=1 C3=2", "A3=0 B3=0 C3=1", "A10 C20", "A2=30 B2=10", "ORIRPY", "ORIEULER",
            "ORIMKS", "ORIWKS", "G3 X-5 CR=9 A3=0.5 C3=1", "ORICONCW", "A6=0 B6=0 C6=1", "ORICURVE\nX9 XH=9 YH=1 ZH=9",
            "ORIPATH\nX20 LEAD=5", "ORIPATHS\nX3 Y4 LEAD=8\nY9 A8=0 B8=0 C8=1", "ORIVECT", "PTP", "CP",
            "A3=1 C3=1 STAT=1",
            "C=90 TU='B1'", "ORIRESET(10,20)", "ROT X10", "TRANS", "TRAFOOF", "TRAORI", "T2 D1", "G91 X1\nG90",
            "G0 X1", "G1 Y1", "G64", "G60", "G41 X9 Y9\nX20\nG40 X30", "RND=1 X8\nY8",
        ),
        setup={"tools": {1: {"radius": 2.0, "length": 50.0}, 2: {"radius": 3.0, "length": 30.0}}},
        machine="mill5-ca-head",
    ),
    "turning": Language(
        "G90 G17 G94 T1 D1 F500\nG0 X40 Z5",
        (
            "TRANSMIT", "TRACYL(40)", "TRAFOOF", "G0 X20 Z1", "G1 X10 Z2", "G1 X30", "PTPG0", "CP", "ROT RPL=20",
            "TRANS X2", "G0 Z9", "G91 Z1\nG90", "M0",
        ),
        setup={"tools": {1: {"radius": 2.0}}},
        machine="lathe-c-transmit",
    ),
    "groove": Language(
        "G90 G19 G94 T1 D1 F500\nG0 X40 Z5\nTRACYL(40)\nG1 X20",
        (
            "G1 G42 Z9", "G40 Z1", "G1 Y5", "G1 Z8", "Z2", "G3 Y10 Z0 CR=20", "OFFN=6", "M0", "Y0", "X25", "TRAFOOF",
            "TRACYL(50)",
        ),
        setup={"tools": {1: {"radius": 2.0}}, "parameters": {"$MC_TRAFO_TYPE_1": 513}},
        machine="lathe-c-transmit-y",
    ),
}  # fmt: skip
LANGUAGES = {
    "sinumerik-840d": SINUMERIK,
    "fanuc-m": replace(
        MILL, blocks=(*MILL.blocks, "G10 L21 P1 X1.\nG54.2 P1 G0 X3.\nG54.2 P0", "#26010=1.\nG54.4 P1\nX2.")
    ),
    "meldas-m": MELDAS,
    "fanuc-0i-tf": LATHE,
    "syntec-mill": SYNTEC,
}


def group_of(control_id: str, text: str, language: Language, bulk: Bulk | None = None) -> Iterator[Wait]:
    """A run of all channels, block by block."""
    chosen = control(control_id)
    store = ProgramStore(form=chosen.form)
    folder = "/_N_MPF_DIR/" if chosen.form is Form.SINUMERIK else ""
    main = store.add_text(f"{folder}MAIN", text)
    for name, more in language.files.items():
        store.add_text(folder + name, more)
    machine = load_machine(language.machine or chosen.default_machine)
    channel = Channel(chosen, machine, parse_setup(language.setup), store, block_limit=3000, bulk=bulk)
    channel.single_block = channel.block_by_block = bulk is None
    return ChannelGroup(channel).run(main)


def state_of(group: ChannelGroup) -> list[object]:
    """Everything that one sees of the channels of a group."""
    seen: list[object] = []
    for channel in group.channels:
        names = [] if channel.memory is None else channel.control.variable_names(channel)
        seen.append((
            [repr(row) for row in channel.toolpath.rows()],
            channel.toolpath.contexts[:],
            {name: repr(channel.control.read_variable(channel, name)) for name in names},
            [repr(alarm) for alarm in channel.alarms],
            plain_states(channel),
            (channel.blocks, channel.coordinates.machine, channel.mode.codes, repr(channel.feed)),
            [(level.index, level.kind, level.repeats) for level in channel.stack],
            Clocks.of(channel).seconds,
        ))  # fmt: skip
    return seen


def rest_of(run: Iterator[Wait], group: ChannelGroup) -> tuple[list[object], ...]:
    """Waits to the end of a run, or to where it goes on in a main run; how it ends; what is retained, too."""
    waits: list[object] = []
    for wait in run:
        waits.append((wait.reason, wait.code))
        if wait.reason is Why.CLOCK:
            break
    return waits, state_of(group), [plain_tables(channel) for channel in group.channels]


def check_from(run: Iterator[Wait], blocks: int) -> None:
    """Go some blocks on; from there, every time, the same must happen."""
    group: ChannelGroup = run._group  # type: ignore[attr-defined]
    for _ in range(blocks):
        if next(run, None) is None:
            break
    here, snapshot = state_of(group), Snapshot(group)
    first = rest_of(run, group)
    for _ in range(2):
        snapshot.restore()
        assert state_of(group) == here
        assert rest_of(run, group) == first


@pytest.mark.parametrize("control_id", LANGUAGES)
@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_what_a_program_does_from_a_block_on_is_the_same_every_time(
    control_id: str, data: st.DataObject
) -> None:
    language = LANGUAGES[control_id]
    chosen = data.draw(st.lists(st.sampled_from(language.blocks), min_size=2, max_size=12))
    text = "\n".join([language.head, *chosen, language.tail, ""])
    check_from(group_of(control_id, text, language), data.draw(st.integers(0, text.count("\n") + 10)))


@pytest.mark.parametrize("kind", TRANSFORMED)
@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_so_it_is_under_transformations(kind: str, data: st.DataObject) -> None:
    language = TRANSFORMED[kind]
    chosen = data.draw(st.lists(st.sampled_from(language.blocks), min_size=2, max_size=12))
    text = "\n".join([language.head, *chosen, language.tail, ""])
    check_from(group_of("sinumerik-840d", text, language), data.draw(st.integers(0, text.count("\n") + 10)))


@pytest.mark.parametrize("blocks", range(9))
def test_a_snapshot_of_one_channel_covers_those_that_run_beside_it(blocks: int) -> None:
    second = "WAITM(1,1)\nR1=R1+1\nG0 X=R1\n$A_DLD[0]=$A_DLD[0]+1\nWAITM(2,1)\nR2=7\nM30\n"
    first = 'INIT(2,"B")\nSTART(2)\nR1=1\nWAITM(1,2)\nG0 Y=R1\n$A_DLD[0]=$A_DLD[0]*2\nWAITM(2,2)\nR1=5\nM30\n'
    language = Language("", (), files={"_N_B_MPF": second}, machine="mill3-2ch")
    check_from(group_of("sinumerik-840d", first, language), blocks)


@pytest.mark.parametrize("blocks", range(12))
def test_a_snapshot_of_an_axis_group_covers_registers_and_axes_that_groups_share(blocks: int) -> None:
    text = """$1
@1=1
G52.2 P100
G4.1 P1
G0 X3.
@2=@2+@1
G4.1 P2
G52.1 P100
M30
$2
@1=@1+1
G4.1 P1
#1=@2
G4.1 P2
G52.2 P100
G0 X7.
M30
"""
    setup = {"parameters": {"742": 1, "701": 3, "702": 3}}
    check_from(group_of("syntec-mill", text, Language("", (), setup=setup, machine="mill2-2ch")), blocks)


@pytest.mark.parametrize("blocks", [0, 1, 2])
def test_rows_that_were_scanned_in_bulk_come_again(blocks: int) -> None:
    lines = [f"G1 X{i / 7:.3f} Y{i % 5}." for i in range(60)]
    text = "\n".join(
        [
            "O1",
            "G90 G54 G0 X0 Y0 F100.",
            *lines,
            "M0",
            "M98 P2",
            *lines,
            "G10 L2 P1 X1.",
            "M0",
            *lines,
            "M30",
            "",
        ]
    )
    check_from(group_of("fanuc-m", text, MILL, Bulk(0, scan)), blocks)


def test_a_generator_in_flight_is_refused() -> None:
    with pytest.raises(SnapshotError, match="generator in flight"):
        Snapshot(SimpleNamespace(blocks=(number for number in range(3))))


def test_a_state_made_since_comes_back_as_the_same_object_as_it_begins() -> None:
    run = group_of("fanuc-m", "O1\nG0 X1.\nM30\n", MILL)
    next(run)
    group: ChannelGroup = run._group  # type: ignore[attr-defined]
    without = Snapshot(group)
    assert RadiusState not in group.first.states
    state = RadiusState.of(group.first)
    state.number = 3
    with_it = Snapshot(group)
    without.restore()
    assert state.number == 0
    with_it.restore()
    assert RadiusState.of(group.first).number == 3
    without.restore()
    assert RadiusState.of(group.first) is state
    assert state.number == 0


# ---- what objects may look like ----------------------------------------------------------------------------------


class Slotted:
    """An object whose fields lie in slots; one has no value yet."""

    __slots__ = ("later", "values")
    later: int

    def __init__(self) -> None:
        self.values = [1]


def counter() -> Any:
    """A closure over a number that changes."""
    count = 0

    def step() -> int:
        nonlocal count
        count += 1
        return count

    return step


def test_objects_stay_the_same_ones_and_get_their_contents_back() -> None:
    slotted, step, random = Slotted(), counter(), Random(1)
    inner: list[int] = []
    root = SimpleNamespace(
        slotted=slotted, step=step, add=inner.append, random=random, table={"a": inner}, seen={1}
    )
    snapshot = Snapshot(root)  # anything may be a root
    for _ in range(2):
        root.add(5)
        root.extra, root.table["b"], slotted.later, slotted.values = 1, [], 3, []
        root.seen.add(2)
        drawn = random.random()
        assert step() == 1
        snapshot.restore()
        assert (inner, root.table, root.seen, slotted.values) == ([], {"a": inner}, {1}, [1])
        assert not hasattr(slotted, "later")
        assert not hasattr(root, "extra")
        assert root.table["a"] is inner
        assert random.random() == drawn
        snapshot.restore()


def test_what_cannot_be_noted_is_refused() -> None:
    with pytest.raises(SnapshotError, match="list_iterator"):
        Snapshot(SimpleNamespace(rest=iter([1, 2])))
