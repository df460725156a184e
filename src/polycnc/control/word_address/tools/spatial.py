"""Radius compensation in space: the tool stands beside the path, across path and tool (G41.2, G42.2).

The geometry is that of `compensation.spatial` under tip control and of `spatial_axes` where words name the axes; how
corners are passed and what is refused is told by the controls.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.moves.knots import join
from polycnc.control.word_address.coordinates.systems import work_zero
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.tools import radius
from polycnc.control.word_address.tools.radius import SIDES, RadiusState
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.compensation.spatial.rules import Corners, Rules
    from polycnc.compensation.spatial.stage import SpatialStage
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.transformation.orientation.solutions import Posture

#: Codes that mirror and scale what the program says.
SHAPES = ("G50", "G50.1", "G51", "G51.1")


def stage_of(channel: WordAddressChannel) -> SpatialStage | None:
    """The stage of the path while the compensation is active."""
    from polycnc.compensation.spatial.stage import SpatialStage  # where it is used

    stage = channel.path.find(SpatialStage)
    return stage if stage is not None and stage.active else None


def engage(channel: WordAddressChannel, words: Words, corners: Corners, rules: Rules) -> None:
    """The compensation begins with the next block, or goes on at another side or with another radius."""
    state = RadiusState.of(channel)
    number = words.integer("D")
    state.number = state.number if number is None else number
    amount: float = channel.control.radius_value(channel, state.number)
    side = SIDES[channel.mode["compensation"]] * (-1 if channel.coordinates.programming.mirrors else 1)
    stage = stage_of(channel)
    if stage is not None:
        stage.change(side, amount)
        return
    from polycnc.compensation.spatial.stage import SpatialStage

    channel.flush()
    channel.path.take(SpatialStage)
    channel.path.put(_stage(channel, amount, side, corners, rules))


def posture_of(channel: WordAddressChannel) -> Posture:
    """How the tool stands on the work, by positions of the path."""
    from polycnc.transformation.orientation.solutions import Posture

    c = channel.coordinates
    kinematics = channel.control.kinematics(channel)
    return Posture(kinematics, channel.axes, tuple(c.offsets), TipState.of(channel).frame)


def _stage(
    channel: WordAddressChannel, amount: float, side: int, corners: Corners, rules: Rules
) -> SpatialStage:
    from polycnc.compensation.spatial.stage import SpatialStage

    c, kinematics = channel.coordinates, channel.control.kinematics(channel)
    unite = partial(join, channel)
    if TipState.of(channel).active is not None or not kinematics.work:
        return SpatialStage(c.geometry, posture_of(channel), amount, side, corners, rules, unite)
    from polycnc.control.word_address.tools.spatial_axes import AxesStage
    from polycnc.transformation.orientation.unled import Unled

    zero = work_zero(channel, c.offsets)
    table = Unled(kinematics, channel.axes, tuple(c.offsets), c.geometry, zero)
    return AxesStage(c.geometry, table, amount, side, corners, rules, unite)


def end(channel: WordAddressChannel) -> None:
    """G40: the last block ends square on itself, and the next one leads back; unless one is awaited that does so."""
    stage = stage_of(channel)
    if stage is not None and not stage.leaves:
        from polycnc.compensation.spatial.stage import SpatialStage

        channel.flush()
        channel.path.take(SpatialStage)


def plan_radius_number(builder: Builder) -> Step:
    """D: number of the radius offset, modal; the new radius holds from the end of the block, in space as well."""
    change = radius.plan_radius_number(builder)

    def act(channel: WordAddressChannel, values: list[float]) -> None:
        change(channel, values)
        stage = stage_of(channel)
        if stage is not None:
            stage.change_radius(channel.control.radius_value(channel, RadiusState.of(channel).number))

    return act
