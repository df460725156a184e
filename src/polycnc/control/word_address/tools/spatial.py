"""Radius compensation in space under tip control: the tool stands beside the path, across path and tool (G41.2, G42.2).

The geometry is that of `compensation.spatial`; how corners are passed and what is refused is told by the controls.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from polycnc.channel.moves.knots import knot_context
from polycnc.compensation.spatial import SpatialStage
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.transformation.orientation.solutions import Posture

if TYPE_CHECKING:
    from polycnc.compensation.spatial import Corners, Rules
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel

#: Codes by the side of the path on which the tool stands; those that name the tool's direction by I J K.
SIDES = {"G41.2": 1, "G42.2": -1, "G41.6": 1, "G42.6": -1}
BY_VECTOR = ("G41.6", "G42.6")
#: Codes that mirror and scale what the program says.
SHAPES = ("G50", "G50.1", "G51", "G51.1")


def stage_of(channel: WordAddressChannel) -> SpatialStage | None:
    """The stage of the path while the compensation is active."""
    stage = channel.path.find(SpatialStage)
    return stage if stage is not None and stage.active else None


def engage(channel: WordAddressChannel, words: Words, corners: Corners, rules: Rules) -> None:
    """The compensation begins with the next block, or goes on at another side or with another radius."""
    state = RadiusState.of(channel)
    number = words.integer("D")
    state.number = state.number if number is None else number
    radius: float = channel.control.radius_value(channel, state.number)
    side = SIDES[channel.mode["compensation"]] * (-1 if channel.coordinates.programming.mirrors else 1)
    stage = stage_of(channel)
    if stage is not None:
        stage.change(side, radius)
        return
    c, frame = channel.coordinates, TipState.of(channel).frame
    posture = Posture(channel.control.kinematics(channel), channel.axes, tuple(c.offsets), frame)
    channel.flush()
    channel.path.take(SpatialStage)
    within = partial(knot_context, channel)
    channel.path.put(SpatialStage(c.geometry, posture, radius, side, corners, rules, within))


def end(channel: WordAddressChannel) -> None:
    """G40: the last block ends square on itself, and the next one leads back; unless one is awaited that does so."""
    stage = stage_of(channel)
    if stage is not None and not stage.leaves:
        channel.flush()
        channel.path.take(SpatialStage)
