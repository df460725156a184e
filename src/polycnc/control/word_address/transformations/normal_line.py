"""Normal line control G40.1, G41.1, G42.1: a rotary axis stays square to the path.

The angle of the axis is that of a direction in the active plane: 0 along its first axis, 90 along the second.
G41.1 keeps it on the normal that points to the left of the way, G42.1 to the right. In front of every block, rapids
included, the axis turns the short way round onto the normal of that block; along an arc it turns with the arc.
Words of the axis have no effect while the control is on.

So FANUC and MELDAS have it, which `start` is for. What a control refuses meanwhile are its `NormalLineRules`; the end
and the stage of the path (`normal_stage`) are the same on all.
"""

from __future__ import annotations

from polycnc.control.word_address.transformations.normal_stage import CUTS, SAME_DEG, Direction, NormalStage
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel

#: Modal group of G40.1 to G42.1, and its code while the control is off.
GROUP, OFF = "normal_line", "G40.1"
LEFT = "G41.1"
#: Where no parameter names the axis, it is the rotary axis of this name.
DELIVERED_AXIS = "C"


@dataclass(frozen=True, slots=True)
class NormalLineRules:
    """What a control refuses while normal line control is on, beside another plane. Mistakes stand by their names.

    Attributes:
        forbidden: Mistakes by code, or by code and an address that stands with it.
        preset: The code that sets positions and may not name the axis; empty for none.
        axis_word: The mistake of a word of the axis; empty where such words have no effect.
        with_its_end: The block that ends the control is looked at as well.
    """

    forbidden: Mapping[str | tuple[str, str], str] = field(default_factory=dict)
    preset: str = "G92"
    axis_word: str = ""
    with_its_end: bool = True


def start(channel: MacroChannel, words: Words) -> None:
    """G41.1, G42.1: from the next way on the axis stands on the normal."""
    parameters, code = channel.memory.parameters, channel.mode[GROUP]
    number = parameters.normal_axis
    axis = channel.axis_index.get(DELIVERED_AXIS, -1) if number is None else number - 1
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
        shortest_mm=parameters.normal_shortest_move,
        least_turn_deg=max(parameters.normal_least_turn, SAME_DEG),
        turn_feed=parameters.normal_turn_feed / 60.0 or None,
        follows=CUTS | {Kind.RAPID},
    )
    channel.path.put(NormalStage(direction, channel.toolpath))


def acts(channel: WordAddressChannel) -> bool:
    """Whether the axis follows the path."""
    return channel.path.find(NormalStage) is not None


def cancel(channel: WordAddressChannel, _words: Words) -> None:
    """G40.1: the axis stays where it is."""
    end(channel)


def end(channel: WordAddressChannel) -> None:
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
    """Refuse what the control does not allow while the axis follows the path."""
    rules: NormalLineRules = builder.control.normal_line_rules()
    if builder.before.codes.get(GROUP, OFF) == OFF or not (rules.with_its_end or builder.mode[GROUP] != OFF):
        return
    fail, codes = builder.control.fail, [row.code for row in builder.codes]
    for code in codes:
        for key, mistake in rules.forbidden.items():
            if key == code or (isinstance(key, tuple) and key[0] == code and builder.has(key[1])):
                raise fail(mistake, address=code)
    stage = builder.channel.path.find(NormalStage)
    if stage is None:
        return
    name = builder.channel.axes[stage.direction.axis]
    if rules.axis_word and builder.has(name) and not any(row.axis_words for row in builder.codes):
        raise fail(rules.axis_word, address=name)
    if PLANES[builder.mode["plane"]][:2] != stage.direction.places:
        raise fail("normal_plane", address=builder.mode["plane"])
    if builder.has(name) and rules.preset in codes:
        raise fail("normal_preset", address=rules.preset, code=rules.preset)
