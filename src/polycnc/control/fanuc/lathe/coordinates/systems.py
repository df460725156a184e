"""Coordinate systems of the lathe: G50 setting and clamp, preset, G53, feed unit, planes with parallel axes."""

from __future__ import annotations

from functools import wraps
from math import copysign, nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.lathe.cycles.modal import SingleCycleState
from polycnc.control.fanuc.lathe.tools.offsets import refresh
from polycnc.control.word_address.block import repeated_codes
from polycnc.control.word_address.coordinates import systems
from polycnc.control.word_address.coordinates.frames import RotationState, rotation_frame
from polycnc.control.word_address.coordinates.systems import ZeroState
from polycnc.control.word_address.tools.radius import RadiusState, active_compensation, suspended
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, TypeVar
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.fanuc.lathe.motion import corners
    from polycnc.control.word_address.motion import planes

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Frame

T = TypeVar("T")


@dataclass(slots=True)
class CodeState(State, lifetime=Lifetime.POWER):
    """The codes G98 or G99 and G17 to G19 that were given last, before the one that runs."""

    feed: str = ""
    plane: str = ""


def note_codes(channel: LatheChannel) -> None:
    """The codes of power-on count as given."""
    state = CodeState.of(channel)
    state.feed, state.plane = channel.mode["feed"], channel.mode["plane"]


def set_position(channel: LatheChannel, words: Words) -> None:
    """G50 (B, C: G92, absolute even under G91): the present point reads these coordinates; U, W change the reading.

    S clamps the speed of G96. The point is the one before the tool offset that moves it (II.5.1.2), so a T in the
    block moves nothing.
    """
    state = ZeroState.of(channel)
    limit = words.typed("S")
    if limit is not None:
        channel.memory.spindle.limit_rpm = limit
        channel.context_changed()
    named = words.axes()
    if not named:
        return
    _refuse_rotation(channel, words, "G50")
    c = channel.coordinates
    drop_vector(channel)
    point = c.programmed[:]
    by_address = channel.control.system(channel) == "A"
    for axis, value, incremental in named:
        point[axis] = point[axis] + value if incremental and by_address else value
        state.local[axis] = 0.0
    refresh(channel)
    wanted, way = c.to_position(point), [0.0] * len(channel.axes)
    for axis, _, _ in named:
        way[axis] = c.position[axis] - wanted[axis]
    for axis, part in enumerate(systems.shift_of_zero(channel, way, "G50")):
        state.preset[axis] += part
    refresh(channel)


def set_local_system(channel: LatheChannel, words: Words) -> None:
    """G52: zero of a local system within each of G54 to G59; an increment moves it."""
    _refuse_rotation(channel, words, "G52")
    local = ZeroState.of(channel).local
    drop_vector(channel)
    for axis, value, incremental in words.axes():
        local[axis] = local[axis] + value if incremental else value
    refresh(channel)


def preset_system(channel: LatheChannel, words: Words) -> None:
    """G50.3 (B, C: G92.1): G50 and G52 of the named axes vanish, and offsets that move the point (1205#7)."""
    state = ZeroState.of(channel)
    _refuse_rotation(channel, words, "G50.3")
    memory = channel.memory
    for axis, value, _ in words.axes():
        if value != 0.0:
            raise words.fail("preset_value", words.plan.axis_words[0].address)
        state.preset[axis] = state.local[axis] = 0.0
        if not memory.parameters.WTC:
            memory.frames.offset[axis] = 0.0
    refresh(channel)
    channel.coordinates.set_programming(memory.frames.product(), memory.frames.shift)


def move_in_machine_system(channel: LatheChannel, words: Words) -> None:
    """G53: rapid to machine coordinates whatever the modal code; an increment is ignored by the control."""
    _move_in_machine_system(channel, words, rapid=True)


def feed_in_machine_system(channel: LatheChannel, words: Words) -> None:
    """G53.2: as G53, at the feed of G01; rapid under G00."""
    _move_in_machine_system(channel, words, rapid=channel.mode["motion"] == "G0")


def _move_in_machine_system(channel: LatheChannel, words: Words, *, rapid: bool) -> None:
    if not rapid and not channel.feed > 0.0:
        raise words.fail("no_feed", "G53.2")
    c = channel.coordinates
    machine = c.machine
    for axis, value, incremental in words.axes():
        if not incremental:
            machine[axis] = value
    with suspended(channel, [axis for axis, _, incremental in words.axes() if not incremental]):
        channel.straight(
            Kind.RAPID if rapid else Kind.FEED, c.from_machine(machine), nan if rapid else channel.feed
        )
    _owe_offset(channel, [axis for axis, _, incremental in words.axes() if not incremental])


