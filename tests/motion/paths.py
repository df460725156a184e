"""What the tests of motion share: small toolpaths, a machine, and the sampled motion of a plan."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import sqrt
from typing import TYPE_CHECKING, Any

from polycnc.machine import Machine, load_machine
from polycnc.motion.kernels.columns import Form, PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.toolpath import NO_CURVE, Context, Event, Kind, Toolpath

if TYPE_CHECKING:
    from polycnc.motion import Plan

MILL, LATHE, MILL4 = load_machine("mill3"), load_machine("lathe2"), load_machine("mill4")


def mill(acceleration: float = 1000.0, top: float = 500.0, cycle: float = 0.004) -> Machine:
    """A mill whose axes are all alike."""
    axes = tuple(replace(a, acceleration=acceleration, rapid=top, max_feed=top) for a in MILL.axes)
    return replace(MILL, axes=axes, interpolation_cycle_s=cycle)


@dataclass
class Build:
    """Writes a toolpath row by row; the context in force is replaced in parts."""

    axes: tuple[str, ...] = ("X", "Y", "Z")
    context: Context = field(default_factory=Context)
    chunk_rows: int = 65_536

    def __post_init__(self) -> None:
        self.toolpath = Toolpath(self.axes, chunk_rows=self.chunk_rows)
        self.toolpath.program_number("O0001")
        self.end = [0.0] * len(self.axes)
        self.line = 0

    def set(self, **changes: Any) -> Build:
        self.context = replace(self.context, **changes)
        return self

    def row(self, kind: Kind, *end: float, feed: float = 100.0, curve: tuple[float, ...] = ()) -> Build:
        self.line += 1
        self.end = list(end)
        number = self.toolpath.add_curve(*curve) if curve else NO_CURVE
        context = self.toolpath.context_number(self.context)
        self.toolpath.append(kind, 0, self.line, context, feed, self.end, number)
        self.toolpath.block_boundary()
        return self

    def feed(self, *end: float, feed: float = 100.0) -> Build:
        return self.row(Kind.FEED, *end, feed=feed)

    def rapid(self, *end: float) -> Build:
        return self.row(Kind.RAPID, *end, feed=float("nan"))

    def arc(self, *end: float, center: tuple[float, float], feed: float = 100.0, turns: float = 0.0) -> Build:
        return self.row(Kind.CCW, *end, feed=feed, curve=(*center, 0.0, 0.0, 0.0, 1.0, turns))

    def dwell(self, seconds: float = 0.0, revolutions: float = 0.0) -> Build:
        return self.row(Kind.DWELL, *self.end, feed=float("nan"), curve=(seconds, revolutions))

    def event(self, event: Event, *, same_block: bool = False) -> Build:
        if not same_block:
            self.line += 1
        context = self.toolpath.context_number(self.context)
        self.toolpath.append_event(event, 0, self.line, context, self.end)
        return self

    def plan(self, machine: Machine = MILL, **options: Any) -> Plan:
        return Planner(self.toolpath, machine, **options).finish()


@dataclass
class Piece:
    """A planned piece, as numbers by name."""

    length: float
    cap2: float
    pull: float
    start2: float
    end2: float
    time: float
    form: int
    row: int
    vectors: list[list[float]]

    def samples(self, steps: int) -> list[tuple[float, list[float], list[float]]]:
        """At places on the piece: x, velocities and accelerations of the axes, by interpolation."""
        t0, t1, c0, c1 = self.vectors
        result = []
        for k in range(steps + 1):
            f = k / steps
            x, u = self._at(f * self.length)
            t = [a + f * (b - a) for a, b in zip(t0, t1, strict=True)]
            c = [a + f * (b - a) for a, b in zip(c0, c1, strict=True)]
            velocity = [q * sqrt(x) for q in t]
            result.append((x, velocity, [q2 * x + q1 * u for q1, q2 in zip(t, c, strict=True)]))
        return result

    def _at(self, s: float) -> tuple[float, float]:
        if self.form == Form.CURVED:
            u = (self.end2 - self.start2) / (2.0 * self.length)
            return max(self.start2 + 2.0 * u * s, 0.0), u
        peak2 = min(self.cap2, 0.5 * (self.start2 + self.end2) + self.pull * self.length)
        up = (peak2 - self.start2) / (2.0 * self.pull)
        down = self.length - (peak2 - self.end2) / (2.0 * self.pull)
        if s < up:
            return self.start2 + 2.0 * self.pull * s, self.pull
        if s > down:
            return max(self.end2 + 2.0 * self.pull * (self.length - s), 0.0), -self.pull
        return peak2, 0.0


def pieces_of(toolpath: Toolpath, machine: Machine, **options: Any) -> list[Piece]:
    """The planned pieces of a toolpath, a straight one with its direction at both ends."""
    n, found = len(toolpath.axes), list[Piece]()
    width = piece_width(n)

    def note(records: Any, count: int) -> None:
        for at in range(0, count * width, width):
            r = list(records[at : at + width])
            vectors = [r[PieceRecord.VECTORS + k * n : PieceRecord.VECTORS + (k + 1) * n] for k in range(4)]
            found.append(
                Piece(
                    r[PieceRecord.LENGTH],
                    r[PieceRecord.CAP2],
                    r[PieceRecord.PULL],
                    r[PieceRecord.SPEED2],
                    r[PieceRecord.END2],
                    r[PieceRecord.TIME],
                    int(r[PieceRecord.FORM]),
                    int(r[PieceRecord.ROW]),
                    vectors,
                )
            )

    Planner(toolpath, machine, on_pieces=note, **options).finish()
    rows = list(toolpath.rows())
    for piece in found:
        if piece.form == Form.STRAIGHT:
            before = rows[piece.row - 1].end if piece.row else (0.0,) * n
            way = [b - a for a, b in zip(before, rows[piece.row].end, strict=True)]
            length = sqrt(sum(d * d for d in way))
            unit = [d / length for d in way]
            piece.vectors = [unit, unit, [0.0] * n, [0.0] * n]
    return found
