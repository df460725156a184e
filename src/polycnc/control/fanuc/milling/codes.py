"""G table and addresses of the FANUC machining centre (Hartford manual §13.2; FANUC macro B)."""

from __future__ import annotations

from functools import wraps

from polycnc.control.fanuc.milling.cycles import MILLING_DRILLING
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.auxiliary.m_codes import MACHINING_CENTRE
from polycnc.control.word_address.block.codes import (
    MILLING_POWER_ON,
    GCode,
    MCode,
    Order,
    m_table,
    not_yet,
    table,
    with_aliases,
)
from polycnc.control.word_address.coordinates import frames, systems
from polycnc.control.word_address.cycles.drilling import is_active
from polycnc.control.word_address.macro_b import code_calls
from polycnc.control.word_address.motion import path, path_modes
from polycnc.control.word_address.tools.radius import SIDES
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, Any

with loaded_when_called():
    from polycnc.control.fanuc import dwell
    from polycnc.control.fanuc.milling import leading_edge, smoothing, standing_system, table_system
    from polycnc.control.word_address.coordinates import stroke_check
    from polycnc.control.word_address.macro_b import macro_calls, parameter_input
    from polycnc.control.word_address.motion import nurbs, planes, position_offset, skip, thread
    from polycnc.control.word_address.tools import corner_vectors, length, measuring, spatial
    from polycnc.control.word_address.transformations import (
        cylinder,
        normal_line,
        polar_interpolation,
        tilted_plane,
        workpiece,
    )

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Handler
    from polycnc.control.word_address.block.words import Words


def outside_cycles(code: str, handler: Handler, takes: str = "") -> GCode:
    """A row of a code that a drilling cycle refuses (PS0044)."""

    @wraps(handler)
    def act(channel: Channel, words: Words) -> None:
        if is_active(channel):
            raise words.fail("cycle_reference", code)
        handler(channel, words)

    return moves(code, act, takes)


def moves(code: str, handler: Handler, takes: str = "", **fields: Any) -> GCode:
    """A row of a one-shot code that takes the axis words of its block."""
    return GCode(code, handler=handler, takes=takes, axis_words=True, order=Order.MOTION, **fields)


