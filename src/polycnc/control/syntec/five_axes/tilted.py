"""Tilted planes G68.2 and G68.3 and the switch of the work system's rotation G54.4 (manual 2.39, 2.44, 2.45).

The tilted plane is a frame inside the work system: `machine = work offsets + G92.1 turn · tilt · program`. The tool
is aligned by G53.1, G53.3 or G53.6 (`alignment`).
"""

from __future__ import annotations

from polycnc.control.syntec.coordinates.turns import (
    OVER_POWER_OFF,
    KeptPlane,
    TurnState,
    keep_plane,
    renew_preset_frame,
    renew_work_turn,
)
from polycnc.control.syntec.five_axes import alignment, mechanism
from polycnc.control.word_address.coordinates import frames as base_frames
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.motion.planes import choose_basic_axes
from polycnc.control.word_address.states import LengthState
from polycnc.control.word_address.transformations.tilted_plane import (
    check_compensation,
    named_point,
    stand_along,
)
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.geometry.frames import IDENTITY, Frame, rotation, translation
from polycnc.transformation.planes.tilted import by_euler, by_rotary_axes, square_on

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words


class Kept(NamedTuple):
    """The tilted plane as Pr3014 keeps it over a reset: with its code, and with the tool standing on it if it did."""

    tilt: Frame
    code: str = ""
    stands: bool = False

    def restore(self, channel: SyntecChannel) -> None:
        """The plane acts again behind the reset, or none does; nothing moves."""
        if self.tilt is IDENTITY:
            set_tilt(channel, IDENTITY, "")
            return
        channel.mode = channel.mode.with_code("rotation", self.code)
        if self.stands:
            _set_stood(channel, self.tilt, self.code)
        else:
            set_tilt(channel, self.tilt, self.code)


def kept_over_reset(channel: SyntecChannel) -> Kept:
    """What there is in front of a reset; no plane where Pr3014 keeps none."""
    state = TurnState.of(channel)
    if not channel.memory.parameters.keeps_tilt or state.tilt is IDENTITY:
        return Kept(IDENTITY)
    return Kept(state.tilt, state.told_by, LengthState.of(channel).direction is not None)


def kept_over_power_off(channel: SyntecChannel) -> Kept:
    """What there was when the power went off; no plane unless Pr3014 is 2."""
    parts = KeptPlane.of(channel).parts
    if channel.memory.parameters.keeps_tilt != OVER_POWER_OFF or not parts:
        return Kept(IDENTITY)
    a, b, c, d, e, f, g, h, i, x, y, z = cast("list[float]", parts["plane"])
    plane = translation(x, y, z) @ Frame(((a, b, c), (d, e, f), (g, h, i)))
    return Kept(plane, str(parts["code"]), bool(parts["stands"]))


def tilt_by_angles(channel: SyntecChannel, words: Words) -> None:
    """G68.2 X Y Z I J K: origin from the work zero, turned by I about Z, J about X', K about Z''."""
    check_compensation(channel, words, "G68.2")
    choose_basic_axes(channel)
    origin = named_point(channel, words, "argument")
    i, j, k = (words.angle(letter) or 0.0 for letter in "IJK")
    set_tilt(channel, translation(*origin) @ by_euler(i, j, k), "G68.2")


