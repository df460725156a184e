"""The seat of a transformation: frames in front of it, the tool in it or behind it, and what words then name.

Frames belong to the work, in front of the transformation; the tool counts in it or behind it. So while one acts it
holds both (`transformation.seated`), and nothing else lies between the display and the machine. Whoever changes frames
or the tool calls `stand`, by way of `frames.active.apply`.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.sinumerik import axis_names
from polycnc.control.sinumerik.couplings import links
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools.lengths import OF_MACHINE
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.vectors import minus, plus
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES
from polycnc.messages import AlarmError
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.kinematic.polar import CLOSEST_MM, PolarPlane
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from polycnc.transformation.seated import Seated

with loaded_when_called():
    from polycnc.control.sinumerik.transformations import data_sets

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.transformations.data_sets import Build
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.language.sinumerik.names.frame import NcFrame
    from polycnc.transformation.contract import Geometry

_NONE: Vector = (0.0, 0.0, 0.0)
#: Modal state that says which kind of transformation acts; empty for none.
GROUP = "transformation"
#: Modal state that says which channel axes are the geometry axes; empty for those of the machine.
GEOMETRY = "geometry"


@dataclass(slots=True)
class Transformations(State, lifetime=Lifetime.RESET):
    """The transformation that acts.

    Attributes:
        kind: The procedure that has selected it; empty for none.
        build: What it makes of the axes.
        seated: The same with frames and tool.
        columns: Columns of X, Y and Z that GEOAX has assigned; None for those of the machine.
        angles: The last angle of TRAANG by its data set.
    """

    kind: str = ""
    build: Build | None = None
    seated: Seated | None = None
    columns: Geometry | None = None
    angles: dict[int, float] = lasting(Lifetime.POWER, factory=dict)

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset brings the geometry axes of the machine back, unless MD20118 keeps the assigned ones."""
        columns = self.columns
        super().end(channel, lifetime)
        if lifetime is Lifetime.RESET and not MachineData.of(channel).integer("$MC_GEOAX_CHANGE_RESET"):
            self.columns = columns


def regroup(channel: SinumerikChannel, columns: Geometry | None) -> None:
    """Let these columns be X, Y and Z, None for those of the machine; `stand` brings it about."""
    Transformations.of(channel).columns = columns
    channel.mode = channel.mode.with_code(GEOMETRY, geometry_code(channel))


def geometry_code(channel: SinumerikChannel) -> str:
    """What the modal state says of the geometry axes."""
    columns = Transformations.of(channel).columns
    return "" if columns is None else " ".join(map(str, columns))


def centre_point(channel: SinumerikChannel) -> ToolCentrePoint | None:
    """The orientation transformation that acts, without frames; None for none."""
    seated = Transformations.of(channel).seated
    inner = seated.inner if seated is not None else None
    if isinstance(inner, Chain):
        inner = inner.links[0]
    return inner if isinstance(inner, ToolCentrePoint) else None


def frame_in_front(channel: SinumerikChannel) -> Frame:
    """From the work to the basic system."""
    seated = Transformations.of(channel).seated or links.Couplings.of(channel).seated
    return channel.coordinates.zero if seated is None else seated.frame


# ---- frames and tool


def stand(channel: SinumerikChannel, total: NcFrame, *, travelled: bool = False) -> None:
    """The transformation that acts takes its seat between frames and tool; without one the axes are free.

    Args:
        channel: The channel.
        total: The frames in front.
        travelled: The next incremental word of an axis travels a change of frames or tool as well; under a
            transformation none does (6.10).
    """
    coupled = bool(links.Couplings.of(channel).links)
    before = links.places(channel) if coupled else []
    _take_seat(channel, total, travelled=travelled)
    if coupled and links.keep_ways(channel, before):
        _take_seat(channel, total, travelled=travelled)


