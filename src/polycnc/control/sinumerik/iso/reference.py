"""G28 and G30 of the ISO dialect: over a point to the reference points."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.iso.holes import with_motion
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.transformations import seat
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord

#: P of G30: the second to fourth reference point.
_POINTS = (2, 3, 4)


def return_to(running: IsoRun, word: IsoWord) -> None:
    """G28, G30: at rapid to the point that the words say, then the named axes to their reference points.

    Raises:
        AlarmError: 17630 for an axis that a transformation uses; PC0001 without axes, with a radius compensation, and
            for another P than 2 to 4.
    """
    channel, number = running.channel, 1
    if word.code == "G30":
        chosen = running.take("P")
        number = 2 if chosen is None else int(chosen.value)
        if number not in _POINTS or (chosen is not None and chosen.value != number):
            raise running.refused(word)
    names = [axis.letter for axis in running.axis_words()]
    if not names or channel.mode["compensation"] != "G40":
        raise running.refused(word)
    running.positions = True
    with_motion(running, "G0")
    running.after.append(partial(_go_on, running, names, number - 1))


def _go_on(running: IsoRun, names: list[str], point: int) -> None:
    channel = running.channel
    columns = [channel.memory.column(name) for name in names]
    seat.refuse_transformed(channel, columns, "17630")
    points = {column: channel.axis_data[column].reference_points[point] for column in columns}
    moves.to_machine(channel, Kind.REF, points)
