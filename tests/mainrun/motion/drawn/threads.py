"""Threads of a lathe in chains: along it, across it and oblique, with a lead that stays or changes."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING, ClassVar

from tests.mainrun.motion.random_programs import FEEDS, Writer

if TYPE_CHECKING:
    from random import Random

#: Acceleration along a thread below which the axes of the machine follow it, mm/s².
MOST_PULL = 2000.0
#: Ways on which a thread takes up its speed and brakes without exceeding what its axes may.
RAMPS = (-1, 8, 20)
LEADS = (0.75, 1.5, 3.0)
WAYS = {"along": (0.0, -1.0), "across": (1.0, 0.0), "slope": (0.2, -1.0), "steep": (1.0, -0.6)}


class Threads(Writer):
    """Cuts of threads, each a chain from the same place on, with rapids and cuts of other kinds between them."""

    machine: ClassVar[str] = "lathe2"
    setup: ClassVar[dict[str, object]] = {}

    def program(self) -> str:
        draw = self.random
        rpm, sense = draw.choice((100, 400, 900, 1400)), draw.choice((3, 3, 4))
        if self.siemens:
            head = f"G18 G90 DIAMON {self.modes()}\nG95 S{rpm} M{sense}"
        else:
            head = f"G21 {draw.choice(('G64', 'G61'))}\nG99 G97 S{rpm} M{sense}"
        self.lines = [*head.split("\n")]
        for _ in range(draw.randint(1, 3)):
            if "BRISK" in head and draw.random() < 0.4:
                self.lines.append(f"DITS={draw.choice(RAMPS)} DITE={draw.choice(RAMPS)}")
            self.lines += ["G0 X60. Z5.", *chain(draw, rpm, siemens=self.siemens, steps=draw.random() < 0.3)]
            if draw.random() < 0.3:
                self.lines.append(f"G1 X100. F{draw.choice(FEEDS) / 20000.0}")
            self.lines.append("G0 X120.")
        return "\n".join([*self.lines, "M30", ""])


def chain(draw: Random, rpm: int, *, siemens: bool, steps: bool) -> list[str]:
    """Blocks of a chain from X60 Z5 on; with `steps` a block begins with another lead than the one before has left."""
    x, z, lead, lines, way = 60.0, 5.0, draw.choice(LEADS), [], draw.choice(list(WAYS))
    for _ in range(draw.randint(1, 4)):
        if draw.random() < 0.2:
            way = draw.choice(list(WAYS))
        if steps:
            lead = draw.choice(LEADS)
        dx, dz = WAYS[way]
        length = draw.choice((0.5, 4.0, 12.0, 30.0))
        x, z = round(x + 2.0 * dx * length, 3), round(z + dz * length, 3)
        longest = length * max(abs(dx), abs(dz))
        last = lead * draw.uniform(0.6, 1.6)
        growth = draw.choice((0.0, 1.0)) * (last * last - lead * lead) / (2.0 * longest)
        growth = round(growth, 4)
        if siemens and abs(growth) * (rpm / 60.0) ** 2 > MOST_PULL:  # 10604
            growth = 0.0
        lines.append(block(siemens, x, z, lead, growth, along_x=abs(dx) >= abs(dz)))
        lead = round(sqrt(lead * lead + 2.0 * growth * longest), 4)
    return lines


def block(siemens: bool, x: float, z: float, lead: float, growth: float, *, along_x: bool) -> str:
    """A block of a thread."""
    place = f"X{x:.3f} Z{z:.3f}"
    if not siemens:
        return f"G34 {place} F{lead} K{growth}" if growth else f"G32 {place} F{lead}"
    letter = "I" if along_x else "K"
    if growth:
        return f"{'G34' if growth > 0.0 else 'G35'} {place} {letter}{lead} F{abs(growth)}"
    return f"G33 {place} {letter}{lead}"