def tilt_by_tool(channel: SyntecChannel, words: Words) -> None:
    """G68.3 [P1] X Y Z R: the plane stands square on the tool; without X Y Z its origin is the present position.

    P1 turns the plane with the rotary axes; otherwise its X axis is square on the Z axes of work and tool, and R
    turns it about the tool. The tool stands on it as it is: no G53.1 is needed, G43 goes along the tool.
    """
    if not channel.memory.parameters.option_tilted_plane:
        raise channel.control.fail("option", address="G68.3", code="G68.3")
    mechanism.check(channel, words, "G68.3")
    check_compensation(channel, words, "G68.3")
    choose_basic_axes(channel)
    if TurnState.of(channel).by_table:
        raise words.fail("tool_plane", "G68.3")
    given = {axis for axis, _, _ in words.axes()} & {
        axis for axis in channel.coordinates.geometry if axis >= 0
    }
    if given and len(given) != len([axis for axis in channel.coordinates.geometry if axis >= 0]):
        raise words.fail("tool_plane_format", "G68.3")
    turn = _across_tool(channel, words)
    plane = translation(*named_point(channel, words, "argument")) @ turn
    _set_stood(channel, plane, "G68.3")
    if not given:
        c = channel.coordinates
        x, y, z = (c.position[axis] if axis >= 0 else 0.0 for axis in c.geometry)
        _set_stood(channel, plane @ translation(x, y, z), "G68.3")


def end_tilt(channel: SyntecChannel, words: Words) -> None:
    """G69: ends the rotation of G68 and the tilted plane."""
    if TurnState.of(channel).tilt is not IDENTITY:
        check_compensation(channel, words, "G69")
    base_frames.end_rotation(channel, words)
    if TurnState.of(channel).tilt is not IDENTITY:
        set_tilt(channel, IDENTITY, "")


def switch_work_rotation(channel: SyntecChannel, words: Words) -> None:
    """G54.4 P0, P1: rotation of the work system by the angles of its page.

    With Pr3229 = 1 there are no work systems, and the code has no effect (2.39.4).
    """
    switch = words.typed("P")
    if switch is None:
        raise words.fail("argument", "G54.4")
    if switch not in (0, 1):
        raise words.fail("number", "P")
    if switch and TurnState.of(channel).told_by == "G68.3":
        raise words.fail("tool_plane", "G54.4")
    rotate_work_system(channel, on=switch == 1)


def rotate_work_system(channel: SyntecChannel, *, on: bool) -> None:
    """The rotation of the work system is on or off; it is off where Pr3229 takes work systems away."""
    state = TurnState.of(channel)
    state.by_table = on and not channel.memory.parameters.without_work_systems
    if renew_work_turn(channel):
        set_tilt(channel, state.tilt, state.told_by)


def _set_stood(channel: SyntecChannel, tilt: Frame, code: str) -> None:
    """A tilted plane on which the tool stands; the machine stays."""
    set_tilt(channel, tilt, code)
    alignment.stand_on_plane(channel, dict(zip(channel.axes, channel.coordinates.machine, strict=True)))


def set_tilt(channel: SyntecChannel, tilt: Frame, code: str) -> None:
    """Another tilted plane, told by a code (empty for none), the tool not yet aligned with it; the machine stays."""
    turn_state = TurnState.of(channel)
    memory = channel.memory
    c = channel.coordinates
    if c.transformation is not None and not TipState.of(channel).is_leading(channel) and not tilt.is_identity:
        raise channel.control.not_yet("G68.2 G12.1")
    turn_state.tilt, turn_state.told_by, turn_state.table = tilt, code, IDENTITY
    renew_preset_frame(memory)
    if LengthState.of(channel).direction is not None:
        stand_along(channel, None)
    refresh_zero(channel)
    keep_plane(channel)


def _across_tool(channel: SyntecChannel, words: Words) -> Frame:
    """How the plane of G68.3 is turned on the work; Z of it is the tool.

    P1: as the rotary axes turn the tool against the work, from how it stands with them at zero.
    """
    kinematics, back = channel.control.kinematics(channel), ZeroState.of(channel).frame.inverse()
    angles = dict(zip(channel.axes, channel.coordinates.machine, strict=True))
    if words.typed("P") != 1:
        x, y, z = kinematics.tool_on_work(angles)
        return square_on(back.direct(x, y, z)) @ rotation(2, words.angle("R") or 0.0)
    return back @ by_rotary_axes(kinematics, angles) @ mechanism.tool_at_zero(channel)