def _take_seat(channel: SinumerikChannel, total: NcFrame, *, travelled: bool) -> None:
    coordinates, state = channel.coordinates, Transformations.of(channel)
    if state.build is None and state.columns is not None:
        _stand_regrouped(channel, state.columns, total, travelled=travelled)
        return
    if state.build is None:
        if coordinates.transformation is not None:
            coordinates.geometry = data_sets.native(channel)
        zero = (total.frame, _offsets(channel, total))
        coupled = links.take_seat(channel, links.seated(channel, *zero))
        if coupled is not None:
            if coupled is not coordinates.transformation:
                state.seated = None
                _sit(channel, coupled)
                _name_axes(channel, frozenset())
            return
        if coordinates.transformation is not None:
            state.seated = None
            coordinates.transform(None, data_sets.native(channel), zero)
            _name_axes(channel, frozenset())
        elif zero != (coordinates.zero, coordinates.offsets):
            coordinates.set_zero(*zero, travelled=travelled)
        else:
            return
        channel.context_changed()
        return
    seated = _seated(channel, state.build, total)
    build = _on_its_side(channel, state.build, seated)
    if build is not state.build:
        state.build, seated = build, _seated(channel, build, total)
    links.take_seat(channel, seated)
    if seated == state.seated:
        return
    state.seated = seated
    _sit(channel, seated)
    _name_axes(channel, state.build.used)


def _on_its_side(channel: SinumerikChannel, build: Build, seated: Seated) -> Build:
    """TRANSMIT on the side of the centre where the tip is that a tool brings there; in the centre C stands.

    Raises:
        AlarmError: PC0001 where MD24911 or MD24951 keeps it on the other side: no motion leads there.
    """
    first, *others = build.inner.links if isinstance(build.inner, Chain) else (build.inner,)
    if not isinstance(first, PolarPlane):
        return build
    axes = seated.behind(channel.coordinates.machine)
    for link in reversed(others):
        axes = link.to_work(axes)
    away = axes[first.linear] * first.side
    if abs(away) < CLOSEST_MM:
        plane = replace(first, pole_deg=axes[first.rotary])
    elif away < 0.0:
        if not build.changes_sides:
            raise not_supported(f"$MC_TRANSMIT_POLE_SIDE_FIX_{build.order}")
        plane = replace(first, side=-first.side)
    else:
        return build
    return replace(build, inner=Chain((plane, *others)) if others else plane)


def _sit(channel: SinumerikChannel, seated: Seated) -> None:
    """A transformation acts, with frames and tool in it; nothing is owed to incremental words."""
    coordinates = channel.coordinates
    coordinates.transform(seated, seated.geometry, (IDENTITY, [0.0] * len(channel.axes)))
    coordinates.pending = [0.0] * len(channel.axes)
    coordinates.owes = False
    aside = _aside(seated.inner)
    if aside >= 0 and coordinates.position[aside]:
        position = coordinates.position.copy()
        position[aside] = 0.0
        coordinates.arrive(position)
    channel.context_changed()


def _aside(inner: Any) -> int:
    """Column that says where a real Y axis stands beside the one of TRANSMIT or TRACYL; -1 without one.

    The next block brings it to where the transformation and the tool need it.
    """
    first = inner.links[0] if isinstance(inner, Chain) else inner
    if isinstance(first, PolarPlane) and first.virtual >= 0:
        return first.rotary
    return first.axis if isinstance(first, Cylinder) and first.virtual >= 0 else -1


def _stand_regrouped(
    channel: SinumerikChannel, columns: Geometry, total: NcFrame, *, travelled: bool
) -> None:
    """Frames and tool act on the geometry axes of GEOAX."""
    coordinates, state = channel.coordinates, Transformations.of(channel)
    seated = _regrouped(channel, columns, total)
    links.take_seat(channel, seated)
    if seated == state.seated:
        return
    state.seated = seated
    before = coordinates.position
    coordinates.transform(seated, columns, (IDENTITY, [0.0] * len(channel.axes)))
    if travelled:
        ways = zip(coordinates.pending, before, coordinates.position, strict=True)
        coordinates.pending = [owed + old - new for owed, old, new in ways]
        coordinates.owes = any(coordinates.pending)
    _name_axes(channel, frozenset())
    channel.context_changed()


def _regrouped(channel: SinumerikChannel, columns: Geometry, total: NcFrame) -> Seated:
    offsets = _offsets(channel, total, columns)
    frame = IDENTITY if total.frame.is_identity else total.frame
    made = Seated(ParallelAxes(columns), frame, (), tuple(offsets) if any(offsets) else ())
    return links.beside(channel, made)


