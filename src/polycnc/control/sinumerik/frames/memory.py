"""The frames of a channel: what is stored, what is active, and the way from the work display to the machine.

machine <- base frames <- settable frame (G54) <- programmable frame (TRANS, ROT, …) <- work coordinates.
SINUMERIK's absolute display shows work coordinates, so every frame belongs to the zero frame of
`Coordinates`.

Source: job planning 5.1 (coordinate systems, predefined frame variables), 5.7 (chain); Fundamentals (G54…,
SUPA).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import reduce
from operator import matmul
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.errors import not_supported
from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame, ctrans

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Frame

#: System frames by the name of their variable, in the order of the chain (job planning 5.7.2).
BEFORE_BASE = ("$P_PARTFRAME", "$P_SETFRAME", "$P_EXTFRAME")
AFTER_SETTABLE = ("$P_TOOLFRAME", "$P_WPFRAME", "$P_TRAFRAME")
AFTER_PROGRAMMABLE = ("$P_CYCFRAME",)
SYSTEM_FRAMES = (*BEFORE_BASE, *AFTER_SETTABLE, *AFTER_PROGRAMMABLE)


@dataclass(slots=True)
class Frames:
    """Stored and active frames.

    Attributes:
        settable: `$P_UIFR[n]`: 0 is G500, 1 G54 … 4 G57, 5 G505 … 99 G599.
        base: `$P_CHBFR[n]`, stored base frames of the channel.
        global_base: `$P_NCBFR[n]`, stored base frames of the control.
        number: `$P_UIFRNUM`, the settable frame that G54… chose.
        active_settable: `$P_IFRAME`.
        active_base: `$P_CHBFRAME[n]`.
        active_global_base: `$P_NCBFRAME[n]`.
        programmable: `$P_PFRAME`.
        system: System frames by the name of their variable.
        base_mask: `$P_CHBFRMASK`: bit n includes base frame n.
        global_base_mask: `$P_NCBFRMASK`.
    """

    settable: list[NcFrame]
    base: list[NcFrame]
    global_base: list[NcFrame]
    number: int = 0
    active_settable: NcFrame = NEUTRAL
    active_base: list[NcFrame] = field(default_factory=list)
    active_global_base: list[NcFrame] = field(default_factory=list)
    programmable: NcFrame = NEUTRAL
    system: dict[str, NcFrame] = field(default_factory=lambda: dict.fromkeys(SYSTEM_FRAMES, NEUTRAL))
    base_mask: int = 1
    global_base_mask: int = 1

    def select(self, number: int) -> None:
        """Activate a stored settable frame, and the stored base frames with it (G500, G54 …)."""
        self.number = number
        self.active_settable = self.settable[number]
        self.active_base = list(self.base)
        self.active_global_base = list(self.global_base)

    @property
    def is_in_force(self) -> bool:
        """Whether `select` with the active number would change nothing."""
        active = self.active_settable, list(self.active_base), list(self.active_global_base)
        return active == (self.settable[self.number], list(self.base), list(self.global_base))

    def actual_base(self) -> NcFrame:
        """`$P_ACTBFRAME`: the base frames that the masks include, global ones first."""
        chosen = [f for i, f in enumerate(self.active_global_base) if self.global_base_mask >> i & 1]
        chosen += [f for i, f in enumerate(self.active_base) if self.base_mask >> i & 1]
        return chain(chosen)

    def total(self, suppression: str = "") -> NcFrame:
        """`$P_ACTFRAME` under G53 (settable and programmable off), G153 (base too), SUPA (all off)."""
        system = self.system
        if suppression == "SUPA":
            return NEUTRAL
        outer = [system[name] for name in BEFORE_BASE]
        if suppression == "G153":
            return chain(outer)
        outer.append(self.actual_base())
        if suppression == "G53":
            return chain(outer)
        return chain([*outer, self.active_settable, *self.inner()])

    def inner(self) -> list[NcFrame]:
        """The frames between the settable zero system and the work coordinates."""
        return [
            *(self.system[name] for name in AFTER_SETTABLE),
            self.programmable,
            *(self.system[name] for name in AFTER_PROGRAMMABLE),
        ]


def chain(frames: list[NcFrame]) -> NcFrame:
    """The frames joined with `:`."""
    return reduce(matmul, (frame for frame in frames if frame is not NEUTRAL), NEUTRAL)


def stored_frames(
    offsets: Mapping[str, Mapping[str, float]], count: int, numbers: Mapping[str, int]
) -> list[NcFrame]:
    """Settable frames from the work offsets of a setup.

    Args:
        offsets: Shift by axis for each zero offset (`G54`, `G505`, `G500`).
        count: How many settable frames the control has.
        numbers: Number of each zero offset in its G group, from 1.
    """
    frames = [NEUTRAL] * count
    for code, shifts in offsets.items():
        if code in numbers and numbers[code] <= count:
            frames[numbers[code] - 1] = ctrans({axis: float(value) for axis, value in shifts.items()})
    return frames


def apply(channel: SinumerikChannel, suppression: str = "", *, travelled: bool = False) -> None:
    """Bring the active frames and the tool into the channel's coordinates; the machine does not move.

    Args:
        channel: The channel.
        suppression: G53, G153 or SUPA while their block runs.
        travelled: The next incremental word of an axis travels the change as well.
    """
    coordinates = channel.coordinates
    frame, offsets = _to_machine(channel, suppression)
    if frame != coordinates.zero or offsets != coordinates.offsets:
        coordinates.set_zero(frame, offsets, travelled=travelled)
        channel.context_changed()


def is_in_force(channel: SinumerikChannel) -> bool:
    """Whether a zero offset that is in force would change nothing now: G500, G54 ... once more."""
    frames, c = channel.memory.frames, channel.coordinates
    return frames.is_in_force and _to_machine(channel, "") == (c.zero, c.offsets)


def _to_machine(channel: SinumerikChannel, suppression: str) -> tuple[Frame, list[float]]:
    """The way from the display to the machine by the active frames and the tool."""
    memory = channel.memory
    total = memory.frames.total(suppression)
    offsets = [0.0] * len(channel.axes)
    for axis, part in total.others.items():
        if part.factor != 1.0:
            raise not_supported(f"SCALE, MIRROR {axis}")
        offsets[memory.column(axis)] += part.coarse + part.fine
    for column, length in zip(channel.coordinates.geometry, memory.tools.lengths, strict=True):
        if column >= 0:
            offsets[column] += length
    return total.frame, offsets


def changed(channel: SinumerikChannel) -> None:
    """A frame has changed: it acts at once; incremental words travel the change if SD42440 says so."""
    memory = channel.memory
    apply(channel, travelled=bool(memory.data.number("$SC_FRAME_OFFSET_INCR_PROG")))
