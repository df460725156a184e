"""Polar coordinate interpolation G12.1 / G13.1: a linear and a rotary axis become a Cartesian plane.

The contour is written as if the rotary axis were the second axis of the plane, in millimetres. Positions in the
toolpath are Cartesian; the linear axis follows by the distance from the rotation centre, the rotary one by the angle.
"""

from __future__ import annotations

from polycnc.control.word_address.block.numbers import length_converter
from polycnc.control.word_address.states import CylinderState, PolarState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from collections.abc import Collection

    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.transformation.kinematic.polar import PolarPlane

#: Modal group of G12.1 and G13.1.
GROUP = "polar_interpolation"
#: Where nothing is set, the rotary axis is the one of this name.
DELIVERED_ROTARY = "C"
#: The plane that a linear axis X, Y or Z begins: it decides which of I, J, K give the centre of an arc.
PLANE_OF_LINEAR = ("G17", "G19", "G18")
_CUTS = frozenset({"G1", "G2", "G3"})
#: G codes that every control allows.
ALLOWED = frozenset({
    "G1", "G2", "G3", "G4", "G9", "G13.1", "G40", "G41", "G42", "G65", "G66", "G66.1", "G67",
})  # fmt: skip


def start_polar(channel: MacroChannel, words: Words) -> None:
    """G12.1 (G112): the axes of 5460 and 5461 become a Cartesian plane; the tool stands at angle 0."""
    from polycnc.transformation.kinematic.polar import PolarPlane

    memory, c = channel.memory, channel.coordinates
    number = memory.parameters.polar_linear_axis
    linear = c.geometry[0] if number is None else number - 1
    number = memory.parameters.polar_rotary_axis
    rotary = channel.axis_index.get(DELIVERED_ROTARY, -1) if number is None else number - 1
    if (
        linear not in c.geometry
        or not 0 <= rotary < len(channel.axes)
        or not channel.axis_data[rotary].rotary
    ):
        raise words.fail("polar_axes", "G12.1")
    if RadiusState.of(channel).side or CylinderState.of(channel).active is not None or not c.zero.is_identity:
        raise words.fail("polar_code", "G12.1")
    if PolarState.of(channel).plane is not None:
        return
    channel.flush()
    here = c.position
    first = c.geometry.index(linear)
    plane = PLANE_OF_LINEAR[first]
    geometry = list(c.geometry)
    geometry[PLANES[plane][1]] = rotary
    side = -1.0 if here[linear] < 0.0 else 1.0
    polar = PolarPlane(
        linear,
        rotary,
        (geometry[0], geometry[1], geometry[2]),
        here[rotary],
        side=side,
        pole_deg=here[rotary],
    )
    enter_polar(channel, polar, plane, diameter=channel.control.is_diameter(channel, linear))


def enter_polar(channel: WordAddressChannel, polar: PolarPlane, plane: str, *, diameter: bool) -> None:
    """From here on the words name points of the plane, which is `plane` (G17 to G19); nothing moves.

    `diameter`: the machine display goes on to show diameters of the linear axis.
    """
    from polycnc.control.word_address.transformations.polar_stage import PolarStage  # where it acts only

    state = PolarState.of(channel)
    state.plane_before, state.geometry_before = channel.mode["plane"], channel.coordinates.geometry
    state.plane, state.diameter = polar, diameter
    channel.mode = channel.mode.with_code("plane", plane)
    channel.coordinates.transform(polar, polar.geometry)
    channel.context_changed()
    channel.path.put(PolarStage(channel))


def end_polar(channel: WordAddressChannel, words: Words) -> None:
    """G13.1 (G113): the axes are axes of their own again; the former plane returns."""
    if PolarState.of(channel).plane is None:
        return
    if RadiusState.of(channel).side:
        raise words.fail("polar_code", "G13.1")
    channel.flush()
    leave_polar(channel)


def leave_polar(channel: WordAddressChannel) -> None:
    """The axes are named themselves again (also at reset); nothing moves."""
    state = PolarState.of(channel)
    if state.plane is None:
        return
    state.plane = None
    channel.mode = channel.mode.with_code("plane", state.plane_before)
    channel.coordinates.transform(None, state.geometry_before)
    channel.context_changed()


def is_length(channel: WordAddressChannel, axis: int) -> bool:
    """Whether words of a rotary axis are lengths now."""
    plane = PolarState.of(channel).plane
    return plane is not None and axis == plane.rotary


def length_word(builder: Builder, axis: int, form: str, convert: Convert | None) -> Convert | None:
    """Words of the rotary axis are lengths."""
    if not is_length(builder.channel, axis):
        return convert
    return length_converter(form, builder.rules, inch=builder.inch)


def check_block(builder: Builder, further: Collection[str]) -> None:
    """Refuse what polar coordinate interpolation does not allow: codes but `ALLOWED` and further ones, rapid motion."""
    if builder.before.codes.get(GROUP) != "G12.1":
        return
    control, motion = builder.control, builder.mode["motion"]
    for row in builder.codes:
        if row.code not in ALLOWED and row.code not in further:
            raise control.fail("polar_code", address=row.code)
    moves = any(control.axis_of_address(builder.channel, a, builder) for a in builder.slots)
    if moves and motion not in _CUTS and not any(row.axis_words for row in builder.codes):
        raise control.fail("polar_code", address=motion)
