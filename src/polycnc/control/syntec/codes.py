"""G and M tables of the SYNTEC milling control (manual 1.1 and chapters 2, 3)."""

from __future__ import annotations

from polycnc.control.syntec import cycles, spindles, tapping
from polycnc.control.syntec.axis_groups import borrowing, groups
from polycnc.control.syntec.coordinates import systems as frames
from polycnc.control.syntec.macros import calls, interrupts
from polycnc.control.syntec.motion import arcs, dwell, moves, planes, smoothing
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.block.codes import (
    MILLING_POWER_ON,
    GCode,
    MCode,
    Order,
    m_table,
    table,
)
from polycnc.control.word_address.coordinates import frames as base_frames
from polycnc.control.word_address.coordinates import systems
from polycnc.control.word_address.motion import path, path_modes
from polycnc.control.word_address.tools import radius
from polycnc.deferred.functions import loaded_when_called

with loaded_when_called():
    from polycnc.control.syntec.coordinates import diameters, tool_setting
    from polycnc.control.syntec.five_axes import alignment, normal_direction, spatial, tilted, tip_control
    from polycnc.control.syntec.motion import operation, oscillation, polar, skips
    from polycnc.control.word_address.coordinates import stroke_check
    from polycnc.control.word_address.motion import nurbs
    from polycnc.control.word_address.tools import length as base_length
    from polycnc.control.word_address.transformations import normal_line

MOTION = Order.MOTION