def _owe_offset(channel: LatheChannel, axes: list[int]) -> None:
    """At a machine position an offset that moves the point is suspended; the axis' next move has it again (5.1.5)."""
    c, offset = channel.coordinates, channel.memory.frames.offset
    for axis in axes:
        c.pending[axis] = offset[axis]
    c.owes = any(c.pending)


def return_to_reference(channel: LatheChannel, words: Words) -> None:
    """G28: over the intermediate point to the first reference point."""
    _refuse_rotation(channel, words, "G28")
    systems.return_to_reference(channel, words)
    _owe_offset(channel, [axis for axis, _, _ in words.axes()])


def return_to_further_reference(channel: LatheChannel, words: Words) -> None:
    """G30 [P2 … P4]: over the intermediate point to another reference point."""
    _refuse_rotation(channel, words, "G30")
    systems.return_to_further_reference(channel, words)
    _owe_offset(channel, [axis for axis, _, _ in words.axes()])


def check_reference(channel: LatheChannel, words: Words) -> None:
    """G27: rapid to the point, which must be the reference point of the named axes."""
    _refuse_rotation(channel, words, "G27")
    systems.check_reference(channel, words)


def return_from_reference(channel: LatheChannel, words: Words) -> None:
    """G29: over the intermediate point of the last reference return to a point."""
    _refuse_rotation(channel, words, "G29")
    systems.return_from_reference(channel, words)


def _refuse_rotation(channel: LatheChannel, words: Words, code: str) -> None:
    frames = channel.memory.frames
    if frames.rotates or frames.conversions:
        raise words.fail("in_rotation", code)


def drop_vector(channel: LatheChannel) -> None:
    """A command for which the tool goes to the uncompensated point and back (II.5.4.3)."""
    stage = active_compensation(channel)
    if stage is not None:
        stage.drop_vector()


def keep_feed_number(channel: LatheChannel, words: Words) -> None:
    """G98, G99: the number of F stays as it is when its unit changes."""
    state = CodeState.of(channel)
    code = channel.mode["feed"]
    before, state.feed = state.feed or code, code
    if "F" not in words and before != code:
        channel.feed = channel.feed * 60.0 if code == "G99" else channel.feed / 60.0
    channel.context_changed()


def _feed_is_in_force(channel: LatheChannel) -> bool:
    """G98, G99: F has been typed under this code."""
    return CodeState.of(channel).feed == channel.mode["feed"]


def _plane_is_in_force(channel: LatheChannel) -> bool:
    """G17 to G19: as on every control; no corner waits for its next block, and no single cycle has words."""
    same_plane = CodeState.of(channel).plane == channel.mode["plane"]
    unchanged = same_plane and not SingleCycleState.of(channel).has_words
    return channel.path.head is None and unchanged and repeated_codes.plane(channel)


def _length_is_in_force(channel: LatheChannel) -> bool:
    """G49: the lathe has no offsets by code (5040#3)."""
    return not channel.memory.parameters.TCT


#: Codes that change nothing where they are in force already; see `word_address/block/repeated_codes.py`.
REPEATED = {
    **dict.fromkeys(("G17", "G18", "G19"), _plane_is_in_force),
    **dict.fromkeys(("G54", "G55", "G56", "G57", "G58", "G59"), repeated_codes.work_offset),
    **dict.fromkeys(("G98", "G99"), _feed_is_in_force),
    "G49": _length_is_in_force,
    "G67": repeated_codes.modal_call,
    "G69.1": repeated_codes.frame,
}


def feed_number(channel: LatheChannel) -> float:
    """F as the number that was typed, mm: the lead of a thread, whatever the feed unit."""
    return channel.feed * (60.0 if channel.mode["feed"] == "G98" else 1.0)


def select_plane(channel: LatheChannel, words: Words) -> None:
    """G17 to G19: the plane; an axis word names a parallel axis (1022) in place of the basic one."""
    state, code = CodeState.of(channel), channel.mode["plane"]
    if RadiusState.of(channel).side and state.plane != code:
        raise words.fail("comp_plane", code)
    _refuse_corner(channel, words, code)
    SingleCycleState.of(channel).forget()  # also where the code changes nothing (II.4.1.6)
    state.plane = code
    planes.lay_axes(channel, words)


