"""G codes of the lathe in the systems A, B and C as one table, M codes, addresses (0i-TF Plus II.2).

A row says how a code is written in each system (3401#6, #7) and what it does. Inside polycnc a code has one name
whatever the system: that of system A, and of B and C where A has none. So handlers know one name only.
"""

from __future__ import annotations

from functools import cache

from polycnc.control.fanuc.lathe import balance as turning_balance
from polycnc.control.fanuc.lathe.coordinates import limits, systems
from polycnc.control.fanuc.lathe.cycles.drilling import NORMAL_CYCLES, SERIES_15_CYCLES
from polycnc.control.fanuc.lathe.cycles.tapping import RIGID, RIGID_OFF, rigid_tapping
from polycnc.control.fanuc.lathe.motion import threads
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.tools import offsets
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.block.codes import GCode, MCode, Order, m_table
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.coordinates import systems as coordinates
from polycnc.control.word_address.macro_b import code_calls
from polycnc.control.word_address.motion import path, path_modes
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.fanuc.lathe import auxiliary as turning_auxiliary
    from polycnc.control.fanuc.lathe import spindle_indexing
    from polycnc.control.fanuc.lathe.coordinates import tilted
    from polycnc.control.fanuc.lathe.cycles import grinding as turning_grinding
    from polycnc.control.fanuc.lathe.cycles import repetitive, single
    from polycnc.control.fanuc.lathe.motion import beside, retract
    from polycnc.control.fanuc.lathe.tools import data_input, measuring, nose_radius
    from polycnc.control.word_address.macro_b import macro_calls, parameter_input, subprograms
    from polycnc.control.word_address.transformations import (
        cylinder,
        normal_line,
        polar_interpolation,
        tilted_plane,
    )

if TYPE_CHECKING:
    from collections.abc import Mapping


SYSTEMS = "ABC"


@dataclass(frozen=True, slots=True)
class Row:
    """A code and how it is written in systems A, B and C; empty where a system does not have it."""

    codes: tuple[str, str, str]
    code: GCode


def same(code: GCode, *aliases: str) -> tuple[Row, ...]:
    """A code that is written alike in all systems, and further ways to write it."""
    return tuple(Row((written,) * 3, code) for written in (code.code, *aliases))


def by_system(a: str, b: str, c: str, code: GCode) -> tuple[Row, ...]:
    """A code that is written differently."""
    return (Row((a, b, c), code),)


def not_yet(*codes: str) -> tuple[Row, ...]:
    """Codes that the control knows and polycnc does not execute yet."""
    return tuple(row for code in codes for row in same(GCode(code, not_yet=True)))


def _motion(code: str, planner: object) -> GCode:
    return GCode(code, "motion", ends="cycle", planner=planner)  # type: ignore[arg-type]


def _point(code: str, handler: object, takes: str = "") -> GCode:
    """A one-shot code that takes the axis words of its block."""
    return GCode(code, handler=handler, takes=takes, axis_words=True, order=Order.MOTION)  # type: ignore[arg-type]


def _cycle(code: str, handler: object) -> GCode:
    """A multiple repetitive cycle: its P and D may be depths and allowances."""
    return replace(_point(code, handler, "P Q U V W R D I J K A E"), reals="PD")