G_CODES = table(
    GCode("G0", "motion", planner=moves.plan_rapid, ends="cycle"),
    GCode("G1", "motion", planner=path.plan_line, ends="cycle"),
    GCode("G2", "motion", planner=arcs.plan_arc_cw, ends="cycle"),
    GCode("G3", "motion", planner=arcs.plan_arc_ccw, ends="cycle"),
    GCode("G2.4", "motion", planner=arcs.plan_three_point_arc, ends="cycle"),
    GCode("G3.4", "motion", planner=arcs.plan_three_point_arc, ends="cycle"),
    GCode("G6.2", "motion", planner=nurbs.plan_nurbs, ends="cycle"),
    GCode("G33", "motion", planner=moves.plan_thread, ends="cycle"),
    GCode("G4", handler=dwell.dwell, takes="X P Q", axis_words=True, order=MOTION),
    GCode("G4.1", handler=groups.meet, takes="P Q", axis_words=True, order=MOTION),
    GCode("G10.6", handler=operation.arm_retract, takes="R F", axis_words=True),
    GCode("G28.1", handler=skips.position_at_sensor, takes="Q R F1 F2", axis_words=True, order=MOTION),
    GCode("G31.10", handler=skips.define_group, takes="Q P", axis_words=True, order=MOTION),
    GCode("G31.11", handler=skips.move_groups, axis_words=True, order=MOTION),
    GCode("G51.2", handler=spindles.polygon_on, takes="P Q R K"),
    GCode("G50.2", handler=spindles.release, takes="K"),
    GCode("G114.1", handler=spindles.synchronise, takes="R K"),
    GCode("G114.3", handler=spindles.superimpose, takes="K"),
    GCode("G113", handler=spindles.release, takes="K"),
    GCode("G120.1", handler=operation.select_conditions, takes="P Q"),
    GCode("G121", handler=operation.default_conditions),
    GCode("G5", handler=smoothing.high_precision, takes="P E", axis_words=True),
    GCode("G5.1", handler=smoothing.smooth_path, takes="Q E R"),
    GCode("G10.9", handler=diameters.switch_diameter, axis_words=True),
    GCode("G9", handler=path_modes.exact_stop_block),
    GCode("G10", handler=frames.input_data, takes="L P R Q I J K", axis_words=True, order=MOTION),
    GCode("G15", "polar"),
    GCode("G16", "polar", base_frames.start_polar),
    GCode("G12.1", "polar_interpolation", polar.start_polar, axis_words=True, order=MOTION),
    GCode("G13.1", "polar_interpolation", polar.end_polar),
    GCode("G17", "plane", planes.select_plane),
    GCode("G18", "plane", planes.select_plane),
    GCode("G19", "plane", planes.select_plane),
    GCode("G22", "stroke", frames.stroke_limit_on, takes="I J K", axis_words=True, order=MOTION),
    GCode("G23", "stroke", stroke_check.stroke_check_off),
    GCode("G28", handler=frames.return_to_reference, axis_words=True, order=MOTION),
    GCode("G29", handler=frames.return_from_reference, axis_words=True, order=MOTION),
    GCode("G30", handler=frames.return_to_further_reference, takes="P", axis_words=True, order=MOTION),
    GCode("G31", handler=moves.skip_move, takes="P Q", axis_words=True, order=MOTION),
    GCode("G37", handler=tool_setting.measure_length, takes="R D F P", axis_words=True, order=MOTION),
    GCode("G37.2", handler=tool_setting.measure_into_work_system, takes="K R F P Q", axis_words=True, order=MOTION),
    GCode("G37.3", handler=tool_setting.measure_into_length, takes="H R F P Q", axis_words=True, order=MOTION),
    GCode("G40.1", "normal_line", normal_line.cancel),
    GCode("G41.1", "normal_line", normal_direction.start, takes="Q P E R", order=MOTION),
    GCode("G42.1", "normal_line", normal_direction.start, takes="Q P E R", order=MOTION),
    GCode("G40", "compensation", cycles.cancel_compensation, takes="I J K", order=Order.COMPENSATION),
    GCode("G41", "compensation", cycles.compensate_left, takes="D", order=Order.COMPENSATION),
    GCode("G42", "compensation", cycles.compensate_right, takes="D", order=Order.COMPENSATION),
    *(
        GCode(code, "compensation", spatial.start, takes="D", order=Order.COMPENSATION)
        for code in radius.COMMON_SIDES
    ),
    GCode("G43", "length", tip_control.compensate_length, takes="H", order=Order.LENGTH),
    GCode("G44", "length", tip_control.compensate_length, takes="H", order=Order.LENGTH),
    GCode("G43.4", "length", tip_control.start, takes="H Q L I", order=Order.LENGTH),
    GCode("G43.5", "length", tip_control.start, takes="H", order=Order.LENGTH),
    GCode("G49", "length", tip_control.cancel, order=Order.LENGTH, ends="normal_line"),
    GCode("G45", handler=moves.lengthened, takes="D I J K", axis_words=True, order=MOTION),
    GCode("G46", handler=moves.shortened, takes="D I J K", axis_words=True, order=MOTION),
    GCode("G47", handler=moves.lengthened_twice, takes="D I J K", axis_words=True, order=MOTION),
    GCode("G48", handler=moves.shortened_twice, takes="D I J K", axis_words=True, order=MOTION),
    GCode("G50", "scaling", base_frames.end_scale),
    GCode("G51", "scaling", base_frames.scale, takes="I J K P", axis_words=True),
    GCode("G50.1", "mirror", base_frames.end_mirror, axis_words=True),
    GCode("G51.1", "mirror", frames.mirror, axis_words=True),
    GCode("G52", handler=systems.set_local_system, axis_words=True),
    GCode("G52.1", handler=borrowing.release, takes="P Q R", order=MOTION),
    GCode("G52.2", handler=borrowing.borrow, takes="P Q R I J K", order=MOTION),
    GCode("G53", handler=moves.move_in_machine_system, takes="P F1 Q", axis_words=True, order=MOTION),
    GCode("G54", "wcs", frames.select_work_system, takes="P", gives_way="P"),
    *(GCode(f"G{number}", "wcs", frames.select_work_system) for number in range(55, 60)),
    *(GCode(f"G59.{number}", "wcs", frames.select_work_system) for number in range(1, 10)),
    GCode("G61", "path", frames.cutting_mode),
    GCode("G62", "path", frames.cutting_mode, takes="P"),
    GCode("G63", "path", frames.cutting_mode),
    GCode("G64", "path", frames.cutting_mode, takes="P"),
    GCode("G65", axis_words=True, order=Order.CALL),
    GCode("G66", "macro", axis_words=True, order=Order.CALL),
    GCode("G66.1", "macro", axis_words=True, order=Order.CALL),
    GCode("G67", "macro", calls.end_modal_call),
    GCode("G68", "rotation", frames.rotate, takes="R", axis_words=True),
    GCode("G69", "rotation", tilted.end_tilt),
    GCode("G68.2", "rotation", tilted.tilt_by_angles, takes="I J K", axis_words=True, order=MOTION),
    GCode("G68.3", "rotation", tilted.tilt_by_tool, takes="P R", axis_words=True, order=MOTION),
    GCode("G53.1", handler=alignment.align_tool, takes="P", order=MOTION),
    GCode("G53.3", handler=alignment.align_and_position, takes="H P", axis_words=True, order=MOTION),
    GCode("G53.6", handler=alignment.align_about_tip, takes="H P R", order=MOTION),
    GCode("G54.4", handler=tilted.switch_work_rotation, takes="P"),
    GCode("G70", "unit", systems.note_context, only_changes=True),
    GCode("G71", "unit", systems.note_context, only_changes=True),
    GCode("G80", "cycle", oscillation.end, ends="oscillation"),
    GCode("G81.1", "oscillation", oscillation.start, takes="Q R", axis_words=True, order=MOTION),
    GCode("G81.2", "oscillation", oscillation.start_precise, takes="P Q R L", order=MOTION),
    GCode("G80.2", "oscillation", oscillation.end_precise, takes="Q", order=MOTION),
    *(GCode(code, "cycle") for code in cycles.CYCLES),
    GCode(tapping.RETRACT, handler=tapping.retract, takes="F S", order=MOTION),
    GCode("G134", handler=cycles.circle_of_holes, takes="I J K", axis_words=True, order=MOTION),
    GCode("G135", handler=cycles.line_of_holes, takes="I J K", axis_words=True, order=MOTION),
    GCode("G136", handler=cycles.arc_of_holes, takes="I J P K", axis_words=True, order=MOTION),
    GCode("G137.1", handler=cycles.grid_of_holes, takes="I J P K", axis_words=True, order=MOTION),
    GCode("G90", "distance"),
    GCode("G91", "distance"),
    GCode("G92", handler=frames.set_position, takes="S", axis_words=True, order=MOTION),
    GCode("G92.1", handler=frames.preset_system, takes="I J K R", axis_words=True, order=MOTION),
    GCode("G93", "feed", moves.change_feed_mode, order=Order.FEED_MODE),
    GCode("G94", "feed", moves.change_feed_mode, order=Order.FEED_MODE),
    GCode("G95", "feed", moves.change_feed_mode, order=Order.FEED_MODE),
    GCode("G96", "surface_speed", spindles.constant_surface_speed, takes="P"),
    GCode("G97", "surface_speed", spindles.end_surface_speed, only_changes=True),
    GCode("G98", "return"),
    GCode("G99", "return"),
)  # fmt: skip

