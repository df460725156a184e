"""3-D coordinate conversion G68.1 with I J K, tilted planes G68.2 to G68.4, and their end G69.1 (group 17).

The table of G codes names them, II.5.1.5 says how offsets go with them; what they do is that of the function as known
from FANUC's mills. A conversion is a system inside the work system: its origin is X Y Z, and it is turned by R about
the direction I J K. A second one counts within the first. The display shows the coordinates of the system.
"""

from __future__ import annotations

from polycnc.control.fanuc.lathe.coordinates import systems
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState
from polycnc.control.word_address.states import TiltState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations import tilted_plane
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, translation
from polycnc.machine.kinematics import turn_about

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Frame

#: Conversions that may act within each other.
DEEPEST = 2
#: What may lie beside an axis that the machine does not have.
NO_TURN = 1e-9


def rotate(channel: LatheChannel, words: Words) -> None:
    """G68.1 X Z R: rotation of the plane; with I, J or K 3-D conversion: X Y Z origin, I J K direction, R angle."""
    if not any(letter in words for letter in "IJK"):
        if TiltState.of(channel).plane is not None:
            raise words.fail("in_rotation", "G68.1")
        systems.rotate(channel, words)
        return
    frames, tilt = channel.memory.frames, TiltState.of(channel)
    _check_state(channel, words, "in_rotation", "G68.1")
    if tilt.plane is not None and not frames.conversions:
        raise words.fail("in_rotation", "G68.1")
    if frames.conversions == DEEPEST:
        raise words.fail("conversion_nesting", "G68.1")
    x, y, z = (words.part(letter) or 0.0 for letter in "IJK")
    angle = words.angle("R")
    if angle is None or not (x or y or z):
        raise words.fail("conversion_format", "R" if angle is None else "I")
    if any(OffsetState.of(channel).shift):
        raise words.fail("offset_in_thread", "G68.1")
    origin = tilted_plane.named_point(channel, words, "conversion_format")
    plane = (tilt.plane or IDENTITY) @ translation(*origin) @ turn_about((x, y, z), angle)
    _check_axes(channel, words, plane, "conversion_format")
    frames.conversions += 1
    tilted_plane.tilt(channel, plane)


def tilt_plane(channel: LatheChannel, words: Words) -> None:
    """G68.2 [P] X Y Z I J K: as on mills; X is a diameter where words of X are."""
    _check_tilt(channel, words, "G68.2")
    tilted_plane.tilt_plane(channel, words)
    _check_axes(channel, words, TiltState.of(channel).plane, "tilt_format")


def tilt_further(channel: LatheChannel, words: Words) -> None:
    """G68.4 …: as G68.2, but in the plane that acts."""
    _check_tilt(channel, words, "G68.4")
    tilted_plane.tilt_further(channel, words)
    _check_axes(channel, words, TiltState.of(channel).plane, "tilt_format")


def tilt_by_tool(channel: LatheChannel, words: Words) -> None:
    """G68.3 X Y Z R: the plane across the tool as the rotary axes stand it."""
    _check_tilt(channel, words, "G68.3")
    tilted_plane.tilt_by_tool(channel, words)
    _check_axes(channel, words, TiltState.of(channel).plane, "tilt_format")


def end(channel: LatheChannel, words: Words) -> None:
    """G69.1: ends the rotation, all conversions and the tilted plane."""
    if TiltState.of(channel).plane is not None:
        _check_state(channel, words, "tilt_mode", "G69.1")
    channel.memory.frames.conversions = 0
    tilted_plane.end_tilt(channel, words)


def _check_tilt(channel: LatheChannel, words: Words, code: str) -> None:
    _check_state(channel, words, "tilt_mode", code)
    if channel.memory.frames.conversions:
        raise words.fail("tilt_mode", code)


def _check_state(channel: LatheChannel, words: Words, mistake: str, code: str) -> None:
    """Neither nose radius compensation, nor a rotation of the plane, nor another transformation may act."""
    frames = channel.memory.frames
    if RadiusState.of(channel).side or frames.rotates or channel.coordinates.transformation is not None:
        raise words.fail(mistake, code)


def _check_axes(channel: LatheChannel, words: Words, plane: Frame | None, mistake: str) -> None:
    """A lathe without Y can turn about Y alone: an axis that is not there must not take part."""
    for place, column in enumerate(channel.coordinates.geometry):
        if plane is None or column >= 0:
            continue
        beside = [plane.m[place][k] for k in range(3) if k != place]
        beside += [plane.m[k][place] for k in range(3) if k != place]
        if any(abs(part) > NO_TURN for part in (*beside, plane.t[place])):
            raise words.fail(mistake, "XYZ"[place])
