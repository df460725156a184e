"""The machine as the control sees it: plain frozen values in internal units, without a word about files.

Lengths are millimetres, rotary positions degrees, times seconds, speeds mm/s or degrees/s, accelerations and
jerks per s² and s³; spindle speeds stay revolutions per minute, as they are programmed. Positions are machine
coordinates.
"""

from __future__ import annotations

from functools import cached_property
from math import inf

from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.machine.builder import NO_BUILDER
from polycnc.machine.plc import Plc

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.geometry.frames import Vector
    from polycnc.machine.builder import Builder
    from polycnc.machine.plc import PlcAlarm
    from polycnc.machine.rules import Rule
    from polycnc.machine.tables import Act, Carries, Pockets, SpeedWait, Timing, Turns
    from polycnc.machine.text import Text


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
        rapid_time_s: Rapids take so long from rest to `rapid`, and `rapid_bell_s` is how long the acceleration takes to
            build up (FANUC T1 and T2); 0: `acceleration` and `jerk` hold. `cutting_time_s` and `cutting_bell_s` are
            the same of cuts that the control plans ahead, from rest to `max_feed`.
        after_interpolation_s: Behind the interpolator cuts take so long from rest to any speed; 0: all are planned
            ahead.
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
    rapid_time_s: float = 0.0
    rapid_bell_s: float = 0.0
    cutting_time_s: float = 0.0
    cutting_bell_s: float = 0.0
    after_interpolation_s: float = 0.0
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
    """A spindle; `axis` names the rotary axis that it becomes when it is positioned as one, or is empty.

    `speed_wait` says what waits until it has its speed.
    """

    number: int
    name: str
    min_rpm: float
    max_rpm: float
    acceleration_rpm_s: float
    orient_s: float
    carries: Carries
    axis: str = ""
    gears: tuple[Gear, ...] = ()
    speed_wait: SpeedWait = "block"


@dataclass(frozen=True, slots=True)
class Magazine:
    """The tool store.

    `change_at`: at which of its reference points (1 to 4) an axis stands for a change; empty: anywhere. The change
    itself brings the axes there, in this order and each to its first point, where it `retracts`; else controls refuse
    a change elsewhere (`control/tool_change.py`). `place_time_s` is the time in which it turns by one place, the
    shorter way round or only `forward`. A magazine of `random` pockets has an arm: it turns to the tool of a T beside
    everything else, and the old tool gets the pocket of the new one. With `fixed` ones it has none: the change takes
    the old tool back to its own pocket, and turns to the new one then.
    """

    kind: Literal["magazine", "turret"]
    places: int
    change_time_s: float
    change_at: Mapping[str, tuple[int, ...]]
    retracts: bool = False
    place_time_s: float = 0.0
    pockets: Pockets = "random"
    turns: Turns = "shortest"

    def turn_s(self, before: int, after: int) -> float:
        """Seconds in which it turns from one place to another."""
        way = (after - before) % self.places
        return (way if self.turns == "forward" else min(way, self.places - way)) * self.place_time_s

    def index_s(self, before: int, after: int) -> float:
        """Seconds in which a turret turns from the place of one tool to that of another.

        A tool without a place of its own (number 0, above `places`, or called by name) is not turned to.
        """
        known = all(0 < tool <= self.places for tool in (before, after))
        if self.kind != "turret" or not known:
            return 0.0
        return self.turn_s(before, after)


def program_called(calls: str) -> int | str:
    """The program that a machine file names: O9100 and 9100 are a number, anything else is a name."""
    number = calls.removeprefix("O")
    return int(number) if number.isdigit() else calls


@dataclass(frozen=True, slots=True)
class MFunction:
    """What an M code does on this machine.

    Attributes:
        code: Number.
        name: What it does.
        seconds: How long it takes.
        timing: When beside the motion of its block.
        takes: Addresses of its block that go to the machine with it; None for those that nothing else takes.
        calls: The program that it calls as a macro, by number or name; the words of the block are its arguments.
        does: What it does in the control; empty for nothing.
    """

    code: int
    name: Text
    seconds: float
    timing: Timing
    takes: tuple[str, ...] | None = None
    calls: str = ""
    does: Act | Literal[""] = ""


@dataclass(frozen=True, slots=True)
class GFunction:
    """What a G code of the builder does on this machine; the attributes are those of `MFunction`."""

    code: str
    name: Text
    seconds: float
    takes: tuple[str, ...] | None = None
    calls: str = ""


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

    From the end of the interpolation `settle_fine_s` and `settle_coarse_s` pass until the axes are within their windows
    `in_position_fine` and `in_position_coarse`. `block_time_s` is what the control takes for a block of a path before
    it can run the next one. With all rotary axes at zero the tool points along `tool_direction`, from its tip to the
    spindle, and `nose` leads from the last joint that carries the tool to where tools are seated. `control_variant`
    names a variant of the control that does without some functions, `control_options` those that it has all the same.
    `rules` and `alarms` are the file's own; those of its `builder` lie under them. `m_functions` and `g_functions` hold
    both.
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
    block_time_s: float = 0.0
    control_variant: str = ""
    control_options: tuple[str, ...] = ()
    rules: tuple[Rule, ...] = ()
    alarms: tuple[PlcAlarm, ...] = ()
    tool_direction: Vector = (0.0, 0.0, 1.0)
    nose: Vector = (0.0, 0.0, 0.0)
    g_functions: Mapping[str, GFunction] = field(default_factory=dict)
    builder: Builder = NO_BUILDER

    def plc(self, control: str) -> Plc:
        """The machine's own controller on a control, by the control's id."""
        found = self._plcs.get(control)
        if found is None:
            own = {f"M{code}" for code in self.m_functions} | set(self.g_functions)
            found = self._plcs[control] = Plc(
                (*self.builder.rules, *self.rules),
                (*self.builder.alarms_of(control, own), *self.alarms),
            )
        return found

    @cached_property
    def _plcs(self) -> dict[str, Plc]:
        return {}

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

    def goes_beside(self, code: int) -> bool:
        """Whether an M function takes time, and takes it beside the motion of its block."""
        function = self.m_functions.get(code)
        return function is not None and function.timing == "with" and function.seconds > 0.0

    def channel(self, number: int) -> Channel:
        """A channel by its number; raises `KeyError` where there is none."""
        for channel in self.channels:
            if channel.number == number:
                return channel
        raise KeyError(number)

    def channel_axes(self, number: int) -> tuple[str, ...]:
        """What programs of a channel call its axes, in order."""
        return self.channel(number).names

    def axis_number(self, name: str) -> int:
        """Number of an axis among all of the machine, from 1."""
        return 1 + next(i for i, axis in enumerate(self.axes) if axis.name == name)

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
