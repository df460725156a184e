"""What holds over many moves and changes rarely: kept once, referred to by number."""

from __future__ import annotations

from math import inf

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath.modes import AccelerationMode, CornerMode, FeedMode, StopWindow

if TYPE_CHECKING:
    from polycnc.transformation.contract import Transformation


#: Origins of rows that the program itself has; higher ones are intermediate blocks.
PROGRAMMED, SHORTENED = 0, 1
#: Metres in a foot, in which surface speeds count where the program is in inches.
FOOT_M = 0.3048
#: How a stroke of a cycle meets the next one: none of its ends overlaps; only its start may; its end may too: the next
#: stroke begins so many mm before its end, or as soon as the axes come to rest.
Overlap = float
NO_OVERLAP, STROKE, OVERLAPS = -1.0, 0.0, inf


@dataclass(frozen=True, slots=True)
class Pace:
    """What a program says about speeds and limits of axes beside F. Tuples have a number for every column.

    Attributes:
        feed: Factor on the path feed (`OVR`); `rapid` on rapids (`OVRRAP`).
        edge: On arcs under radius compensation F is the speed of the cutting edge on the contour: `always` (`CFC`), on
            `inside` curves only (`CFIN`), or `never`: it is that of the tool's centre (`CFTCP`).
        weights: Millimetres that a millimetre or degree of each column counts in the length that F is for (`FGROUP`,
            `FGREF`), 0 for a synchronous axis; empty for the control's own rule.
        turning: Likewise what each counts where nothing else moves than rotary axes without a weight; empty for 1.
        top: Highest velocity in cuts, mm/s or degrees/s (`FL`); infinite for none. Empty for no such limits.
        reach: Highest velocity in all moves, mm/s or degrees/s (MD32000 where it is named); infinite for that of the
            machine. Empty for no such limits.
        following: Highest speed of what the linear axes move beside the tip's own way because rotary axes turn under
            tool tip control, mm/s, in cuts (SYNTEC Pr3091); infinite for none.
        velocity: Factors on the highest velocity (`VELOLIM`); `acceleration` (`ACC`) and `jerk` (`JERKLIM`) likewise.
            Empty for none.
        left: Highest velocity in all moves that motions over an axis leave to the path, mm/s or degrees/s, and
            `left_pull` the part of its acceleration (`$AA_OFF`). Of the axes of the machine, whatever makes them of the
            columns. Empty for none.
    """

    feed: float = 1.0
    rapid: float = 1.0
    edge: str = "never"
    weights: tuple[float, ...] = ()
    turning: tuple[float, ...] = ()
    top: tuple[float, ...] = ()
    reach: tuple[float, ...] = ()
    following: float = inf
    velocity: tuple[float, ...] = ()
    acceleration: tuple[float, ...] = ()
    jerk: tuple[float, ...] = ()
    left: tuple[float, ...] = ()
    left_pull: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Fairing:
    """How far cuts that follow each other in short blocks may be led beside their ends, to be smoother (`fairing.py`).

    Attributes:
        tolerance_mm: The path may leave the programmed lines by so much, rounding included.
        reach: So many ends before and behind it tell where the smooth path lies.
        longest_mm: Longer blocks stay as they are.
        turns: Columns of rotary axes that may leave their way, and by how many degrees; others keep to it.
    """

    tolerance_mm: float
    reach: int
    longest_mm: float
    turns: tuple[tuple[int, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Context:
    """The state under which a run of moves was made. Immutable; equal contexts share one number.

    Attributes:
        plane: Working plane as `G17`, `G18` or `G19`.
        inch: Words and display are in inches. Lengths in the table stay in millimetres.
        feed_inch: Feeds alone are told in inches, the display is not (SINUMERIK G700).
        feed_mode: What the feed of a row counts.
        frame: Work coordinates to machine coordinates of the geometry axes, without the tool.
        offsets: Shift from work to machine of every channel axis beside `frame`, tool included (mm, degrees).
        tool: Tool number in the spindle, 0 for none; `tool_name` where the control calls tools by name.
        radius_mm: Radius that cutter compensation applies, 0 when it is off.
        side: Cutter compensation: 0 off, 1 left, -1 right.
        spindle_rpm: Programmed speed (rpm; under constant surface speed m/min, or feet/min in inches), spindle
            direction 1, -1 or 0.
        corner_mode: How the path goes through the ends of blocks; `stop_window` what an exact stop waits for.
        tolerance_mm: Contour tolerance for the planner where a code names one, else 0.
        fairing: Cuts of short blocks may be led beside their ends so that their path is smoother, as a part of the
            tolerance; None where they keep to them.
        turn_tolerance_deg: How far rotary axes may leave their way where two blocks meet, where a code names that
            (OST), and `turn_distance_mm` how far from there they may (OSD); 0 for what holds for all axes.
        swing_deg: How far they may where a corner is rounded within `tolerance_mm`; 0 for as many degrees as that has.
        acceleration: How the axes take up speed; None for the control's own way.
        rapid_by_axis: On a rapid every axis runs alone, whatever the control's parameters say.
        rapid_speed: Speed of rapids along the path, or of each axis that runs alone, mm/s, where they have one of their
            own (FANUC 1466, SYNTEC G00 P1 F1=), else 0.
        diameter_axes: Bit mask of channel axes that show diameters.
        wcs: Name of the active work coordinate system.
        part: From the display to the system of the work offset, where programmed frames lie behind the display: in
            that system the path of a whole program is one picture.
        feed_override: The operator's feed override acts; else it counts 100 %. `spindle_override` and `rapid_override`
            the same.
        feed_hold: The operator's feed hold acts.
        stop_delay: The move lies in a section whose stops wait for its end, and which keeps the overrides with which it
            was entered.
        search_lock: The move lies in a section that no block search enters (SINUMERIK IPTRLOCK).
        lag_s: Acceleration after interpolation of thread cycles: seconds by which the axes are behind at speed (FANUC
            1626), 0 for what the axes can do. `lag_from` is the speed, mm/s, from which on it acts (1627).
        overlap: How strokes of a cycle overlap (FANUC 1681, SYNTEC Pr4008, G53 Q): `Overlap`.
        rapid_overlap: How far before the end of a rapid the next one begins, mm (SYNTEC G00 Q); 0: when the axes rest.
        transformation: From the positions of the toolpath to those of the real axes, where they differ.
        machine_diameters: As `diameter_axes`, of the machine display where that differs: an axis of the plane of polar
            interpolation may be a radius. None where it does not.
        pace: What the program says about speeds beside the feed; None for nothing.
        unrolled: A rotary axis whose positions are lengths on a surface (FANUC G07.1), by its column, and the degrees
            of a millimetre, by which it is shown.
        shown_by: Rows hold positions of the axes, though the display shows those of the path: by this transformation
            (point to point, SINUMERIK PTP). None where rows hold what is shown.
        names: What the work display calls the columns where a transformation makes other axes of them (Y of TRANSMIT);
            empty where the channel's names hold, an empty one for a column that it uses up.
        knot: Rows end at a knot within a motion, which the next row goes on with; displays show the motion as one, if
            not each point of a curve (`shows_knot`).
        chords: Rows of feed are chords of a smooth curve of the rotary axes; the tip goes straight along them.
        knot_deg: As much may the rotary axes at least leave their way at a knot, degrees; nothing but them turns there.
        share: Part of its motion that a row of inverse time makes: displays show the feed of the whole.
        finishes: The move belongs to strokes that a hold and a reset let come to their end (SYNTEC taps).
        origin: What has made a row of the program's blocks: `PROGRAMMED` nothing, `SHORTENED` one that a chamfer or the
            like beside it has cut, else an intermediate block by its kind and what has made it (`origins.py`).
        dwell_signal: A signal that ends the dwell of a row (SYNTEC G04 Q); empty for none.
    """

    plane: str = "G17"
    inch: bool = False
    feed_inch: bool = False
    feed_mode: FeedMode = FeedMode.PER_MINUTE
    frame: Frame = IDENTITY
    offsets: tuple[float, ...] = ()
    tool: int = 0
    tool_name: str = ""
    radius_mm: float = 0.0
    side: int = 0
    spindle: int = 1
    spindle_rpm: float = 0.0
    spindle_direction: int = 0
    surface_speed: bool = False
    spindle_limit_rpm: float = 0.0
    corner_mode: CornerMode = CornerMode.CONTINUOUS
    stop_window: StopWindow = StopWindow.FINE
    tolerance_mm: float = 0.0
    fairing: Fairing | None = None
    turn_tolerance_deg: float = 0.0
    turn_distance_mm: float = 0.0
    swing_deg: float = 0.0
    acceleration: AccelerationMode | None = None
    rapid_by_axis: bool = False
    rapid_speed: float = 0.0
    diameter_axes: int = 0
    wcs: str = "G54"
    part: Frame = IDENTITY
    feed_override: bool = True
    spindle_override: bool = True
    rapid_override: bool = True
    feed_hold: bool = True
    stop_delay: bool = False
    search_lock: bool = False
    lag_s: float = 0.0
    lag_from: float = 0.0
    overlap: Overlap = NO_OVERLAP
    rapid_overlap: float = 0.0
    transformation: Transformation | None = None
    machine_diameters: int | None = None
    unrolled: tuple[int, float] | None = None
    pace: Pace | None = None
    shown_by: Transformation | None = None
    names: tuple[str, ...] = ()
    knot: bool = False
    chords: bool = False
    knot_deg: float = 0.0
    shows_knot: bool = False
    share: float = 1.0
    finishes: bool = False
    dwell_signal: str = ""
    origin: int = PROGRAMMED

    @property
    def surface_m_min(self) -> float:
        """Programmed surface speed under constant surface speed, m/min."""
        return self.spindle_rpm * FOOT_M if self.inch else self.spindle_rpm

    @property
    def stops(self) -> bool:
        """Whether the axes come to rest at the end of a row: where a motion goes on they do not."""
        return self.corner_mode is CornerMode.EXACT_STOP and not self.knot

    @property
    def is_hidden(self) -> bool:
        """Whether displays show a row with the one that goes on behind it."""
        return self.knot and not self.shows_knot

    def begins_early(self, before: Context, *, rapid: bool) -> bool:
        """Whether a move, `rapid` or not, begins before the axes rest behind one in the context `before`."""
        if self.overlap == NO_OVERLAP:
            return rapid and before.rapid_overlap > 0.0
        return before.overlap > 0.0

    def spindle_factor(self, override: float) -> float:
        """What the operator's override makes of the spindle's speed; it does not pass the program's highest speed.

        Under constant surface speed, where the speed is another at every radius, it is the override itself.
        """
        if not self.spindle_override:
            return 1.0
        if self.surface_speed or self.spindle_limit_rpm <= 0.0 or self.spindle_rpm <= 0.0:
            return override
        return min(override, max(self.spindle_limit_rpm / self.spindle_rpm, 1.0))

    @property
    def degree_mm(self) -> float:
        """Millimetres of a feed that are a degree where nothing but rotary axes moves: a speed counts degrees then."""
        return INCH_MM if self.inch or self.feed_inch else 1.0

    def rapid_top(self, limit: float, *, rotary: bool) -> float:
        """Highest speed of an axis that runs a rapid alone; `limit` is what the machine allows."""
        limit *= self.pace.rapid if self.pace is not None else 1.0
        own = self.rapid_speed / self.degree_mm if rotary else self.rapid_speed
        return min(limit, own) if own else limit
