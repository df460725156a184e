"""Programs of mills with word addresses: cycles of holes and taps, frames, tip of the tool, plane and cylinder."""

from __future__ import annotations

from math import cos, hypot, sin
from typing import TYPE_CHECKING, ClassVar

from tests.mainrun.motion.drawn.mixed import Blocks
from tests.mainrun.motion.random_programs import FEEDS, HEADS

if TYPE_CHECKING:
    from collections.abc import Callable


class Holes(Blocks):
    """Holes in a row and at drawn places, between lines."""

    CYCLES = (
        "G81 Z-{z:.2f} R{r:.2f}",
        "G82 Z-{z:.2f} R{r:.2f} P120",
        "G83 Z-{z:.2f} R{r:.2f} Q{q:.2f}",
        "G73 Z-{z:.2f} R{r:.2f} Q{q:.2f}",
        "G85 Z-{z:.2f} R{r:.2f}",
        "G89 Z-{z:.2f} R{r:.2f} P80",
    )

    def head(self) -> str:
        return f"{super().head()} M3 S1000\nG0 X0 Y0 Z10."

    def kinds(self) -> list[Callable[[], None]]:
        return [self.holes, self.holes, self.line, self.rapid]

    def cycle(self) -> str:
        draw = self.random
        return draw.choice(self.CYCLES).format(
            z=draw.uniform(0.5, 15.0), r=draw.uniform(0.5, 4.0), q=draw.uniform(1.0, 6.0)
        )

    def holes(self) -> None:
        draw = self.random
        x, y, _ = self.place
        self.place = x, y, 10.0
        self.lines.append("G0 Z10.")
        start = f"{draw.choice(('G98', 'G99'))} {self.cycle()} F{draw.choice((200, 1000, 3000))}."
        for k in range(draw.randint(1, 4)):
            self.by(draw.choice((2.0, 30.0)))
            x, y, _ = self.place
            self.place = x, y, 10.0
            self.lines.append(f"{start if k == 0 else ''} X{x:.3f} Y{y:.3f}".strip())
        self.lines += ["G80", "G0 Z10."]


class Taps(Holes):
    """Rigid taps: the spindle turns with the way of the axis."""

    def head(self) -> str:
        return f"{Blocks.head(self)}\nG0 X0 Y0 Z10."

    def kinds(self) -> list[Callable[[], None]]:
        return [self.tap, self.line]

    def tap(self) -> None:
        draw = self.random
        rpm, lead = draw.choice((200, 500, 1000)), draw.choice((0.8, 1.0, 1.5))
        if self.control == "fanuc-m":
            self.lines.append(f"M29 S{rpm}")
        else:
            self.lines.append(f"M3 S{rpm}")
        exact = " ,R1" if self.control == "meldas-m" else ""
        feed = lead if self.control == "meldas-m" else rpm * lead
        x, y = (round(v + draw.uniform(-20.0, 20.0), 3) for v in self.place[:2])
        z, r = draw.uniform(4.0, 15.0), draw.uniform(1.0, 4.0)
        self.place = x, y, 10.0
        code = draw.choice(("G84", "G74"))
        self.lines += [f"G98 {code} X{x} Y{y} Z-{z:.2f} R{r:.2f} F{feed:.1f}{exact}", "G80"]
        self.lines.append(f"G1 F{draw.choice(FEEDS)}.")


class Spirals(Blocks):
    """Arcs whose radius changes along them (G02.1)."""

    def kinds(self) -> list[Callable[[], None]]:
        return [self.spiral, self.spiral, self.line]

    def spiral(self) -> None:
        draw, (x, y, z) = self.random, self.place
        angle, sweep = draw.uniform(0.0, 6.28), draw.uniform(0.5, 6.0)
        radius, last = draw.uniform(3.0, 15.0), draw.uniform(1.0, 20.0)
        i, j = -radius * cos(angle), -radius * sin(angle)
        sense = draw.choice((1.0, -1.0))
        angle += sense * sweep
        self.place = (
            round(x + i + last * cos(angle), 4),
            round(y + j + last * sin(angle), 4),
            round(z + draw.choice((0.0, 2.0)), 3),
        )
        self.write("G3.1" if sense > 0.0 else "G2.1", rest=f" I{i:.4f} J{j:.4f}")


