"""Words of tool offsets: DL, TOFFL, TOFF, TOFFR, OFFN, ISD, DISC, TCARR and CUTMOD."""

from __future__ import annotations

from polycnc.control.sinumerik import auxiliary
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number, whole
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.tools import sides, stages
from polycnc.control.sinumerik.tools.holders import active as carriers
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.words import WordAlarm

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape


def additive_offset(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """DL: additive offset of the active edge, 1 to 6; 0 and a new D take it away."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value not in range(7):
            raise WordAlarm("12560", position, text="DL")
        channel.memory.tools.additive = int(value)
        auxiliary.tool_changed(channel)

    return run


def added_length(draft: Draft, position: int, shape: WordShape) -> Step:
    """TOFFL, TOFFL[n]: addition to length n of the active edge."""
    index = shape.index if shape.index is not None else 1
    if index not in (1, 2, 3):
        raise WordAlarm("12400", position, text="TOFFL")
    which = int(str(index)) - 1
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        channel.memory.tools.added_lengths[which] = number(values, position) * factor
        auxiliary.tool_changed(channel)

    return run


def added_on_axis(draft: Draft, position: int, shape: WordShape) -> Step:
    """TOFF[axis]: addition along a geometry axis."""
    column = axis_column(draft, position, shape)
    geometry = draft.channel.coordinates.geometry
    if column not in geometry:
        raise WordAlarm("16410", position, axis=draft.channel.axes[column])
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        channel.memory.tools.added_on_axes[geometry.index(column)] = number(values, position) * factor
        auxiliary.tool_changed(channel)

    return run


def added_radius(draft: Draft, position: int, _shape: WordShape) -> Step:
    """TOFFR: addition to the tool radius."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        channel.memory.tools.added_radius = number(values, position) * factor
        stages.changed_radius(channel)
        channel.context_changed()

    return run


def allowance(draft: Draft, position: int, _shape: WordShape) -> Step:
    """OFFN: allowance to the contour."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        sides.Contour.of(channel).allowance_mm = number(values, position) * factor
        stages.changed_radius(channel)

    return run


def depth(draft: Draft, position: int, _shape: WordShape) -> Step:
    """ISD: how far the tip lies below the programmed point along the tool, for CUT3DC."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        sides.Contour.of(channel).depth_mm = number(values, position) * factor
        stages.changed_radius(channel)

    return run


def disc(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """DISC: how far the transition arc of G450 is raised, 0 to 100 (at most MD20220)."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        highest = channel.memory.data.number("$MC_CUTCOM_MAX_DISC")
        sides.Contour.of(channel).disc = min(max(number(values, position), 0.0), highest)
        stages.changed_rules(channel)

    return run


def tool_carrier(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """TCARR: the orientable toolholder, 0 for none; 14150 for one that is not defined."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value != int(value) or value < 0.0:
            raise WordAlarm("14150", position, number=f"{value:g}")
        carriers.activate(channel, int(value))
        auxiliary.tool_changed(channel)

    return run


def cutting_data(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """CUTMOD: edge positions turn with the toolholder of a number, with any (-1), with the active one (-2), or not."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        carriers.modify_cuts(channel, whole(values, position))
        auxiliary.tool_changed(channel)

    return run
