"""Polar coordinate interpolation G12.1 / G13.1: X and C become a Cartesian plane (manual 2.15).

The contour is written as if X and C were the two axes of G17; the linear axis follows by the distance from the rotation
centre, the rotary one by the angle. The angle of C at G12.1 is the direction of the first axis.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.syntec.coordinates.systems import DiameterState
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.polar_interpolation import (
    GROUP,
    PolarState,
    enter_polar,
    leave_polar,
    length_word,
)
from polycnc.transformation.kinematic.polar import PolarPlane

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words

POLAR = GROUP
LINEAR, ROTARY = "X", "C"
#: What must not come inside: it would change the coordinate system or leave it (2.15.2, notes 5, 12 and 16).
FORBIDDEN = frozenset({
    "G28", "G28.1", "G29", "G30", "G31", "G31.10", "G31.11", "G50", "G50.1", "G51", "G51.1", "G52", "G53", "G53.1",
    "G53.3", "G53.6", "G54", "G54.4", "G55", "G56", "G57", "G58", "G59", *(f"G59.{i}" for i in range(1, 10)), "G68",
    "G68.2", "G68.3", "G92", "G92.1", "G43.4", "G43.5",
})  # fmt: skip


def start_polar(channel: SyntecChannel, words: Words) -> None:
    """G12.1 [X] [C]: the plane of X and C; X and C are the program zero against the rotation centre."""
    memory, c = channel.memory, channel.coordinates
    linear, rotary = (channel.axis_index.get(name, -1) for name in (LINEAR, ROTARY))
    if linear < 0 or rotary < 0 or not channel.axis_data[rotary].rotary:
        raise words.fail("polar_axes", "G12.1")
    if RadiusState.of(channel).side or not (c.direct and c.zero.is_identity):
        raise words.fail("polar_mode", "G12.1")
    if PolarState.of(channel).plane is not None:
        return
    channel.flush()
    here = c.position
    eccentricity = (words.length("X") or 0.0, words.length("C") or 0.0)
    side = -1.0 if here[linear] < 0.0 else 1.0
    diameter = memory.is_diameter(linear)
    DiameterState.of(channel).switched[linear] = False
    geometry = (linear, rotary, c.geometry[2])
    polar = PolarPlane(linear, rotary, geometry, here[rotary], eccentricity, side)
    enter_polar(channel, polar, "G17", diameter=diameter)


def end_polar(channel: SyntecChannel, words: Words) -> None:
    """G13.1: X and C are axes of their own again; the former plane and the parameter's kind of X return."""
    if PolarState.of(channel).plane is None:
        return
    if RadiusState.of(channel).side:
        raise words.fail("polar_mode", "G13.1")
    channel.flush()
    leave_plane(channel)


def leave_plane(channel: SyntecChannel) -> None:
    """The axes are named themselves again; nothing moves."""
    plane = PolarState.of(channel).plane
    if plane is not None:
        DiameterState.of(channel).switched.pop(plane.linear, None)
        leave_polar(channel)


def _check_block(builder: Builder) -> None:
    """Refuse codes that polar interpolation does not allow."""
    if builder.before[POLAR] != "G12.1":
        return
    for row in builder.codes:
        if row.code in FORBIDDEN:
            raise builder.control.fail("polar_mode", address=row.code)
        if row.code == "G10.9":
            raise builder.control.fail("polar_diameter", address=row.code)


#: What blocks may hold and how they are read in polar interpolation.
RULE = Rule("polar interpolation", unless={POLAR: "G13.1"}, check=_check_block, convert=length_word)