def is_in_place(channel: SinumerikChannel, total: NcFrame) -> bool:
    """Whether frames and the active tool would change nothing."""
    state, coordinates = Transformations.of(channel), channel.coordinates
    if state.build is not None:
        return _seated(channel, state.build, total) == state.seated
    if state.columns is not None:
        return _regrouped(channel, state.columns, total) == state.seated
    coupled = links.seated(channel, total.frame, _offsets(channel, total))
    if coupled is not None:
        return coupled == links.Couplings.of(channel).seated
    return (total.frame, _offsets(channel, total)) == (coordinates.zero, coordinates.offsets)


def _offsets(channel: SinumerikChannel, total: NcFrame, geometry: Geometry | None = None) -> list[float]:
    offsets = _shifts(channel, total)
    for column, length in zip(
        geometry or channel.coordinates.geometry, channel.memory.tools.lengths, strict=True
    ):
        if column >= 0:
            offsets[column] += length
    return offsets


def _shifts(channel: SinumerikChannel, total: NcFrame) -> list[float]:
    """Shifts of the axes beside the geometry by the frames."""
    shifts = [0.0] * len(channel.axes)
    for axis, part in total.others.items():
        if part.factor != 1.0:
            raise not_supported(f"SCALE, MIRROR {axis}")
        if axis in channel.memory.columns or axis in channel.memory.machine_columns:
            shifts[channel.memory.column(axis)] += part.coarse + part.fine
    return shifts


def _seated(channel: SinumerikChannel, build: Build, total: NcFrame) -> Seated:
    tools = channel.memory.tools
    x, y, z = lengths = minus(tools.lengths, tools.apart)
    inner, shifts, offsets = build.inner, _shifts(channel, total), [0.0] * len(channel.axes)
    # Under all but orientation transformations the basic system takes the place of the machine's (Function Manual W1).
    on_axes = build.lengths == "tip" and tools.rules is not None and tools.rules.system == OF_MACHINE
    in_front, behind = (_NONE, tools.apart) if on_axes else (tools.apart, _NONE)
    if build.lengths == "tip":
        own = tools.own_direction(channel.mode["plane"]) if build.follows_tool else None
        inner = _with_tip(
            inner, (-x, -y, -z), None if own is None else (tools.carrier or IDENTITY).direct(*own)
        )
    elif build.lengths == "before":
        in_front = plus(in_front, lengths)
    else:
        behind = lengths
    in_front, behind = plus(in_front, build.in_front), plus(behind, build.behind)
    for column, length in zip(inner.geometry, in_front, strict=True):
        if column >= 0:
            shifts[column] += length
    _add_to_axes(channel, inner, offsets, behind)
    frame = total.frame
    made = Seated(
        inner,
        IDENTITY if frame.is_identity else frame,
        tuple(shifts) if any(shifts) else (),
        tuple(offsets) if any(offsets) else (),
    )
    return links.beside(channel, made)


def _add_to_axes(channel: SinumerikChannel, inner: Any, offsets: list[float], lengths: Vector) -> None:
    """Lengths along the axes of the machine: a virtual Y axis has none of them (PC0001)."""
    if not any(lengths):
        return
    infeed, second, third = data_sets.native(channel)
    if lengths[1] and second < 0:
        raise not_supported(f"{Transformations.of(channel).kind}: $TC_DP")
    columns = (inner.geometry[0] if infeed < 0 else infeed, second, third)
    for column, length in zip(columns, lengths, strict=True):
        if column >= 0:
            offsets[column] += length
    if isinstance(inner, Chain) and not isinstance(inner.links[0], ToolCentrePoint):
        for link in inner.links[1:]:  # the tool belongs to the first link (6.12)
            offsets[:] = link.to_machine(offsets)


def _with_tip(inner: Any, tip: Vector, along: Vector | None) -> Any:
    """The transformation with another tool; of a chain it is the first link that has the tool.

    `along` is the direction of the tool, None where it has none of its own.
    """
    if isinstance(inner, Chain):
        first, *others = inner.links
        return Chain((_with_tip(first, tip, along), *others))
    kinematics = inner.kinematics if along is None else replace(inner.kinematics, along=along)
    return replace(inner, tip=tip, kinematics=kinematics)


# ---- names