def _refuse_corner(channel: LatheChannel, words: Words, code: str) -> None:
    """A plane code behind a chamfer or corner R is an alarm, even if it names the same plane (II.4.7)."""
    if corners.corner_waits(channel):
        drawing = channel.memory.parameters.CRD
        raise words.fail("drawing_increment" if drawing else "corner_no_move", code)


def select_work_offset(channel: LatheChannel, words: Words) -> None:
    """G54 to G59, G54 P: the work coordinate system; no motion by itself."""
    _refuse_rotation(channel, words, channel.mode["wcs"])
    systems.select_work_offset(channel, words)


def rotate(channel: LatheChannel, words: Words) -> None:
    """G68.1 X Z R: rotation of the plane about a point, counter-clockwise; 5410 where R is missing."""
    state = RotationState.of(channel)
    memory, c = channel.memory, channel.coordinates
    parts = memory.frames
    if channel.mode["motion"] not in ("G0", "G1"):
        raise words.fail("rotation_form", "G68.1")
    center = c.programmed[:]
    plane = plane_axes(channel)
    for word in words.plan.axis_words:
        if word.axis not in plane:
            raise words.fail("rotation_form", word.address)
    for axis, value, _ in words.axes():
        center[axis] = value
    angle = words.angle("R")
    if angle is None:
        angle = memory.parameters.rotation_angle
    elif words.form("R") == "" and memory.parameters.FRD:
        # FRD: without a decimal point R counts 0.00001 degrees.
        angle /= 100.0
    if "R" in words and channel.control.rotation_adds(channel) and not parts.rotation.is_identity:
        angle += state.angle
    state.angle = angle
    parts.rotation = rotation_frame(channel, [center[i] if i >= 0 else 0.0 for i in c.geometry], angle)
    # 11600#5 AX1 = 0: an axis that the next block does not name keeps the value that it had before the rotation.
    c.set_programming(parts.product(), parts.shift, stays=memory.parameters.AX1)


def sense(channel: LatheChannel, axis: int) -> float:
    """-1 for an axis that a mirror turns round (G51.1, G68), else 1.

    What a cycle adds to a point along the axis lies on the other side then: tapers, allowances, escapes, strokes.
    """
    geometry, matrix = channel.coordinates.geometry, channel.coordinates.programming.m
    if axis not in geometry:
        return 1.0
    i = geometry.index(axis)
    return copysign(1.0, matrix[i][i])


def senses(channel: LatheChannel) -> tuple[float, float]:
    """Those of the first and second axis of the plane."""
    first, second = plane_axes(channel)
    return sense(channel, first), sense(channel, second)


def without_rotation(cycle: Callable[[LatheChannel, T], None]) -> Callable[[LatheChannel, T], None]:
    """A cycle, step or handler, in which coordinate rotation has no effect (II.5.9)."""

    @wraps(cycle)
    def run(channel: LatheChannel, words: T) -> None:
        before = set_rotation(channel, IDENTITY)
        try:
            cycle(channel, words)
        finally:
            set_rotation(channel, before)

    return run


def set_rotation(channel: LatheChannel, turned: Frame) -> Frame:
    """Rotate the coordinates from now on; the rotation before."""
    parts = channel.memory.frames
    before: Frame = parts.rotation
    if before is not turned:
        parts.rotation = turned
        channel.coordinates.set_programming(parts.product(), parts.shift)
    return before


def mirror_turret(channel: LatheChannel, words: Words) -> None:
    """G68: X of the opposite turret: mirrored, and shifted by the distance of the turrets (1290; II.4.8)."""
    _check_alone(words, "G68")
    memory = channel.memory
    axis = channel.coordinates.geometry[0]
    distance = memory.radius_of(axis, memory.parameters.turret_distance)
    memory.frames.set_turret(distance)
    channel.coordinates.set_programming(memory.frames.product(), memory.frames.shift)


def end_mirror_turret(channel: LatheChannel, words: Words) -> None:
    """G69."""
    _check_alone(words, "G69")
    memory = channel.memory
    memory.frames.set_turret(None)
    channel.coordinates.set_programming(memory.frames.product(), memory.frames.shift)


def _check_alone(words: Words, code: str) -> None:
    if words.axes():
        raise words.fail("turret_form", code)


def plane_axes(channel: LatheChannel) -> tuple[int, int]:
    """Channel axes that are the first and the second one of the active plane; -1 for one that is missing."""
    u, v, _ = PLANES[channel.mode["plane"]]
    geometry = channel.coordinates.geometry
    return geometry[u], geometry[v]
