"""G28, G30, G53 and G31 of the ISO dialect: to reference points, to a point of the machine, to what a probe touches."""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.iso.holes import with_motion
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
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


def to_machine(running: IsoRun, word: IsoWord) -> None:
    """G53: at rapid to a point of the machine, whatever motion function is modal.

    Raises:
        AlarmError: 17630 for an axis that a transformation uses; PC0001 without axes, under G91, with a radius
            compensation or a length of the tool, for the dialect wants these cancelled.
    """
    channel = running.channel
    words = running.axis_words()
    codes = running.block.codes
    incremental = "G91" in codes or (channel.mode["distance"] == "G91" and "G90" not in codes)
    if not words or incremental or channel.mode["compensation"] != "G40" or any(channel.coordinates.offsets):
        raise running.refused(word)
    running.positions = True
    running.taken += words
    running.after.append(partial(_to_machine, running, words))


def to_probe(running: IsoRun, word: IsoWord) -> None:
    """G31: straight at F until the first probe touches; the rest of the way is dropped (MEAS=1).

    Raises:
        AlarmError: PC0001 without axes and with a radius compensation.
    """
    if not running.axis_words() or running.channel.mode["compensation"] != "G40":
        raise running.refused(word)
    running.positions = True
    with_motion(running, "G1")
    running.extra.append("MEAS=1")


def _to_machine(running: IsoRun, words: list[IsoWord]) -> None:
    channel, points = running.channel, {}
    for word in words:
        column = channel.memory.column(word.letter)
        points[column] = word.value if channel.axis_data[column].rotary else running.length(word)
    seat.refuse_transformed(channel, list(points), "17630")
    moves.to_machine(channel, Kind.RAPID, points)


def _go_on(running: IsoRun, names: list[str], point: int) -> None:
    channel = running.channel
    columns = [channel.memory.column(name) for name in names]
    seat.refuse_transformed(channel, columns, "17630")
    points = {column: channel.axis_data[column].reference_points[point] for column in columns}
    moves.to_machine(channel, Kind.REF, points)
