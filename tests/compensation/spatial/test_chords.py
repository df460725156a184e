"""How many chords the tip of a tool that turns needs."""

from __future__ import annotations

from math import cos, radians, sin
from typing import TYPE_CHECKING

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move
from polycnc.compensation.spatial.chords import MOST_CHORDS, bends, doubled, strays
from polycnc.toolpath.kinds import Kind
from polycnc.transformation.orientation.turning import Turning

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector


class Leaning:
    """A tool that leans along Y by the axis in the fourth column."""

    def tool_at(self, position: Sequence[float]) -> Vector:
        angle = radians(position[3])
        return (0.0, sin(angle), cos(angle))


def line(turning: Turning | None) -> MovePath:
    move = Move(Kind.FEED, [0.0, 0.0, 0.0, 0.0], [10.0, 0.0, 0.0, 40.0], turning=turning)
    return MovePath(move, (0, 1, 2), in_chords=True)


def test_an_even_turn_never_strays() -> None:
    assert not strays(line(None), Leaning(), 1)


def test_a_turn_strays_along_chords_that_are_too_long() -> None:
    path = line(Turning((3,), (0.25, 1.0), ((20.0,), (40.0,))))
    assert strays(path, Leaning(), 1)
    count = doubled(1, lambda n: strays(path, Leaning(), n))
    assert not strays(path, Leaning(), count)
    assert 8 <= count <= 128


def test_pieces_between_chords_have_no_turning_of_their_own() -> None:
    path = line(Turning((3,), (0.25, 1.0), ((20.0,), (40.0,))))
    piece = path.between(0.1, 0.6)
    assert piece.turning is None
    assert (piece.start[3], piece.end[3]) == (path.at(0.1)[3], path.at(0.6)[3])


def test_no_more_chords_than_the_most() -> None:
    assert doubled(3, lambda _: True) >= MOST_CHORDS
    assert doubled(1, lambda n: bends(lambda part: (part * part, 0.0, 0.0), n)) == 16
