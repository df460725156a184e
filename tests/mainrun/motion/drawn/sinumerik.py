"""Programs of SINUMERIK: DRIVE, frames, cycles that are called modally, taps."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from tests.mainrun.motion.drawn.mixed import Blocks
from tests.mainrun.motion.random_programs import FEEDS

if TYPE_CHECKING:
    from collections.abc import Callable


class Reduced(Blocks):
    """Axes that accelerate less above a speed (DRIVE)."""

    def modes(self) -> str:
        return re.sub("BRISK|SOFT", "DRIVE", super().modes())

    def kinds(self) -> list[Callable[[], None]]:
        return [*super().kinds(), self.spline]


class Frames(Blocks):
    """Blocks in frames, one upon the other or instead of each other."""

    moves_places = True

    def between(self) -> str:
        draw = self.random
        angle = draw.uniform(-180.0, 180.0)
        return draw.choice(
            (
                "",
                f"ROT RPL={angle:.2f}",
                f"AROT RPL={angle:.2f}",
                f"ROT X{angle:.2f}",
                f"AROT Y{angle:.2f}",
                "SCALE X0.5 Y0.5 Z0.5",
                "ASCALE X1.7 Y1.7",
                "AMIRROR X0",
                "MIRROR Y0",
                "TRANS X3 Y1 Z2",
                "ATRANS X-1.5",
                "ROT",
            )
        )


class Calls(Blocks):
    """Cycles of holes and taps, called once, at every place, and at those of a pattern."""

    CYCLES = (
        "CYCLE81(10,0,{r},-{z})",
        "CYCLE82(10,0,{r},-{z},,0.1)",
        "CYCLE83(10,0,{r},-{z},,,{q},,0.05,0.02,1,{kind})",
        "CYCLE84(10,0,{r},-{z},,0,5,,{lead},0,{rpm},{rpm})",
        "CYCLE85(10,0,{r},-{z},,0.05,600,900)",
    )
    PATTERNS = "HOLES1({x},{y},{angle},5,7,{n})", "HOLES2({x},{y},12,{angle},0,{n})", "X{x} Y{y}"

    def head(self) -> str:
        return f"{super().head()} M3 S1000 F{self.random.choice((200, 1000))}\nG0 X0 Y0 Z10"

    def kinds(self) -> list[Callable[[], None]]:
        return [self.called, self.called, self.line]

    def called(self) -> None:
        draw = self.random
        self.lines.append("G0 Z10")
        cycle = draw.choice(self.CYCLES).format(
            r=draw.choice((1, 2.5)), z=round(draw.uniform(1.0, 14.0), 2), q=round(draw.uniform(1.0, 6.0), 2),
            kind=draw.choice((0, 1)), lead=draw.choice((0.8, 1.25)), rpm=draw.choice((200, 500)),
        )  # fmt: skip
        x, y = (round(draw.uniform(-20.0, 20.0), 3) for _ in "xy")
        self.place = x, y, 10.0
        if draw.random() < 0.4:
            self.lines += [f"G0 X{x} Y{y}", cycle]
        else:
            places = draw.choice(self.PATTERNS).format(
                x=x, y=y, angle=draw.randint(-90, 90), n=draw.randint(1, 3)
            )
            self.lines += [f"MCALL {cycle}", places, "MCALL"]
        self.lines += [f"G1 G94 F{draw.choice(FEEDS)}"]


class Taps(Blocks):
    """Taps without a chuck that gives way (G331, G332)."""

    def head(self) -> str:
        return f"{super().head()}\nSPOS=0\nG0 X0 Y0 Z5"

    def kinds(self) -> list[Callable[[], None]]:
        return [self.tap, self.line]

    def tap(self) -> None:
        draw = self.random
        x, y, _ = self.place
        lead, rpm = draw.choice((0.8, 1.25)), draw.choice((200, 600))
        self.lines += [
            f"SPOS=0 G0 X{x} Y{y} Z5",
            f"G331 Z-{draw.uniform(2.0, 15.0):.2f} K{lead} S{rpm}",
            f"G332 Z{draw.choice((3, 5))} K{lead}",
            f"G1 F{draw.choice(FEEDS)}",
        ]
