"""SF, DITS, DITE: where a thread begins on the circumference, and its paths to take up speed and to brake.

They are setting data that words write (job planning 1.1.7), so they hold for the threads behind (16.1: SF is modal).
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.tables import TURN, length_factor
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

#: The element of the setting datum that a word writes.
RAMPS = {"DITS": 0, "DITE": 1}
DATUM = "$SC_THREAD_RAMP_DISP"
#: Start angle of threads, degrees.
START_ANGLE = "$SC_THREAD_START_ANGLE"
#: As fast as the axis can.
BY_DYNAMICS = -1.0
#: A way that counts as none.
AT_ONCE_MM = 1e-6


def ramp(draft: Draft, position: int, shape: WordShape) -> Step:
    """DITS, DITE: the path, modal, as SD42010; below 0 as the dynamics of the axis allow."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        wanted = value * factor if value >= 0.0 else BY_DYNAMICS
        channel.memory.data.write(DATUM, (RAMPS[shape.address],), wanted)

    return run


def ways(channel: SinumerikChannel) -> tuple[float, float]:
    """Ways on which a thread takes up its speed and brakes, mm along its axis; 0 for those that the axes allow.

    SD42010 (its description in the list manual is general knowledge here): below 0 by the acceleration of the axis, 0
    at once, above 0 evenly over that way, whatever acceleration it asks for.
    """
    data = channel.memory.data
    values = (data.number(DATUM, element) for element in RAMPS.values())
    at_start, at_end = (0.0 if value < 0.0 else max(value, AT_ONCE_MM) for value in values)
    return at_start, at_end


def start_angle(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """SF: the start angle, modal, as SD42000; 16730 for one that is no part of a turn."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        angle = number(values, position)
        if not 0.0 <= angle < TURN:
            raise AlarmError("16730")
        channel.memory.data.write(START_ANGLE, (), angle)

    return run
