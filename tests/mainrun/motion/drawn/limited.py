"""Programs of SINUMERIK that leave axes parts of their velocity, acceleration and jerk, also under transformations."""

from __future__ import annotations

from tests.mainrun.motion.random_programs import Cylinder, FiveAxes, Inclined, Polar, Vectors, Writer

#: Per cent that a program leaves an axis.
PARTS = (5, 10, 25, 50, 80)
#: Where acceleration and jerk are concerned, also more than there is by itself.
MORE = (*PARTS, 150, 200)


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
    LimitedPolar,
    LimitedCylinder,
    LimitedInclined,
    LimitedFiveAxes,
    LimitedVectors,
)
