"""What parameters of a FANUC control say about planes across the tool, G68.3 (A-79976E, pages 4, 5 and 13)."""

from __future__ import annotations

from math import atan2, degrees, hypot

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.vectors import axis_vector, cross, dot

if TYPE_CHECKING:
    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Frame, Vector

#: 12321: upright is the axis of the machine with this number, from 1, or that of the tool with its axes at zero.
ALONG_TOOL, Z = 0, 3
#: 12322 where that is 0 or more than a right angle, degrees.
PARALLEL_DEG, MOST_DEG = 1.0, 90.0


def plane_across(
    channel: WordAddressChannel, parameters: FanucParameters[FanucAxisParameters], tool: Vector
) -> Frame:
    """The plane across a tool (a unit vector of the machine); PS5459 for an upright axis that there is not.

    12321 names the upright axis that X of the plane is square on. A tool that leans from it by no more than 12322
    counts as upright: Z, X and Y of the plane are that axis and the two that follow it.
    """
    from polycnc.transformation.planes.tilted import square_on

    number = parameters.upright_axis
    if number == ALONG_TOOL:
        along = channel.control.kinematics(channel).along
        number = 1 + max(range(3), key=lambda axis: abs(along[axis]))
    if not 1 <= number <= Z:
        raise channel.control.fail("tilt_unreachable", address="G68.3")
    upright, limit = axis_vector(number - 1), parameters.upright_within
    lean = degrees(atan2(hypot(*cross(upright, tool)), dot(upright, tool)))
    if lean > (limit if 0.0 < limit <= MOST_DEG else PARALLEL_DEG):
        return square_on(tool, number - 1)
    return IDENTITY if number == Z else square_on(upright, number - 1)
