"""Cylindrical interpolation G07.1: the surface of a cylinder is unrolled into a plane.

Words of the rotary axis stay degrees, and so does what the displays show. In the toolpath the axis is a length on the
surface, so that arcs, radius compensation and the planner see a plane.
"""

from __future__ import annotations

from math import pi

from polycnc.control.word_address.states import CylinderState
from polycnc.control.word_address.tools.radius import RadiusState, active_compensation
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from collections.abc import Collection

    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel

#: Modal group that holds `G7.1` while a cylinder is unrolled.
GROUP = "cylinder"
_CUTS = frozenset({"G1", "G2", "G3"})
#: G codes that every control refuses, beside cycles.
REFUSED = frozenset({
    "G0", "G12.1", "G27", "G28", "G29", "G30", "G31", "G33", "G37", "G52", "G53", "G54", "G55", "G56", "G57", "G58",
    "G59", "G60", "G68", "G92",
})  # fmt: skip


def cylinder(channel: MacroChannel, words: Words) -> None:
    """G07.1 C r (G107): C is unrolled at the radius r; r = 0 ends the mode."""
    from polycnc.transformation.kinematic.cylinder import Cylinder

    named = words.plan.axis_words
    if len(named) != 1 or not channel.axis_data[named[0].axis].rotary:
        raise words.fail("cylinder_axis", "G7.1")
    radius = abs(words.length(named[0].address) or 0.0)
    state = CylinderState.of(channel)
    if not radius:
        channel.flush()
        if active_compensation(channel) is not None:
            # Its vector lies on the surface; without one it cannot be led back to the path.
            raise words.fail("cylinder_code", "G7.1")
        end_cylinder(channel)
        return
    if state.active is not None:
        raise words.fail("cylinder_axis", "G7.1")
    if (
        channel.mode["motion"] not in _CUTS
        or RadiusState.of(channel).side
        or channel.coordinates.transformation is not None
    ):
        raise words.fail("cylinder_code", "G7.1")
    axis, c = named[0].axis, channel.coordinates
    channel.flush()
    state.geometry_before = c.geometry
    state.active = Cylinder(axis, radius * pi / 180.0, unrolled_geometry(channel, axis))
    c.transform(state.active, state.active.geometry)
    channel.mode = channel.mode.with_code(GROUP, "G7.1")
    _forget_compensation(channel)
    channel.context_changed()


def unrolled_geometry(channel: MacroChannel, axis: int) -> tuple[int, int, int]:
    """The unrolled axis takes the place of a plane axis: by 1022, else of the one that the cylinder's own is not."""
    plane = channel.mode["plane"]
    u, v, _ = PLANES[plane]
    role = channel.control.axis_role(channel, axis)
    own = _turns_about(channel, axis)
    # Where neither plane axis is the cylinder's own (a plane across it), 1022 should have said which one gives way.
    slot = role - 5 if role in (5, 6, 7) else u if v == own or (own < 0 and plane == "G19") else v
    geometry = list(CylinderState.of(channel).geometry_before)
    geometry[slot] = axis
    return (geometry[0], geometry[1], geometry[2])


def _turns_about(channel: MacroChannel, axis: int) -> int:
    """Geometry axis (0 to 2) that a rotary axis turns about, by the machine's joints; -1 where they do not say."""
    machine = channel.machine
    for joint in (*machine.tool_chain, *machine.work_chain):
        if joint.axis == channel.axes[axis]:
            return next((i for i in range(3) if abs(joint.direction[i]) > 1.0 - 1e-9), -1)
    return -1


def end_cylinder(channel: WordAddressChannel) -> None:
    """The axis turns by degrees again (also at reset); nothing moves."""
    state = CylinderState.of(channel)
    if state.active is None:
        return
    channel.flush()
    _forget_compensation(channel)
    state.active = None
    channel.mode = channel.mode.with_code(GROUP, "")
    channel.coordinates.transform(None, state.geometry_before)
    channel.context_changed()


def check_block(builder: Builder, further: Collection[str]) -> None:
    """Refuse codes that cylindrical interpolation does not allow: `REFUSED`, and further ones of the control."""
    if not builder.before.codes.get(GROUP):
        return
    for row in builder.codes:
        if row.code in REFUSED or row.code in further or (row.group == "cycle" and row.code != "G80"):
            raise builder.control.fail("cylinder_code", address=row.code)


def unroll(channel: MacroChannel, axis: int, angle_deg: float) -> float:
    """A word of the unrolled axis as a length on the surface, mm."""
    active = CylinderState.of(channel).active
    return angle_deg * active.mm_per_degree if active is not None and active.axis == axis else angle_deg


def shown(channel: WordAddressChannel, axis: int, value: float) -> float:
    """A position of an axis as displays and variables show it: degrees on the unrolled one too."""
    active = CylinderState.of(channel).active
    return value / active.mm_per_degree if active is not None and active.axis == axis else value


def surface_word(builder: Builder, axis: int, _form: str, convert: Convert | None) -> Convert | None:
    """Words of the unrolled axis are angles of the surface."""
    channel = builder.channel
    unrolled = CylinderState.of(channel).active
    if unrolled is None or axis != unrolled.axis:
        return convert
    return lambda value: unroll(channel, axis, convert(value) if convert else value)


def _forget_compensation(channel: WordAddressChannel) -> None:
    """A vector of the other plane means nothing on this one."""
    stage = active_compensation(channel)
    if stage is not None:
        stage.discard()
