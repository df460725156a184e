"""How a control leads the axes of a machine: what its parameters decide and no machine file says."""

from __future__ import annotations

from enum import StrEnum
from math import inf

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.toolpath.modes import AccelerationMode

if TYPE_CHECKING:
    from collections.abc import Mapping


#: What waits until a spindle has its speed: the block that asks for it, the first cut behind it, or nothing.
SpindleWaitFor = Literal["block", "cut", "never"]


class DryFeed(StrEnum):
    """How the feed of a dry run stands to the programmed one."""

    REPLACES = "replaces"
    LARGER = "larger"
    """The larger of both is taken."""
    SMALLER = "smaller"


@dataclass(frozen=True, slots=True)
class DryRun:
    """What a dry run does with programmed speeds.

    Attributes:
        speed: Feed of the dry run at a feed override of 100 %, mm/s; delivered, the jog rate of the Hartford manual.
        feed: How it stands to the programmed feed.
        with_spindle: It acts on threads and taps as well, which then do not keep to their lead.
        rapids: It acts on rapids as well.
    """

    speed: float = 1000.0 / 60.0
    feed: DryFeed = DryFeed.REPLACES
    with_spindle: bool = False
    rapids: bool = False

    def speed_for(self, asked: float) -> float:
        """Speed in place of what the program asks for; infinite where it asks for none."""
        if self.feed is DryFeed.REPLACES or asked == inf:
            return self.speed
        return max(asked, self.speed) if self.feed is DryFeed.LARGER else min(asked, self.speed)


@dataclass(frozen=True, slots=True)
class Ramp:
    """How an axis takes up speed, as parameters of a control give it; nothing said is what the machine file says.

    Attributes:
        seconds: Time from rest to the axis's highest speed; None: not given.
        bell_s: Time over which the acceleration builds up and fades (FANUC T2); None: not given.
        acceleration: In place of `seconds`, mm/s² or degrees/s²; None: not given.
    """

    seconds: float | None = None
    bell_s: float | None = None
    acceleration: float | None = None


