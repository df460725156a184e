"""Coordinate systems of SYNTEC: G22, G30, G50 to G52, G54 to G59.9, G68, G92.1, G04, G10 (2.8 to 2.63)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec.axis_groups.names import map_virtual_axis
from polycnc.control.syntec.coordinates.turns import (
    TurnState,
    renew_preset_frame,
    renew_work_turn,
    turn_preset_frame,
)
from polycnc.control.syntec.motion import conditions
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.coordinates import frames as base_frames
from polycnc.control.word_address.coordinates import systems as base_systems
from polycnc.control.word_address.coordinates.systems import (
    ZeroState,
    go_to_reference,
    refresh_zero,
    shift_of_zero,
)
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import about, scaling
from polycnc.geometry.planes import PLANES
from polycnc.language.syntec.values import to_long

with loaded_when_called():
    from polycnc.control.syntec.five_axes import spatial
    from polycnc.control.syntec.macros import registers
    from polycnc.control.syntec.motion import polar
    from polycnc.control.word_address.tools import data_input
    from polycnc.control.word_address.tools import length as tool_length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.geometry.frames import Vector

#: Names of the work coordinate systems G54 P1 … P100 in the memory of offsets.
WORK_SYSTEMS = (
    *(f"G{number}" for number in range(54, 60)),
    *(f"G59.{number}" for number in range(1, 10)),
    *(f"G54 P{number}" for number in range(16, 101)),
)
REFERENCE_POINTS = (1, 2, 3, 4)
#: Axes that G28, G29 and G30 move.
REFERABLE_AXES = frozenset({*"XYZUVWABC", "X1", "Y1", "Z1", "X2", "Y2", "Z2"})
WORK_OFFSET, SPATIAL_CORNERS, VIRTUAL_AXIS, REGISTER_INPUT, POLAR_PAIR = 2, 450, 801, 1000, 1301
LAST_REGISTER = 65535


@dataclass(slots=True)
class ScaleState(State, lifetime=Lifetime.RESET):
    """Factors of the active G51."""

    factors: Vector = (1.0, 1.0, 1.0)


# ---- work systems ----------------------------------------------------------------------------------------


def select_work_system(channel: SyntecChannel, words: Words) -> None:
    """G54 to G59, G59.1 to G59.9, G54 P1 to P100 (2.38); Pr3229 = 1 switches work systems off."""
    state = ZeroState.of(channel)
    code = channel.mode["wcs"]
    number = words.typed("P") if "P" in words else None
    memory = channel.memory
    if number is None:
        state.system = code
    elif number != int(number) or not 1 <= number <= len(WORK_SYSTEMS):
        raise words.fail("number", "P")
    else:
        state.system = WORK_SYSTEMS[int(number) - 1]
    if memory.parameters.without_work_systems == 1:
        state.system = NO_WORK_SYSTEM
    renew_work_turn(channel)
    refresh_zero(channel)


#: Name of the work system without offsets that holds while Pr3229 = 1.
NO_WORK_SYSTEM = "G53"


def set_position(channel: SyntecChannel, words: Words) -> None:
    """G92 X Y Z: the present position gets these coordinates; G92 S: highest speed under G96 (2.63, 2.66)."""
    axes = words.axes()
    memory = channel.memory
    if axes:
        way, position = [0.0] * len(channel.axes), channel.coordinates.position
        for axis, value, _ in axes:
            way[axis] = position[axis] - value
        _shift_preset(channel, shift_of_zero(channel, way, "G92"))
        refresh_zero(channel)
    limit = words.typed("S")
    if limit is not None:
        memory.spindle.limit_rpm = limit
        channel.context_changed()


def preset_system(channel: SyntecChannel, words: Words) -> None:
    """G92.1 X Y Z I J K R: this point becomes the origin, the axes turn by R about (I, J, K) (2.62)."""
    angle = words.angle("R") or 0.0
    if angle and any(data.rotary for data in channel.axis_data[:3]):
        raise words.fail("preset_rotary", "R")
    origin = [0.0] * len(channel.axes)
    for axis, value, _ in words.axes():
        origin[axis] = value
    shift = shift_of_zero(channel, origin, "G92.1")
    vector = [words.part(letter) or 0.0 for letter in "IJK"]
    turn_preset_frame(channel, angle, vector if any(vector) else [0.0, 0.0, 1.0], "G92.1")
    _shift_preset(channel, shift)
    refresh_zero(channel)


def _shift_preset(channel: SyntecChannel, shift: list[float]) -> None:
    """The zero of every work system goes further by this."""
    state = ZeroState.of(channel)
    state.preset[:] = [before + further for before, further in zip(state.preset, shift, strict=True)]


def forget_preset_turn(memory: SyntecMemory) -> None:
    """The turn of G92.1 is the default again: #1930 is 0, #1931 to #1933 the Z axis."""
    state = TurnState.of(memory.channel)
    state.angle, state.axis = 0.0, [0.0, 0.0, 1.0]
    renew_preset_frame(memory)


