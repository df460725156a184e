"""The parameters of the control as attributes; written from parameters.toml by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.parameters import Bit, Number, Whole, WholeRun
from polycnc.control.word_address.parameters import A_co, MacroAxisParameters, MacroParameters


class FanucAxisParameters(MacroAxisParameters):
    """The parameters that every axis has."""

    #: 1022: Axis of the basic coordinate system: 1, 2, 3 for X, Y, Z; 5, 6, 7 for their parallels.
    basic_axis = Whole(1022, delivered=None)
    #: 1240: First reference point, machine coordinates [mm].
    reference_point_1 = Number(1240, delivered=None)
    #: 1241: Second reference point, machine coordinates [mm].
    reference_point_2 = Number(1241, delivered=None)
    #: 1242: Third reference point, machine coordinates [mm].
    reference_point_3 = Number(1242, delivered=None)
    #: 1243: Fourth reference point, machine coordinates [mm].
    reference_point_4 = Number(1243, delivered=None)
    #: 1320: Stored stroke check 1, upper limit [mm].
    travel_upper = Number(1320, delivered=None)
    #: 1321: Stored stroke check 1, lower limit [mm].
    travel_lower = Number(1321, delivered=None)
    #: 1420: Rapid traverse; 0 for that of the machine, which it does not pass [mm/min].
    rapid_speed = Number(1420, delivered=0.0)
    #: 1430: Highest feed of an axis in cuts; 0 for that of the machine [mm/min].
    cutting_speed = Number(1430, delivered=0.0)
    #: 1610#0: linear acceleration after interpolation (1).
    CTL = Bit(1610, 0, delivered=False)
    #: 1610#1: bell-shaped acceleration after interpolation (1).
    CTB = Bit(1610, 1, delivered=False)
    #: 1620: Rapids: time constant T (linear) or T1 (bell-shaped) of the acceleration, from rest to rapid
    #: traverse [ms].
    rapid_time = Number(1620, delivered=None)
    #: 1621: Rapids: time constant T2 of the bell-shaped acceleration; 0 for the linear one [ms].
    rapid_bell_time = Number(1621, delivered=None)
    #: 1622: Cuts without look-ahead: time constant of the acceleration after interpolation [ms].
    cutting_time = Number(1622, delivered=None)
    #: 1660: Cuts with look-ahead: largest acceleration before interpolation; 0 for that of the machine
    #: [mm/s²].
    cutting_acceleration = Number(1660, delivered=None)
    #: 1671: Rapids on a line with acceleration before interpolation (19501#5): largest acceleration; 0 for
    #: that of 1620 [mm/s²].
    rapid_acceleration = Number(1671, delivered=None)
    #: 1735: Arcs with look-ahead: largest acceleration, which bounds the feed by the radius; 0 for none
    #: [mm/s²].
    arc_acceleration = Number(1735, delivered=0.0)
    #: 1737: Short lines with look-ahead: largest acceleration of an axis from one to the next; 0 for none
    #: [mm/s²].
    line_acceleration = Number(1737, delivered=0.0)
    #: 1769: Cuts with look-ahead: time constant of the acceleration after interpolation; 0 for none [ms].
    ahead_time = Number(1769, delivered=0.0)
    #: 1783: Corners with look-ahead: largest change of an axis's feed, which bounds the feed there; 0 for
    #: none [mm/min].
    corner_step = Number(1783, delivered=0.0)
    #: 6241: Speed of automatic tool offset [mm/min].
    measuring_feed = Number(6241, delivered=0.0)
    #: 6251: Automatic tool offset: deceleration distance [mm].
    measuring_deceleration = Number(6251, delivered=0.0)
    #: 6254: Automatic tool offset: window of the signal [mm].
    measuring_window = Number(6254, delivered=0.0)


class FanucParameters(MacroParameters[A_co]):
    """The parameters of the control."""

    #: 0#2: unit at power-on, metric (0) or inch (1).
    INI = Bit(0, 2, delivered=False)
    #: 1004#7: a length or angle without a point counts one (0) or ten (1) least input increments, not with
    #: IS-A.
    IPR = Bit(1004, 7, delivered=False)
    #: 1013#0: least input increment 0.01 mm.
    ISA = Bit(1013, 0, delivered=False)
    #: 1013#1: least input increment 0.0001 mm.
    ISC = Bit(1013, 1, delivered=False)
    #: 1300#0: inside (0) or outside (1) of zone 2 is forbidden.
    OUT = Bit(1300, 0, delivered=False)
    #: 1401#1: rapids run every axis by itself (0) or on a line (1).
    LRP = Bit(1401, 1, delivered=False)
    #: 1401#4: a feed override of 0 % leaves rapids alone (0) or holds them too (1).
    RF0 = Bit(1401, 4, delivered=False)
    #: 1401#5: a dry run acts on threads and taps (0) or not (1).
    TDR = Bit(1401, 5, delivered=False)
    #: 1401#6: a dry run acts on rapids (1).
    RDR = Bit(1401, 6, delivered=False)
    #: 1403#5: F of an arc with motion beside it is the speed along the arc (0), or along the whole path (1).
    HTG = Bit(1403, 5, delivered=False)
    #: 1410: Speed of a dry run; 0 for 1000 mm/min [mm/min].
    dry_run_speed = Number(1410, delivered=0.0)
    #: 1421: Speed of the rapid override's position F0 [mm/min].
    rapid_f0 = Number(1421, delivered=400.0)
    #: 1422: Highest feed of a cut on its path; 0 for no limit [mm/min].
    path_feed = Number(1422, delivered=0.0)
    #: 1672: The same rapids: time in which that acceleration builds up (bell-shaped); 0 for at once [ms].
    rapid_change_time = Number(1672, delivered=None)
    #: 1732: Arcs with look-ahead: feed below which 1735 slows none [mm/min].
    arc_least_feed = Number(1732, delivered=0.0)
    #: 1738: Short lines with look-ahead: feed below which 1737 slows none [mm/min].
    line_least_feed = Number(1738, delivered=0.0)
    #: 1772: Cuts with look-ahead: time constant T2 of the bell-shaped acceleration before interpolation [ms].
    cutting_bell_time = Number(1772, delivered=None)
    #: 3401#0: words without a point are least increments (0) or millimetres, inches, seconds (1).
    DPI = Bit(3401, 0, delivered=False)
    #: 3402#0: G01 at power-on.
    start_g01 = Bit(3402, 0, delivered=False)
    #: 3402#3: G91 at power-on (lathe: systems B, C).
    start_g91 = Bit(3402, 3, delivered=False)
    #: 3403#5: an arc without R and centre is a line (0) or the alarm PS0022 (1).
    CIR = Bit(3403, 5, delivered=False)
    #: 3404#6: a program without M02, M30 or M99 at its end is the alarm PS5010 (0), or it ends with a reset
    #: (1).
    EOR = Bit(3404, 6, delivered=False)
    #: 3405#1: under feed per revolution the dwell G04 counts revolutions.
    DWL = Bit(3405, 1, delivered=False)
    #: 3410: Allowed difference of the radii of an arc; 0: no check [mm].
    arc_tolerance = Number(3410, delivered=0.03)
    #: 3411: M codes behind which no block is read before they have run.
    unbuffered_m_codes = WholeRun(3411, 10, delivered=0)
    #: 3421: Ranges of M codes behind which no block is read: lower and upper end in turn.
    unbuffered_m_ranges = WholeRun(3421, 12, delivered=0)
    #: 3708#0: the first cut does not wait (0) or waits (1) until the spindle has its speed.
    SAR = Bit(3708, 0, delivered=None)
    #: 5003#0: start-up and cancel of compensation, type A (0) or B (1).
    SUP = Bit(5003, 0, delivered=False)
    #: 5003#1: start-up and cancel of compensation, type C.
    SUV = Bit(5003, 1, delivered=False)
    #: 5003#2: G28 and G30 in compensation: the vector vanishes on the way to the intermediate point (0) or
    #: behind it (1).
    CCN = Bit(5003, 2, delivered=False)
    #: 5010: Corner moves shorter than this are left out in compensation [mm].
    least_corner_move = Number(5010, delivered=0.001)
    #: 5114: Retract of high speed pecking [mm].
    peck_retract = Number(5114, delivered=0.5)
    #: 5115: Clearance of deep hole pecking [mm].
    peck_clearance = Number(5115, delivered=0.5)
    #: 5200#5: pecking taps break chips (0) or clear them (1).
    PCP = Bit(5200, 5, delivered=False)
    #: 5213: Retract of a pecking tap [mm].
    tap_peck_retract = Number(5213, delivered=0.0)
    #: 5410: Angle of G68 (lathe: G68.1) without R [degrees].
    rotation_angle = Number(5410, delivered=0.0)
    #: 5460: Linear axis of polar interpolation.
    polar_linear_axis = Whole(5460, delivered=None)
    #: 5461: Rotary axis of polar interpolation.
    polar_rotary_axis = Whole(5461, delivered=None)
    #: 5480: Rotary axis of normal line control.
    normal_axis = Whole(5480, delivered=None)
    #: 5481: Normal line control: feed of turns; 0 for that of the cut [degrees/min].
    normal_turn_feed = Number(5481, delivered=0.0)
    #: 5482: Normal line control: turns up to this angle are left out [degrees].
    normal_least_turn = Number(5482, delivered=0.0)
    #: 5483: Normal line control: in moves up to this length the axis stands [mm].
    normal_shortest_move = Number(5483, delivered=0.0)
    #: 6000#0: G67 without a modal call is an alarm (0) or nothing (1).
    G67 = Bit(6000, 0, delivered=True)
    #: 6000#5: single block halts behind macro statements (1).
    SBM = Bit(6000, 5, delivered=False)
    #: 6000#7: single block halts behind macro statements whatever #3003 says (1).
    SBV = Bit(6000, 7, delivered=False)
    #: 6001#1: DPRNT prints blanks in front of a number (0) or none (1).
    PRT = Bit(6001, 1, delivered=False)
    #: 6001#5: T calls O9000 (1).
    TCS = Bit(6001, 5, delivered=False)
    #: 6001#6: the RESET key empties #100 to #199 (0) or leaves them (1).
    CCV = Bit(6001, 6, delivered=False)
    #: 6001#7: a reset empties #1 to #33 (0) or leaves them (1).
    CLV = Bit(6001, 7, delivered=False)
    #: 6003#2: an interruption macro waits for the end of the block (1).
    MIN = Bit(6003, 2, delivered=False)
    #: 6003#5: the interruption program has local variables of its own, as a macro (0), or those of the
    #: program (1).
    MSB = Bit(6003, 5, delivered=False)
    #: 6003#7: M96 and M97 are those of the interruption macro (1).
    MUS = Bit(6003, 7, delivered=None)
    #: 6004#0: results of ATAN are 0 to 360 (0) or -180 to 180 degrees (1).
    NAT = Bit(6004, 0, delivered=False)
    #: 6006#0: conditions may be joined by AND, OR, XOR (1).
    MLG = Bit(6006, 0, delivered=False)
    #: 6008#1: #3000 = n is the alarm 3000 + n (0) or n itself (1).
    MCA = Bit(6008, 1, delivered=False)
    #: 6008#6: in a program that a G code called, M and T codes may call, and the other way round (1).
    GMP = Bit(6008, 6, delivered=False)
    #: 6050: G codes that call O9010 to O9019; negative: a modal call.
    g_codes_of_macros = WholeRun(6050, 10, delivered=0)
    #: 6071: M codes that call O9001 to O9009 as subprograms.
    m_codes_of_subprograms = WholeRun(6071, 9, delivered=0)
    #: 6080: M codes that call the macros O9020 to O9029.
    m_codes_of_macros = WholeRun(6080, 10, delivered=0)
    #: 6200#7: in G31 by feed per minute feed override and dry run do not act (0) or act (1).
    SKF = Bit(6200, 7, delivered=False)
    #: 7001#0: axes moved by hand return to the path before the program goes on (1).
    MIT = Bit(7001, 0, delivered=False)
    #: 11304#3: program numbers have four (0) or eight digits (1).
    ON8 = Bit(11304, 3, delivered=False)
    #: 12321: G68.3: X of the plane is square on the tool and on X (1), Y (2), Z (3) of the machine or the
    #: tool with its axes at zero (0).
    upright_axis = Whole(12321, delivered=0)
    #: 12322: G68.3: a tool that leans from there by no more stands upright; 0 for 1 degree [deg].
    upright_within = Number(12322, delivered=0.0)
    #: 19501#5: rapids on a line are accelerated after the interpolation (0) or before it, by 1671 and 1672
    #: (1).
    FRP = Bit(19501, 5, delivered=False)
    #: 19625: Blocks that compensation looks ahead.
    read_blocks = Whole(19625, delivered=3)
