"""Frames before the display: scaling G51, mirror G51.1, rotation G68, and polar words G16.

Order (FANUC; SYNTEC states none): programmed point → scaling or mirror → rotation → display. Each part is kept in the
control's memory; the programming frame is their product. So the centre of a rotation is scaled and mirrored with the
shape, its angle is not scaled, and a mirror of one axis of the plane turns its direction round.
"""

from __future__ import annotations

from math import hypot

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.motion.arcs import mirrors_plane
from polycnc.control.word_address.motion.path import reach
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, about, cos_sin_deg, rotation, scaling
from polycnc.geometry.planes import PLANES
from polycnc.language.bulk import Idle, declare

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Frame


@dataclass(slots=True)
class RotationState(State, lifetime=Lifetime.POWER):
    """The angle of the last rotation as programmed, degrees."""

    angle: float = 0.0


def _refresh(channel: WordAddressChannel, *, stays: bool = True) -> None:
    parts = channel.memory.frames
    channel.coordinates.set_programming(parts.product(), parts.shift, stays=stays)


def _point(channel: WordAddressChannel, words: Words, *, absolute: bool) -> list[float]:
    """The point that axis words name on the geometry axes; the present programmed position where they are missing.

    Args:
        channel: The channel.
        words: Words of the block.
        absolute: The words are coordinates under G91 too.
    """
    c = channel.coordinates
    base = channel.memory.frames
    here = c.image(base.product().inverse(), c.position) if base.product() is not IDENTITY else c.position
    point = [here[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    for word in words.plan.axis_words:
        if word.axis not in c.geometry:
            raise words.fail("address", word.address)
    for axis, value, incremental in words.axes():
        i = c.geometry.index(axis)
        point[i] = point[i] + value if incremental and not absolute else value
    return point


def rotate(channel: WordAddressChannel, words: Words) -> None:
    """G68 X Y R: rotation of the plane about a point, an absolute one under G91 too; a new one replaces the old."""
    parts, state = channel.memory.frames, RotationState.of(channel)
    angle = words.angle("R")
    if angle is None:
        angle = channel.control.rotation_without_angle(channel)
        if angle is None:
            raise words.fail("rotation_angle", "G68")
    elif channel.control.rotation_adds(channel) and not parts.rotation.is_identity:
        angle += state.angle
    state.angle = angle
    before = channel.coordinates.programmed[:]
    parts.rotation = IDENTITY
    _refresh(channel)
    parts.rotation = rotation_frame(channel, _point(channel, words, absolute=True), angle)
    if channel.control.keeps_point_at_rotation(channel):
        channel.coordinates.programmed[:] = before
        _refresh(channel, stays=False)
    else:
        _refresh(channel)


def rotation_frame(channel: WordAddressChannel, center: Sequence[float], angle: float) -> Frame:
    """The rotation of the plane by an angle, degrees, about a programmed point."""
    parts, plane = channel.memory.frames, PLANES[channel.mode["plane"]]
    inner = parts.mirror @ parts.scale
    x, y, z = center
    turned = rotation(plane[2], -angle if mirrors_plane(inner, plane) else angle)
    return about(inner.apply(x, y, z), turned)


def turns_plane(channel: WordAddressChannel) -> bool:
    """Whether the rotation that is active, if one is, turns the active plane in itself."""
    third = PLANES[channel.mode["plane"]][2]
    return bool(channel.memory.frames.rotation.m[third][third] == 1.0)


def _refuse_other_plane(builder: Builder, plan: Plan) -> Step | None:
    """Arcs, corner arcs and radius compensation are those of the plane that is rotated."""
    arc = builder.mode["motion"] in ("G2", "G3") and (plan.axis_words or any(map(builder.has, "IJK")))
    starts = any(row.code in ("G41", "G42") for row in builder.codes)
    if not (arc or starts or builder.has(",R")):
        return None
    control, plane = builder.control, builder.mode["plane"]

    def check(channel: WordAddressChannel, _values: list[float]) -> None:
        if not turns_plane(channel):
            raise control.fail("rotation_plane", address=plane)

    return declare(check, Idle(turns_plane))


def end_rotation(channel: WordAddressChannel, _words: Words) -> None:
    """G69 (on lathes G69.1): the rotation ends."""
    channel.memory.frames.rotation = IDENTITY
    _refresh(channel)


def scale(channel: WordAddressChannel, words: Words) -> None:
    """G51 X Y Z P or I J K: scaling about a point."""
    control, before = channel.control, channel.memory.frames.scale
    channel.memory.frames.scale = IDENTITY
    _refresh(channel)
    center = _point(channel, words, absolute=control.SCALE_CENTER_IS_ABSOLUTE)
    factors = list(control.scale_factors(channel, words))
    if control.SCALES_NAMED_AXES:
        _leave_unnamed(channel, words, before, center, factors)
    x, y, z = center
    channel.memory.frames.scale = about((x, y, z), scaling(*factors))
    _refresh(channel)


def _leave_unnamed(
    channel: WordAddressChannel, words: Words, before: Frame, center: list[float], factors: list[float]
) -> None:
    """Axes whose centre no G51 has named are not scaled; one that an earlier G51 has named keeps its centre."""
    c = channel.coordinates
    named = {c.geometry.index(axis) for axis, _, _ in words.axes() if axis in c.geometry}
    for i in {0, 1, 2} - named:
        own = before.m[i][i]
        if own == 1.0:
            factors[i] = 1.0
        else:
            center[i] = before.t[i] / (1.0 - own)


def end_scale(channel: WordAddressChannel, _words: Words | None = None) -> None:
    """G50: scaling ends."""
    channel.memory.frames.scale = IDENTITY
    _refresh(channel)


def mirror(channel: WordAddressChannel, words: Words) -> None:
    """G51.1: mirror about lines X = … , Y = …: p' = 2a - p."""
    frames = channel.memory.frames
    c = channel.coordinates
    for axis, value, _ in words.axes():
        if axis not in c.geometry:
            raise words.fail("address", words.plan.axis_words[0].address)
        frames.mirrored[c.geometry.index(axis)] = value
    _set_mirror(channel)


def end_mirror(channel: WordAddressChannel, words: Words) -> None:
    """G50.1: ends the mirror of the named axes, of all where none is named."""
    frames = channel.memory.frames
    named = [axis for axis, _, _ in words.axes()]
    for axis in named:
        if axis in channel.coordinates.geometry:
            frames.mirrored.pop(channel.coordinates.geometry.index(axis), None)
    if not named:
        frames.mirrored.clear()
    _set_mirror(channel)


def mirror_first_axis(channel: WordAddressChannel, _words: Words) -> None:
    """M70: the first axis is mirrored about the place where it stands."""
    _mirror_here(channel, 0)


def mirror_second_axis(channel: WordAddressChannel, _words: Words) -> None:
    """M71: the second axis is mirrored about the place where it stands."""
    _mirror_here(channel, 1)


def _mirror_here(channel: WordAddressChannel, i: int) -> None:
    c = channel.coordinates
    channel.memory.frames.mirrored.setdefault(i, c.programmed[c.geometry[i]])
    _set_mirror(channel)


def end_mirror_by_m(channel: WordAddressChannel, _words: Words) -> None:
    """M72: ends the mirror of the first and second axis."""
    for i in (0, 1):
        channel.memory.frames.mirrored.pop(i, None)
    _set_mirror(channel)


def _set_mirror(channel: WordAddressChannel) -> None:
    frames = channel.memory.frames
    x, y, z = (frames.mirrored.get(i, 0.0) for i in range(3))
    factors = [-1.0 if i in frames.mirrored else 1.0 for i in range(3)]
    frames.mirror = about((x, y, z), scaling(*factors)) if frames.mirrored else IDENTITY
    _refresh(channel)


@dataclass(slots=True)
class PolarCoordinateState(State, lifetime=Lifetime.POWER):
    """Polar coordinates (G16): pole and last radius, mm; last angle, degrees."""

    pole: tuple[float, float] = (0.0, 0.0)
    radius: float = 0.0
    angle: float = 0.0


def polar_target(channel: WordAddressChannel, plan: Plan, values: list[float]) -> list[float]:
    """End point of a block under G16: first plane axis radius, second angle (counter-clockwise from the first axis).

    Absolute: about the work zero. Incremental radius: about the present position. An incremental angle adds to the last
    one. A word that is missing keeps its last value.
    """
    polar, c = PolarCoordinateState.of(channel), channel.coordinates
    u, v, _ = PLANES[channel.mode["plane"]]
    first, second = c.geometry[u], c.geometry[v]
    plane_words = [word for word in plan.axis_words if word.axis in (first, second)]
    end = reach(channel, tuple(w for w in plan.axis_words if w not in plane_words), values)
    if not plane_words:
        return end
    for word in plane_words:
        value = word.convert(values[word.slot]) if word.convert else values[word.slot]
        if word.axis == first:
            polar.radius = value
            polar.pole = (c.programmed[first], c.programmed[second]) if word.incremental else (0.0, 0.0)
        else:
            angle = value
            polar.angle = polar.angle + angle if word.incremental else angle
    cosine, sine = cos_sin_deg(polar.angle)
    end[first] = polar.pole[0] + polar.radius * cosine
    end[second] = polar.pole[1] + polar.radius * sine
    return end


def start_polar(channel: WordAddressChannel, _words: Words) -> None:
    """G16: radius and angle begin at the present position."""
    polar, c = PolarCoordinateState.of(channel), channel.coordinates
    u, v, _ = PLANES[channel.mode["plane"]]
    polar.pole = (0.0, 0.0)
    polar.radius = hypot(c.programmed[c.geometry[u]], c.programmed[c.geometry[v]])
    polar.angle = 0.0


#: What a rotation asks of the blocks that its plane forms.
ROTATION_RULE = Rule("plane of a rotation", modes={"rotation": ("G68", "G68.1")}, before=_refuse_other_plane)


def scale_of(channel: WordAddressChannel, axis: int) -> float:
    """How many times longer than programmed the moves of an axis are (G51); offsets and pecks are not."""
    c = channel.coordinates
    if axis not in c.geometry:
        return 1.0
    i = c.geometry.index(axis)
    return hypot(*(row[i] for row in c.programming.m))


def level_of(channel: WordAddressChannel, axis: int, level: float, before: Frame) -> float:
    """What a level of an axis that counted in another frame is in the one that acts now: the place is the same.

    It stays the number it was where the zero alone has moved, and where a frame tilts the axis: no level is a place.
    """
    c = channel.coordinates
    if axis not in c.geometry or before.m == c.programming.m:
        return level
    i = c.geometry.index(axis)
    if any(frame.m[i][j] for frame in (before, c.programming) for j in range(3) if j != i):
        return level
    place = before.apply(*(level if j == i else 0.0 for j in range(3)))[i]
    return c.programming.inverse().apply(*(place if j == i else 0.0 for j in range(3)))[i]
