"""Programs of SINUMERIK: DRIVE, frames, cycles that are called modally, taps."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, ClassVar

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


class Smoothed(Blocks):
    """Blocks of a tip whose tool turns to and fro, by a tolerance or a distance of its own."""

    machine = "mill5-ca-head"
    SMOOTHED: ClassVar[tuple[str, ...]] = (
        "OST\n$SC_ORI_SMOOTH_TOL={tolerance}",
        "OSD\n$SC_ORI_SMOOTH_DIST={distance}",
        "OST OTOL={tolerance}",
        "COMPON\n$SC_COMPRESS_ORI_TOL={tolerance}",
    )

    def program(self) -> str:
        draw, x, y = self.random, 0.0, 0.0
        smoothed = draw.choice(self.SMOOTHED)
        smoothed = smoothed.format(tolerance=draw.choice((0.05, 0.5, 2.0)), distance=draw.choice((0.2, 2.0)))
        corners = draw.choice(("G64", "G642", "G645"))
        self.lines = [f"G71 G90 BRISK {corners} {smoothed}", "TRAORI", "G1 X0 Y0 A10 C0 F2000"]
        for k in range(draw.randint(3, 10)):
            reach = draw.choice((1.0, 5.0))
            x += draw.uniform(0.2, 1.0) * reach
            y += draw.choice((0.0, draw.uniform(-0.5, 0.5))) * reach
            turned = f" C{draw.uniform(-10.0, 10.0):.3f}" if draw.random() < 0.3 else ""
            feed = f" F{draw.choice(FEEDS)}" if k == 0 or draw.random() < 0.2 else ""
            self.lines.append(f"X{x:.3f} Y{y:.3f} A{10.0 + draw.uniform(-5.0, 5.0):.3f}{turned}{feed}")
        return "\n".join([*self.lines, "TRAFOOF", "M30", ""])


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
