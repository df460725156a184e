"""What a SINUMERIK channel remembers beside modal codes and positions; it is `channel.memory`."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import nan
from typing import TYPE_CHECKING, Any

from polycnc.messages import AlarmError
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections import deque
    from collections.abc import Callable, Mapping

    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.feed.spindles import Spindles
    from polycnc.control.sinumerik.frames.memory import Frames
    from polycnc.control.sinumerik.limits.protection import Protection
    from polycnc.control.sinumerik.limits.working_area import Limit
    from polycnc.control.sinumerik.signals.interrupts import Assignment, Watch
    from polycnc.control.sinumerik.signals.measuring import Prober
    from polycnc.control.sinumerik.tools.memory import Tools
    from polycnc.geometry.frames import Vector
    from polycnc.language.sinumerik.interface import LanguageMemory


@dataclass(slots=True)
class Polar:
    """Pole and modal polar coordinates (Fundamentals, G110 to G112, AP, RP).

    Attributes:
        pole: In work coordinates of the geometry axes, mm.
        angle: Last AP, degrees.
        radius: Last RP, mm; NaN before the first.
    """

    pole: Vector = (0.0, 0.0, 0.0)
    angle: float = 0.0
    radius: float = nan


@dataclass(slots=True, eq=False)
class Memory:
    """The state of one channel.

    Attributes:
        language: What the NC language keeps (R parameters, user variables, calls).
        data: Machine and setting data.
        frames: Stored and active frames.
        tools: Tool memory and active tool.
        spindles: Spindles and the master spindle.
        columns: Column of every axis by each of its names in the program (channel and geometry names).
        machine_columns: Column of every axis by the name of its machine axis.
        transverse: Column of the axis that diameter programming is for, -1 for none.
        polar: Pole and polar coordinates.
        previous: Where the last path move came from: its start, centre and normal of an arc or None, and 1.0
            for counter-clockwise; None before the first.
        feed_mode: How F is meant, as the toolpath's feed modes.
        modal_corner_feed: FRCM in internal units, NaN for the path feed.
        tooth_feed: FZ, mm, and the feed per revolution that it gave; None before the first.
        feed_source: Spindle that a feed per revolution follows (FPR); 0 for the master spindle.
        feed_before: Feed before the words of the running block (smooth approach).
        acted: The running block has done something on the machine (for single block).
        sections: Program level that began an open section (DELAYFSTON, IPTRLOCK).
        limits: Ranges that targets must stay in.
        open_line: Angle of a line whose end the next block tells (ANG), degrees.
        open_corners: Chamfers and roundings at the end of that line.
        exact_stop_block: G9 holds for the running block.
        feeds: Feed of positioning axes (FA), mm/s or degrees/s, by column.
        allowance_mm: OFFN.
        disc: DISC, 0 to 100.
        rounding_mm: ADIS.
        rapid_rounding_mm: ADISPOS.
        percent: Programmed overrides and dynamic limits (OVR, ACC[X] …), by address and axis.
        interrupts: What SETINT has given each interrupt input.
        watch: The stage that interrupt routines begin from; None where the setup has no inputs.
        repos_mode: Point of the last REPOS (`$AC_REPOS_PATH_MODE`), 0 before.
        protection: Protection zones; None before the first.
        prober: The stage that follows touch probes; None where the setup has none.
        measured: Measured work and machine position of an axis by number of the value and column.
        measured_from: Where the running measuring block began.
        triggered: $AC_MEA by probe.
        fifos: $AC_FIFOn by number.
        shares_axes: Another channel can use axes of this one.
        nck: As `values`, of variables that all channels share.
        values: Values of system variables that only store (`$AC_PARAM`, `$A_DLB` …), by name and index.
    """

    language: LanguageMemory
    data: MachineData
    frames: Frames
    tools: Tools
    spindles: Spindles
    columns: Mapping[str, int]
    machine_columns: Mapping[str, int]
    transverse: int = -1
    polar: Polar = field(default_factory=Polar)
    previous: tuple[list[float], tuple[Vector, Vector] | None, float] | None = None
    feed_mode: FeedMode = FeedMode.PER_MINUTE
    modal_corner_feed: float = nan
    exact_stop_block: bool = False
    acted: bool = False
    tooth_feed: tuple[float, float] | None = None
    feed_source: int = 0
    feed_before: float = nan
    sections: dict[str, Level] = field(default_factory=dict)
    limits: tuple[Limit, ...] = ()
    open_line: float = 0.0
    open_corners: list[Callable[[], None]] = field(default_factory=list)
    feeds: dict[int, float] = field(default_factory=dict)
    allowance_mm: float = 0.0
    disc: float = 0.0
    rounding_mm: float = 0.0
    rapid_rounding_mm: float = 0.0
    percent: dict[tuple[str, str], float] = field(default_factory=dict)
    interrupts: dict[int, Assignment] = field(default_factory=dict)
    watch: Watch | None = None
    repos_mode: int = 0
    protection: Protection | None = None
    prober: Prober | None = None
    measured: dict[tuple[int, int], tuple[float, float]] = field(default_factory=dict)
    measured_from: list[float] | None = None
    triggered: dict[int, bool] = field(default_factory=dict)
    fifos: dict[int, deque[float]] = field(default_factory=dict)
    shares_axes: bool = False
    nck: dict[tuple[str, tuple[Any, ...]], Any] = field(default_factory=dict)
    values: dict[tuple[str, tuple[Any, ...]], Any] = field(default_factory=dict)

    def column(self, axis: str) -> int:
        """Column of an axis by any of its names.

        Raises:
            AlarmError: 12050 for an axis that the channel does not have.
        """
        for names in (self.columns, self.machine_columns):
            if axis in names:
                return names[axis]
        raise AlarmError("12050", axis=axis)
