"""The parameters of the control as attributes; written from parameters.toml by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.parameters import AxisParameters, ControlParameters, Number, Whole, WholeRun


class SyntecAxisParameters(AxisParameters):
    """The parameters that every axis has."""


class SyntecParameters(ControlParameters[SyntecAxisParameters]):
    """The parameters of the control."""

    axis_class = SyntecAxisParameters

    #: 17: Least input unit: 1 for 0.01, 2 for 0.001, 3 for 0.0001 mm or degrees.
    input_unit = Whole(17, delivered=2)
    #: 221: Type of each axis: 0 linear, 2 or 5 a rotary axis that turns as a linear one goes, 1, 3 or 4 in
    #: another way.
    axis_types = WholeRun(221, 20, delivered=None)
    #: 281: Words of each axis are radius values (0) or diameters (1).
    diameter_axes = WholeRun(281, 20, delivered=0)
    #: 321: Code of each axis's name: 100 is X, 101 X1, 302 Z2; 0 for the name that the machine gives.
    axis_names = WholeRun(321, 20, delivered=0)
    #: 401: Time from rest to Pr405 in cuts; 0 for what the axes can do [ms].
    cutting_time = Whole(401, delivered=0)
    #: 405: Highest feed of a cut on its path; 0 for no limit [mm/min].
    path_feed = Whole(405, delivered=0)
    #: 406: Reference feed of corners; 0 for what the axes can do [mm/min].
    corner_feed = Whole(406, delivered=0)
    #: 407: Tolerance of curve fitting under G05, micrometres; 0 for 10 at corners alone.
    fit_tolerance = Whole(407, delivered=0)
    #: 408: Reference feed of an arc of 5 mm radius; others by the root of their radius; 0 for what the axes
    #: can do [mm/min].
    arc_feed = Whole(408, delivered=0)
    #: 411: G00 runs on a line (0), or every axis by itself (1).
    rapids_by_axis = Whole(411, delivered=0)
    #: 413: A reset takes the turn of G92.1 back (0) or keeps it (1, 2).
    keeps_preset_turn = Whole(413, delivered=0)
    #: 441: Time of each axis from rest to its highest speed at rapid traverse; 0 for the machine's
    #: acceleration [ms].
    rapid_times = WholeRun(441, 20, delivered=0)
    #: 461: Highest speed of each axis at rapid traverse; 0 for that of the machine [mm/min].
    rapid_speeds = WholeRun(461, 20, delivered=0)
    #: 541: Time of each axis from rest to its highest speed in cuts; 0 for the machine's acceleration [ms].
    cutting_times = WholeRun(541, 20, delivered=0)
    #: 621: Highest speed of each axis in cuts; 0 for that of the machine [mm/min].
    cutting_speeds = WholeRun(621, 20, delivered=0)
    #: 641: Time in which the acceleration of each axis builds up; 0 where Pr441 or Pr541 is given: at once,
    #: else by the machine [ms].
    cutting_bell_times = WholeRun(641, 20, delivered=0)
    #: 701: Groups that each axis belongs to, a bit each.
    axis_groups = WholeRun(701, 20, delivered=0)
    #: 731: Number of axis groups of the CNC's main system; 0 for all.
    cnc_groups = Whole(731, delivered=0)
    #: 742: What an axis of several groups does: 1 for a roaming axis.
    shared_axes = Whole(742, delivered=0)
    #: 2401: First travel limits, plus and minus for each axis in turn, least units; none where plus is not
    #: above minus.
    first_travel = WholeRun(2401, 40, delivered=0)
    #: 2501: Second travel limits, plus and minus for each axis in turn, least units.
    second_travel = WholeRun(2501, 40, delivered=0)
    #: 2542: Second travel limits forbid the outside (0) or the inside (1).
    travel_2_inside = Whole(2542, delivered=0)
    #: 2801: Second reference point of each axis, machine coordinates in least units.
    reference_points_2 = WholeRun(2801, 20, delivered=None)
    #: 2821: Third reference point of each axis, machine coordinates in least units.
    reference_points_3 = WholeRun(2821, 20, delivered=None)
    #: 2841: Fourth reference point of each axis, machine coordinates in least units.
    reference_points_4 = WholeRun(2841, 20, delivered=None)
    #: 3001: Five-axis mechanism: none (0), both rotary axes in the spindle (1), both in the table (2), one in
    #: each (3).
    five_axis_mechanism = Whole(3001, delivered=None)
    #: 3002: Direction of the tool with all rotary axes at zero: not set (0), X (1), Y (2), Z (3).
    tool_direction = Whole(3002, delivered=None)
    #: 3003: Angle RA by which the tool leans from its direction (from X to Y, Y to Z, Z to X), least units.
    tool_lean_a = Whole(3003, delivered=0)
    #: 3004: Angle RB by which the tool, leaning by RA, is turned about its direction, least units.
    tool_lean_b = Whole(3004, delivered=0)
    #: 3009: Travel of the first rotary axis from and to, then of the second one, least units; the same number
    #: twice for none.
    rotary_travel = WholeRun(3009, 4, delivered=0)
    #: 3013: Length of the tool holder, from the rotary axis to the nose, least units.
    holder_length = Whole(3013, delivered=None)
    #: 3014: The tilted plane is kept over no reset (0), over a reset (1), over power-off too (2).
    keeps_tilt = Whole(3014, delivered=0)
    #: 3021: Offsets of the rotary axes of the mechanism, least units; polycnc has them from the machine file.
    mechanism_offsets = WholeRun(3021, 26, delivered=0)
    #: 3057: Directions of the tool count in the machine (0) or in the work system (1) under G43.4.
    posture_in_work = Whole(3057, delivered=0)
    #: 3091: Highest speed with which linear axes follow the rotary ones under G43.4 and G43.5; 0 for no limit
    #: [mm/min].
    following_speed = Whole(3091, delivered=0)
    #: 3215: T is a plain code (0), calls T0000 as a subprogram (1), or as a macro (2).
    t_macro = Whole(3215, delivered=0)
    #: 3229: Work coordinate systems are on (0) or off (1).
    without_work_systems = Whole(3229, delivered=0)
    #: 3241: Numbers without a point count least input units (0) or whole units (1).
    whole_units = Whole(3241, delivered=0)
    #: 3600: M code that enables interrupts; the next one ends that.
    interrupt_m = Whole(3600, delivered=96)
    #: 3601: M codes that call macros; 0 for none.
    m_macros = WholeRun(3601, 10, delivered=0)
    #: 3701: G codes that macros replace: -1 is G00, 1 to 3 G01 to G03, 4 G53, 5 to 7 G40 to G42; 0 for none.
    g_macros = WholeRun(3701, 10, delivered=0)
    #: 3802: Curves are fitted from the start, as under G05 P10000: on (2).
    fits_at_start = Whole(3802, delivered=0)
    #: 3807: Arc end tolerance, least units.
    arc_tolerance = Whole(3807, delivered=10)
    #: 3809: U, V, W are axes (0) or increments of X, Y, Z (1).
    uvw_increments = Whole(3809, delivered=0)
    #: 3815: How radius compensation starts and ends.
    radius_start = Whole(3815, delivered=0)
    #: 3819: Radius compensation checks for overcut.
    overcut_check = Whole(3819, delivered=0)
    #: 3835: Machining condition at the start.
    machining_condition = Whole(3835, delivered=0)
    #: 3836: Feed mode at power-on: per minute (0) or per revolution (1).
    feed_per_revolution = Whole(3836, delivered=0)
    #: 3838: Second travel limits at power-on: off (0) or on (1).
    travel_2_at_start = Whole(3838, delivered=0)
    #: 3839: The rotation of the work system (G54.4) is on at power-on.
    rotates_at_start = Whole(3839, delivered=0)
    #: 3957: Oscillation stops at R (0) or at once (1).
    oscillation_stop = Whole(3957, delivered=0)
    #: 3986: Intelligent tolerance control (G05.1 Q5) at power-on: off (0) or on (1).
    tolerance_control = Whole(3986, delivered=0)
    #: 3988: Tolerance of corners where G05.1 Q5 has no E, least units; 0 for 0.01 mm.
    corner_control = Whole(3988, delivered=0)
    #: 3990: Way before the end of a G00 at which the next G00 begins, least units.
    rapid_overlap = Whole(3990, delivered=0)
    #: 3991: Least angle of an outer corner that an intersection leads round, least units.
    least_intersection = Whole(3991, delivered=0)
    #: 3992: Largest angle of an outer corner that an arc leads round, least units; 0 for 180 degrees.
    largest_arc = Whole(3992, delivered=0)
    #: 4001: Pecks of tapping retract to R (0) or by Pr4004 (1).
    tap_fast_pecks = Whole(4001, delivered=0)
    #: 4002: Retract of pecks in drilling cycles, least units.
    peck_retract = Whole(4002, delivered=0)
    #: 4004: Retract of pecks in tapping cycles, least units.
    tap_peck_retract = Whole(4004, delivered=0)
    #: 4007: Tapping begins at once (0), or with an orientation of the spindle.
    tap_orients = Whole(4007, delivered=0)
    #: 4008: Normal (0) or fast (1) drilling.
    fast_drilling = Whole(4008, delivered=0)
    #: 4020: Direction off the wall after the oriented stop: 0 to 5 for +X, -X, +Y, -Y, +Z, -Z.
    bore_shift = Whole(4020, delivered=0)
    #: 4021: Base spindle and synchronous spindle of K1, then of K2 and K3.
    spindle_pairs = WholeRun(4021, 6, delivered=0)
    #: 4055: Tool setting: distance R over the sensor, least units.
    setting_distance = Whole(4055, delivered=0)
    #: 4056: Tool setting: tolerance D of the signal, least units.
    setting_tolerance = Whole(4056, delivered=0)
    #: 4057: Tool setting: feed F; 0 for the one in force [mm/min].
    setting_feed = Whole(4057, delivered=0)
    #: 4058: Tool setting: reference point P over the sensor; another number than 1 to 4 for none.
    setting_reference = Whole(4058, delivered=0)
    #: 4059: Tool setting: place Z of the sensor, machine coordinate in least units.
    setting_place = Whole(4059, delivered=0)
    #: 5801: Rotary axis of normal direction control: number of the axis, 0 for none.
    normal_axis = Whole(5801, delivered=0)
    #: 5802: Direction of that rotary axis; 0 for not set.
    normal_axis_direction = Whole(5802, delivered=None)
    #: 5803: Place of that rotary axis; 0 for not set.
    normal_axis_place = Whole(5803, delivered=None)
    #: 5804: Vector from the tool nose to that rotary axis, X [mm].
    normal_nose_x = Number(5804, delivered=0.0)
    #: 5805: Vector from the tool nose to that rotary axis, Y [mm].
    normal_nose_y = Number(5805, delivered=0.0)
    #: 5806: Vector from the tool nose to that rotary axis, Z [mm].
    normal_nose_z = Number(5806, delivered=0.0)
    #: 5809: Least length of a block under normal direction control [mm].
    normal_shortest = Number(5809, delivered=0.0)
    #: 5810: Length of a block over which the tool turns at most; 0 for no limit [mm].
    normal_longest = Number(5810, delivered=0.0)
    #: OPTION11: Option: high precision path control (1).
    option_path_fitting = Whole("OPTION11", delivered=1)
    #: OPTION13: Option: tilted working plane (1).
    option_tilted_plane = Whole("OPTION13", delivered=1)
    #: OPTION19: Option: arc through three points (1).
    option_arc_in_space = Whole("OPTION19", delivered=1)
    #: OPTION48: Option: precise oscillation (1).
    option_oscillation = Whole("OPTION48", delivered=1)
    #: OPTION59: Option: normal direction control (1).
    option_normal_direction = Whole("OPTION59", delivered=1)