def _name_axes(channel: SinumerikChannel, used: frozenset[int]) -> None:
    """Which column a word of an axis means, and what kind of axis it is."""
    memory, geometry = channel.memory, channel.coordinates.geometry
    acts = Transformations.of(channel).build is not None
    if not acts:
        memory.own_columns = axis_names.columns(channel)
    names = {name: column for name, column in axis_names.columns(channel).items() if column not in used}
    lettered = zip(GEOMETRY_AXES, geometry, strict=True)
    memory.columns = {**names, **{letter: column for letter, column in lettered if column >= 0}}
    memory.axes = tuple(
        replace(axis, rotary=False, modulo=False, limit_minus=-inf, limit_plus=inf)
        if acts and axis.rotary and column in geometry
        else axis
        for column, axis in enumerate(channel.axis_data)
    )


def shown_names(channel: SinumerikChannel) -> tuple[str, ...]:
    """What the work display calls the columns; empty where the channel's names hold.

    Geometry axes have the names X, Y and Z, and go by them where no axis of the channel is called so.
    """
    build = Transformations.of(channel).build
    if build is None:
        return _geometry_names(channel)
    if not build.used:
        return ()
    names = ["" if column in build.used else name for column, name in enumerate(channel.axes)]
    for letter, column in zip(GEOMETRY_AXES, build.inner.geometry, strict=True):
        if column >= 0:
            names[column] = letter
    return tuple(names)


def _geometry_names(channel: SinumerikChannel) -> tuple[str, ...]:
    named = {
        column: letter for letter, column in zip(GEOMETRY_AXES, channel.coordinates.geometry, strict=True)
    }
    names = [
        named[column] if column in named and named[column] not in channel.axes else name
        for column, name in enumerate(channel.axes)
    ]
    return tuple(names) if names != list(channel.axes) else ()


def transformed(channel: SinumerikChannel) -> frozenset[int]:
    """Columns of the axes that take part in the transformation."""
    build = Transformations.of(channel).build
    if build is None:
        return frozenset()
    found = {column for column in (*build.inner.geometry, *data_sets.native(channel)) if column >= 0}
    point = centre_point(channel)
    if point is not None:
        found |= {point.axes.index(axis) for axis in point.kinematics.axes}
    return frozenset(found | build.used)


def wall_column(channel: SinumerikChannel) -> int:
    """Column by which a linear axis is led square to the walls of a groove; -1 where none is."""
    build = Transformations.of(channel).build
    return -1 if build is None else build.walls


def refuse_transformed(channel: SinumerikChannel, columns: Iterable[int], code: str) -> None:
    """The alarm for axes that take part in the transformation that acts (6.10)."""
    for column in columns:
        if column in transformed(channel):
            raise AlarmError(code, axis=channel.axes[column])


def check_positioning(channel: SinumerikChannel, name: str, column: int, *, by_axes: bool) -> None:
    """17610 for a positioning axis that the transformation uses up; of point to point travel for any of its axes.

    The axes that it makes may be positioned: X of an inclined axis (6.8.3, example); but not the one round the
    cylinder, nor the one for groove walls, of TRACYL (6.8.2).
    """
    build = Transformations.of(channel).build
    if build is None:
        return
    if column in build.bound:
        raise AlarmError("17610", axis=name)
    is_made = name in channel.memory.columns
    if (column in build.used and not is_made) or (by_axes and column in transformed(channel)):
        raise AlarmError("17610", axis=channel.axes[column])


def check_spindle(channel: SinumerikChannel, number: int) -> None:
    """17610 for a spindle that turns or is positioned while TRANSMIT or TRACYL uses it up as their rotary axis."""
    build, spindle = Transformations.of(channel).build, channel.machine.spindle.get(number)
    if build is None or spindle is None or not spindle.axis:
        return
    if any(channel.axis_data[column].name == spindle.axis for column in build.used):
        raise AlarmError("17610", axis=spindle.axis)


def check_named(channel: SinumerikChannel, address: str) -> None:
    """Alarms for a word that no axis takes: 17610 for one that the transformation uses up, 12050 for a virtual one."""
    build = Transformations.of(channel).build
    used = axis_names.columns(channel).get(address)
    if build is not None and used in build.used:
        raise AlarmError("17610", axis=address)
    if address in channel.machine.channel(channel.number).virtual or (
        address in GEOMETRY_AXES and address not in channel.memory.columns
    ):
        raise AlarmError("12050", axis=address)