ROWS: tuple[Row, ...] = (
    *same(_motion("G0", path.plan_rapid)),
    *same(_motion("G1", path.plan_line)),
    *same(_motion("G2", path.plan_arc_cw)),
    *same(_motion("G3", path.plan_arc_ccw)),
    *same(_point("G4", turning_auxiliary.dwell, "X P U")),
    *same(GCode("G4.1", handler=turning_auxiliary.wait_for_blocks, takes="P")),
    *same(GCode("G5", handler=path_modes.high_speed_machining, takes="P")),
    *same(GCode("G5.1", handler=path_modes.contour_control, takes="Q R")),
    *same(GCode("G5.4", handler=path_modes.select_current_loop, takes="Q")),
    *same(GCode("G8", handler=path_modes.advance_preview, takes="P")),
    *same(GCode("G9", handler=path_modes.exact_stop_block)),
    *same(_point("G10", data_input.input_data, "L P R Q C E F")),
    *same(GCode("G11", handler=parameter_input.end)),
    *same(_point("G10.6", retract.prepare)),
    *same(GCode("G7.1", handler=cylinder.cylinder, axis_words=True, order=Order.MOTION), "G107"),
    *same(GCode("G12.1", "polar_interpolation", polar_interpolation.start_polar), "G112"),
    *same(GCode("G13.1", "polar_interpolation", polar_interpolation.end_polar), "G113"),
    *same(GCode("G17", "plane", systems.select_plane)),
    *same(GCode("G18", "plane", systems.select_plane)),
    *same(GCode("G19", "plane", systems.select_plane)),
    *by_system("G20", "G20", "G70", GCode("G20", "unit", coordinates.note_context, only_changes=True)),
    *by_system("G21", "G21", "G71", GCode("G21", "unit", coordinates.note_context, only_changes=True)),
    *same(GCode("G22", "stroke", limits.stroke_check_on, takes="I J K", axis_words=True, order=Order.MOTION)),
    *same(GCode("G23", "stroke", limits.stroke_check_off)),
    *same(GCode("G25", "fluctuation")),
    *same(GCode("G26", "fluctuation", turning_auxiliary.note_fluctuation, takes="P Q R I")),
    *same(_point("G27", systems.check_reference)),
    *same(_point("G28", systems.return_to_reference), "G28.2"),
    *same(_point("G29", systems.return_from_reference)),
    *same(_point("G30", systems.return_to_further_reference, "P"), "G30.2"),
    *same(_point("G31", measuring.skip_move, "P")),
    *by_system("G32", "G33", "G33", _motion("G32", threads.plan_thread)),
    *same(_motion("G34", threads.plan_growing_thread)),
    *same(_motion("G35", threads.plan_circular_thread_cw)),
    *same(GCode("G38", handler=nose_radius.hold_vector, order=Order.COMPENSATION)),
    *same(GCode("G39", handler=nose_radius.corner_arc, takes="I J K", order=Order.MOTION)),
    *same(GCode("G40", "compensation", nose_radius.cancel, takes="I J K", order=Order.COMPENSATION)),
    *same(GCode("G41", "compensation", nose_radius.left, takes="D", order=Order.COMPENSATION)),
    *same(GCode("G42", "compensation", nose_radius.right, takes="D", order=Order.COMPENSATION)),
    *same(GCode("G40.1", "normal_line", normal_line.cancel)),
    *same(GCode("G41.1", "normal_line", normal_line.start)),
    *same(GCode("G42.1", "normal_line", normal_line.start)),
    *same(GCode("G43.7", "atc_offset", offsets.select_by_code, takes="D", order=Order.LENGTH), "G44.7"),
    *same(
        GCode("G43", "atc_offset", offsets.select_by_length_code, takes="D", order=Order.LENGTH), "G44"
    ),
    *same(GCode("G49", "atc_offset", offsets.cancel_by_code, order=Order.LENGTH)),
    *by_system("G50", "G92", "G92", _point("G50", systems.set_position, "S")),
    *by_system("G50.3", "G92.1", "G92.1", _point("G50.3", systems.preset_system)),
    *same(GCode("G50.1", "mirror", frames.end_mirror, axis_words=True)),
    *same(GCode("G51.1", "mirror", frames.mirror, axis_words=True)),
    *same(GCode("G50.2", "polygon", beside.end_polygon, order=Order.MOTION), "G250"),
    *same(GCode("G51.2", "polygon", beside.start_polygon, takes="P Q R", order=Order.MOTION), "G251"),
    *same(_point("G81.1", beside.start_oscillation, "Q R")),
    *same(GCode("G81.4", handler=beside.start_gear, takes="T L Q P", reals="PQ", order=Order.MOTION)),
    *same(GCode("G50.4", handler=beside.end_synchronous, takes="P Q L", order=Order.MOTION)),
    *same(GCode("G51.4", handler=beside.start_synchronous, takes="P Q L", order=Order.MOTION)),
    *same(_point("G80.5", beside.end_pair)),
    *same(_point("G81.5", beside.start_pair, "T L P")),
    *same(GCode("G80.4", handler=beside.end_gear, order=Order.MOTION)),
    *same(_point("G50.9", turning_auxiliary.output_while_moving)),
    *same(_point("G52", systems.set_local_system)),
    *same(_point("G53", systems.move_in_machine_system, "P")),
    *same(_point("G53.2", systems.feed_in_machine_system)),
    *same(GCode("G54", "wcs", systems.select_work_offset, takes="P", gives_way="P"), "G54.1"),
    *(row for n in range(55, 60) for row in same(GCode(f"G{n}", "wcs", systems.select_work_offset))),
    *same(GCode("G61", "path", coordinates.note_context, only_changes=True)),
    *same(GCode("G63", "path", coordinates.note_context, only_changes=True)),
    *same(GCode("G64", "path", coordinates.note_context, only_changes=True)),
    *same(GCode("G65", handler=macro_calls.call_macro, takes="*", axis_words=True, order=Order.CALL)),
    *same(GCode("G66", "macro", macro_calls.start_modal_call, takes="*", axis_words=True, order=Order.CALL)),
    *same(GCode("G66.1", "macro", macro_calls.start_modal_call, takes="*", axis_words=True, order=Order.CALL)),
    *same(GCode("G67", "macro", macro_calls.end_modal_call)),
    *same(GCode("G53.1", handler=tilted_plane.align_tool, takes="P", order=Order.MOTION)),
    *same(GCode("G53.6", handler=tilted_plane.align_tool_about_tip, takes="P", order=Order.MOTION)),
    *same(GCode("G68.1", "rotation", tilted.rotate, takes="I J K R", axis_words=True)),
    *same(GCode("G68.2", "rotation", tilted.tilt_plane, takes="P Q R I J K", axis_words=True)),
    *same(GCode("G68.3", "rotation", tilted.tilt_by_tool, takes="R", axis_words=True)),
    *same(GCode("G68.4", "rotation", tilted.tilt_further, takes="P Q R I J K", axis_words=True)),
    *same(GCode("G69.1", "rotation", tilted.end)),
    *by_system("G70", "G70", "G72", _point("G70", repetitive.finish, "P Q")),
    *by_system("G71", "G71", "G73", _cycle("G71", repetitive.rough_turning)),
    *by_system("G72", "G72", "G74", _cycle("G72", repetitive.rough_facing)),
    *by_system("G73", "G73", "G75", _cycle("G73", repetitive.repeat_pattern)),
    *by_system("G74", "G74", "G76", _cycle("G74", repetitive.peck_facing)),
    *by_system("G75", "G75", "G77", _cycle("G75", repetitive.groove)),
    *by_system("G76", "G76", "G78", _cycle("G76", repetitive.thread)),
    *same(GCode("G80", "cycle")),  # what moves beside the program ends by a rule
    *by_system("G90", "G77", "G20", _motion("G90", single.plan_single_cycle)),
    *by_system("G92", "G78", "G21", _motion("G92", single.plan_single_cycle)),
    *by_system("G94", "G79", "G24", _motion("G94", single.plan_single_cycle)),
    *same(GCode("G91.1", handler=limits.limit_increment, axis_words=True, order=Order.MOTION)),
    *same(GCode("G96", "surface_speed", turning_auxiliary.surface_speed, takes="P")),
    *same(GCode("G97", "surface_speed", coordinates.note_context, only_changes=True)),
    *same(GCode("G96.1", handler=spindle_indexing.index_and_wait, takes="P R", order=Order.MOTION)),
    *same(GCode("G96.2", handler=spindle_indexing.index, takes="P R", order=Order.MOTION)),
    *same(GCode("G96.3", handler=spindle_indexing.wait_for_index, takes="P R", order=Order.MOTION)),
    *same(GCode("G96.4", handler=spindle_indexing.turn_as_spindle, takes="P R", order=Order.MOTION)),
    *by_system("G98", "G94", "G94", GCode("G98", "feed", systems.keep_feed_number, order=Order.FEED_MODE)),
    *by_system("G99", "G95", "G95", GCode("G99", "feed", systems.keep_feed_number, order=Order.FEED_MODE)),
    *by_system("", "G90", "G90", GCode("G90", "distance")),
    *by_system("", "G91", "G91", GCode("G91", "distance")),
    *by_system("", "G98", "G98", GCode("G98", "return")),
    *by_system("", "G99", "G99", GCode("G99", "return")),
    *not_yet("G31.8", "G50.5", "G50.6", "G51.5", "G51.6"),
)  # fmt: skip

