"""The parameters of the control as attributes; written from parameters.toml by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.parameters import Number, Whole, WholeRun
from polycnc.control.word_address.parameters import MacroAxisParameters, MacroParameters


class MeldasAxisParameters(MacroAxisParameters):
    """The parameters that every axis has."""

    #: 2001: rapid: rapid traverse of an axis; 0 for that of the machine, which it does not pass [mm/min].
    rapid_speed = Number(2001, delivered=0.0)
    #: 2002: clamp: highest feed of an axis in cuts; 0 for that of the machine [mm/min].
    cutting_speed = Number(2002, delivered=0.0)
    #: 2004: G0tL: time constant of rapids (linear), from rest to rapid traverse [ms].
    rapid_time = Number(2004, delivered=None)
    #: 2007: G1tL: time constant of cuts (linear) without high-accuracy control, whatever the feed [ms].
    cutting_time = Number(2007, delivered=None)
    #: 2013: OT-: soft limit in the minus direction, machine coordinates; none where OT- and OT+ are the same
    #: [mm].
    travel_lower = Number(2013, delivered=None)
    #: 2014: OT+: soft limit in the plus direction, machine coordinates [mm].
    travel_upper = Number(2014, delivered=None)
    #: 2037: G53ofs: first reference point, machine coordinates [mm].
    reference_point_1 = Number(2037, delivered=None)
    #: 2038: #2_rfp: second reference point, machine coordinates [mm].
    reference_point_2 = Number(2038, delivered=None)
    #: 2039: #3_rfp: third reference point, machine coordinates [mm].
    reference_point_3 = Number(2039, delivered=None)
    #: 2040: #4_rfp: fourth reference point, machine coordinates [mm].
    reference_point_4 = Number(2040, delivered=None)
    #: 8209: G60 SHIFT: overrun of the axis, with the sign of the last direction [mm].
    overrun = Number(8209, delivered=0.0)


class MeldasParameters(MacroParameters[MeldasAxisParameters]):
    """The parameters of the control."""

    axis_class = MeldasAxisParameters

    #: 1080: Dril_Z: drilling cycles run along the axis that stands on the plane (0), or always along Z (1).
    drills_along_z = Whole(1080, delivered=0)
    #: 1084: RadErr: allowed difference of the radii of an arc; 0: no check [mm].
    arc_tolerance = Number(1084, delivered=0.1)
    #: 1086: G0Intp: rapids run on a line (0), or every axis by itself (1).
    rapids_by_axis = Whole(1086, delivered=1)
    #: 1206: G1bF: speed of cuts under high-accuracy control that is reached within G1btL; 0 for what the
    #: machine can do [mm/min].
    ahead_feed = Number(1206, delivered=0.0)
    #: 1207: G1btL: time from rest to G1bF in cuts under high-accuracy control [ms].
    ahead_time = Number(1207, delivered=0.0)
    #: 1522: Rotary axis of normal line control.
    normal_axis = Whole(1522, delivered=None)
    #: 1523: Normal line control: feed of turns; 0 for that of the cut [degrees/min].
    normal_turn_feed = Number(1523, delivered=0.0)
    #: 7001: M codes that call: the code of each of ten.
    m_call_codes = WholeRun(7001, 10, step=10, delivered=0)
    #: 7002: M codes that call: 0 as M98, 1 as G65, 2 as G66, 3 as G66.1.
    m_call_types = WholeRun(7002, 10, step=10, delivered=0)
    #: 7003: M codes that call: number of the program; 0 for none.
    m_call_programs = WholeRun(7003, 10, step=10, delivered=0)
    #: 7201: G codes that call: the code of each of ten.
    g_call_codes = WholeRun(7201, 10, step=10, delivered=0)
    #: 7202: G codes that call: 0 as M98, 1 as G65, 2 as G66, 3 as G66.1.
    g_call_types = WholeRun(7202, 10, step=10, delivered=0)
    #: 7203: G codes that call: number of the program; 0 for none.
    g_call_programs = WholeRun(7203, 10, step=10, delivered=0)
    #: 7312: T that calls: 0 as M98, 1 as G65, 2 as G66, 3 as G66.1.
    t_call_type = Whole(7312, delivered=0)
    #: 7313: T that calls: number of the program; 0 for none.
    t_call_program = Whole(7313, delivered=0)
    #: 8012: G73 n: retract of high speed pecking [mm].
    peck_retract = Number(8012, delivered=0.5)
    #: 8013: G83 n: clearance of deep hole pecking [mm].
    peck_clearance = Number(8013, delivered=0.5)
    #: 8081: Gcode Rotat: angle of G68 without R [degrees].
    rotation_angle = Number(8081, delivered=0.0)
