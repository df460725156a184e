"""The parameters of the control as attributes; written from parameters.toml by `control/parameter_module.py`."""

from __future__ import annotations

from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
from polycnc.control.parameters import Bit, Number, Whole


class FanucMillingAxisParameters(FanucAxisParameters):
    """The parameters that every axis has."""

    #: 5148: G76, G87: axis of the shift with the sign of its direction, for each drilling axis; 0: by RD1 and
    #: RD2.
    shift_direction = Whole(5148, delivered=0)
    #: 5440: G60: overrun of the axis, with the sign of the last direction [mm].
    overrun = Number(5440, delivered=0.0)
    #: 19667: Shift of the point that positions name under tip control, by 19665#5 [mm].
    control_point_shift = Number(19667, delivered=0.0)


class FanucMillingParameters(FanucParameters[FanucMillingAxisParameters]):
    """The parameters of the control."""

    axis_class = FanucMillingAxisParameters

    #: 3402#1: G18 at power-on.
    start_g18 = Bit(3402, 1, delivered=False)
    #: 3402#2: G19 at power-on.
    start_g19 = Bit(3402, 2, delivered=False)
    #: 3404#7: of several M codes in a block the last acts (0) or up to three act (1).
    M3B = Bit(3404, 7, delivered=False)
    #: 3451#2: a decimal point in S is PS0007 (0) or allowed (1).
    SDP = Bit(3451, 2, delivered=False)
    #: 5001#6: a length that G28, G30 or G53 has cancelled comes back with the next G43, G44 or H (0) or the
    #: next absolute word (1).
    EVO = Bit(5001, 6, delivered=True)
    #: 5004#2: D of cutter compensation names a radius (0) or a diameter (1).
    ODI = Bit(5004, 2, delivered=False)
    #: 5008#1: the interference check of compensation compares directions (0) or not (1).
    CNC = Bit(5008, 1, delivered=False)
    #: 5101#0: drilling cycles run along Z (0) or the third axis of the plane (1).
    FXY = Bit(5101, 0, delivered=False)
    #: 5101#4: G76, G87: the shift is along plus (0) or minus (1).
    RD1 = Bit(5101, 4, delivered=False)
    #: 5101#5: G76, G87: the shift is along the first (0) or second (1) axis of the plane.
    RD2 = Bit(5101, 5, delivered=False)
    #: 5200#0: G74 and G84 are rigid tapping without M29.
    G84 = Bit(5200, 0, delivered=False)
    #: 5400#0: the angle of G68 is absolute (0) or incremental by G91 (1).
    RIN = Bit(5400, 0, delivered=False)
    #: 5400#7: factors of scaling without a point count 0.00001 (0) or 0.001 (1).
    SCR = Bit(5400, 7, delivered=False)
    #: 7570#0: G54.2: the tool goes along with the fixture offset (0) or stays (1).
    FTP = Bit(7570, 0, delivered=False)
    #: 11200#0: G54.4 without tip control: the tool keeps its direction (0) or stands on the work as it lies
    #: (1).
    RCM = Bit(11200, 0, delivered=False)
    #: 11600#5: an axis that the block behind G68 does not name keeps its coordinate from before (0) or its
    #: position (1).
    AX1 = Bit(11600, 5, delivered=True)
    #: 19607#2: radius compensation in space passes sharp outer corners by lines (0) or an arc (1).
    CCC = Bit(19607, 2, delivered=False)
    #: 19631: G41.3: angles between tool and path so close to 0, 90 and 180 degrees count as these [deg].
    edge_angle_fluctuation = Number(19631, delivered=0.0)
    #: 19665#4: tip control: positions are those of the point where the vectors 19709 to 19714 end (0) or of a
    #: shifted one (1).
    SVC = Bit(19665, 4, delivered=False)
    #: 19665#5: the point is shifted so that nothing changes with all rotary axes at zero (0), or by 19667
    #: (1).
    SPR = Bit(19665, 5, delivered=False)
    #: 19666: Tool holder offset, from the nose along the tool to the rotary axis of the head [mm].
    holder_offset = Number(19666, delivered=None)
    #: 19696#5: tip control: words name the tip on the table (0) or in the work system, which does not turn
    #: (1).
    WKP = Bit(19696, 5, delivered=False)
    #: 19696#6: tip control: cuts that turn rotary axes while the tip stands run at the highest feed, 1422
    #: (0), or at F (1).
    RFC = Bit(19696, 6, delivered=False)
    #: 19697: Direction of the tool with all rotary axes at zero: X (1), Y (2), Z (3).
    tool_axis = Whole(19697, delivered=None)
    #: 19698: Angle RA by which the tool leans from that (from X to Y, Y to Z, Z to X) [deg].
    tool_lean = Number(19698, delivered=0.0)
    #: 19699: Angle RB by which the tool, leaning by RA, is turned about the axis of 19697 [deg].
    tool_lean_about = Number(19699, delivered=0.0)
    #: 19700: Place of the first rotary axis of the table, X, machine coordinates [mm].
    table_place_x = Number(19700, delivered=None)
    #: 19701: Place of the first rotary axis of the table, Y, machine coordinates [mm].
    table_place_y = Number(19701, delivered=None)
    #: 19702: Place of the first rotary axis of the table, Z, machine coordinates [mm].
    table_place_z = Number(19702, delivered=None)
    #: 19703: From the first rotary axis of the table to the second, X, machine coordinates [mm].
    table_apart_x = Number(19703, delivered=None)
    #: 19704: From the first rotary axis of the table to the second, Y, machine coordinates [mm].
    table_apart_y = Number(19704, delivered=None)
    #: 19705: From the first rotary axis of the table to the second, Z, machine coordinates [mm].
    table_apart_z = Number(19705, delivered=None)
    #: 19709: From the tool to the rotary axis of the head that carries it, X, machine coordinates [mm].
    tool_apart_x = Number(19709, delivered=None)
    #: 19710: From the tool to the rotary axis of the head that carries it, Y, machine coordinates [mm].
    tool_apart_y = Number(19710, delivered=None)
    #: 19711: From the tool to the rotary axis of the head that carries it, Z, machine coordinates [mm].
    tool_apart_z = Number(19711, delivered=None)
    #: 19712: From the second rotary axis of the head to the first, X, machine coordinates [mm].
    head_apart_x = Number(19712, delivered=None)
    #: 19713: From the second rotary axis of the head to the first, Y, machine coordinates [mm].
    head_apart_y = Number(19713, delivered=None)
    #: 19714: From the second rotary axis of the head to the first, Z, machine coordinates [mm].
    head_apart_z = Number(19714, delivered=None)
    #: 19741: G53.1, G53.6, G43.5: highest machine position of the first rotary axis; both 0 for any (19742)
    #: [deg].
    first_rotary_high = Number(19741, delivered=0.0)
    #: 19742: lowest machine position of the first rotary axis [deg].
    first_rotary_low = Number(19742, delivered=0.0)
    #: 19743: highest machine position of the second rotary axis; both 0 for any (19744) [deg].
    second_rotary_high = Number(19743, delivered=0.0)
    #: 19744: lowest machine position of the second rotary axis [deg].
    second_rotary_low = Number(19744, delivered=0.0)
    #: 19746#4: G41.2 without tip control: words name points of the work system (0) or by WKP of the table
    #: (1).
    TBP = Bit(19746, 4, delivered=False)
