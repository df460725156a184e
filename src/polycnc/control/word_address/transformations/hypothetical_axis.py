"""G07 hypothetical axis interpolation: an axis takes part in the path but does not move.

A helix whose one plane axis is hypothetical becomes a sine curve of the others; it is written as chords.
"""

from __future__ import annotations

from polycnc.channel.moves.knots import join
from polycnc.channel.moves.path import Rank, Stage
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.transformation.kinematic.standing import StandingAxes

#: How far the chords of a sine curve may leave it, mm.
CHORD_TOLERANCE_MM = 0.001


@dataclass(slots=True)
class HypotheticalState(State, lifetime=Lifetime.RESET):
    """Axes that stand while the path moves them (G07); None for none."""

    standing: StandingAxes | None = None


def switch(channel: WordAddressChannel, words: Words) -> None:
    """G07 Y0: the axis becomes hypothetical; G07 Y1: it moves again, and the path begins where it stands."""
    from polycnc.transformation.kinematic.standing import StandingAxes

    named = {word.axis: words.typed(word.address) for word in words.plan.axis_words}
    if not named or any(value not in (0.0, 1.0) for value in named.values()):
        raise words.fail("hypothetical_format", "G7")
    state, c = HypotheticalState.of(channel), channel.coordinates
    before = state.standing
    foreign = c.transformation is not None and c.transformation is not before
    if foreign or RadiusState.of(channel).side:
        raise words.fail("hypothetical_mode", "G7")
    position = c.from_machine(c.machine)
    kept = {} if before is None else dict(before.places)
    standing = {axis: kept.get(axis, position[axis]) for axis, value in named.items() if value == 0.0}
    standing = {**{axis: value for axis, value in kept.items() if axis not in named}, **standing}
    end(channel)
    if standing:
        state.standing = c.transformation = StandingAxes(tuple(standing.items()), c.geometry)
        channel.path.put(StandingStage(channel, state.standing))


def end(channel: WordAddressChannel) -> None:
    """Every axis moves again (also at reset)."""
    state = HypotheticalState.of(channel)
    if state.standing is None:
        return
    channel.flush()
    channel.path.take(StandingStage)
    state.standing = None
    channel.coordinates.transform(None)


class StandingStage(Stage):
    """Leads the axes while some are hypothetical."""

    rank = Rank.AXES
    lasts = True

    def __init__(self, channel: WordAddressChannel, standing: StandingAxes) -> None:
        self._channel, self._standing = channel, standing

    def move(self, move: Move) -> None:
        """Take the next move; see `Stage`."""
        u, v, w = self._plane(move)
        if move.kind in ARC_KINDS and {u, v} & self._standing.columns:
            self._chords(move, (u, v))
            return
        flat = {Kind.HELIX_CW: Kind.CW, Kind.HELIX_CCW: Kind.CCW} if w in self._standing.columns else {}
        self._straight(replace(move, kind=flat.get(move.kind, move.kind)), move.start, move.end)

    def _plane(self, move: Move) -> tuple[int, int, int]:
        """Columns of the first, second and third axis of an arc's plane."""
        w = max(range(3), key=lambda i: abs(move.normal[i]))
        x = self._standing.geometry
        return x[(w + 1) % 3], x[(w + 2) % 3], x[w]

    def _straight(self, move: Move, start: list[float], end: list[float]) -> None:
        real = self._standing.to_machine
        self.after.move(replace(move, start=real(start), end=real(end)))

    def _chords(self, move: Move, plane: tuple[int, int]) -> None:
        """The arc as chords, so close that the curve of the axes that move stays within a micrometre."""
        assert move.center is not None
        u, v = plane
        geometry = self._standing.geometry
        center = (move.center[geometry.index(u)], move.center[geometry.index(v)])
        first, last = (move.start[u], move.start[v]), (move.end[u], move.end[v])
        begin, finish = arcs.radius_of(center, first), arcs.radius_of(center, last)
        ccw = move.kind in CCW_KINDS
        sweep = arcs.sweep_angle(first, last, center, ccw) + move.turns * (arcs.TAU if ccw else -arcs.TAU)
        count = arcs.parts_for_chord_error(max(begin, finish), abs(sweep), CHORD_TOLERANCE_MM)
        angle, chords = arcs.angle_at(center, first), [replace(move, end=move.start)]
        for i in range(1, count + 1):
            part = i / count
            point = [a + (b - a) * part for a, b in zip(move.start, move.end, strict=True)]
            radius = begin + (finish - begin) * part
            point[u], point[v] = last if i == count else arcs.point_at(center, radius, angle + sweep * part)
            chords.append(
                replace(move, kind=Kind.SPLINE, center=None, turns=0.0, start=chords[-1].end, end=point)
            )
        join(self._channel, chords[1:], shows=True, counted=begin / (0.5 * (begin + finish) * abs(sweep)))
        for chord in chords[1:]:
            self._straight(chord, chord.start, chord.end)
