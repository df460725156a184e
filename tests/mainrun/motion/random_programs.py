"""Random programs of several controls, for tests that compare what they lead to."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, degrees, hypot, radians, sin
from random import Random
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable

FEEDS = (500, 1500, 3000, 6000, 12000)
HEADS = {"sinumerik-840d": "G71 G90", "syntec-mill": "G71 G90", "fanuc-m": "G21 G90", "meldas-m": "G21 G90"}
CONTROLS = ("sinumerik-840d", "sinumerik-840d", "fanuc-m", "syntec-mill", "meldas-m")


@dataclass
class Writer:
    """Writes a random program, block by block."""

    random: Random
    control: str
    machine: ClassVar[str] = "mill3"
    setup: ClassVar[dict[str, object]] = {"tools": {1: {"length": 50.0}}}
    lines: list[str] = field(default_factory=list)
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    feed: str = ""
    #: Part of its acceleration, its velocity and its jerk that the program leaves an axis, by name.
    left: dict[str, float] = field(default_factory=dict)
    left_speed: dict[str, float] = field(default_factory=dict)
    left_jerk: dict[str, float] = field(default_factory=dict)

    @property
    def siemens(self) -> bool:
        return self.control == "sinumerik-840d"

    def modes(self) -> str:
        """How a SINUMERIK takes up speed and passes corners."""
        corners = ("G64", "G60", f"G641 ADIS={self.random.uniform(0.05, 1.0):.3f}", "G642")
        return f"{self.random.choice(('BRISK', 'SOFT'))} {self.random.choice(corners)}"

    def program(self) -> str:
        draw, head = self.random, HEADS[self.control]
        if self.siemens:
            head += f" {self.modes()}"
        else:
            head += draw.choice((" G64", " G61"))
        self.lines = [head]
        blocks: list[Callable[[], None]] = [
            self.line,
            self.facets,
            self.arc,
            self.helix,
            self.rapid,
            self.onward,
        ]
        if self.siemens:
            blocks.append(self.spline)
        for _ in range(draw.randint(2, 6)):
            self.feed = f" F{draw.choice(FEEDS)}." if len(self.lines) == 1 or draw.random() < 0.4 else ""
            draw.choice(blocks)()
        return "\n".join([*self.lines, "M30", ""])

    def write(self, code: str, *, rest: str = "") -> None:
        x, y, z = self.place
        fed = any(" F" in line and "G4 F" not in line for line in self.lines)  # that of a dwell is none
        feed = self.feed or ("" if fed else f" F{FEEDS[0]}.")
        self.lines.append(f"{code} X{x:.4f} Y{y:.4f} Z{z:.4f}{rest}{'' if code == 'G0' else feed}")
        self.feed = ""

    def by(self, reach: float) -> None:
        x, y, z = (round(v + self.random.uniform(-reach, reach), 3) for v in self.place)
        self.place = x, y, z

    def rapid(self) -> None:
        self.by(40.0)
        self.write("G0")

    def line(self) -> None:
        self.by(self.random.choice((0.3, 3.0, 25.0)))
        self.write("G1")

    def facets(self) -> None:
        for _ in range(self.random.randint(2, 8)):
            self.by(0.6)
            self.write("G1")

    def onward(self) -> None:
        """Lines in one direction."""
        way = [self.random.uniform(-4.0, 4.0) for _ in range(3)]
        for _ in range(self.random.randint(2, 4)):
            x, y, z = (round(v + w, 3) for v, w in zip(self.place, way, strict=True))
            self.place = x, y, z
            self.write("G1")

    def spline(self) -> None:
        self.by(5.0)
        self.write("G1")
        for k in range(self.random.randint(3, 6)):
            self.by(4.0)
            self.write("ASPLINE" if k == 0 else "")
        self.by(5.0)
        self.write("G1")

    def arc(self, rise: float = 0.0) -> None:
        draw, (x, y, z) = self.random, self.place
        radius, angle, sweep = draw.uniform(0.5, 15.0), draw.uniform(0.0, 6.28), draw.uniform(0.2, 6.0)
        sense = draw.choice((1.0, -1.0))
        centre = x - radius * cos(angle), y - radius * sin(angle)
        end = (
            round(c + radius * f(angle + sense * sweep), 4) for c, f in zip(centre, (cos, sin), strict=True)
        )
        ex, ey = end
        self.place = ex, ey, round(z + rise, 3)
        if hypot(ex - x, ey - y) < 0.1:
            self.write("G1")
            return
        # The centre from which both ends, rounded as they are written, are equally far.
        share = ((centre[0] - (x + ex) / 2) * (y - ey) + (centre[1] - (y + ey) / 2) * (ex - x)) / hypot(
            ex - x, ey - y
        ) ** 2
        i, j = (x + ex) / 2 - share * (ey - y) - x, (y + ey) / 2 + share * (ex - x) - y
        self.write("G3" if sense > 0.0 else "G2", rest=f" I{i:.5f} J{j:.5f}")

    def helix(self) -> None:
        self.arc(self.random.uniform(-3.0, 3.0))


class Compressed(Writer):
    """Contours of short lines, with the noise of a CAM system, and what lies between them, under a compressor."""

    tolerance = 0.0

    def program(self) -> str:
        draw = self.random
        self.tolerance = draw.choice((0.005, 0.01, 0.05))
        on = f"{draw.choice(('COMPON', 'COMPCURV', 'COMPCAD'))} CTOL={self.tolerance}"
        corners = draw.choice(("G64", "G642", "G645"))
        self.lines = [f"G71 G90 {draw.choice(('BRISK', 'SOFT'))} {corners} {on}"]
        blocks = (self.contour, self.contour, self.contour, self.line, self.facets, self.arc, self.rapid)
        for _ in range(draw.randint(1, 4)):
            self.feed = f" F{draw.choice(FEEDS)}." if len(self.lines) == 1 or draw.random() < 0.4 else ""
            draw.choice(blocks)()
        return "\n".join([*self.lines, "M30", ""])

    def contour(self) -> None:
        """A curve, perhaps with a corner, in short lines whose ends lie beside it."""
        draw = self.random
        noise = self.tolerance * draw.choice((0.02, 0.3, 0.9))
        angle, bend = draw.uniform(0.0, 6.28), draw.choice((0.0, draw.uniform(-1.0, 1.0)))
        step = draw.choice((0.02, 0.1, 0.4))
        count = draw.randint(3, 120)
        corner = draw.choice((-1, draw.randint(0, count)))
        x, y, z = self.place
        for k in range(count):
            angle += bend * step + (1.5 if k == corner else 0.0)
            x, y, z = x + step * cos(angle), y + step * sin(angle), z + 0.1 * step * bend
            beside = (round(v + draw.uniform(-noise, noise), 4) for v in (x, y, z))
            bx, by, bz = beside
            self.place = bx, by, bz
            self.write("G1")


class Turning(Compressed):
    """Contours along which a rotary axis turns, with noise and a tolerance of its own."""

    machine = "mill4"
    turn_tolerance = 0.0
    #: Where the axis stands, how far it turns in a block, and how far beside that.
    angle, pace, beside = 1.0, 0.0, 0.0

    def contour(self) -> None:
        draw = self.random
        self.pace, self.beside = draw.uniform(0.01, 0.5), self.turn_tolerance * draw.choice((0.02, 0.3, 0.9))
        super().contour()
        self.pace = 0.0

    def write(self, code: str, *, rest: str = "") -> None:
        if self.pace:
            self.pace = max(self.pace + self.random.uniform(-0.002, 0.002), 0.01)
            self.angle += self.pace
            rest += f" A{self.angle + self.random.uniform(-self.beside, self.beside):.4f}"
        super().write(code, rest=rest)


class CompressedTurns(Turning):
    """They are under a compressor."""

    def program(self) -> str:
        self.turn_tolerance = self.random.choice((0.002, 0.01, 0.1))
        return super().program().replace(" CTOL", f" ATOL[A]={self.turn_tolerance} CTOL", 1)


class Smoothed(Compressed):
    """The same under what SYNTEC leaves points by: the filter of G05.1, the curve of G05."""

    setup: ClassVar[dict[str, object]] = {"parameters": {"407": 10}}

    def switch(self) -> str:
        draw, tolerance = self.random, self.random.choice((0.005, 0.01, 0.05))
        on, self.tolerance = draw.choice(
            ((f"G05.1 Q1 E{tolerance}", tolerance), (f"G05 E{tolerance}", tolerance), ("G05 P10000", 0.01))
        )
        return on

    def program(self) -> str:
        draw, on = self.random, self.switch()
        self.lines = ["G71 G90 G94", on]
        blocks = (self.contour, self.contour, self.contour, self.line, self.facets, self.arc, self.rapid)
        for _ in range(draw.randint(1, 4)):
            self.feed = f" F{draw.choice(FEEDS)}." if len(self.lines) == 2 or draw.random() < 0.4 else ""
            draw.choice(blocks)()
        return "\n".join([*self.lines, "G05.1 Q0" if ".1" in on else "G05 P0", "M30", ""])


class SmoothedTurns(Turning, Smoothed):
    """Contours along which a rotary axis turns that G05 fits."""

    def switch(self) -> str:
        self.tolerance, self.turn_tolerance = 0.01, self.random.choice((0.002, 0.01, 0.1))
        return f"G05 P10000 X0 Y0 Z0 A{self.turn_tolerance}"


SPEEDS, LEADS = (200, 333, 600, 1200), (0.5, 1.0, 2.0)


class Threads(Writer):
    """Threads of a lathe, chained and with several starts, by blocks and cycles, at several speeds of the spindle."""

    machine = "lathe2"

    def turns(self) -> str:
        return f"S{self.random.choice(SPEEDS)} M{self.random.choice((3, 3, 4))}"

    def program(self) -> str:
        draw, siemens = self.random, self.siemens
        self.lines = [f"G90 G95 {self.turns()} F0.2 {self.modes()}" if siemens else f"G99 G97 {self.turns()}"]
        self.place = 20.0, 0.0, 5.0
        parts: list[Callable[[], None]] = [self.chain, self.chain, self.other_speed, self.surface_speed]
        if not siemens:
            parts += [self.cycle, self.infeeds]
        for _ in range(draw.randint(1, 5)):
            x, _, z = self.place
            self.lines.append(f"G0 X{x:.3f} Z{z:.3f}")
            draw.choice(parts)()
            x, z = self.place[0] + 8.0, round(draw.uniform(-5.0, 10.0), 3)
            self.lines += [f"G0 X{x - 3.0:.3f}", f"G1 X{x:.3f} Z{z:.3f} F0.3"]
            self.place = x, 0.0, z
        return "\n".join([*self.lines, "M30", ""])

    def chain(self) -> None:
        """Threads one behind the other, straight and tapered, some with a lead that changes."""
        draw, lead = self.random, self.random.choice(LEADS)
        x, _, z = self.place
        for _ in range(draw.randint(1, 3)):
            down, out = (
                draw.uniform(5.0, 30.0),
                draw.choice((0.0, 0.0, draw.uniform(0.0, 2.0), draw.uniform(0.0, 30.0))),
            )
            x, z = x + out, z - down
            growth, starts = draw.choice((0.0, 0.0, 0.005, 0.01)), draw.random() < 0.3
            if self.siemens:
                start = f" SF={draw.choice((0, 90, 180.5))}" if starts else ""
                code, more = (draw.choice(("G34", "G35")), f" F{growth}") if growth else ("G33", "")
                if lead * lead < 3.0 * growth * max(down, out):  # G35 would come down to no lead (10605)
                    code = "G34"
                word = f"K{lead}"
            else:
                start = f" Q{draw.choice((0, 90000, 180000))}" if starts else ""
                code, more = ("G34", f" K{growth}") if growth else ("G32", "")
                word = f"F{lead}"
            self.lines.append(f"{code} X{x:.3f} Z{z:.3f} {word}{more}{start}")
        self.place = x, 0.0, z

    def cycle(self) -> None:
        """Cuts of G92 at one speed."""
        x, _, z = self.place
        self.lines.append(f"G92 X{x - 1.0:.3f} Z{z - 20.0:.3f} F{self.random.choice(LEADS)}")
        self.lines += [f"X{x - 1.5:.3f}", f"X{x - 2.0:.3f} R-0.5"]

    def infeeds(self) -> None:
        """A multiple thread cycle."""
        x, _, z = self.place
        lead = self.random.choice(LEADS)
        self.lines += [
            "G76 P020060 Q100 R0.05",
            f"G76 X{x - 3.0:.3f} Z{z - 20.0:.3f} P1000 Q400 F{lead}",
        ]

    def other_speed(self) -> None:
        """The spindle turns otherwise, perhaps from rest."""
        self.lines += self.random.choice(([], ["M5"], ["M8"]))
        self.lines.append(self.turns())

    def surface_speed(self) -> None:
        """A facing cut at constant surface speed."""
        x, _, z = self.place
        self.lines += [
            "G96 S100",
            f"G1 X{x + 3.0:.3f} Z{z:.3f} F0.3",
            f"G97 S{self.random.choice(SPEEDS)}",
        ]


class MillThreads(Threads):
    """Threads and taps on mills of all controls."""

    machine = "mill3"

    def program(self) -> str:
        draw, siemens = self.random, self.siemens
        self.lines = [HEADS[self.control], self.modes() if siemens else draw.choice(("G64", "G61"))]
        self.lines += [self.turns(), "G0 Z5."]
        self.place = 0.0, 0.0, 5.0
        parts = (self.chain, self.chain, self.tap, self.other_speed, self.pause)
        for _ in range(draw.randint(2, 6)):
            draw.choice(parts)()
            self.place = self.place[0] + 5.0, 0.0, round(draw.uniform(0.0, 10.0), 3)
            self.lines += [f"G0 X{self.place[0]:.3f}", f"G0 Z{self.place[2]:.3f}"]
        return "\n".join([*self.lines, "M30", ""])

    def chain(self) -> None:
        if self.siemens:
            super().chain()
            return
        draw, lead = self.random, self.random.choice(LEADS)
        x, _, z = self.place
        for _ in range(draw.randint(1, 3)):
            z -= draw.uniform(1.0, 15.0)
            x += draw.choice((0.0, 0.0, draw.uniform(0.0, 2.0)))
            starts = draw.random() < 0.3 and self.control != "syntec-mill"
            start = f" Q{draw.choice((0, 90, 180))}." if starts else ""
            self.lines.append(f"G95 G33 X{x:.3f} Z{z:.3f} F{lead}{start}")
        self.lines.append("G94")
        self.place = x, 0.0, z

    def tap(self) -> None:
        """A tap, rigid or floating; the spindle turns by itself again behind it."""
        draw, lead, x = self.random, self.random.choice(LEADS), self.place[0]
        self.lines.append("G0 Z5.")
        if self.siemens:
            self.lines += [f"G331 Z-12 K{lead} S500", f"G332 Z5 K{lead}"]
        elif self.control == "meldas-m":
            self.lines += [f"G98 G84 X{x:.3f} Y0 Z-12. R2. F{lead} ,R{draw.choice((0, 1))}", "G80"]
        else:
            self.lines += draw.choice(([], ["M29 S500"]))
            self.lines += [f"G98 G84 X{x:.3f} Y0 Z-12. R2. F{500.0 * lead}", "G80"]
        self.lines.append(self.turns())

    def pause(self) -> None:
        """A dwell, a function, a cut."""
        x, feed = self.place[0] + 2.0, self.random.choice((300, 1000))
        self.lines += self.random.choice(
            (["G4 F0.37" if self.siemens else "G04 P370"], ["M8"], [f"G1 X{x:.3f} F{feed}."])
        )


class Polar(Writer):
    """Lines and arcs on the end face of a lathe: real axes under a transformation."""

    machine = "lathe-c-transmit"

    def program(self) -> str:
        draw, siemens = self.random, self.siemens
        begins = [f"G90 G94 {self.modes()}", "T1 D1", "G0 X60 Z5", "TRANSMIT"]
        self.lines = begins if siemens else ["G98 G0 X60. Z5. C0", "G12.1"]
        x, y, second = (60.0 if siemens else 30.0), 0.0, "Y" if siemens else "C"
        for k in range(draw.randint(2, 6)):
            before, (x, y) = (
                (x, y),
                (round(draw.uniform(-30.0, 30.0), 3), round(draw.uniform(-30.0, 30.0), 3)),
            )
            code, more = "G1", ""
            if siemens and draw.random() < 0.4:
                radius = 0.5 * hypot(x - before[0], y - before[1]) * draw.uniform(1.05, 3.0)
                code, more = draw.choice(("G2", "G3")), f" CR={radius:.4f}"
            shown = x if siemens else 2.0 * x
            feed = f" F{draw.choice(FEEDS)}." if k == 0 or draw.random() < 0.3 else ""
            self.lines.append(f"{code} X{shown:.3f} {second}{y:.3f}{more}{feed}")
        self.lines += ["TRAFOOF", "G0 X80"] if siemens else ["G13.1", "G0 X160."]
        return "\n".join([*self.lines, "M30", ""])


class FiveAxes(Writer):
    """Lines of a tool centre point while the tool turns."""

    machine = "mill5-ca-head"

    def program(self) -> str:
        draw = self.random
        self.lines = [f"G90 G94 {self.modes()}", "T1 D1", "TRAORI", "G1 X0 Y0 Z0 A10 C0 F2000"]
        x, y, z, a, c = 0.0, 0.0, 0.0, 10.0, 0.0
        for _ in range(draw.randint(2, 8)):
            reach = draw.choice((1.0, 20.0))
            x, y, z = (round(v + draw.uniform(-reach, reach), 3) for v in (x, y, z))
            a, c = round(a + draw.uniform(-5.0, 10.0), 3), round(c + draw.uniform(-20.0, 20.0), 3)
            feed = f" F{draw.choice(FEEDS)}" if draw.random() < 0.4 else ""
            self.lines.append(f"G1 X{x} Y{y} Z{z} A{min(max(a, 1.0), 60.0)} C{c}{feed}")
        return "\n".join([*self.lines, "TRAFOOF", "M30", ""])


class Vectors(Writer):
    """Lines and arcs of a tool centre point along which the tool turns on great circles."""

    machine = "mill5-ca-head"

    def program(self) -> str:
        draw = self.random
        self.lines = [f"G90 G94 {self.modes()}", "T1 D1", "TRAORI", "ORIVECT"]
        x, y = 0.0, 0.0
        for k in range(draw.randint(2, 4)):
            reach = draw.choice((3.0, 20.0))
            before, (x, y) = (x, y), (round(v + draw.uniform(-reach, reach), 3) for v in (x, y))
            radius = 0.5 * hypot(x - before[0], y - before[1]) * draw.uniform(1.05, 2.0) + 0.01
            code, more = draw.choice((("G1", ""), ("G2", f" CR={radius:.3f}"), ("G3", f" CR={radius:.3f}")))
            a, b = draw.uniform(-0.6, 0.6), draw.choice((0.02, draw.uniform(-0.6, 0.6)))
            feed = f" F{draw.choice(FEEDS)}" if k == 0 or draw.random() < 0.4 else ""
            self.lines.append(f"{code} X{x} Y{y}{more} A3={a:.4f} B3={b:.4f} C3=1{feed}")
        return "\n".join([*self.lines, "TRAFOOF", "M30", ""])


class Paced(Writer):
    """Programs of a mill that leave the axes parts of their accelerations."""

    def modes(self) -> str:
        words = super().modes()
        for axis in self.random.sample("XYZ", self.random.randint(1, 2)):
            per_cent = self.random.choice((10, 20, 50, 80))
            self.left[axis] = 0.01 * per_cent
            words += f"\nACC[{axis}]={per_cent}"
        return words


class Back(Writer):
    """Lines, arcs and splines in a plane; many turn back on the one before, not quite in its direction."""

    heading: float = 0.0

    def program(self) -> str:
        draw = self.random
        self.lines = [f"G71 G90 {self.modes()}"]
        for k in range(draw.randint(2, 7)):
            self.feed = f" F{draw.choice(FEEDS)}." if k == 0 or draw.random() < 0.3 else ""
            turn = draw.uniform(-14.0, 14.0) + 180.0 if draw.random() < 0.6 else draw.uniform(-180.0, 180.0)
            self.heading += turn
            draw.choice((self.ahead, self.ahead, self.bow, self.curve))()
        return "\n".join([*self.lines, "M30", ""])

    def go(self, way: float, turn: float = 0.0) -> None:
        x, y, z = self.place
        angle = radians(self.heading + turn)
        self.place = round(x + way * cos(angle), 4), round(y + way * sin(angle), 4), z

    def ahead(self) -> None:
        self.go(self.random.choice((0.3, 3.0, 25.0)))
        self.write("G1")

    def bow(self) -> None:
        draw = self.random
        radius, sweep = draw.uniform(0.5, 15.0), draw.choice((1.0, -1.0)) * draw.uniform(10.0, 170.0)
        self.go(2.0 * radius * sin(radians(0.5 * abs(sweep))), 0.5 * sweep)
        self.heading += sweep
        self.write("G3" if sweep > 0.0 else "G2", rest=f" CR={radius:.4f}")

    def curve(self) -> None:
        for k in range(self.random.randint(3, 5)):
            self.go(self.random.uniform(0.5, 4.0))
            self.write("ASPLINE" if k == 0 else "")
            self.heading += self.random.uniform(-40.0, 40.0)
        self.go(2.0)
        self.write("G1")


class Plane(Writer):
    """Lines and arcs in a plane that a transformation makes."""

    def between(self, begin: tuple[float, float], reach: float) -> list[tuple[tuple[float, float], str, str]]:
        """Points with the code that leads to each and the radius of an arc, which is an arc of half a round at most."""
        draw, found = self.random, []
        here = begin
        for _ in range(draw.randint(2, 7)):
            span = reach * draw.choice((0.05, 0.3, 1.0))
            x, y = (round(v + draw.uniform(-span, span), 3) for v in here)
            before, here = here, (x, y)
            code, radius = "G1", ""
            if draw.random() < 0.4:
                code = draw.choice(("G2", "G3"))
                half = 0.5 * hypot(here[0] - before[0], here[1] - before[1])
                radius = f"{half * draw.uniform(1.05, 3.0) + 0.002:.4f}"
            found.append((here, code, radius))
        return found

    def feed_word(self, *, first: bool) -> str:
        return f" F{self.random.choice(FEEDS)}." if first or self.random.random() < 0.3 else ""


class Cylinder(Plane):
    """Grooves on the surface of a cylinder."""

    machine = "lathe-c-transmit"

    def program(self) -> str:
        draw, siemens = self.random, self.siemens
        radius = draw.choice((5.0, 20.0, 60.0))
        if siemens:
            begins = [
                f"G90 G94 {self.modes()}",
                "G19 T1 D1",
                f"G0 X{2.0 * radius} Z5",
                f"TRACYL({2.0 * radius})",
            ]
        else:
            begins = [f"G98 G18 G1 X{2.0 * radius:.3f} Z5. C0 F3000.", f"G7.1 C{radius:.3f}"]
        self.lines = begins
        start = (0.0, 5.0)
        if siemens:
            self.lines.append("G1 Y0 Z5 F3000")
        for k, ((y, z), code, bow) in enumerate(self.between(start, 30.0)):
            second = f"Y{y:.3f}" if siemens else f"C{degrees(y / radius):.4f}"
            more = f" {'CR=' if siemens else 'R'}{bow}" if bow else ""
            self.lines.append(f"{code} {second} Z{z:.3f}{more}{self.feed_word(first=k == 0)}")
        self.lines += ["TRAFOOF", "G0 X160"] if siemens else ["G7.1 C0", "G0 X160."]
        return "\n".join([*self.lines, "M30", ""])


class Inclined(Plane):
    """Contours of a grinding machine whose infeed axis is inclined."""

    machine = "grinder-mu-mz"

    def program(self) -> str:
        angle = self.random.choice((30, 45, 60, -20))
        self.lines = [f"G90 G94 G18 {self.modes()}", f"TRAANG({angle})", "G0 X10 Z0"]
        for k, ((x, z), code, bow) in enumerate(self.between((10.0, 0.0), 20.0)):
            more = f" CR={bow}" if bow else ""
            self.lines.append(f"{code} X{x:.3f} Z{z:.3f}{more}{self.feed_word(first=k == 0)}")
        return "\n".join([*self.lines, "TRAFOOF", "M30", ""])


class TurningWork(Writer):
    """Splines and lines along which a rotary axis turns the work."""

    machine = "mill4"

    def program(self) -> str:
        draw = self.random
        self.lines = [f"G71 G90 {self.modes()}", f"G1 X0 Y0 A0 F{draw.choice(FEEDS)}"]
        x, y, reach = 0.0, 0.0, draw.choice((2.0, 12.0))
        for _ in range(draw.randint(1, 2)):
            code, turns = draw.choice(("ASPLINE", "BSPLINE", "CSPLINE")), draw.choice((5.0, 60.0))
            for _ in range(draw.randint(4, 7)):
                x, y = (
                    round(x + draw.uniform(0.2, 1.0) * reach, 3),
                    round(y + draw.uniform(-0.5, 0.5) * reach, 3),
                )
                self.lines.append(f"{code} X{x} Y{y} A=IC({draw.uniform(-turns, turns):.3f})")
                code = ""
            x = round(x + draw.uniform(1.0, 20.0), 3)
            self.lines.append(f"G1 X{x} A=IC({draw.uniform(-turns, turns):.3f})")
        return "\n".join([*self.lines, "M30", ""])


def writer(seed: int) -> Writer:
    """The writer of a program: of every ten, three write for mills without a transformation."""
    random = Random(seed)
    control, kind = random.choice(CONTROLS), seed % 10
    if kind == 3:
        return Threads(random, random.choice(("sinumerik-840d", "fanuc-0i-tf")))
    if kind == 6:
        return MillThreads(random, control)
    if kind == 7:
        return Polar(random, random.choice(("sinumerik-840d", "fanuc-0i-tf")))
    if kind == 4:
        return Cylinder(random, random.choice(("sinumerik-840d", "sinumerik-840d", "fanuc-0i-tf")))
    if kind in OF_SINUMERIK:
        return random.choice(OF_SINUMERIK[kind])(random, "sinumerik-840d")
    return Writer(random, control)


#: Writers for SINUMERIK alone, by the last digit of the seed.
OF_SINUMERIK = {5: (Paced, Inclined), 8: (TurningWork,), 9: (FiveAxes, Vectors)}


#: Codes with which cuts are planned ahead, on and off.
AHEAD = {
    "fanuc-m": (("G05.1 Q1", "G05.1 Q0"), ("G05 P10000", "G05 P0"), ("G08 P1", "G08 P0")),
    "fanuc-0i-tf": (("G05.1 Q1", "G05.1 Q0"), ("G08 P1", "G08 P0")),
    "meldas-m": (("G05 P10000", "G05 P0"), ("G05 P2", "G05 P0")),
}


#: Codes between which none of those may stand.
ALONE = ("G12.1", "G07.1", "G7.1")


def planned_ahead(text: str, control: str) -> str:
    """The program, of two one with cuts planned ahead: behind its head, in some up to the middle, or from there on."""
    draw = Random(text)
    if control not in AHEAD or draw.random() < 0.5 or any(code in text for code in ALONE):
        return text
    on, off = draw.choice(AHEAD[control])
    lines = text.splitlines()
    first, last = 1, len(lines) - 1
    if last > 3:
        middle = draw.randint(2, last - 1)
        first, last = draw.choice(((first, last), (first, last), (first, middle), (middle, last)))
    return "\n".join([*lines[:first], on, *lines[first:last], off, *lines[last:], ""])
