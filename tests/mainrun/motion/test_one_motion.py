"""Plan, samples and main run are one motion, on random programs of the controls.

The times agree, and by the differences of the sampled positions themselves no axis exceeds its velocity, acceleration
or jerk. Under BRISK an axis may step its velocity at corners; then acceleration and jerk are not asked for.
`pytest --hypothesis-profile=explore` draws many more.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, hypot, sin
from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded

if TYPE_CHECKING:
    from collections.abc import Callable

PERIOD = 0.001
#: Sums of many terms, and positions of many digits behind third differences.
SLACK = 1.001
FEEDS = (500, 1500, 3000, 6000, 12000)
#: Programs of a run in CI, and of one that explores.
CI, EXPLORE = 40, 2000
HEADS = {"sinumerik-840d": "G71 G90", "syntec-mill": "G71 G90", "fanuc-m": "G21 G90", "meldas-m": "G21 G90"}
CONTROLS = ("sinumerik-840d", "sinumerik-840d", "fanuc-m", "syntec-mill", "meldas-m")


@dataclass
class Writer:
    """Writes a random program, block by block."""

    random: Random
    control: str
    lines: list[str] = field(default_factory=list)
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    feed: str = ""

    @property
    def siemens(self) -> bool:
        return self.control == "sinumerik-840d"

    def program(self) -> str:
        draw, head = self.random, HEADS[self.control]
        if self.siemens:
            corners = ("G64", "G60", f"G641 ADIS={draw.uniform(0.05, 1.0):.3f}", "G642")
            head += f" {draw.choice(('BRISK', 'SOFT', 'SOFT'))} {draw.choice(corners)}"
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
        feed = self.feed or (f" F{FEEDS[0]}." if not any(" F" in line for line in self.lines) else "")
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


def planned(text: str, control: str) -> tuple[float, float, Samples]:
    """Planned time, the end of the samples, and all of them."""
    given: list[Samples] = []
    session = open_session(text.encode(), control=control, machine="mill3", keep=False)
    sampler = session.sample(PERIOD, given.append)
    result = session.run()
    assert result.ok, text
    total = result.plan.total_s
    sampler.close()
    columns = [np.concatenate(column) for column in zip(*given, strict=True)]
    return total, sampler.time, Samples(*columns)


def executed(text: str, control: str) -> float:
    """When the main run has come to the end of the program."""
    virtual = power_on(text, control, machine="mill3")
    records = recorded(virtual)
    virtual.cycle_start()
    assert virtual.run(limit_s=10_000.0) is State.READY
    return next(record.time for record in reversed(records) if record.what == "state")


def check(seed: int) -> None:
    random = Random(seed)
    control = random.choice(CONTROLS)
    text = Writer(random, control).program()
    total, end, samples = planned(text, control)
    assert end == pytest.approx(total, abs=1e-6), text
    assert executed(text, control) == pytest.approx(total, abs=0.001), text
    axes = open_session(text.encode(), control=control, machine="mill3").result.machine.axes
    steps = np.diff(samples.position, axis=0)
    middle = 0.5 * PERIOD * (samples.velocity[1:] + samples.velocity[:-1])
    change = np.diff(samples.acceleration, axis=0) * PERIOD**2 / 12.0
    for i, axis in enumerate(axes):
        assert np.abs(steps[:, i]).max() <= axis.rapid * PERIOD * SLACK, text
        if "BRISK" in text:
            continue
        assert np.abs(steps - middle + change).max() < 2e-6, text
        assert np.abs(np.diff(steps[:, i])).max(initial=0.0) <= axis.acceleration * PERIOD**2 * SLACK, text
        assert np.abs(np.diff(steps[:, i], 2)).max(initial=0.0) <= axis.jerk * PERIOD**3 * SLACK, text


@pytest.mark.parametrize("seed", range(CI))
def test_plan_samples_and_main_run_are_one_motion(seed: int) -> None:
    check(seed)


@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
@given(st.integers(CI, 1_000_000))
def test_so_they_are_on_programs_that_nobody_has_seen(seed: int) -> None:
    check(seed)