@dataclass(frozen=True, slots=True)
class MotionSettings:
    """What the planner asks of a control's parameters.

    Attributes:
        bends_by_way: With limited jerk a run of cuts that are planned ahead is bent by its way, and a law of third
            order leads along it; what else is planned is averaged over time, as bell-shaped acceleration is.
        rapid_by_axis: On a rapid every axis runs alone at its own speed (FANUC 1401#1 LRP = 0, SYNTEC Pr411 =
            1); else all arrive together on a line. A context can ask for it too (SINUMERIK `RTLIOF`).
        rapid_stops: The axes come to rest before and after every rapid (in-position check).
        rotary_in_feed: The feed of a move of linear and rotary axes counts a degree as a millimetre (an inch
            in inch mode), as the word-address controls do; else it counts the linear axes alone (SINUMERIK
            without FGROUP).
        feed_along_arc: The feed of an arc is the speed along it, whatever other axes do beside (FANUC 1403#5 HTG = 0);
            else it counts their way too.
        inverse_time_by_radius: Inverse time of an arc counts its radius (FANUC, MELDAS: F times the radius is the
            speed), not its length.
        keeps_corners: Continuous path keeps to the corner, which costs speed; else it rounds it.
        tolerance_mm: Contour tolerance of corners that are rounded, where the program names none.
        overload: At a corner without deviation an axis may change its velocity within one interpolation cycle
            by this many times its acceleration (SINUMERIK MD32310 MAX_ACCEL_OVL_FACTOR).
        corner_speed: Highest step of an axis's velocity at a corner of two cuts, mm/s: the speed at which a right angle
            between two axes is passed (SYNTEC Pr406). `corner_steps` is the same for single axes by their name in
            programs (FANUC 1783).
        arc_pull: Highest acceleration across the path on arcs, mm/s² (SYNTEC Pr408); `arc_pulls` that of single axes by
            their name in programs (FANUC 1735).
        arc_least: Speed below which these do not slow an arc, mm/s (FANUC 1732). All of them hold in cuts that are
            planned ahead.
        line_pulls: Highest acceleration from one line to the next in such cuts, mm/s² or degrees/s², of axes by their
            names in programs (FANUC 1737); `line_least` is the speed below which it slows none, mm/s (FANUC 1738).
        behind_times: Time constants behind the interpolation of cuts that are planned ahead, seconds, by the axes'
            names in programs (FANUC 1769).
        path_feed: Highest speed of a cut along the path, mm/s (SYNTEC Pr405).
        turn_speed: Speed of a cut under tip control in which the tip stands and rotary axes turn, degrees/s (FANUC
            19696#6 RFC = 0); 0 for its feed.
        rapid_caps: Highest rapid traverse of axes by their name in programs, mm/s or degrees/s, where it is below that
            of the machine (SYNTEC Pr461 on).
        feed_caps: The same for cutting (SYNTEC Pr621 on).
        rapid_ramps: How axes take up speed on rapids, by their name in programs, where parameters say it (FANUC 1620,
            1621, SYNTEC Pr441); `cut_ramps` likewise in cuts (FANUC 1660, 1772, SYNTEC Pr541, Pr641).
        after_interpolation: Cuts whose context does not ask for something else are accelerated behind the
            interpolator, over a time that does not depend on their speed, where machine or parameters give one.
        after_times: That time of axes by their name in programs, seconds, where parameters give it (FANUC 1622).
        spindle_wait: What waits until a spindle has its speed, where parameters say it (FANUC 3708#0, SINUMERIK
            MD35500): the first cut, or nothing; empty for what the machine file says.
        acceleration: How the axes take up speed where the context does not say.
        drive_speed: Reduced at speed (`DRIVE`): from this part of its velocity on an axis accelerates less (MD35220).
        drive_reduction: The same: by this part of its acceleration (MD35230).
        taps_overridden: The feed override acts on rigid taps (FANUC 5203#4 OVS).
        taps_held: Feed hold stops a rigid tap at once (FANUC 5200#6 FHD).
        dry_run: What a dry run does.
        slowest_rapid: Speed of the fastest axis at the lowest position of the rapid override (F0), mm/s.
        rapid_held: A feed override of 0 % holds rapids too (FANUC 1401#4 RF0).
        returns_to_path: Axes that were moved by hand go back to where the program waits before it goes on (SINUMERIK
            REPOSA, FANUC 7001#0 MIT); else it goes on from where they are.
    """

    bends_by_way: bool = False
    rapid_by_axis: bool = False
    rapid_stops: bool = True
    rotary_in_feed: bool = True
    feed_along_arc: bool = False
    inverse_time_by_radius: bool = False
    keeps_corners: bool = True
    tolerance_mm: float = 0.01
    overload: float = 1.2
    corner_speed: float = inf
    corner_steps: Mapping[str, float] = field(default_factory=dict)
    arc_pull: float = inf
    arc_pulls: Mapping[str, float] = field(default_factory=dict)
    arc_least: float = 0.0
    line_pulls: Mapping[str, float] = field(default_factory=dict)
    line_least: float = 0.0
    path_feed: float = inf
    turn_speed: float = 0.0
    rapid_caps: Mapping[str, float] = field(default_factory=dict)
    feed_caps: Mapping[str, float] = field(default_factory=dict)
    rapid_ramps: Mapping[str, Ramp] = field(default_factory=dict)
    cut_ramps: Mapping[str, Ramp] = field(default_factory=dict)
    after_interpolation: bool = False
    after_times: Mapping[str, float] = field(default_factory=dict)
    behind_times: Mapping[str, float] = field(default_factory=dict)
    spindle_wait: SpindleWaitFor | Literal[""] = ""
    acceleration: AccelerationMode = AccelerationMode.CONSTANT
    drive_speed: float = 1.0
    drive_reduction: float = 0.0
    taps_overridden: bool = False
    taps_held: bool = False
    dry_run: DryRun = DryRun()
    slowest_rapid: float = 400.0 / 60.0
    rapid_held: bool = False
    returns_to_path: bool = True


DEFAULT = MotionSettings()
