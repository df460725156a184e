"""Blocks of a mill with something between them: feeds of another kind, dwells, M codes, inches, frames, rotary axes."""

from __future__ import annotations

import re
from math import cos, radians, sin
from typing import TYPE_CHECKING, ClassVar

from tests.mainrun.motion.random_programs import FEEDS, HEADS, Writer

if TYPE_CHECKING:
    from collections.abc import Callable


class Blocks(Writer):
    """A head, and blocks drawn from `kinds`, each after what stands `between`."""

    #: Whether behind what stands between a place has another meaning, so that no arc may begin there.
    moves_places: ClassVar[bool] = False

    def head(self) -> str:
        modes = self.modes() if self.siemens else self.random.choice(("G64", "G61"))
        return f"{HEADS[self.control]} {modes}"

    def kinds(self) -> list[Callable[[], None]]:
        return [self.line, self.facets, self.arc, self.helix, self.rapid, self.onward]

    def between(self) -> str:
        """Lines in front of the next block."""
        return ""

    def program(self) -> str:
        draw = self.random
        self.lines = [self.head()]
        for k in range(draw.randint(2, 5)):
            if between := self.between():
                self.lines.append(between)
            self.feed = f" F{draw.choice(FEEDS)}." if k == 0 or draw.random() < 0.4 else ""
            if between and self.moves_places:
                self.line()
            draw.choice(self.kinds())()
        return "\n".join([*self.lines, *self.ends(), "M30", ""])

    def ends(self) -> list[str]:
        return []


class Pauses(Blocks):
    """Dwells, coolant, spindle and exact stops between blocks."""

    def between(self) -> str:
        dwell = "G4 F0.137" if self.siemens else "G4 P137"
        return self.random.choice(
            ("", dwell, "M8", "M9", "M3 S800", "M5", "G9 G1 Z1.5 F700.", f"M8\n{dwell}", "S500")
        )


class Questions(Blocks):
    """Between blocks the program asks for what only the machine knows, and waits for its answer."""

    ASKED: ClassVar[dict[str, tuple[str, ...]]] = {
        "sinumerik-840d": ("STOPRE", "R1=$AA_IM[X]", "R1=$A_IN[1]\nR2=$A_IN[2]", "M1"),
        "syntec-mill": ("M1", "M1 M8"),
        "fanuc-m": ("#1=#1000", "#1=#1000\n#2=#1001", "M1"),
        "meldas-m": ("#1=#1000", "#1=#1032", "M1"),
    }

    def between(self) -> str:
        return self.random.choice(("", *self.ASKED[self.control]))


class Functions(Blocks):
    """Auxiliary functions beside the motion of their blocks, some longer than it."""

    def write(self, code: str, *, rest: str = "") -> None:
        function = self.random.choice(("", "", " M8", " M9"))
        super().write(code, rest=f"{rest}{function}")


class Revolutions(Blocks):
    """Feeds a revolution, and of them back to feeds a minute."""

    RPM = 1000

    def program(self) -> str:
        lines = super().program().splitlines()
        lines[0] += f" M3 S{self.RPM} G95"
        text = "\n".join([*lines, ""])
        return re.sub(r" F(\d+)\.", lambda found: f" F{int(found[1]) / self.RPM:.3f}", text)


class InverseTimes(Blocks):
    """Feeds by the time of a block (G93)."""

    def program(self) -> str:
        lines = [re.sub(r" F\d+\.", "", line) for line in super().program().splitlines()]
        lines[0] += " G93"
        for k, line in enumerate(lines):
            if "X" in line and not line.startswith("G0 "):
                lines[k] += f" F{self.random.choice((20, 100, 300))}."
        return "\n".join([*lines, "G94", ""]).replace("M30\nG94\n", "G94\nM30\n")


class Inches(Blocks):
    """The same in inches."""

    def program(self) -> str:
        unit = {"G71": "G700", "G21": "G20"} if self.siemens else {"G71": "G70", "G21": "G20"}
        text = super().program()
        text = re.sub(r"\b([XYZIJK])(-?\d+\.\d+)", lambda f: f"{f[1]}{float(f[2]) / 25.4:.5f}", text)
        text = re.sub(r" F(\d+)\.", lambda f: f" F{int(f[1]) / 25.4:.1f}", text)
        return re.sub(r"\b(G71|G21)\b", lambda f: unit[f[1]], text)


class Oblique(Inches):
    """Corners of lines that lie across all axes, in inches."""

    def kinds(self) -> list[Callable[[], None]]:
        return [self.facets, self.line, self.onward]


class Rotary(Blocks):
    """A rotary axis that counts round beside the linear ones, and alone."""

    machine = "mill4"
    angle = 0.0

    def kinds(self) -> list[Callable[[], None]]:
        return [self.turned, self.turned, self.turned, self.line, self.rapid, self.arc]

    def turned(self) -> None:
        draw = self.random
        for _ in range(draw.randint(1, 3)):
            self.angle = round(self.angle + draw.uniform(-1.0, 1.0) * draw.choice((3.0, 40.0, 300.0)), 3)
            to = f" A{self.word()}"
            if draw.random() < 0.3:
                self.lines.append(f"{draw.choice(('G0', 'G1 F2000.'))}{to}")
                continue
            self.by(draw.choice((0.3, 10.0)))
            self.write("G1", rest=to)

    def word(self) -> str:
        if self.siemens and (way := self.random.choice(("", "DC", "ACP", "ACN", "IC"))):
            return f"={way}({self.angle if way == 'IC' else self.angle % 360.0:.3f})"
        return f"{self.angle % 360.0 if self.siemens else self.angle:.3f}"


class Contour(Blocks):
    """A contour beside which the tool goes: G41 or G42 with corners inside and outside, lines and arcs."""

    setup: ClassVar[dict[str, object]] = {"tools": {1: {"length": 50.0, "radius": 2.5}}}

    def head(self) -> str:
        return f"{super().head()}{' T1 D1' if self.siemens else ''}"

    def program(self) -> str:
        draw = self.random
        side = draw.choice(("G41", "G42"))
        corners = f"{draw.choice(('G450', 'G451'))} " if self.siemens else ""
        self.lines = [self.head()]
        self.place = 10.0, 0.0, 0.0
        self.feed = f" F{draw.choice(FEEDS)}."
        number = "" if self.siemens else " D1"
        self.write(f"{corners}{side} G1", rest=number)
        way = 0.0
        for k in range(draw.randint(2, 6)):
            if k:
                way += draw.choice((draw.uniform(-100.0, 100.0), draw.uniform(-20.0, 20.0), 0.0))
            length = draw.uniform(9.0, 25.0)
            x, y, z = self.place
            x += length * cos(radians(way))
            y += length * sin(radians(way))
            self.place = round(x, 3), round(y, 3), z
            if draw.random() < 0.3:
                radius = length * draw.uniform(1.5, 4.0)
                word = "CR=" if self.siemens else "R"
                self.write(draw.choice(("G2", "G3")), rest=f" {word}{radius:.3f}")
            else:
                self.write("G1")
        x, y, z = self.place
        self.lines.append(f"G40 G1 X{x + 10.0 * cos(radians(way)):.3f} Y{y + 10.0 * sin(radians(way)):.3f}")
        return "\n".join([*self.lines, "M30", ""])
