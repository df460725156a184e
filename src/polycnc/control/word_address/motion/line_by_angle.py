"""`,A`: a straight block gives the direction of its line and one of the coordinates (FANUC macro B §11)."""

from __future__ import annotations

from math import cos, hypot, nan, radians, sin, tan

from polycnc.control.word_address.block.numbers import angle_converter
from polycnc.control.word_address.motion.path import reach
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel

ANGLE = ",A"
#: A line that runs nearer than this to an axis does not say where it reaches a coordinate of the other one.
LEAST_ANGLE_DEG = 1.0
#: How far an end beside an angle may lie off the line: both ends are rounded, to 0.0001 inch at worst.
ROUNDING_MM = 0.005
_STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}


def leaves_line(first: float, second: float, angle_deg: float) -> bool:
    """Whether a way says another line than an angle beside its end does; nobody knows which of the two is meant."""
    beside = abs(first * sin(radians(angle_deg)) - second * cos(radians(angle_deg)))
    return beside > max(hypot(first, second) * sin(radians(LEAST_ANGLE_DEG)), ROUNDING_MM)


def plan_line_by_angle(builder: Builder, plan: Plan) -> Step | None:
    """A block of G00 or G01 with `,A`, counter-clockwise from the plane's first axis; None without."""
    kind = _STRAIGHT.get(builder.mode["motion"])
    if kind is None or not builder.has(ANGLE):
        return None
    builder.take(ANGLE)
    slot, form = builder.slots[ANGLE]
    convert, control = angle_converter(form, builder.rules), builder.control
    u, v, _ = PLANES[builder.mode["plane"]]
    geometry = builder.channel.coordinates.geometry
    named = {word.axis for word in plan.axis_words} & {geometry[u], geometry[v]}
    if not named:
        # The end would be where the line of the next block meets this one.
        raise AlarmError("PC0001", address=ANGLE, hint="hint.not-supported", code=ANGLE)
    corner = builder.corner()

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        rapid = kind == Kind.RAPID
        if not rapid and not channel.feed > 0.0:
            raise control.fail("no_feed")
        c = channel.coordinates
        first, second = c.geometry[u], c.geometry[v]
        angle = convert(values[slot]) if convert else values[slot]
        end = reach(channel, plan.axis_words, values)
        start = c.programmed
        if len(named) > 1:
            if leaves_line(end[first] - start[first], end[second] - start[second], angle):
                raise control.fail("drawing_end", address=ANGLE)
        else:
            across = angle - 90.0 if first in named else angle
            if abs(sin(radians(across))) < sin(radians(LEAST_ANGLE_DEG)):
                raise control.fail("drawing_end", address=ANGLE)
            slope = tan(radians(angle))
            if first in named:
                end[second] = start[second] + (end[first] - start[first]) * slope
            else:
                end[first] = start[first] + (end[second] - start[second]) / slope
        if corner is not None:
            corner(channel, values)
        channel.straight(kind, c.to_position(end), nan if rapid else channel.feed, end)

    return move