#: 3405#3 G36 = 0: automatic tool offset; = 1: circular thread, and the offset is G37.1, G37.2.
MEASURING_36 = (
    *same(_point("G36", measuring.measure_first)),
    *same(_point("G37", measuring.measure_second)),
)
MEASURING_37 = (
    *same(_point("G37.1", measuring.measure_first)),
    *same(_point("G37.2", measuring.measure_second)),
    *same(_motion("G36", threads.plan_circular_thread_ccw)),
)
#: One path, or 8137#0 NVC = 1: G68 mirrors the opposite turret; else it is balance cutting.
MIRROR = (
    *same(GCode("G68", "turret_mirror", systems.mirror_turret, takes="P")),
    *same(GCode("G69", "turret_mirror", systems.end_mirror_turret)),
)
BALANCE = (
    *same(GCode("G68", "turret_mirror", turning_balance.begin, takes="*")),
    *same(GCode("G69", "turret_mirror", turning_balance.end, takes="*")),
)
#: 5106#0 GFX = 1: grinding cycles in place of G71 to G74.
GRINDING = tuple(
    row
    for a, c in (("G71", "G72"), ("G72", "G73"), ("G73", "G74"), ("G74", "G75"))
    for row in by_system(a, a, c, _motion(f"{a} grinding", turning_grinding.plan_grinding))
)