#: Second ways to write codes.
ALIASES = {"G49.1": "G49", "G107": "G7.1", "G112": "G12.1", "G113": "G13.1"}
ROWS = table(
    GCode("G0", "motion", ends="cycle", planner=path.plan_rapid),
    GCode("G1", "motion", ends="cycle", planner=path.plan_line),
    GCode("G2", "motion", ends="cycle", planner=path.plan_arc_cw),
    GCode("G3", "motion", ends="cycle", planner=path.plan_arc_ccw),
    GCode("G6.2", "motion", ends="cycle", planner=nurbs.plan_nurbs),
    moves("G4", dwell.dwell, "X P U"),
    GCode("G5", handler=path_modes.high_speed_machining, takes="P"),
    GCode("G5.1", handler=smoothing.contour_control, takes="Q R", axis_words=True),
    GCode("G5.4", handler=path_modes.select_current_loop, takes="Q"),
    GCode("G8", handler=path_modes.advance_preview, takes="P"),
    GCode("G9", handler=path_modes.exact_stop_block),
    moves("G10", workpiece.input_data, "L P R"),
    GCode("G11", handler=parameter_input.end),
    GCode("G15", "polar"),
    GCode("G16", "polar", frames.start_polar),
    GCode("G7.1", handler=cylinder.cylinder, axis_words=True, order=Order.MOTION),
    GCode("G12.1", "polar_interpolation", polar_interpolation.start_polar),
    GCode("G13.1", "polar_interpolation", polar_interpolation.end_polar),
    GCode("G17", "plane", planes.select_plane),
    GCode("G18", "plane", planes.select_plane),
    GCode("G19", "plane", planes.select_plane),
    GCode("G20", "unit", systems.note_context, only_changes=True),
    GCode("G21", "unit", systems.note_context, only_changes=True),
    GCode(
        "G22", "stroke", stroke_check.stroke_check_on, takes="I J K", axis_words=True, order=Order.MOTION
    ),
    GCode("G23", "stroke", stroke_check.stroke_check_off),
    GCode("G25", "fluctuation"),
    GCode("G26", "fluctuation", takes="P Q R I"),
    outside_cycles("G27", systems.check_reference),
    outside_cycles("G28", systems.return_to_reference),
    outside_cycles("G29", systems.return_from_reference),
    outside_cycles("G30", systems.return_to_further_reference, "P"),
    moves("G31", skip.skip_or_torque_move, "P"),
    GCode("G33", "motion", ends="cycle", planner=thread.plan_thread),
    moves("G37", measuring.measure_length, "H"),
    GCode("G38", handler=corner_vectors.hold_vector, takes="I J K", order=Order.COMPENSATION),
    GCode("G39", handler=corner_vectors.corner_arc, takes="I J K", order=Order.COMPENSATION),
    GCode("G40.1", "normal_line", normal_line.cancel),
    GCode("G41.1", "normal_line", normal_line.start),
    GCode("G42.1", "normal_line", normal_line.start),
    GCode("G40", "compensation", table_system.cancel, takes="I J K", order=Order.COMPENSATION),
    GCode("G41", "compensation", corner_vectors.compensate_left, takes="D I J K", order=Order.COMPENSATION),
    GCode("G42", "compensation", corner_vectors.compensate_right, takes="D I J K", order=Order.COMPENSATION),
    *(
        GCode(code, "compensation", table_system.compensate, takes="D", order=Order.COMPENSATION)
        for code in SIDES
    ),
    GCode("G41.3", "compensation", leading_edge.offset_edge, takes="D", order=Order.COMPENSATION),
    GCode("G43", "length", standing_system.compensate_length, takes="H", order=Order.LENGTH),
    GCode("G44", "length", standing_system.compensate_length, takes="H", order=Order.LENGTH),
    GCode("G43.4", "length", standing_system.start_following, takes="H", order=Order.LENGTH),
    GCode("G43.5", "length", standing_system.start_following, takes="H Q", order=Order.LENGTH),
    *(
        moves(code, position_offset.offset_move, "D I J K R", idle_in_cycle=True)
        for code in ("G45", "G46", "G47", "G48")
    ),
    GCode("G49", "length", standing_system.cancel_length, order=Order.LENGTH),
    GCode("G50", "scaling", frames.end_scale),
    GCode("G51", "scaling", frames.scale, takes="I J K P", reals="P", axis_words=True),
    GCode("G50.1", "mirror", frames.end_mirror, axis_words=True),
    GCode("G51.1", "mirror", frames.mirror, axis_words=True),
    GCode("G52", handler=systems.set_local_system, axis_words=True),
    moves("G53", systems.move_in_machine_system_absolute),
    GCode("G54", "wcs", systems.select_work_offset, takes="P", gives_way="P"),
    GCode("G54.1", "wcs", systems.select_work_offset, takes="P"),
    *(GCode(f"G{number}", "wcs", systems.select_work_offset) for number in range(55, 60)),
    GCode("G54.2", handler=workpiece.offset_fixture, takes="P", order=Order.MOTION),
    GCode("G54.4", handler=workpiece.correct_workpiece, takes="P", order=Order.MOTION),
    moves("G60", position_offset.position_one_way),
    GCode("G61", "path", systems.note_context, only_changes=True),
    GCode("G62", "path", systems.note_context, only_changes=True),
    GCode("G63", "path", systems.note_context, only_changes=True),
    GCode("G64", "path", systems.note_context, only_changes=True),
    GCode("G65", handler=macro_calls.call_macro, takes="*", axis_words=True, order=Order.CALL),
    GCode("G66", "macro", macro_calls.start_modal_call, takes="*", axis_words=True, order=Order.CALL),
    GCode("G66.1", "macro", macro_calls.start_modal_call, takes="*", axis_words=True, order=Order.CALL),
    GCode("G67", "macro", macro_calls.end_modal_call),
    GCode("G68", "rotation", frames.rotate, takes="R", axis_words=True),
    GCode("G68.2", "rotation", tilted_plane.tilt_plane, takes="P Q R I J K", axis_words=True),
    GCode("G68.3", "rotation", tilted_plane.tilt_by_tool, takes="R", axis_words=True),
    GCode("G68.4", "rotation", tilted_plane.tilt_further, takes="P Q R I J K", axis_words=True),
    GCode("G53.1", handler=tilted_plane.align_tool, takes="P", order=Order.MOTION),
    GCode("G53.6", handler=tilted_plane.align_tool_about_tip, takes="P", order=Order.MOTION),
    GCode("G69", "rotation", tilted_plane.end_tilt),
    GCode("G80", "cycle"),
    *(GCode(code, "cycle") for code in MILLING_DRILLING.cycles),
    GCode("G90", "distance"),
    GCode("G91", "distance"),
    moves("G92", systems.set_position_or_limit, "S"),
    moves("G92.1", systems.preset_system),
    GCode("G93", "feed", systems.forget_feed, order=Order.FEED_MODE),
    GCode("G94", "feed", systems.forget_feed, order=Order.FEED_MODE, only_changes=True),
    GCode("G95", "feed", systems.forget_feed, order=Order.FEED_MODE, only_changes=True),
    GCode("G96", "surface_speed", systems.note_context, takes="P"),
    GCode("G97", "surface_speed", systems.note_context, only_changes=True),
    GCode("G98", "return"),
    GCode("G99", "return"),
    not_yet("G10.9"),
)  # fmt: skip
G_CODES = with_aliases(ROWS, ALIASES)
M_CODES = m_table(*MACHINING_CENTRE, MCode(29, handler=functions.arm_rigid_tapping))


ADDRESSES = {
    "F": functions.plan_feed,
    "S": functions.plan_spindle_speed,
    "T": code_calls.plan_tool_or_call,
    "B": functions.plan_second_auxiliary,
    "H": length.plan_length_number,
    "D": spatial.plan_radius_number,
}

POWER_ON = MILLING_POWER_ON | {
    "fluctuation": "G25",
    "polar_interpolation": "G13.1",
    "cylinder": "",
    "normal_line": "G40.1",
    "fixture": "",
    "workpiece_error": "",
    "tip_system": "",
    "point_system": "",
    "tip_lean": "",
    "calls": code_calls.ALL_CALLS,
    "interruption": "M97",
    "data_input": "G11",
}
