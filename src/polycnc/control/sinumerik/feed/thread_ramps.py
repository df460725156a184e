"""DITS, DITE: paths on which a thread takes up speed and brakes (Fundamentals, G33).

They are setting data; the planner lets the axes take up speed as they can.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.tables import length_factor

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

#: The element of the setting datum that a word writes.
RAMPS = {"DITS": 0, "DITE": 1}
DATUM = "$SC_THREAD_RAMP_DISP"
#: As fast as the axis can.
BY_DYNAMICS = -1.0


def ramp(draft: Draft, position: int, shape: WordShape) -> Step:
    """DITS, DITE: the path, modal, as SD42010; below 0 as the dynamics of the axis allow."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        wanted = value * factor if value >= 0.0 else BY_DYNAMICS
        channel.memory.data.write(DATUM, (RAMPS[shape.address],), wanted)

    return run
