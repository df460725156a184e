"""Random programs of short cuts under transformations, whose ends functions of a control leave."""

from __future__ import annotations

from math import cos, radians, sin
from typing import TYPE_CHECKING, ClassVar

from tests.mainrun.motion.random_programs import FEEDS, Compressed

if TYPE_CHECKING:
    from random import Random

#: Machines, and the axis that tilts the tool.
TIPS = (
    ("mill5-ca-head", "A", "C"),
    ("mill5-bc-head", "B", "C"),
    ("mill5-ac-table", "A", "C"),
    ("mill5-ab-head", "A", "B"),
)
#: What the direction may be off by, degrees: of each of two axes that are square to each other.
OF_EACH = 0.5**0.5


class OnTip(Compressed):
    """Contours of a tool's tip while the tool turns, with noise in both."""

    turn_tolerance = 0.0
    machine, tilt, around = TIPS[0]
    tail: ClassVar[str] = "COMPOF TRAFOOF"
    #: Positions of the two axes; how far they turn in a block, and how far beside that.
    turned = (20.0, 0.0)
    pace = (0.0, 0.0)
    beside = 0.0

    def program(self) -> str:
        draw = self.random
        self.turned = draw.choice((20.0, 20.0, 3.0)), 180.0  # a modulo axis has room on both sides
        self.lines = self.begun()
        self.feed = " F2000"
        self.write("G1")
        blocks = (self.contour, self.contour, self.contour, self.line, self.facets)
        for _ in range(draw.randint(1, 3)):
            self.feed = f" F{draw.choice(FEEDS)}." if draw.random() < 0.4 else ""
            draw.choice(blocks)()
        return "\n".join([*self.lines, self.tail, "M30", ""])

    def begun(self) -> list[str]:
        draw = self.random
        self.tolerance, self.turn_tolerance = draw.choice((0.005, 0.01, 0.05)), draw.choice((0.01, 0.05, 0.2))
        on = f"{draw.choice(('COMPON', 'COMPCURV', 'COMPCAD'))} CTOL={self.tolerance}"
        if draw.random() < 0.7:
            on, self.turn_tolerance = f"{on} OTOL={self.turn_tolerance}", self.turn_tolerance * OF_EACH
        else:
            on = f"{on} ATOL[{self.tilt}]={self.turn_tolerance} ATOL[{self.around}]={self.turn_tolerance}"
        corners = draw.choice(("G64", "G642", "G645"))
        how = draw.choice(("BRISK", "SOFT"))
        return [f"G71 G90 G94 {how} {corners} {on}", "T1 D1", "TRAORI"]

    def contour(self) -> None:
        draw = self.random
        self.pace = draw.uniform(-0.1, 0.1), draw.choice((0.0, draw.uniform(-0.3, 0.3)))
        self.beside = self.turn_tolerance * draw.choice((0.02, 0.3, 0.9))
        super().contour()
        self.pace, self.beside = (0.0, 0.0), 0.0

    def write(self, code: str, *, rest: str = "") -> None:
        a, c = (at + by for at, by in zip(self.turned, self.pace, strict=True))
        self.turned = min(max(a, 2.0), 50.0), c
        super().write(code, rest=self.told() + rest)

    def told(self) -> str:
        """How the tool stands."""
        a, c = (at + self.random.uniform(-self.beside, self.beside) for at in self.turned)
        return f" {self.tilt}{a:.4f} {self.around}{c:.4f}"


class OnTipByVectors(OnTip):
    """The same by directions of the tool."""

    def begun(self) -> list[str]:
        return [*super().begun(), "ORIVECT"]

    def told(self) -> str:
        a, c = (radians(at + self.random.uniform(-self.beside, self.beside)) for at in self.turned)
        return f" A3={sin(a) * cos(c):.6f} B3={sin(a) * sin(c):.6f} C3={cos(a):.6f}"


class OnTipOfSyntec(OnTip):
    """The same under the filter of G05.1, which moves the tip alone."""

    tail = "G49 G05.1 Q0"

    def begun(self) -> list[str]:
        draw = self.random
        self.tolerance, self.turn_tolerance = draw.choice((0.005, 0.01, 0.05)), 0.01
        return ["G71 G90 G94", f"G05.1 Q1 E{self.tolerance}", "G43.4 H1"]


def on_a_machine(made: type[OnTip], draw: Random, control: str) -> OnTip:
    """A writer for a machine that is drawn."""
    named = dict(zip(("machine", "tilt", "around"), draw.choice(TIPS), strict=True))
    writer: OnTip = type(made.__name__, (made,), named)(draw, control)
    return writer


class InPolarPlane(Compressed):
    """Contours on the end face of a lathe."""

    machine = "lathe-c-transmit"

    def program(self) -> str:
        draw = self.random
        self.tolerance = draw.choice((0.005, 0.01, 0.05))
        on = f"{draw.choice(('COMPON', 'COMPCURV', 'COMPCAD'))} CTOL={self.tolerance}"
        begun = [f"G71 G90 G94 {draw.choice(('BRISK', 'SOFT'))} {draw.choice(('G64', 'G642'))}", "T1 D1"]
        self.lines = [*begun, "G0 X60 Z5", "TRANSMIT", on]
        self.place = draw.uniform(3.0, 30.0), draw.uniform(-20.0, 20.0), 0.0
        blocks = (self.contour, self.contour, self.line, self.facets)
        self.feed = f" F{draw.choice(FEEDS)}."
        for _ in range(draw.randint(1, 3)):
            draw.choice(blocks)()
        return "\n".join([*self.lines, "COMPOF", "TRAFOOF", "G0 X80", "M30", ""])


class OnCylinder(InPolarPlane):
    """Contours on the surface of a cylinder."""

    def program(self) -> str:
        return super().program().replace("TRANSMIT", "TRACYL(60)").replace("G0 X60 Z5", "G0 X60 Z-5")
