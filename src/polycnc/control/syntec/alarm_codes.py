"""Mistakes by name and the SYNTEC alarms for them.

Codes are those of the milling manual and of the macro language. COR-012 and COR-013 stand in neither: they
are what such controls show for a missing program and for calls nested too deep. The manual names no alarm for
software travel limits: PC0004 is polycnc's own.
"""

from __future__ import annotations

SEMANTIC = "COR-023"
ALARMS: dict[str, str] = {
    # words of a block
    "address": SEMANTIC,
    "argument": SEMANTIC,
    "argument_address": SEMANTIC,
    "point": SEMANTIC,
    "number": "COR-064",
    "improper_g": "COR-100",
    "option": "COR-100",
    "no_data": "COM-003",
    # motion
    "no_feed": SEMANTIC,
    "plane": SEMANTIC,
    "arc_end": "COR-006",
    "center_off_plane": "COR-006",
    "radius_zero": "COR-006",
    "radius_too_small": "COR-006",
    "three_point_word": "COR-133",
    "three_point_format": "COR-134",
    "curve_format": SEMANTIC,
    "inverse_time_feed": "COR-085",
    "no_intermediate": SEMANTIC,
    "stroke_pair": "COR-109",
    "condition_set": "COR-103",
    "over_travel_plus": "PC0004",
    "over_travel_minus": "PC0004",
    "smoothing_format": "COR-107",
    "smoothing_stops": "COR-106",
    "polar_axes": SEMANTIC,
    "polar_mode": SEMANTIC,
    "polar_diameter": "COR-325",
    "diameter_switch": "COR-326",
    "surface_axis": "COR-383",
    # oscillation
    "oscillation_move": "COR-339",
    "oscillation_frame": "COR-340",
    "oscillation_axis": "COR-341",
    "oscillation_kinematics": "COR-342",
    "oscillation_repeated": "COR-370",
    # tool presetting
    "setting_place": "MAR-330",
    "setting_start": "MAR-333",
    "setting_without_length": "MAR-334",
    "setting_too_early": "MAR-335",
    "setting_no_signal": "MAR-336",
    # axis groups
    "axis_borrowing": "COR-363",
    "axes_not_borrowed": "COR-364",
    "axis_not_held": "COR-365",
    "axis_borrowing_type": "COR-146",
    # normal direction control
    "normal_linear_axes": "COR-180-1",
    "normal_rotary_axis": "COR-180-2",
    "normal_axis_type": "COR-180-3",
    "normal_not_set": "COR-180-5",
    "normal_words": "COR-180-6",
    "normal_lengths": "COR-180-7",
    "normal_plane": "COR-181",
    "normal_rotary_word": "COR-182-1",
    "normal_compensation": "COR-182-2",
    "normal_oscillation": "COR-182-5",
    "normal_smoothing": "COR-182-6",
    "normal_machine": "COR-182-7",
    "normal_three_point": "COR-182-9",
    "normal_skip": "COR-182-10",
    "normal_thread": "COR-182-11",
    "normal_frame": SEMANTIC,
    # five axes
    "align_way": "COR-149",
    "tilt_unreachable": "COR-153",
    "tilt_missing": SEMANTIC,
    "tip_machine": "COR-100",
    "tip_mode": SEMANTIC,
    "tip_on_tool_plane": "COR-381",
    "tip_direction": "COR-153",
    "tip_zero_direction": "COR-159",
    "tip_rotary_word": "COR-158",
    "tip_in_compensation": "MAR-406",
    "tip_without_length": "MAR-407",
    "tip_smoothing": "COR-140",
    "tool_plane_format": "COR-130",
    "tool_plane": "COR-381",
    "skip_groups": "COR-362",
    "meeting_mark": "COR-137",
    "meeting_groups": "COR-144",
    "retract_way": "MAR-452",
    "retract_distance": "MAR-454",
    "conditions_missing": "MACRO-411",
    "conditions_range": "MACRO-412",
    "base_spindle": "COR-091",
    "sync_spindle": "COR-092",
    "spindle_repeated": "COR-102",
    "spindle_group": "COR-142",
    "cycle_word": SEMANTIC,
    "retract_feed": "COR-045",
    # coordinates
    "rotation_angle": SEMANTIC,
    "scale": SEMANTIC,
    "preset_rotary": "COR-115",
    # compensation
    "offset_number": SEMANTIC,
    "comp_arc_start": SEMANTIC,
    "comp_skip": SEMANTIC,
    "comp_no_intersection": "COR-074",
    "comp_interference": "COR-074",
    "offset_in_compensation": "COR-082",
    "offset_arc": "COR-081",
    # calls
    "no_program": "COR-012",
    "program_number": "COR-052",
    "subprogram_number": "COR-052",
    "repeat_count": "COR-045",
    "nesting": "COR-013",
    "registered_m": "OP-020",
    "interrupt_format": "COR-330",
    "interrupt_left_on": "COR-117",
}

#: Codes of other makers that arrive in SYNTEC programs: message ids of hints.
FOREIGN_CODES = {
    "G20": "hint.syntec.inch",
    "G21": "hint.syntec.inch",
    "G54.1": "hint.syntec.work-systems",
}