M_CODES = m_table(
    MCode(0, after=True, handler=functions.stop, silent=True),
    MCode(1, after=True, handler=functions.optional_stop, silent=True),
    MCode(2, after=True, handler=calls.end_program),
    MCode(3, handler=functions.spindle_clockwise, turns=True),
    MCode(4, handler=functions.spindle_counter_clockwise, turns=True),
    MCode(5, handler=functions.spindle_stop, turns=True),
    MCode(6, after=True, handler=functions.change_tool),
    MCode(19, after=True, handler=functions.spindle_stop, turns=True),
    MCode(30, after=True, handler=calls.end_program),
    MCode(96, handler=interrupts.interrupts_on, takes="P I Q R L", silent=True),
    MCode(97, handler=interrupts.interrupts_off, silent=True),
    MCode(98, after=True, handler=calls.call_subprogram, takes="P H L", silent=True),
    MCode(99, after=True, handler=calls.return_from_program, takes="P Q", silent=True),
    MCode(198, after=True, handler=calls.call_external_subprogram, takes="P H L", silent=True),
)

ADDRESSES = {
    "F": functions.plan_feed,
    "S": spindles.plan_speed,
    **{f"S{number}": spindles.plan_named_speed(number) for number in range(1, 11)},
    "T": functions.plan_tool,
    "B": functions.plan_second_auxiliary,
    "H": base_length.plan_length_number,
    "D": radius.plan_radius_number,
}

POWER_ON = MILLING_POWER_ON | {
    "unit": "G71",
    "polar_interpolation": "G13.1",
    "normal_line": "G40.1",
    "oscillation": "G80.2",
    "posture": "",
}