class Turned(Blocks):
    """Blocks in systems that are turned, mirrored and scaled."""

    moves_places = True

    def between(self) -> str:
        draw = self.random
        if self.control == "meldas-m":
            mirror = "G51.1 X5.", "G50.1 X0", "G51.1 Y0", "G50.1 Y0"
        else:
            mirror = "G51.1 X5.", "G50.1 X0", "G51.1 X0 Y3.", "G50.1 X0 Y0"
        turn = f"G68 X{draw.uniform(-9.0, 9.0):.2f} Y2. R{draw.uniform(-180.0, 180.0):.2f}"
        scale = f"G51 X0 Y0 Z0 P{draw.choice(('0.5', '1.7', '0.25'))}"
        return draw.choice(("", turn, turn, "G69", *mirror, scale, "G50", "G52 X3. Y1.", "G52 X0 Y0"))


class Tip(Blocks):
    """The tip of the tool on its path while the tool or the work turns (G43.4)."""

    machine = "mill5-ac-table"
    tilt: ClassVar[str] = "A"

    def program(self) -> str:
        draw, tilt = self.random, self.tilt
        self.lines = [f"{self.head()} G43.4 H1", f"G1 X0 Y0 Z0 {tilt}10. C0 F{draw.choice(FEEDS)}."]
        a, c, reach = 10.0, 0.0, draw.choice((1.0, 10.0))
        for _ in range(draw.randint(2, 6)):
            self.by(reach)
            x, y, z = self.place
            a = min(max(round(a + draw.uniform(-5.0, 8.0), 3), 1.0), 60.0)
            c = round(c + draw.uniform(-20.0, 20.0), 3)
            feed = f" F{draw.choice(FEEDS)}." if draw.random() < 0.4 else ""
            self.lines.append(f"G1 X{x} Y{y} Z{z} {tilt}{a} C{c}{feed}")
        return "\n".join([*self.lines, "G49", "M30", ""])


class TipOfHead(Tip):
    """The same where both axes turn the tool."""

    machine = "mill5-bc-head"
    tilt = "B"


class Plane(Blocks):
    """Lines and arcs of polar interpolation (G12.1) on a mill."""

    machine = "mill4-xyzc"

    def head(self) -> str:
        passed = self.random.choice(("G64", "G64", "G61"))
        return f"{HEADS[self.control]} {passed}"

    def program(self) -> str:
        draw = self.random
        self.lines = [self.head(), f"G1 X30. C0 F{draw.choice(FEEDS)}.", "G12.1"]
        x, y = 30.0, 0.0
        for _ in range(draw.randint(2, 6)):
            before = x, y
            x, y = round(draw.uniform(-30.0, 30.0), 3), round(draw.uniform(-30.0, 30.0), 3)
            code, more = "G1", ""
            if draw.random() < 0.4:
                radius = 0.5 * hypot(x - before[0], y - before[1]) * draw.uniform(1.05, 3.0)
                code, more = draw.choice(("G2", "G3")), f" R{radius:.4f}"
            feed = f" F{draw.choice(FEEDS)}." if draw.random() < 0.3 else ""
            self.lines.append(f"{code} X{x} C{y}{more}{feed}")
        return "\n".join([*self.lines, "G13.1", "G0 X40.", "M30", ""])


class Groove(Blocks):
    """Lines on the surface of a cylinder (G07.1)."""

    machine = "mill4"

    def program(self) -> str:
        draw = self.random
        self.lines = [self.head(), f"G1 X0 A0 F{draw.choice(FEEDS)}.", f"G07.1 A{draw.choice((10, 50))}."]
        x, a = 0.0, 0.0
        for _ in range(draw.randint(2, 6)):
            reach = draw.choice((1.0, 20.0))
            x, a = round(x + draw.uniform(-reach, reach), 3), round(a + draw.uniform(-reach, reach), 3)
            feed = f" F{draw.choice(FEEDS)}." if draw.random() < 0.3 else ""
            self.lines.append(f"G1 X{x} A{a}{feed}")
        return "\n".join([*self.lines, "G07.1 A0", "G0 X40.", "M30", ""])
