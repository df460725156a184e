"""The frames of a channel: what is stored, and what is active.

machine <- base frames <- settable frame (G54) <- programmable frame (TRANS, ROT, …) <- work coordinates.
SINUMERIK's absolute display shows work coordinates, so every frame belongs to the zero frame of
`Coordinates`.

Source: job planning 5.1 (coordinate systems, predefined frame variables), 5.7 (chain); Fundamentals (G54…,
SUPA).
"""

from __future__ import annotations

from functools import reduce
from operator import matmul

from polycnc.channel.states.state import Lifetime, State, lasting, retained
from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame, ctrans
from polycnc.memory.retained import WORK_OFFSETS, filled
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel

#: System frames by the name of their variable, in the order of the chain (job planning 5.7.2).
BEFORE_BASE = ("$P_PARTFRAME", "$P_SETFRAME", "$P_EXTFRAME")
AFTER_SETTABLE = ("$P_TOOLFRAME", "$P_WPFRAME", "$P_TRAFRAME")
#: Those of the ISO dialect: its mirror, its rotation, and its scale, innermost.
ISO_MIRROR, ISO_ROTATION, ISO_SCALE = "$P_ISO1FRAME", "$P_ISO2FRAME", "$P_ISO4FRAME"
AFTER_PROGRAMMABLE = (ISO_MIRROR, ISO_ROTATION, "$P_ISO3FRAME", ISO_SCALE, "$P_CYCFRAME")
SYSTEM_FRAMES = (*BEFORE_BASE, *AFTER_SETTABLE, *AFTER_PROGRAMMABLE)
#: Those of swivelled and tilted planes and of cycles: a change of transformation ends them, and a reset.
OF_PLANES = ("$P_TOOLFRAME", "$P_WPFRAME", "$P_TRAFRAME", "$P_CYCFRAME")
#: Number of every settable zero offset in its group.
ZERO_OFFSETS = {word: gcodes.number_of(word) for word in gcodes.BY_NAME["wcs"].words}


@dataclass(slots=True)
class Frames(State, lifetime=Lifetime.POWER):
    """Stored and active frames.

    Attributes:
        of_channel: Stored frames of the channel, by the name of their variable.
        of_control: Those of the control.
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

    of_channel: dict[str, list[NcFrame]] = retained(WORK_OFFSETS)
    of_control: dict[str, list[NcFrame]] = retained(WORK_OFFSETS, of_control=True)
    settable: list[NcFrame] = field(default_factory=list)
    base: list[NcFrame] = field(default_factory=list)
    global_base: list[NcFrame] = field(default_factory=list)
    number: int = 0
    active_settable: NcFrame = NEUTRAL
    active_base: list[NcFrame] = field(default_factory=list)
    active_global_base: list[NcFrame] = field(default_factory=list)
    programmable: NcFrame = lasting(Lifetime.RESET, NEUTRAL)
    system: dict[str, NcFrame] = field(default_factory=lambda: dict.fromkeys(SYSTEM_FRAMES, NEUTRAL))
    base_mask: int = 1
    global_base_mask: int = 1

    @classmethod
    def first(cls, channel: Channel) -> Frames:
        """Nothing is active; stored is what is retained, else what the setup says.

        Raises:
            AlarmError: 12550 for a zero offset of the setup that the control does not have.
        """
        data = MachineData.of(channel)
        offsets = dict(channel.setup.work_offsets)
        external, base = ctrans(offsets.pop("EXT", {})), ctrans(offsets.pop("BASE", {}))
        unknown = next((name for name in offsets if name not in ZERO_OFFSETS), None)
        if unknown is not None:
            raise AlarmError("12550", text=unknown)
        of_channel, of_control = (channel.retained.table(WORK_OFFSETS, n) for n in (channel.number, 0))
        shared, bases = data.count("$MN_MM_NUM_GLOBAL_USER_FRAMES"), data.count("$MC_MM_NUM_BASE_FRAMES")
        settable = stored_frames(offsets, shared or data.count("$MC_MM_NUM_USER_FRAMES"), ZERO_OFFSETS)
        global_base = [NEUTRAL] * data.count("$MN_MM_NUM_GLOBAL_BASE_FRAMES")
        return cls(
            of_channel,
            of_control,
            settable=filled(of_control if shared else of_channel, "$P_UIFR", settable),
            base=filled(of_channel, "$P_CHBFR", [base, *[NEUTRAL] * (bases - 1)][:bases]),
            global_base=filled(of_control, "$P_NCBFR", global_base),
            base_mask=data.integer("$MC_CHBFRAME_RESET_MASK"),
            global_base_mask=data.integer("$MN_NCBFRAME_RESET_MASK"),
            system={**dict.fromkeys(SYSTEM_FRAMES, NEUTRAL), "$P_EXTFRAME": external},
        )

    def select(self, number: int) -> None:
        """Activate a stored settable frame, and the stored base frames with it (G500, G54 …)."""
        if number >= len(self.settable):
            raise AlarmError("17020", text="$P_UIFR", index=number)
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
