"""Chamfers and roundings between two moves: `,C` and `,R` (FANUC macro B §11)."""

from __future__ import annotations

from polycnc.channel.moves.knots import Motions
from polycnc.compensation.corner import CornerStage, CornerViolation, Shape
from polycnc.compensation.plane import Plane
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.family import WordAddressChannel

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

    def insert(channel: WordAddressChannel, values: list[float]) -> None:
        size = convert(values[slot]) if convert else values[slot]
        if size < 0.0:
            raise channel.control.fail("minus", address=address)
        if size > 0.0:
            corner_stage(channel).insert(shape, size)

    return insert


def corner_stage(channel: WordAddressChannel) -> CornerStage:
    """The channel's corner stage for the active plane, put into its path when it is first needed."""
    u, v, w = PLANES[channel.mode["plane"]]
    stage = channel.path.find(CornerStage)
    if stage is not None and (stage.plane.u, stage.plane.v) == (u, v):
        return stage
    if stage is not None:
        stage.flush()
    alarms = channel.control.alarms
    codes = {violation: alarms[mistake] for violation, mistake in MISTAKES.items()}
    plane = Plane(u, v, w, channel.coordinates.geometry)
    return channel.path.put(CornerStage(plane, channel.control.corner_policy(), codes, Motions(channel)))


def dwell(channel: WordAddressChannel) -> None:
    """A dwell stands between the two moves of a corner, where the control lets it."""
    stage = channel.path.find(CornerStage)
    if stage is not None:
        stage.dwell()


def refuse_start_up(channel: WordAddressChannel) -> None:
    """Compensation may not start up between the two moves of a corner, but where the control's corners let it."""
    corners = channel.path.find(CornerStage)
    if corners is not None and corners.active and not corners.policy.start_up_between:
        raise channel.control.fail("corner_no_move")


def refuse_change(channel: WordAddressChannel) -> None:
    """Compensation may not end or change between the two moves of a corner: the first one is of the contour."""
    stage = channel.path.find(CornerStage)
    if stage is not None and not stage.settle():
        raise channel.control.fail("corner_no_move")
