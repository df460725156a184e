"""A tiny word-address reader that feeds compensation stages, so that tests read like programs."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeVar

from polycnc.channel.moves.path import Move, PlacedEvent, Sink, Stage
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.compensation.policy import Policy, Violation
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from collections.abc import Mapping

S = TypeVar("S", bound=Stage)
CODES = {violation: violation.name for violation in Violation}
G17 = Plane(0, 1, 2)
_KINDS = {0: Kind.RAPID, 1: Kind.FEED, 2: Kind.CW, 3: Kind.CCW}


class Recorder(Sink):
    """The end of a chain: keeps moves, and everything in order."""

    def __init__(self) -> None:
        self.moves: list[Move] = []
        self.order: list[str] = []
        self.flushed = 0

    def move(self, move: Move) -> None:
        self.moves.append(move)
        self.order.append(f"{move.kind.name.lower()} {move.line}")

    def event(self, event: PlacedEvent) -> None:
        self.order.append(f"{event.event.type}{event.event.data['code']}")

    def block(self) -> None:
        self.order.append(";")

    def flush(self) -> None:
        self.flushed += 1

    @property
    def points(self) -> list[tuple[float, float]]:
        """End points in X and Y, rounded."""
        return [(round(m.end[0], 4) + 0.0, round(m.end[1], 4) + 0.0) for m in self.moves]

    @property
    def rows(self) -> list[tuple[str, float, float]]:
        """Kind and end point of every move."""
        return [(m.kind.name.lower(), u, v) for m, (u, v) in zip(self.moves, self.points, strict=True)]


def into(after: Stage, stage: S) -> S:
    """A stage that passes on to another one."""
    stage.after = after
    return stage


class Reader:
    """Absolute X Y Z, arc centres I J from the start, D for the radius; `start` is where it stands."""

    def __init__(
        self,
        policy: Policy,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        violations: Mapping[Violation, str] = CODES,
        radius: float = 5.0,
    ) -> None:
        self.recorder = Recorder()
        self.stage = into(self.recorder, CutterCompensation(G17, policy, violations))
        self.position = list(start)
        self.kind = Kind.RAPID
        self.radius = radius
        self.line = 0

    def run(self, program: str) -> Recorder:
        for text in program.strip().splitlines():
            self.block(text.split("(")[0])
        self.stage.flush()
        return self.recorder

    def block(self, text: str) -> None:
        self.line += 1
        words = re.findall(r"([A-Z])([-+.\d]+)", text)
        codes = [int(value) for letter, value in words if letter == "G"]
        values = {letter: float(value) for letter, value in words if letter != "G"}
        for code in codes:
            self.kind = _KINDS.get(code, self.kind)
        place = Move(self.kind, self.position, self.position, line=self.line)
        vector = (values.get("I", 0.0), values.get("J", 0.0))
        has_vector = "I" in values or "J" in values
        straight = self.kind in (Kind.RAPID, Kind.FEED)
        if "D" in values:
            self.radius = values["D"]
            self.stage.change_radius(self.radius)
        for code in codes:
            if code == 40:
                self.stage.cancel(vector if has_vector else None, place)
            elif code in (41, 42):
                self.stage.engage(1 if code == 41 else -1, self.radius, place=place)
            elif code == 38:
                self.stage.hold_vector()
            elif code == 39:
                self.stage.corner_arc(place, vector if has_vector else None)
        if has_vector and straight and not {39, 40} & set(codes):
            self.stage.forced_vector(vector)
        if {"X", "Y", "Z"} & set(values):
            self._move(values, vector)
        if "M" in values:
            self.stage.event(PlacedEvent(Auxiliary(int(values["M"])), 0, self.line, 0))
        self.stage.block()

    def _move(self, values: dict[str, float], vector: tuple[float, float]) -> None:
        start = self.position
        end = [values.get(letter, start[i]) for i, letter in enumerate("XYZ")]
        center = None
        kind = self.kind
        if kind in (Kind.CW, Kind.CCW):
            center = (start[0] + vector[0], start[1] + vector[1], start[2])
        elif start == end:
            return
        self.stage.move(Move(kind, start, end, 10.0, line=self.line, center=center))
        self.position = end


def run(policy: Policy, program: str, **options: object) -> Recorder:
    """The recorded rows of a program."""
    return Reader(policy, **options).run(program)  # type: ignore[arg-type]
