"""The machine as the control sees it: plain frozen values in internal units, without a word about files.

Lengths are millimetres, rotary positions degrees, times seconds, speeds mm/s or degrees/s, accelerations and
jerks per s² and s³; spindle speeds stay revolutions per minute, as they are programmed. Positions are machine
coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING, Literal

from polycnc.messages.catalogue import language

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.geometry.frames import Vector
    from polycnc.machine.rules import Rule

Carries = Literal["tool", "work"]
Timing = Literal["before", "with", "after"]
#: The modulus of rotary axes whose position repeats after a turn.


@dataclass(frozen=True, slots=True)
class Text:
    """A text that the user reads; `zh_tw` is empty where the author wrote one language only."""

    en: str = ""
    zh_tw: str = ""

    def __str__(self) -> str:
        return self.zh_tw if self.zh_tw and language() == "zh-TW" else self.en


@dataclass(frozen=True, slots=True)
class Axis:
    """One axis of the machine.

    Attributes:
        name: Unique on the machine.
        rotary: Counts degrees instead of millimetres.
        modulo: Rotary, and its work display repeats after a turn.
        diameter: The transverse axis of a turning machine: the one that is programmed in diameter, if any is.
        parallel_to: Name of the axis that it runs parallel to, or empty.
        aliases: Further names by which programs may call it.
        machine_name: Name of the machine axis where the control tells it from the channel axis (SINUMERIK).
        limit_minus: Lowest machine position, -inf for none.
        limit_plus: Highest machine position, inf for none.
        rapid: Rapid traverse.
        max_feed: Fastest feed.
        acceleration: Largest acceleration.
        jerk: Largest jerk.
        reference_points: Machine positions of the first to fourth reference point.
        in_position_fine: Window of the fine exact stop.
        in_position_coarse: Window of the coarse exact stop.
    """

    name: str
    rotary: bool = False
    modulo: bool = False
    diameter: bool = False
    parallel_to: str = ""
    aliases: tuple[str, ...] = ()
    machine_name: str = ""
    limit_minus: float = -inf
    limit_plus: float = inf
    rapid: float = 0.0
    max_feed: float = 0.0
    acceleration: float = 0.0
    jerk: float = 0.0
    reference_points: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    in_position_fine: float = 0.0
    in_position_coarse: float = 0.0

    def overtravel(self, position: float, tolerance: float = 1e-6) -> int:
        """On which side a machine position lies beyond the limits: 1, -1, or 0 for within."""
        if position > self.limit_plus + tolerance:
            return 1
        return -1 if position < self.limit_minus - tolerance else 0


@dataclass(frozen=True, slots=True)
class Channel:
    """A channel (path, axis group): what one program can move.

    Attributes:
        number: From 1.
        axes: Machine axes in the channel's order. The first channel that names an axis owns it at power-on.
        names: What programs of this channel call them, in the same order.
        geometry: Machine axis that is X, Y and Z of the Cartesian system; a missing one is left out.
        virtual: Geometry axes that exist only while a transformation makes them (Y of TRANSMIT).
        spindles: Numbers of its spindles; the first is the master.
    """

    number: int
    axes: tuple[str, ...]
    names: tuple[str, ...]
    geometry: Mapping[str, str]
    virtual: tuple[str, ...] = ()
    spindles: tuple[int, ...] = (1,)


@dataclass(frozen=True, slots=True)
class Gear:
    """One gear stage, rpm."""

    min_rpm: float
    max_rpm: float


@dataclass(frozen=True, slots=True)
class Spindle:
    """A spindle; `axis` names the rotary axis that it becomes when it is positioned as one, or is empty."""

    number: int
    name: str
    min_rpm: float
    max_rpm: float
    acceleration_rpm_s: float
    orient_s: float
    carries: Carries
    axis: str = ""
    gears: tuple[Gear, ...] = ()


@dataclass(frozen=True, slots=True)
class Magazine:
    """The tool store. `change_at`: at which of its reference points (1 to 4) an axis stands for a change.

    Controls refuse a change elsewhere (`control/tool_change.py`).
    """

    kind: Literal["magazine", "turret"]
    places: int
    change_time_s: float
    change_at: Mapping[str, tuple[int, ...]]


@dataclass(frozen=True, slots=True)
class MFunction:
    """What an M code does on this machine: how long it takes, and when beside the motion of its block."""

    code: int
    name: Text
    seconds: float
    timing: Timing


@dataclass(frozen=True, slots=True)
class Joint:
    """One link of the kinematic chain.

    When its axis counts up, a joint moves what it carries along `direction` if the axis is linear, and turns
    it right-handed about `direction` if it is rotary. `offset` leads from the joint before (nearer to the
    base) to this one at position zero.
    """

    axis: str
    rotary: bool
    carries: Carries
    direction: Vector
    offset: Vector


@dataclass(frozen=True, slots=True)
class Solid:
    """A body of the machine. `moves_with` is an axis, or `base`, `tool` or `work` (the end of that chain).

    `box`: `size` from the corner `position`. `cylinder`: `size` is (diameter, length, 0) from the middle of
    the foot at `position` along `direction`.
    """

    name: Text
    role: Literal["table", "chuck", "tailstock", "fixture", "head", "guard"]
    shape: Literal["box", "cylinder"]
    position: Vector
    size: Vector
    direction: Vector
    moves_with: str


@dataclass(frozen=True)
class Machine:
    """A machine, complete. `axes` are in the order of the channels that own them, `rules` in that of their scan.

    From the end of the interpolation `settle_fine_s` and `settle_coarse_s` pass until the axes are within their
    windows `in_position_fine` and `in_position_coarse`.
    """

    id: str
    name: Text
    description: Text
    axes: tuple[Axis, ...]
    channels: tuple[Channel, ...]
    spindles: tuple[Spindle, ...]
    magazine: Magazine
    m_functions: Mapping[int, MFunction]
    joints: tuple[Joint, ...]
    solids: tuple[Solid, ...]
    interpolation_cycle_s: float = 0.004
    settle_fine_s: float = 0.0
    settle_coarse_s: float = 0.0
    rules: tuple[Rule, ...] = ()

    @cached_property
    def axis(self) -> Mapping[str, Axis]:
        """The axes by name."""
        return {axis.name: axis for axis in self.axes}

    @cached_property
    def spindle(self) -> Mapping[int, Spindle]:
        """The spindles by number."""
        return {spindle.number: spindle for spindle in self.spindles}

    @cached_property
    def tool_chain(self) -> tuple[Joint, ...]:
        """The joints that carry the tool, from the base outwards."""
        return tuple(joint for joint in self.joints if joint.carries == "tool")

    @cached_property
    def work_chain(self) -> tuple[Joint, ...]:
        """The joints that carry the work, from the base outwards."""
        return tuple(joint for joint in self.joints if joint.carries == "work")

    def channel(self, number: int) -> Channel:
        """A channel by its number; raises `KeyError` where there is none."""
        for channel in self.channels:
            if channel.number == number:
                return channel
        raise KeyError(number)

    def channel_axes(self, number: int) -> tuple[str, ...]:
        """What programs of a channel call its axes, in order."""
        return self.channel(number).names

    def geometry_indices(self, number: int) -> tuple[int, int, int]:
        """Where X, Y and Z of the Cartesian system stand among the axes of a channel; -1 for none."""
        channel = self.channel(number)
        x, y, z = (
            channel.axes.index(channel.geometry[letter]) if letter in channel.geometry else -1
            for letter in "XYZ"
        )
        return x, y, z

    def owner(self, axis: str) -> int:
        """Number of the channel that owns an axis at power-on."""
        return next(channel.number for channel in self.channels if axis in channel.axes)

    def with_channels(self, channels: Mapping[int, tuple[str, ...]]) -> Machine:
        """The same machine with its axes dealt out anew, as the `channels` of a setup say.

        A channel keeps names, geometry and spindles of the built channel of that number as far as its axes
        are still there; a new channel takes them from the first.

        Raises:
            KeyError: A channel names an axis that the machine does not have.
        """
        built = {channel.number: channel for channel in self.channels}
        dealt = []
        for number, axes in sorted(channels.items()):
            like = built.get(number, self.channels[0])
            called = dict(zip(like.axes, like.names, strict=True))
            for name in axes:
                self.axis[name]  # an unknown axis is a mistake of the setup
            dealt.append(
                replace(
                    like,
                    number=number,
                    axes=axes,
                    names=tuple(called.get(name, name) for name in axes),
                    geometry={key: name for key, name in like.geometry.items() if name in axes},
                )
            )
        return replace(self, channels=tuple(dealt))
