"""Random programs with couplings and overlays: axes keep their limits, and disturbances change nothing of the end.

In every interpolation cycle no axis is faster than it can be, nor accelerates more, or an alarm comes. The same program
with overrides, holds and resumes at random times ends with the same positions and variables, as its actions ask for no
time. Programs have coupled motion with chains, master values by curve tables, electronic gears, arcs, and command axes
and overlays of synchronised actions. `pytest --hypothesis-profile=explore` draws 1,000 others.
"""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.mainrun import State
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from polycnc.mainrun import VirtualControl

CONTROL, MACHINE = "sinumerik-840d", "mill5-xyzvw"
CYCLE = 0.004
#: Differences of positions of many digits.
SLACK = 1.001
ROUNDING = 1e-6
#: Programs of a run in CI, and of one that explores.
CI, EXPLORE = 12, 1000
#: A table that is as smooth as its axis needs: a polynomial that comes to rest at both ends.
TABLE = "CTABDEF(V,X,1,0)\nX-400 V0\nPOLY PO[X]=(400) PO[V]=(60,180,-120)\nCTABEND\nG1"


class Program:
    """A program that couples axes, moves them and ends its couplings.

    Args:
        seed: Of its random numbers.
    """

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)
        self.lines = ["G1 F3000", self.random.choice(("SOFT", "BRISK")), self.random.choice(("G60", "G64"))]
        self.leads: dict[str, set[str]] = {}
        self.actions = 0

    def text(self) -> str:
        """Its lines; shifts come to rest before the end."""
        random = self.random
        if random.random() < 0.3:
            self.lines += TABLE.split("\n")
            self.lines += ["LEADON(V,X,1)"]
            self.leads["V"] = {"X"}
        for _ in range(random.randrange(4, 12)):
            random.choice((self.couple, self.move, self.move, self.arc, self.uncouple, self.act))()
        self.lines += [f"TRAILOF({axis})" for axis in self.leads]
        self.lines += ["G4 F1", "R1=$AA_IM[V] R2=$AA_IM[W]", "M30"]
        return "\n".join(self.lines) + "\n"

    def couple(self) -> None:
        """Coupled motion of V or W, also of one by the other."""
        random = self.random
        following = random.choice("VW")
        leading = random.choice([axis for axis in "XYZVW" if axis != following])
        if following in self.leads.get(leading, ()) or len(self.leads.get(following, ())) >= 2:
            return
        self.leads.setdefault(following, set()).add(leading)
        self.lines.append(f"TRAILON({following},{leading},{random.choice((-2, -0.5, 0.3, 1, 1.7))})")

    def uncouple(self) -> None:
        """Coupled motion of one axis ends."""
        following = self.random.choice("VW")
        self.lines.append(f"TRAILOF({following})")
        self.leads.pop(following, None)

    def move(self) -> None:
        """A line or a rapid, with ways of following axes by themselves."""
        random = self.random
        axes = [axis for axis in "XYZ" if random.random() < 0.6] or ["X"]
        own = [axis for axis in "VW" if random.random() < 0.2]
        words = [f"{axis}{random.uniform(-60, 60):.2f}" for axis in axes]
        words += [f"{axis}=IC({random.uniform(-20, 20):.2f})" for axis in own]
        self.lines.append(
            f"{random.choice(('G0', 'G1', 'G1'))} {' '.join(words)} F{random.randrange(500, 9000)}"
        )

    def arc(self) -> None:
        """A half circle in the plane."""
        x, y = (self.random.uniform(-15, 15) for _ in "XY")
        code, feed = self.random.choice(("G2", "G3")), self.random.randrange(500, 6000)
        self.lines.append(f"{code} X=IC({2 * x:.3f}) Y=IC({2 * y:.3f}) I{x:.3f} J{y:.3f} F{feed}")

    def act(self) -> None:
        """An action that shifts an axis beside the path as soon as another one passes a place, leading or following."""
        if self.actions < 3:
            self.actions += 1
            axis, place = self.random.choice("XY"), self.random.uniform(-30, 30)
            word, shifted = self.random.choice(("WHEN", "EVERY")), self.random.choice("XZZVW")
            self.lines.append(
                f"ID={self.actions} {word} $AA_IM[{axis}]>{place:.1f} "
                f"DO $AA_OFF[{shifted}]={self.random.uniform(-3, 3):.2f}"
            )


def executed(text: str) -> tuple[VirtualControl, np.ndarray]:
    """A control that has run the program, and where its axes were in each cycle."""
    virtual = power_on(text, CONTROL, machine=MACHINE)
    virtual.cycle_start()
    places = [virtual.positions.real]
    for _ in range(200_000):
        virtual.step(CYCLE)
        places.append(virtual.positions.real)
        if not virtual.is_busy:
            break
    return virtual, np.array([list(place.values()) for place in places])


def check_limits(seed: int) -> None:
    text = Program(seed).text()
    virtual, places = executed(text)
    if virtual.alarms:
        return
    assert virtual.state is State.READY, text
    steps = np.diff(places, axis=0)
    for i, axis in enumerate(virtual.machine.channel_axes(1)):
        data = virtual.machine.axis[axis]
        assert np.abs(steps[:, i]).max() <= data.rapid * CYCLE * SLACK + ROUNDING, (axis, text)
        slope = data.acceleration * CYCLE**2
        assert np.abs(np.diff(steps[:, i])).max(initial=0.0) <= slope * SLACK + ROUNDING, (axis, text)


def disturbed(text: str, random: Random) -> VirtualControl:
    """A control whose operator turns overrides, holds and goes on while the program runs."""
    virtual = power_on(text, CONTROL, machine=MACHINE)
    virtual.cycle_start()
    for _ in range(12):
        virtual.step(random.randrange(1, 300) * CYCLE)
        if virtual.state is State.READY:
            break
        match random.randrange(4):
            case 0:
                virtual.override(feed=random.choice((0.0, 0.3, 1.0, 1.2)))
            case 1:
                virtual.override(rapid=random.choice((0.0, 0.25, 1.0)))
            case 2 if virtual.state is State.RUNNING:
                virtual.feed_hold()
            case _ if virtual.state is State.HOLD:
                virtual.cycle_start()
    virtual.override(feed=1.0, rapid=1.0)
    if virtual.state is State.HOLD:
        virtual.cycle_start()
    virtual.run(limit_s=10_000.0)
    return virtual


def check_end(seed: int) -> None:
    text, random = Program(seed).text(), Random(seed)
    virtual = power_on(text, CONTROL, machine=MACHINE)
    virtual.cycle_start()
    virtual.run(limit_s=10_000.0)
    other = disturbed(text, random)
    assert [alarm.code for alarm in other.alarms] == [alarm.code for alarm in virtual.alarms], text
    if not virtual.alarms:
        assert list(other.positions.real.values()) == pytest.approx(
            list(virtual.positions.real.values()), abs=1e-6
        ), text
        for name in ("R1", "R2"):
            assert other.read_variable(name) == pytest.approx(virtual.read_variable(name), abs=1e-6), text


@pytest.mark.parametrize("seed", range(CI))
def test_no_axis_of_a_coupled_program_exceeds_its_limits(seed: int) -> None:
    check_limits(seed)


@pytest.mark.parametrize("seed", range(CI))
def test_disturbances_do_not_change_the_end(seed: int) -> None:
    check_end(seed)


@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
@given(st.integers(CI, 1_000_000))
def test_so_it_is_with_programs_that_nobody_has_seen(seed: int) -> None:
    check_limits(seed)
    check_end(seed)
