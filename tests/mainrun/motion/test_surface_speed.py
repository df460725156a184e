"""Under constant surface speed the feed follows the turning radius: plan, samples and main run ask for the same."""

from __future__ import annotations

from math import cos, hypot, sin, sqrt
from random import Random
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.machine import parse_setup
from polycnc.motion.kernels.arcs import facing_radius
from polycnc.motion.kernels.columns import new_state
from polycnc.motion.third_order.laying.rows import put_arc_place
from tests.mainrun.motion.both_times import executed, planned
from tests.mainrun.motion.random_programs import Writer
from tests.mainrun.motion.test_one_motion import compare
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from collections.abc import Callable

SEEDS = range(12)


class Turned(Writer):
    """A random contour of lines and arcs on a lathe under G96; X in diameter on FANUC, and perhaps on SINUMERIK."""

    machine = "lathe2"
    setup = {}  # noqa: RUF012 - as its base has it
    by_diameter = 2.0

    def program(self) -> str:
        draw = self.random
        self.place = (draw.uniform(10.0, 40.0), 0.0, 0.0)
        feed, surface = draw.uniform(0.1, 0.6), draw.choice((60, 200, 500))
        if self.siemens:
            self.by_diameter = draw.choice((1.0, 2.0))
            diameters = "DIAMOF" if self.by_diameter == 1.0 else "DIAMON"
            self.lines = [f"G71 G90 G18 {diameters} {self.modes()} LIMS=3000"]
        else:
            self.lines = ["O1", "G21", "G50 S3000"]
        self.lines.append(f"G0 {self.words()}")
        self.lines.append(f"{'' if self.siemens else 'G99 '}G96 S{surface} M3 F{feed:.3f}")
        blocks: tuple[Callable[[], None], ...] = (self.line, self.arc, self.arc, self.facing)
        for _ in range(draw.randint(2, 5)):
            draw.choice(blocks)()
        return "\n".join([*self.lines, "M30", ""])

    def words(self) -> str:
        return f"X{self.by_diameter * self.place[0]:.4f} Z{self.place[2]:.4f}"

    def line(self) -> None:
        x, _, z = self.place
        self.place = max(x + self.random.uniform(-8.0, 8.0), 1.0), 0.0, z - self.random.uniform(0.2, 15.0)
        self.lines.append(f"G1 {self.words()}")

    def facing(self) -> None:
        self.place = self.random.uniform(0.5, 45.0), 0.0, self.place[2]
        self.lines.append(f"G1 {self.words()}")

    def arc(self, rise: float = 0.0) -> None:
        x, _, z = self.place
        angle, radius = self.random.uniform(-3.0, 3.0), self.random.uniform(1.0, 10.0)
        chord = self.random.uniform(0.3, 1.9) * radius
        self.place = max(x + chord * cos(angle), 0.5), 0.0, z + chord * sin(angle)
        if hypot(self.place[0] - x, self.place[2] - z) > 1.95 * radius:
            self.line()
            return
        name = "CR=" if self.siemens else "R"
        self.lines.append(f"{self.random.choice(('G2', 'G3'))} {self.words()} {name}{radius:.4f}")


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("control", ["fanuc-0i-tf", "sinumerik-840d"])
def test_plan_samples_and_main_run_are_one_motion(control: str, seed: int) -> None:
    written = Turned(Random(seed), control)
    compare(written.program(), written)


@pytest.mark.parametrize(
    ("control", "head", "arc"),
    [
        ("fanuc-0i-tf", "O1\nG21\nG0 X60.\nG96 S200 M3\nG99 F0.3\n", "G2 X39. R10.\n"),
        ("sinumerik-840d", "G18 DIAMON SOFT G645\nG0 X60\nG96 S200 M3 F0.3\n", "G2 X39 CR=10\nG1 X2\n"),
    ],
)
def test_they_take_the_same_time_on_arcs_and_on_lines_that_face(control: str, head: str, arc: str) -> None:
    total_s = planned(f"{head}{arc}M30\n", control, "lathe2")
    assert executed(f"{head}{arc}M30\n", control, "lathe2") == pytest.approx(total_s, abs=1e-6)


@pytest.mark.parametrize("override", [0.5, 1.2])
def test_an_override_acts_on_the_speed_at_every_radius(override: float) -> None:
    """Twice the time at half the speed: where the axes follow quickly, that is all of the motion."""
    text = "O1\nG21\nG0 X60.\nG96 S20 M3\nG99 F0.05\nG2 X39. R10.\nM30\n"
    virtual = power_on(text, "fanuc-0i-tf", machine="lathe2", setup=parse_setup({}))
    virtual.override(feed=override)
    virtual.cycle_start()
    virtual.run(limit_s=1000.0)
    head_s = planned(text.replace("G2 X39. R10.\n", ""), "fanuc-0i-tf", "lathe2")
    arc_s = planned(text, "fanuc-0i-tf", "lathe2") - head_s
    assert virtual.time - head_s == pytest.approx(arc_s / override, rel=0.01)


@pytest.mark.parametrize(("growth", "rise"), [(0.0, 0.0), (3.0, 0.0), (-2.0, 0.0), (0.0, 4.0), (1.0, -4.0)])
def test_the_radius_is_that_of_the_place_on_arcs_spirals_and_helices(growth: float, rise: float) -> None:
    state, limits, place = new_state(3), SimpleNamespace(geometry=(0, 1, 2)), [0.0, 0.0, 0.0]
    told: Any = limits
    # Across X, Y and Z alike, so that X changes with all of them.
    for k, value in enumerate((2.0, 2.0, -4.0, -2.0, 2.0, 0.0, 1.0, 1.0, 1.0)):
        state.basis[k] = value / (sqrt(24.0), sqrt(8.0), sqrt(3.0))[k // 3]
    state.arc.radius, state.arc.sweep, state.arc.growth, state.arc.rise = 5.0, 2.0, growth, rise
    put_arc_place(state.arc.sweep, 3, told, state, place, 0)
    for i in range(3):
        state.delta[i] = place[i]
    state.row.facing = 20.0 + place[0]
    for angle in (0.0, 0.7, 1.3, 2.0):
        put_arc_place(angle, 3, told, state, place, 0)
        assert facing_radius(angle, told, state) == pytest.approx(20.0 + place[0])


def test_a_thread_follows_the_spindle_at_every_radius_whatever_f_counts() -> None:
    """The spindle follows the radius on a taper, and the thread the spindle (FANUC 0i-TF Plus II.3.1)."""
    times = []
    for feed in ("G99", "G98"):
        text = f"O1\nG21\nG50 S3000\nG0 X40. Z2.\nG96 S100 M3\n{feed}\nG32 X80. Z-20. F1.\nM30\n"
        times.append(planned(text, "fanuc-0i-tf", "lathe2"))
        assert executed(text, "fanuc-0i-tf", "lathe2") == pytest.approx(times[-1], abs=1e-6)
    assert times[0] == times[1]
