"""G17, G18, G19 on controls with parallel axes: which axes form the plane."""

from __future__ import annotations

from polycnc.control.word_address.coordinates.frames import turns_plane
from polycnc.control.word_address.coordinates.systems import ZeroState
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.states import CylinderState, PlaneAxes
from polycnc.control.word_address.tools.radius import RadiusState, idle_or_active
from polycnc.control.word_address.transformations import cylinder
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel


def choose_axes(channel: WordAddressChannel, geometry: tuple[int, int, int]) -> None:
    """Let these axes be X, Y and Z of the plane; those of the machine while they lie in space."""
    from polycnc.transformation.kinematic.parallel import ParallelAxes

    state = PlaneAxes.of(channel)
    zero = ZeroState.of(channel)
    if TipState.of(channel).is_leading(channel) or not (zero.turn.is_identity and zero.plane.is_identity):
        geometry = channel.memory.basic_geometry
    channel.coordinates.geometry = geometry
    if geometry == channel.memory.basic_geometry:
        state.parallel = None
    elif state.parallel is None or state.parallel.geometry != geometry:
        state.parallel = ParallelAxes(geometry)
    channel.context_changed()


def choose_basic_axes(channel: WordAddressChannel) -> None:
    """X, Y and Z of the machine are those of the plane again: tip control and tilted planes lead them only."""
    if channel.coordinates.geometry != channel.memory.basic_geometry:
        choose_axes(channel, channel.memory.basic_geometry)


def select_plane(channel: MacroChannel, words: Words) -> None:
    """G17 to G19: another plane than that of an active radius compensation is an alarm."""
    code = channel.mode["plane"]
    stage = idle_or_active(channel)
    if (
        RadiusState.of(channel).side
        and stage is not None
        and (stage.plane.u, stage.plane.v) != PLANES[code][:2]
    ):
        raise words.fail("comp_plane", code)
    if channel.control.PLANE_HELD_BY_ROTATION and not turns_plane(channel):
        raise words.fail("rotation_plane", code)
    lay_axes(channel, words)


def lay_axes(channel: MacroChannel, words: Words) -> None:
    """The plane's axes: a word of the block names a parallel axis (1022) in place of the basic one."""
    memory, c = channel.memory, channel.coordinates
    basic = list(memory.basic_geometry)
    for axis, _, _ in words.axes():
        role = channel.control.axis_role(channel, axis)
        if role in (5, 6, 7):
            basic[role - 5] = axis
    geometry = (basic[0], basic[1], basic[2])
    state = CylinderState.of(channel)
    if state.active is None:
        choose_axes(channel, geometry)
        return
    state.geometry_before = geometry
    state.active = replace(state.active, geometry=cylinder.unrolled_geometry(channel, state.active.axis))
    c.transform(state.active, state.active.geometry)
    channel.context_changed()
