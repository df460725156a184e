"""Chamfers and roundings between two moves: `,C` and `,R` (FANUC macro B §11)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.compensation import Plane
from polycnc.compensation.corner import FANUC_CORNERS, CornerStage, CornerViolation, Shape
from polycnc.control.word_address.path import PLANES

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.path import PathStage
    from polycnc.control.word_address.codes import Step
    from polycnc.control.word_address.plan import Builder

SHAPES = {",C": Shape.CHAMFER, ",R": Shape.ROUNDING}
#: What each violation is called in a control's table of mistakes.
MISTAKES = {
    CornerViolation.NO_NEXT_MOVE: "corner_no_move",
    CornerViolation.RAPID: "corner_next_block",
    CornerViolation.TOO_SHORT: "corner_too_short",
}


def plan_corner_words(builder: Builder) -> Step | None:
    """What `,C` or `,R` in a block asks for; the step runs in front of the motion."""
    address = next((address for address in SHAPES if builder.has(address)), None)
    if address is None:
        return None
    builder.take(address)
    slot, convert = builder.slot(address), builder.length(address)
    shape = SHAPES[address]
    assert slot is not None

    def insert(channel: Channel, values: list[float]) -> None:
        size = convert(values[slot]) if convert else values[slot]
        if size < 0.0:
            raise channel.control.fail("minus", address=address)
        if size > 0.0:
            corner_stage(channel).insert(shape, size)

    return insert


def corner_stage(channel: Channel) -> CornerStage:
    """The channel's corner stage for the active plane, in front of everything else in the path."""
    memory = channel.memory
    u, v, w = PLANES[channel.mode["plane"]]
    stage: CornerStage | None = memory.corners
    if stage is not None and (stage.plane.u, stage.plane.v) == (u, v) and channel.head is stage:
        return stage
    if stage is not None and channel.head is stage:
        stage.flush()
        channel.head = stage.after
    alarms = channel.control.alarms
    codes = {violation: alarms[mistake] for violation, mistake in MISTAKES.items()}
    plane = Plane(u, v, w, channel.coordinates.geometry)
    memory.corners = stage = CornerStage(plane, FANUC_CORNERS, codes, channel.head or channel.table)
    channel.put_stage(stage)
    return stage


def put_behind_corners(channel: Channel, stage: PathStage) -> None:
    """Put a stage into the path as the first one behind the corners."""
    corners: CornerStage | None = channel.memory.corners
    if corners is not None and channel.head is corners:
        if corners.active:
            raise channel.control.fail("corner_no_move")
        corners.after = stage
    else:
        channel.put_stage(stage)