# ---- reference points, stroke limits ---------------------------------------------------------------------


def _referable(channel: SyntecChannel, words: Words) -> Words | None:
    """The words of G28, G29 and G30 without axes that these codes do not move (2.19.4); None where no axis is left."""
    named = words.plan.axis_words
    others = [word.address for word in named if channel.axes[word.axis] not in REFERABLE_AXES]
    if not others:
        return words
    return Words(words.plan.without(others), words.values) if len(others) < len(named) else None


def return_to_reference(channel: SyntecChannel, words: Words) -> None:
    """G28: over the intermediate point to the first reference point (2.19)."""
    if (own := _referable(channel, words)) is not None:
        go_to_reference(channel, own, 1)


def return_from_reference(channel: SyntecChannel, words: Words) -> None:
    """G29: over the intermediate point of the last G28 or G30 to the target (2.20)."""
    if (own := _referable(channel, words)) is not None:
        base_systems.return_from_reference(channel, own)


def return_to_further_reference(channel: SyntecChannel, words: Words) -> None:
    """G30 [P]: over the intermediate point to reference point 1 to 4, 2 without P (2.21)."""
    number = words.typed("P")
    number = 2 if number is None else number
    if number not in REFERENCE_POINTS:
        raise words.fail("number", "P")
    if (own := _referable(channel, words)) is not None:
        go_to_reference(channel, own, int(number))


def limits_in(channel: SyntecChannel, travel: Sequence[int]) -> dict[int, tuple[float, float]]:
    """Minus and plus limit of axes by column, from pairs of a plus and a minus limit; none where plus is not above."""
    unit = least_unit(channel.memory.parameters)
    pairs = ((travel[2 * i + 1] * unit, travel[2 * i] * unit) for i in range(len(channel.axes)))
    return {i: (low, high) for i, (low, high) in enumerate(pairs) if high > low}


def stroke_limit_on(channel: SyntecChannel, words: Words) -> None:
    """G22 X Y Z I J K: second travel limits, X Y Z with I J K in pairs, the others from Pr2501 on (2.18)."""
    memory = channel.memory
    beside = next((w for w in words.plan.axis_words if w.axis not in channel.coordinates.geometry), None)
    if beside is not None:
        raise words.fail("stroke_pair", beside.address)
    given = {axis: value for axis, value, _ in words.axes()}
    zones = limits_in(channel, memory.parameters.second_travel)
    for letter, axis in zip("IJK", channel.coordinates.geometry, strict=True):
        other = words.length(letter)
        if (other is None) != (axis not in given):
            raise words.fail("stroke_pair", letter if other is not None else "")
        if other is None:
            continue
        low, high = sorted((other, given[axis]))
        zones.pop(axis, None)
        if low != high:
            zones[axis] = (low, high)
    set_zone(channel, zones)


def set_zone(channel: SyntecChannel, zones: dict[int, tuple[float, float]]) -> None:
    """The protected range of each axis; Pr2542 says whether its inside or its outside is forbidden."""
    if not zones:
        channel.boundary = None
        return
    axes = tuple(sorted(zones))
    inside = channel.memory.parameters.travel_2_inside == 1
    lows, highs = tuple(zones[a][0] for a in axes), tuple(zones[a][1] for a in axes)
    from polycnc.control.word_address.coordinates.stroke_check import StrokeZone

    channel.boundary = StrokeZone(lows, highs, axes, inside)


# ---- programming frames ----------------------------------------------------------------------------------


def scale_factors(channel: SyntecChannel, words: Words) -> tuple[float, float, float]:
    """Factors of G51: P for all axes or I J K; only axes of the plane are scaled (2.33)."""
    common = words.typed("P")
    if common is not None:
        data_input.refuse_words(words, "IJK", "argument")
    factors = [1.0, 1.0, 1.0]
    for axis in PLANES[channel.mode["plane"]][:2]:
        own = words.typed("IJK"[axis])
        value = common if common is not None else own
        factors[axis] = 1.0 if value is None else float(value)
        if factors[axis] == 0.0:
            raise words.fail("argument", "P" if common is not None else "IJK"[axis])
    result = (factors[0], factors[1], factors[2])
    ScaleState.of(channel).factors = result
    return result