#: 7710 names an axis: G81 closes the electronic gear box.
GEAR = same(GCode("G81", handler=beside.start_gear, takes="T L Q P", reals="PQ", order=Order.MOTION))


#: Functions that a machine may lack: the bit, its value that says so, and the codes it takes away.
FUNCTIONS = (
    (LatheParameters.SSC, False, frozenset({"G96"})),
    (LatheParameters.MNC, True, frozenset({"G65", "G66", "G66.1", "G67"})),
    (LatheParameters.NCR, True, frozenset({"G38", "G39", "G41", "G42"})),
)


def missing_codes(parameters: LatheParameters) -> frozenset[str]:
    """The codes whose functions the machine lacks: they are improper ones then (PS0010, II.2)."""
    lacking = (codes for function, off, codes in FUNCTIONS if parameters.value(function) is off)
    return frozenset[str]().union(*lacking)


@cache
def g_table(
    system: str,
    *,
    circular_thread: bool,
    grinding: bool,
    series_15: bool,
    balance: bool,
    gear: bool = False,
    missing: frozenset[str] = frozenset(),
) -> Mapping[str, GCode]:
    """The G table of a system as programs write it, with what the machine's parameters choose."""
    column = SYSTEMS.index(system)
    drilling = SERIES_15_CYCLES if series_15 else NORMAL_CYCLES
    chosen = (
        *ROWS,
        *(MEASURING_37 if circular_thread else MEASURING_36),
        *(GRINDING if grinding else ()),
        *(BALANCE if balance else MIRROR),
        *(row for code in drilling for row in same(GCode(code, "cycle"))),
        *(GEAR if gear else ()),
    )
    return {
        row.codes[column]: row.code for row in chosen if row.codes[column] and row.code.code not in missing
    }


#: All codes, as any system writes them.
WRITTEN = frozenset(
    code
    for row in (*ROWS, *MEASURING_37, *MEASURING_36, *GRINDING, *BALANCE, *MIRROR, *GEAR)
    for code in row.codes
    if code
) | {*NORMAL_CYCLES, *SERIES_15_CYCLES}


@cache
def written_codes(system: str) -> Mapping[tuple[str, str], str]:
    """How a modal code, by group and inner name, is written in a system."""
    column = SYSTEMS.index(system)
    rows = reversed((*ROWS, *MIRROR))
    return {(row.code.group, row.code.code): row.codes[column] for row in rows if row.codes[column]}


M_CODES = m_table(
    MCode(0, after=True, handler=functions.stop, silent=True),
    MCode(1, after=True, handler=functions.optional_stop, silent=True),
    MCode(2, after=True, handler=functions.end_program),
    MCode(3, handler=functions.spindle_clockwise, turns=True),
    MCode(4, handler=functions.spindle_counter_clockwise, turns=True),
    MCode(5, after=True, handler=functions.spindle_stop, turns=True),
    MCode(9, after=True),
    MCode(13, handler=functions.spindle_clockwise, turns=True),
    MCode(14, handler=functions.spindle_counter_clockwise, turns=True),
    MCode(19, after=True, handler=functions.spindle_stop, turns=True),
    MCode(29, handler=rigid_tapping),
    MCode(30, after=True, handler=functions.end_program),
    MCode(98, after=True, handler=subprograms.call_subprogram, takes="P L Q", silent=True),
    MCode(99, after=True, handler=subprograms.return_from_subprogram, takes="P L", silent=True),
    MCode(198, after=True, handler=subprograms.call_external_subprogram, takes="P L", silent=True),
)

ADDRESSES = {
    "F": functions.plan_feed,
    "S": functions.plan_spindle_speed,
    "T": offsets.plan_tool,
    "B": turning_auxiliary.plan_second_auxiliary,
}

POWER_ON = {
    "motion": "G0",
    "polar_interpolation": "G13.1",
    "cylinder": "",
    "plane": "G18",
    "distance": "G90",
    "stroke": "G22",
    "feed": "G99",
    "unit": "G21",
    "fluctuation": "G25",
    "compensation": "G40",
    "normal_line": "G40.1",
    "atc_offset": "G49",
    "mirror": "G50.1",
    "polygon": "G50.2",
    "wcs": "G54",
    "path": "G64",
    "macro": "G67",
    "calls": code_calls.ALL_CALLS,
    "turret_mirror": "G69",
    "rotation": "G69.1",
    RIGID: RIGID_OFF,
    "cycle": "G80",
    "surface_speed": "G97",
    "data_input": "G11",
    "return": "G98",
}
