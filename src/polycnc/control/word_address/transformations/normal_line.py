"""Normal line control G40.1, G41.1, G42.1 of FANUC and MELDAS: a rotary axis stays square to the path.

The angle of the axis is that of a direction in the active plane: 0 along its first axis, 90 along the second.
G41.1 keeps it on the normal that points to the left of the way, G42.1 to the right. In front of every block, rapids
included, the axis turns the short way round onto the normal of that block; along an arc it turns with the arc.
Words of the axis have no effect while the control is on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from polycnc.control.word_address.motion.path import PLANES
from polycnc.control.word_address.transformations.normal_stage import CUTS, SAME_DEG, Direction, NormalStage
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words

#: Modal group of G40.1 to G42.1, and its code while the control is off.
GROUP, OFF = "normal_line", "G40.1"
LEFT = "G41.1"
#: Where no parameter names the axis, it is the rotary axis of this name.
DELIVERED_AXIS = "C"


@dataclass(frozen=True, slots=True)
class NormalLineParameters:
    """Numbers of the parameters of normal line control; 0 where a control has none.

    Attributes:
        axis: Holds the number of the rotary axis.
        turn_feed: Feed of turns in front of cuts, degrees a minute.
        least_turn: Turns that are not greater are left out, degrees.
        shortest: In blocks that are not longer the axis stands, mm.
        preset: The code that sets positions; it may not name the axis while the control is on.
    """

    axis: int
    turn_feed: int = 0
    least_turn: int = 0
    shortest: int = 0
    preset: str = "G92"


def start(channel: Channel, words: Words) -> None:
    """G41.1, G42.1: from the next way on the axis stands on the normal."""
    memory, code = channel.memory, channel.mode[GROUP]
    numbers: NormalLineParameters = channel.control.NORMAL_LINE_PARAMETERS
    number = memory.parameters.number
    axis = int(number(numbers.axis, default=channel.axis_index.get(DELIVERED_AXIS, -1) + 1)) - 1
    turn_feed = number(numbers.turn_feed) / 60.0 if numbers.turn_feed else 0.0
    if not 0 <= axis < len(channel.axes) or not channel.axis_data[axis].rotary:
        raise words.fail("normal_axis", code)
    if channel.coordinates.transformation is not None:
        raise words.fail("normal_mode", code)
    u, v, _ = PLANES[channel.mode["plane"]]
    geometry = channel.coordinates.geometry
    if axis in geometry or geometry[u] < 0 or geometry[v] < 0:
        raise words.fail("normal_axis", code)
    end(channel)
    direction = Direction(
        axis,
        1.0,
        (geometry[u], geometry[v]),
        (u, v),
        90.0 if code == LEFT else -90.0,
        shortest_mm=number(numbers.shortest) if numbers.shortest else 0.0,
        least_turn_deg=max(number(numbers.least_turn) if numbers.least_turn else 0.0, SAME_DEG),
        turn_feed=turn_feed or None,
        follows=CUTS | {Kind.RAPID},
    )
    channel.path.put(NormalStage(direction, preset=numbers.preset))


def cancel(channel: Channel, _words: Words) -> None:
    """G40.1: the axis stays where it is."""
    end(channel)


def end(channel: Channel) -> None:
    """Take the stage out of the path (also at reset)."""
    stage = channel.path.find(NormalStage)
    if stage is None:
        return
    channel.flush()
    channel.path.take(NormalStage)
    if stage.at is not None:
        position = channel.coordinates.position[:]
        position[stage.direction.axis] = stage.at
        channel.coordinates.arrive(position)


def check_block(builder: Builder) -> None:
    """Refuse another plane, and G92 of the axis."""
    if builder.before.codes.get(GROUP, OFF) == OFF:
        return
    stage = builder.channel.path.find(NormalStage)
    if stage is None:
        return
    if PLANES[builder.mode["plane"]][:2] != stage.direction.places:
        raise builder.control.fail("normal_plane", address=builder.mode["plane"])
    name = builder.channel.axes[stage.direction.axis]
    preset = stage.preset
    if builder.has(name) and any(row.code == preset for row in builder.codes):
        raise builder.control.fail("normal_preset", address=preset, code=preset)
