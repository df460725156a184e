"""The parameters of the control as attributes; written from parameters.toml by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
from polycnc.control.parameters import Bit, Number, Whole


class LatheAxisParameters(FanucAxisParameters):
    """The parameters that every axis has."""

    #: 1006#3: words of the axis are radius values (0) or diameters (1); delivered 1 for X.
    DIA = Bit(1006, 3, delivered=None)
    #: 1310#0: the axis is checked against zone 2.
    OT2 = Bit(1310, 0, delivered=False)
    #: 1310#1: the axis is checked against zone 3.
    OT3 = Bit(1310, 1, delivered=False)
    #: 1322: Stored stroke check 2, upper limit [mm].
    zone_2_upper = Number(1322, delivered=0.0)
    #: 1323: Stored stroke check 2, lower limit [mm].
    zone_2_lower = Number(1323, delivered=0.0)
    #: 1324: Stored stroke check 3, upper limit [mm].
    zone_3_upper = Number(1324, delivered=0.0)
    #: 1325: Stored stroke check 3, lower limit [mm].
    zone_3_lower = Number(1325, delivered=0.0)
    #: 1430: Largest cutting feed of the axis [mm/min].
    largest_feed = Number(1430, delivered=0.0)
    #: 1610#5: threads of cycles accelerate exponentially (0) or as cuts by CTL and CTB (1).
    THL = Bit(1610, 5, delivered=False)
    #: 1626: Time constant of the acceleration in thread cycles; 0 for what the axes can do [ms].
    thread_time_constant = Number(1626, delivered=0.0)
    #: 1627: FL speed of the exponential acceleration in thread cycles [mm/min].
    thread_fl_speed = Number(1627, delivered=0.0)
    #: 7740: Speed of the tool retract (G10.6), that of the first axis; 0 for rapid traverse [mm/min].
    retract_speed = Number(7740, delivered=0.0)
    #: 7741: How far the axis retracts where G10.6 names none [mm].
    retract_amount = Number(7741, delivered=0.0)
    #: 8162#0: in synchronous control the axis moves as its master (0) or against it (1).
    SMR = Bit(8162, 0, delivered=False)
    #: 12600: Number by which P and Q of synchronous control (G51.4) name the axis; 0 for none.
    identification = Whole(12600, delivered=0)


class LatheParameters(FanucParameters[LatheAxisParameters]):
    """The parameters of the control."""

    axis_class = LatheAxisParameters

    #: 1#1: program format, normal (0) or Series 15 (1).
    FCV = Bit(1, 1, delivered=False)
    #: 1202#3: a reset cancels the local coordinate system.
    RLC = Bit(1202, 3, delivered=False)
    #: 1205#7: the preset of the coordinate system keeps the tool offset.
    WTC = Bit(1205, 7, delivered=False)
    #: 1290: Distance of the opposite turrets for the mirror of G68 [mm].
    turret_distance = Number(1290, delivered=0.0)
    #: 1330: TY: the chuck holds at the inner (0) or outer (1) face.
    jaw_kind = Whole(1330, delivered=0)
    #: 1331: L: length of a chuck jaw [mm].
    jaw_length = Number(1331, delivered=0.0)
    #: 1332: W: size of a chuck jaw, radius [mm].
    jaw_size = Number(1332, delivered=0.0)
    #: 1333: L1: holding length of a jaw [mm].
    grip_length = Number(1333, delivered=0.0)
    #: 1334: W1: holding step of a jaw, radius [mm].
    grip_step = Number(1334, delivered=0.0)
    #: 1335: CX: position of the chuck, X [mm].
    chuck_x = Number(1335, delivered=0.0)
    #: 1336: CZ: position of the chuck, Z [mm].
    chuck_z = Number(1336, delivered=0.0)
    #: 1341: L: length of the tailstock [mm].
    tailstock_length = Number(1341, delivered=0.0)
    #: 1342: D: diameter of the tailstock [mm].
    tailstock_diameter = Number(1342, delivered=0.0)
    #: 1343: L1: length of the first step [mm].
    tailstock_length_1 = Number(1343, delivered=0.0)
    #: 1344: D1: diameter of the first step [mm].
    tailstock_diameter_1 = Number(1344, delivered=0.0)
    #: 1345: L2: length of the second step [mm].
    tailstock_length_2 = Number(1345, delivered=0.0)
    #: 1346: D2: diameter of the second step [mm].
    tailstock_diameter_2 = Number(1346, delivered=0.0)
    #: 1347: D3: diameter of the hole [mm].
    tailstock_hole = Number(1347, delivered=0.0)
    #: 1348: TZ: position of the tailstock, Z [mm].
    tailstock_z = Number(1348, delivered=0.0)
    #: 1403#4: the rapid override does not act on the retract of thread cutting cycles.
    ROC = Bit(1403, 4, delivered=False)
    #: 1466: Speed of the retract in thread cutting cycles; 0 for rapid traverse [mm/min].
    thread_retract_speed = Number(1466, delivered=0.0)
    #: 1611#0: the retract of thread cutting cycles runs at 1466 (0) or at rapid traverse (1).
    CFR = Bit(1611, 0, delivered=False)
    #: 1681#0: drilling cycles do not overlap strokes to R and to the next hole (1).
    DPS = Bit(1681, 0, delivered=False)
    #: 1681#1: drilling cycles do not overlap strokes at R (1).
    DRL = Bit(1681, 1, delivered=False)
    #: 1681#2: drilling cycles do not overlap the end of a peck's retract (1).
    DRV = Bit(1681, 2, delivered=False)
    #: 1681#3: drilling cycles do not overlap the end of the way back to the cut in deep pecking (1).
    DFW = Bit(1681, 3, delivered=False)
    #: 1681#4: drilling cycles do not overlap the end of a peck (1).
    DQL = Bit(1681, 4, delivered=False)
    #: 1681#5: drilling cycles do not overlap the bottom (1).
    DZL = Bit(1681, 5, delivered=False)
    #: 3032: Digits that T may have; 0 for any number.
    t_digits = Whole(3032, delivered=0)
    #: 3290#0: wear offsets cannot be typed in.
    WOF = Bit(3290, 0, delivered=False)
    #: 3290#1: geometry offsets cannot be typed in.
    GOF = Bit(3290, 1, delivered=False)
    #: 3290#5: second geometry offsets can be typed in.
    GO2 = Bit(3290, 5, delivered=False)
    #: 3294: First offset number that cannot be typed in.
    locked_offset = Whole(3294, delivered=0)
    #: 3295: How many offset numbers cannot be typed in.
    locked_offsets = Whole(3295, delivered=0)
    #: 3401#6: G code system B.
    GSB = Bit(3401, 6, delivered=False)
    #: 3401#7: G code system C.
    GSC = Bit(3401, 7, delivered=False)
    #: 3402#1: G17 at power-on.
    start_g17 = Bit(3402, 1, delivered=False)
    #: 3402#2: G19 at power-on.
    start_g19 = Bit(3402, 2, delivered=False)
    #: 3402#4: feed per revolution G99 (0) or per minute G98 (1) at power-on.
    FPM = Bit(3402, 4, delivered=True)
    #: 3402#6: a reset leaves the reset state (0) or the clear state (1).
    CLR = Bit(3402, 6, delivered=False)
    #: 3402#7: G23 at power-on.
    start_g23 = Bit(3402, 7, delivered=False)
    #: 3404#4: rewinds the program (0), or it stays at its end (1).
    M30 = Bit(3404, 4, delivered=False)
    #: 3404#5: rewinds the program (0), or it stays at its end (1).
    M02 = Bit(3404, 5, delivered=False)
    #: 3405#3: automatic tool offset is G36, G37 (0) or G37.1, G37.2 (1).
    G36 = Bit(3405, 3, delivered=False)
    #: 3405#4: chamfers are written by I, K (0) or C (1), and I, K of a line under compensation are a vector
    #: (1).
    chamfer_by_c = Bit(3405, 4, delivered=False)
    #: 3405#5: drawing dimensions have a comma in front.
    DDP = Bit(3405, 5, delivered=False)
    #: 3406#1: a reset keeps the codes of group 01.
    C01 = Bit(3406, 1, delivered=False)
    #: 3406#2: a reset keeps the codes of group 02.
    C02 = Bit(3406, 2, delivered=False)
    #: 3406#3: a reset keeps the codes of group 03.
    C03 = Bit(3406, 3, delivered=False)
    #: 3406#5: a reset keeps the codes of group 05.
    C05 = Bit(3406, 5, delivered=False)
    #: 3407#2: a reset keeps the codes of group 10.
    C10 = Bit(3407, 2, delivered=False)
    #: 3407#3: a reset keeps the codes of group 11.
    C11 = Bit(3407, 3, delivered=False)
    #: 3407#6: a reset keeps the codes of group 14.
    C14 = Bit(3407, 6, delivered=False)
    #: 3407#7: a reset keeps the codes of group 15.
    C15 = Bit(3407, 7, delivered=False)
    #: 3408#0: a reset keeps the codes of group 16.
    C16 = Bit(3408, 0, delivered=False)
    #: 3453#0: chamfer and corner R by I, K, R (0) or drawing dimensions (1).
    CRD = Bit(3453, 0, delivered=False)
    #: 3458#7: Signs of chamfers and radii of drawing dimensions are read over.
    unsigned_corners = Bit(3458, 7, delivered=False)
    #: 3703#3: P beside S names the spindle.
    MPP = Bit(3703, 3, delivered=False)
    #: 3740: Time from the start of a hole to the check of the spindle's speed [ms].
    speed_arrival_wait = Number(3740, delivered=0.0)
    #: 5000#3: A block without travel within compensation.
    wall_without_travel = Bit(5000, 3, delivered=False)
    #: 5001#6: a changed offset acts at once.
    EVO = Bit(5001, 6, delivered=False)
    #: 5002#1: geometry has the number of the tool (1) or of the offset (0).
    LGN = Bit(5002, 1, delivered=False)
    #: 5002#2: wear moves the tool (0) or shifts the coordinates (1).
    LWT = Bit(5002, 2, delivered=False)
    #: 5002#4: geometry shifts the coordinates (0) or moves the tool (1).
    LGT = Bit(5002, 4, delivered=False)
    #: 5002#5: offset number 0 also cancels the shift by geometry.
    LGC = Bit(5002, 5, delivered=False)
    #: 5002#6: an offset moves the axes in the block of T (0) or with the next move (1).
    LWM = Bit(5002, 6, delivered=False)
    #: 5002#7: the tip number is that of geometry (0) or wear (1).
    WNP = Bit(5002, 7, delivered=False)
    #: 5003#7: a reset cancels the shift by geometry.
    TGC = Bit(5003, 7, delivered=False)
    #: 5004#1: offsets are diameters (0) or radius values (1).
    ORC = Bit(5004, 1, delivered=False)
    #: 5004#3: the sensor has four contacts (0) or one (1).
    TS1 = Bit(5004, 3, delivered=False)
    #: 5005#2: the signal PRC latches positions for measured input.
    PRC = Bit(5005, 2, delivered=False)
    #: 5005#5: signals choose the offset number of measured input B.
    QNI = Bit(5005, 5, delivered=False)
    #: 5006#3: a reset cancels offsets.
    LVC = Bit(5006, 3, delivered=False)
    #: 5008#1: interference of compensation.
    CNC = Bit(5008, 1, delivered=False)
    #: 5008#3: interference of compensation.
    CNV = Bit(5008, 3, delivered=False)
    #: 5008#4: intersections of compensation.
    MCR = Bit(5008, 4, delivered=False)
    #: 5015: Face of the touch sensor for contact +X, machine coordinates [mm].
    sensor_x_plus = Number(5015, delivered=0.0)
    #: 5016: Face of the touch sensor for contact -X, machine coordinates [mm].
    sensor_x_minus = Number(5016, delivered=0.0)
    #: 5017: Face of the touch sensor for contact +Z, machine coordinates [mm].
    sensor_z_plus = Number(5017, delivered=0.0)
    #: 5018: Face of the touch sensor for contact -Z, machine coordinates [mm].
    sensor_z_minus = Number(5018, delivered=0.0)
    #: 5020: Offset number of the tool that measures the work shift.
    work_shift_offset = Whole(5020, delivered=0)
    #: 5024: Number of offset sets; 0 for the standard 32.
    offset_sets = Whole(5024, delivered=0)
    #: 5028: Digits of T that are the offset number; 0 by the number of sets.
    offset_digits = Whole(5028, delivered=0)
    #: 5040#3: tools are changed by turret (0) or arm (1).
    TCT = Bit(5040, 3, delivered=False)
    #: 5040#4: meaning of G43 and G43.7.
    TLG = Bit(5040, 4, delivered=False)
    #: 5043: Axis of the Y offset.
    y_offset_axis = Whole(5043, delivered=0)
    #: 5044: Axis of the 4th axis offset.
    axis_of_offset_4 = Whole(5044, delivered=0)
    #: 5045: Axis of the 5th axis offset.
    axis_of_offset_5 = Whole(5045, delivered=0)
    #: 5101#0: Series 15 drills along Z (0) or across the plane (1).
    FXY = Bit(5101, 0, delivered=False)
    #: 5101#2: pecks break chips (0) or clear them (1).
    RTR = Bit(5101, 2, delivered=False)
    #: 5102#2: the block Q of a shape is looked for before motion.
    QSR = Bit(5102, 2, delivered=False)
    #: 5102#3: drilling keeps the normal format under Series 15.
    F16 = Bit(5102, 3, delivered=False)
    #: 5102#6: R of Series 15 drilling is an increment (0) or absolute (1).
    RAB = Bit(5102, 6, delivered=False)
    #: 5102#7: R of Series 15 drilling is a radius (0) or as the drilling axis (1).
    RDI = Bit(5102, 7, delivered=False)
    #: 5103#3: a plane without axis is no alarm in drilling.
    PNA = Bit(5103, 3, delivered=False)
    #: 5104#2: the shape is checked before motion.
    FCK = Bit(5104, 2, delivered=False)
    #: 5105#0: single block in drilling, chamfers and corner R.
    SBC = Bit(5105, 0, delivered=False)
    #: 5105#1: no rough finishing in G71, G72 of type I.
    RF1 = Bit(5105, 1, delivered=False)
    #: 5105#2: no rough finishing in G71, G72 of type II.
    RF2 = Bit(5105, 2, delivered=False)
    #: 5105#3: M05 before the spindle reverses in tapping.
    M5T = Bit(5105, 3, delivered=False)
    #: 5106#0: G71 to G74 are grinding cycles.
    GFX = Bit(5106, 0, delivered=False)
    #: 5106#2: Compensation within the shape of G70.
    NT1 = Bit(5106, 2, delivered=False)
    #: 5106#3: Compensation within the shape of G70.
    NT2 = Bit(5106, 3, delivered=False)
    #: 5107#0: returns of G71, G72 are rapid.
    ASU = Bit(5107, 0, delivered=False)
    #: 5107#1: returns of G71, G72 are merged.
    ASC = Bit(5107, 1, delivered=False)
    #: 5108#0: behind a stroke, type II follows parts of the shape parallel to it (1).
    R16 = Bit(5108, 0, delivered=False)
    #: 5108#3: type II runs no path twice (1).
    NSP = Bit(5108, 3, delivered=False)
    #: 5109#3: feed hold in a thread cycle stops at the start (0) or behind the retract (1).
    TFH = Bit(5109, 3, delivered=False)
    #: 5110: M code that clamps the C axis.
    clamp_code = Whole(5110, delivered=0)
    #: 5111: Dwell after the C axis is unclamped [ms].
    unclamp_dwell = Number(5111, delivered=0.0)
    #: 5124#0: the way off at 45 degrees is feed (0) or rapid (1).
    CBR = Bit(5124, 0, delivered=False)
    #: 5125#2: single block in G73 stops at every block (0) or at the way off and every pass (1).
    PRS = Bit(5125, 2, delivered=False)
    #: 5125#6: straight back to the start of the stroke.
    RPA = Bit(5125, 6, delivered=False)
    #: 5126: Distance of the last feed of RPA [mm].
    last_feed = Number(5126, delivered=0.0)
    #: 5130: Chamfer of threads [0.1 lead].
    thread_chamfer = Number(5130, delivered=0.0)
    #: 5131: Angle of the thread chamfer; 0 for 45 [degrees].
    thread_chamfer_angle = Number(5131, delivered=0.0)
    #: 5132: G71, G72: depth of a stroke [mm].
    stroke_depth = Number(5132, delivered=0.0)
    #: 5133: G71, G72: escape [mm].
    stroke_escape = Number(5133, delivered=0.0)
    #: 5134: G71, G72: clearance in pockets [mm].
    pocket_clearance = Number(5134, delivered=0.0)
    #: 5135: G73: escape along X [mm].
    pattern_escape_x = Number(5135, delivered=0.0)
    #: 5136: G73: escape along Z [mm].
    pattern_escape_z = Number(5136, delivered=0.0)
    #: 5137: G73: number of passes.
    pattern_passes = Whole(5137, delivered=0)
    #: 5139: G74, G75: return amount [mm].
    groove_return = Number(5139, delivered=0.0)
    #: 5140: G76: least depth of a pass [mm].
    thread_least_depth = Number(5140, delivered=0.0)
    #: 5141: G76: finishing allowance [mm].
    thread_allowance = Number(5141, delivered=0.0)
    #: 5142: G76: finishing passes.
    thread_finishing_passes = Whole(5142, delivered=0)
    #: 5143: G76: tip angle [degrees].
    thread_angle = Number(5143, delivered=0.0)
    #: 5145: G71, G72: allowed reversal along the first axis [mm].
    reversal_first_axis = Number(5145, delivered=0.0)
    #: 5146: G71, G72: allowed reversal along the second axis [mm].
    reversal_second_axis = Number(5146, delivered=0.0)
    #: 5161#4: Second pair of clamp codes.
    second_clamp_pair = Bit(5161, 4, delivered=False)
    #: 5176: Axis of traverse grinding.
    traverse_axis = Whole(5176, delivered=0)
    #: 5177: Axis of traverse grinding with direct gauging.
    traverse_gauged_axis = Whole(5177, delivered=0)
    #: 5178: Axis of oscillation grinding.
    oscillation_axis = Whole(5178, delivered=0)
    #: 5179: Axis of oscillation grinding with direct gauging.
    oscillation_gauged_axis = Whole(5179, delivered=0)
    #: 5200#0: G84 is rigid tapping without M29.
    G84 = Bit(5200, 0, delivered=False)
    #: 5200#4: extraction override of rigid tapping.
    DOV = Bit(5200, 4, delivered=False)
    #: 5200#6: feed hold and single block act in rigid tapping.
    FHD = Bit(5200, 6, delivered=False)
    #: 5201#3: 5211 counts 10 per cent.
    OVU = Bit(5201, 3, delivered=False)
    #: 5201#4: J gives the extraction speed.
    OV3 = Bit(5201, 4, delivered=False)
    #: 5203#4: the feed override acts on rigid taps.
    OVS = Bit(5203, 4, delivered=False)
    #: 5209#0: taps run along Z and X whatever the plane.
    RTX = Bit(5209, 0, delivered=False)
    #: 5211: Extraction override of rigid tapping [%].
    tap_extraction_override = Number(5211, delivered=0.0)
    #: 5241: Highest speed of rigid tapping in gear 1 [rev/min].
    tap_speed_gear_1 = Number(5241, delivered=0.0)
    #: 5242: Highest speed of rigid tapping in gear 2 [rev/min].
    tap_speed_gear_2 = Number(5242, delivered=0.0)
    #: 5243: Highest speed of rigid tapping in gear 3 [rev/min].
    tap_speed_gear_3 = Number(5243, delivered=0.0)
    #: 5244: Highest speed of rigid tapping in gear 4 [rev/min].
    tap_speed_gear_4 = Number(5244, delivered=0.0)
    #: 5400#0: R of G68.1 is absolute (0) or incremental by G91 (1).
    RIN = Bit(5400, 0, delivered=False)
    #: 5450#0: X of polar interpolation is a radius (0) or a diameter (1).
    PDI = Bit(5450, 0, delivered=False)
    #: 7610: Tool axis of polygon turning (G51.2): number of a rotary axis, 0 for none.
    polygon_axis = Whole(7610, delivered=0)
    #: 7710: Workpiece axis of the electronic gear box (G81): number of a rotary axis, 0 for none.
    gear_axis = Whole(7710, delivered=0)
    #: 8103#1: P of waiting and balance cutting is a binary sum (0) or path numbers (1).
    MWP = Bit(8103, 1, delivered=False)
    #: 8132#1: the Y offset is there.
    YOF = Bit(8132, 1, delivered=True)
    #: 8133#0: constant surface speed is there.
    SSC = Bit(8133, 0, delivered=True)
    #: 8134#1: the chuck and tailstock barrier is there.
    BAR = Bit(8134, 1, delivered=True)
    #: 8134#2: chamfering and drawing dimensions are there.
    CCR = Bit(8134, 2, delivered=True)
    #: 8135#5: custom macros are not there.
    MNC = Bit(8135, 5, delivered=False)
    #: 8136#6: one set of offsets (1) in place of geometry and wear.
    NGW = Bit(8136, 6, delivered=False)
    #: 8136#7: nose radius compensation is not there.
    NCR = Bit(8136, 7, delivered=False)
    #: 8137#0: balance cutting is not there.
    NVC = Bit(8137, 0, delivered=False)
    #: 11349#4: the Y offset screen switches by [SWITCH] (0) or [WEAR], [GEOM] (1).
    YGW = Bit(11349, 4, delivered=False)
    #: 11400#1: the 5th axis offset is in use.
    NO5 = Bit(11400, 1, delivered=False)
    #: 11403#2: offset files write axis names A and B for E and F.
    OFN = Bit(11403, 2, delivered=False)
    #: 11507#7: Only the first hole of a drilling cycle waits for 3740; the way to the next hole overlaps (1).
    SAC = Bit(11507, 7, delivered=False)
    #: 11600#5: axes that the block behind G68.1 does not name.
    AX1 = Bit(11600, 5, delivered=False)
    #: 11630#0: least increment of the angle of G68.1, 0.001 (0) or 0.00001 degrees (1).
    FRD = Bit(11630, 0, delivered=False)
    #: 13543: M code that unclamps the C axis, first pair.
    unclamp_code = Whole(13543, delivered=0)
    #: 13544: Second M code that clamps the C axis.
    second_clamp_code = Whole(13544, delivered=0)
    #: 13545: M code that unclamps the C axis, second pair.
    second_unclamp_code = Whole(13545, delivered=0)
    #: 19607#2: outer corners of compensation are lines (0) or arcs (1).
    CCC = Bit(19607, 2, delivered=False)
    #: 19607#5: Interference check of compensation.
    CAV = Bit(19607, 5, delivered=False)
    #: 19607#6: Interference check of compensation.
    NAA = Bit(19607, 6, delivered=False)
