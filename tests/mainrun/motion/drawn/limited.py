"""Programs of SINUMERIK that leave axes parts of their velocity, acceleration and jerk, also under transformations."""

from __future__ import annotations

from math import cos, radians, sin

from tests.mainrun.motion.random_programs import Cylinder, FiveAxes, Inclined, Polar, Vectors, Writer

#: Per cent that a program leaves an axis.
PARTS = (5, 10, 25, 50, 80)
#: Where acceleration and jerk are concerned, also more than there is by itself.
MORE = (*PARTS, 150, 200)
#: Highest velocity of an axis of `mill3` in cuts, as a part of that in rapids.
CUTTING = 15.0 / 24.0


class Limited(Writer):
    """Limits of single axes, as the program names them before it begins."""

    axes: tuple[str, ...] = ()

    def modes(self) -> str:
        draw, words = self.random, super().modes()
        for axis in draw.sample(self.axes, draw.randint(1, 2)):
            kind = draw.choice(("ACC", "ACC", "VELOLIM", "JERKLIM"))
            per_cent = draw.choice(PARTS if kind == "VELOLIM" else MORE)
            left = {"ACC": self.left, "VELOLIM": self.left_speed, "JERKLIM": self.left_jerk}[kind]
            if axis not in left:
                left[axis] = 0.01 * per_cent
                words += f"\n{kind}[{axis}]={per_cent}"
        return words


class LimitedMill(Limited):
    """Without a transformation."""

    axes = ("X", "Y", "Z")


class SlowAxes(Limited):
    """Contours with limited jerk in which some axes are slow, within tolerances that let corners reach far."""

    heading: float = 0.0

    def modes(self) -> str:
        draw = self.random
        words = f"SOFT {draw.choice(('G641 ADIS=0.5', 'G64', 'G645'))} CTOL={draw.choice((0.01, 0.05, 0.3))}"
        for axis in draw.sample("XYZ", draw.randint(1, 2)):
            per_cent = draw.choice((5, 10, 25, 50))
            self.left_speed[axis] = 0.01 * per_cent * CUTTING
            words += f"\nVELOLIM[{axis}]={per_cent}"
        return words

    def program(self) -> str:
        draw = self.random
        self.lines = [f"G71 G90 {self.modes()}"]
        size = draw.choice((0.1, 0.5, 3.0, 20.0))
        self.feed, self.heading = f" F{draw.choice((3000, 10_000, 20_000))}", draw.uniform(0.0, 360.0)
        for _ in range(draw.randint(3, 12)):
            self.side(size * draw.uniform(0.3, 2.0), size)
        return "\n".join([*self.lines, "M30", ""])

    def side(self, way: float, size: float) -> None:
        """A line, now and then along an axis or nearly so, or an arc."""
        draw, (x, y, z) = self.random, self.place
        if draw.random() < 0.4:
            self.heading = draw.choice((0.0, 90.0, 180.0, 270.0)) + draw.choice((0.0, 3.0, -2.0))
        else:
            self.heading += draw.uniform(-120.0, 120.0)
        angle, is_arc = radians(self.heading), draw.random() < 0.15
        if not is_arc and draw.random() < 0.2:
            z = round(draw.uniform(-size, size), 4)
        self.place = round(x + way * cos(angle), 4), round(y + way * sin(angle), 4), z
        radius = 0.5 * way * draw.uniform(1.05, 2.0) + 0.01
        self.write("G2" if is_arc else "G1", rest=f" CR={radius:.4f}" if is_arc else "")


class LimitedPolar(Limited, Polar):
    """On the end face of a lathe."""

    axes = ("X", "C")


class LimitedCylinder(Limited, Cylinder):
    """On a cylinder."""

    axes = ("X", "Z", "C")


class LimitedInclined(Limited, Inclined):
    """Behind an inclined axis."""

    axes = ("MU", "MZ")


class LimitedFiveAxes(Limited, FiveAxes):
    """Under the tip of a tool."""

    axes = ("X", "Y", "Z", "A", "C")


class LimitedVectors(Limited, Vectors):
    """Under the tip of a tool that turns on great circles."""

    axes = ("X", "Y", "Z", "A", "C")


KINDS: tuple[type[Limited], ...] = (
    LimitedMill,
    SlowAxes,
    LimitedPolar,
    LimitedCylinder,
    LimitedInclined,
    LimitedFiveAxes,
    LimitedVectors,
)