def mirror(channel: SyntecChannel, words: Words) -> None:
    """G51.1 X Y Z: mirror about these coordinates, which under G91 count from the position (2.32)."""
    frames, c = channel.memory.frames, channel.coordinates
    for axis, value, incremental in words.axes():
        if axis not in c.geometry:
            raise words.fail("argument", channel.axes[axis])
        frames.mirrored[c.geometry.index(axis)] = c.programmed[axis] + value if incremental else value
    center: Vector = (frames.mirrored.get(0, 0.0), frames.mirrored.get(1, 0.0), frames.mirrored.get(2, 0.0))
    factors = [-1.0 if i in frames.mirrored else 1.0 for i in range(3)]
    frames.mirror = about(center, scaling(*factors))
    c.set_programming(frames.product())


def rotate(channel: SyntecChannel, words: Words) -> None:
    """G68 X Y R: turns the plane about a point in absolute coordinates; a new one replaces the old (2.43)."""
    frames, c = channel.memory.frames, channel.coordinates
    angle = words.angle("R")
    if angle is None:
        raise words.fail("argument", "G68")
    base_frames.end_rotation(channel, words)
    u, v, _ = PLANES[channel.mode["plane"]]
    point = [c.programmed[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    named = words.axes()
    for axis, value, _ in named:
        for i in (u, v):
            if c.geometry[i] == axis:
                point[i] = value
    if named and not any(axis in (c.geometry[u], c.geometry[v]) for axis, _, _ in named):
        return  # a centre beside the plane: the rotation does not act (2.43.3)
    frames.rotation = base_frames.rotation_frame(channel, point, angle)
    c.set_programming(frames.product())


# ---- dwell, data input, cutting modes --------------------------------------------------------------------


def input_data(channel: SyntecChannel, words: Words) -> None:
    """G10 L2 work offsets, L10 to L13 tool data (2.14), L450, L801, L1000, L1301; G91 adds to offsets."""
    kind, number = words.typed("L"), words.typed("P")
    if kind == REGISTER_INPUT:
        value = words.typed("R")
        if number is None or value is None or number != int(number):
            raise words.fail("argument", "G10")
        if not 0 <= number <= LAST_REGISTER:
            raise words.fail("argument", "P")
        registers.write_register(channel, int(number), to_long(value))
        return
    if kind == WORK_OFFSET:
        _input_work_offset(channel, words)
        return
    if kind == SPATIAL_CORNERS:
        spatial.choose_corners(channel, words)
        return
    if kind == POLAR_PAIR:
        polar.switch_polar(channel, words)
        return
    if kind == VIRTUAL_AXIS:
        map_virtual_axis(channel, words)
        return
    from polycnc.control.word_address.tools.data_input import TOOL_FIELDS

    if kind not in TOOL_FIELDS or kind == 1:
        raise channel.control.not_yet("G10" if kind is None else f"G10 L{kind:g}", "G10")
    data_input.refuse_words(words, "QIJK", "argument")
    data_input.refuse_axes(words, "argument")
    length = words.length("R")
    if number is None or number != int(number) or number < 1 or length is None:
        raise words.fail("argument", "P" if length is not None else "R")
    tool = channel.memory.offset_number(int(number))
    field = TOOL_FIELDS[int(kind)]
    if channel.mode["distance"] == "G91":
        length += getattr(tool, field)
    setattr(tool, field, length)
    tool_length.renew_length(channel)


def _input_work_offset(channel: SyntecChannel, words: Words) -> None:
    """G10 L2 P X Y Z: zero of work system P, 0 the external one; G91 adds."""
    data_input.refuse_words(words, "RQIJK", "argument")
    number = words.typed("P")
    if number is None or number != int(number) or not 0 <= number <= len(WORK_SYSTEMS):
        raise words.fail("argument", "P" if number is not None else "G10")
    offset = channel.memory.work_offset(WORK_SYSTEMS[int(number) - 1] if number else EXTERNAL)
    for axis, value, incremental in words.axes():
        offset[axis] = offset[axis] + value if incremental else value
    refresh_zero(channel)


def cutting_mode(channel: SyntecChannel, words: Words) -> None:
    """G61 to G64 [P]: P of G62 and G64 selects a set of machining conditions (2.40)."""
    condition = words.typed("P") if "P" in words else None
    if condition is None:
        channel.context_changed()
    elif condition not in conditions.KNOWN:
        raise words.fail("condition_set", "P")
    else:
        conditions.choose(channel, int(condition))
