"""Overrides, holds and single block in the middle of a run: the path and its end stay, and so do the axes' limits."""

from __future__ import annotations

from itertools import pairwise
from math import cos, dist, inf, sin, sqrt
from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State, VirtualControl
from tests.examples import examples
from tests.mainrun.support import MILL, execution_of, power_on, recorded

if TYPE_CHECKING:
    from collections.abc import Iterator

SCRIPTS = 1000


def joints_of(virtual: VirtualControl) -> list[tuple[float, ...]]:
    """The ends of all rows that the axes will have run along, in order.

    Where a row is cut into pieces depends on what is prepared behind it: in single block nothing is.
    """
    joints: list[tuple[float, ...]] = []
    arrive = execution_of(virtual)._arrive

    def noted() -> None:
        motion = execution_of(virtual).motion
        is_last = motion is not None and motion.piece.first + motion.piece.share >= 1.0 - 1e-9
        arrive()
        if is_last:
            joints.append(tuple(execution_of(virtual).position))

    execution_of(virtual)._arrive = noted  # type: ignore[method-assign]
    return joints


def disturb(virtual: VirtualControl, random: Random) -> None:
    """One thing that an operator may do."""
    match random.randrange(6):
        case 0:
            virtual.override(feed=random.choice((0.0, 0.1, 0.5, 1.0, 1.2, 2.0)))
        case 1:
            virtual.override(rapid=random.choice((0.0, 0.25, 1.0)))
        case 2:
            virtual.set_switches(single_block=random.random() < 0.5)
        case 3 if virtual.state is State.RUNNING:
            virtual.feed_hold()
        case _ if virtual.state in (State.HOLD, State.STOPPED):
            virtual.cycle_start()


def play(virtual: VirtualControl, random: Random, commands: int) -> Iterator[None]:
    """A random script; then everything goes back to normal and the program to its end."""
    virtual.cycle_start()
    yield
    for _ in range(commands):
        for _ in range(random.randrange(4)):
            virtual.step(random.randrange(1, 60) * 0.004)
            yield
        if virtual.state is State.READY:
            return
        disturb(virtual, random)
    virtual.override(feed=1.0, rapid=1.0)
    virtual.set_switches(single_block=False)
    while virtual.state is not State.READY:
        if virtual.state is not State.RUNNING:
            virtual.cycle_start()
        virtual.step(0.1)
        yield


def undisturbed() -> tuple[list[tuple[float, ...]], list[float]]:
    virtual = power_on()
    joints = joints_of(virtual)
    virtual.cycle_start()
    virtual.run()
    return joints, virtual.machine_position


def test_a_thousand_scripts_end_where_the_undisturbed_run_ends() -> None:
    path, end = undisturbed()
    for seed in range(examples(SCRIPTS)):
        virtual = power_on()
        joints = joints_of(virtual)
        for _ in play(virtual, Random(seed), 12):
            pass
        assert virtual.machine_position == end, seed
        assert joints == path, seed


def test_the_same_script_gives_the_same_trace() -> None:
    def trace() -> list[object]:
        virtual = power_on()
        records = recorded(virtual)
        positions = [virtual.machine_position for _ in play(virtual, Random(7), 40)]
        return [records, positions]

    assert trace() == trace()


def test_every_position_lies_on_the_path_or_within_the_tolerance_of_it() -> None:
    for seed in range(examples(20)):
        virtual = power_on("O1\nG1 X20. F3000\nG2 X30. Y10. R10.\nG1 Y40.\nM30\n")
        for _ in play(virtual, Random(seed), 20):
            x, y, _z = virtual.machine_position
            lines = [dist((x, y), (min(x, 20.0), 0.0)), dist((x, y), (30.0, max(y, 10.0)))]
            arc = abs(dist((x, y), (30.0, 0.0)) - 10.0) if 19.9 <= x <= 30.1 and y >= 0.0 else inf
            assert min(*lines, arc) <= TOLERANCE, seed
        assert virtual.machine_position == [30.0, 40.0, 0.0]


#: A slow axis, so that arcs are bound by it: mm/s² and mm/s of every axis.
PULL, TOP, JERK = 3000.0, 15000.0 / 60.0, 50000.0
ARCS = "O1\nG1 X20. F15000\nG2 X30. Y10. R10.\nG1 Y14.\nG3 X20. Y24. R10.\nX0 Y4. R20.\nG1 X-10.\nM30\n"


#: Gentle corners in short lines, which bound each other (`motion/kernels/hold.py`).
CORNERS = "O1\nG1 F6000\n" + "".join(f"X{0.7 * k:.3f} Y{0.2 * (k % 3):.3f}\n" for k in range(1, 60)) + "M30\n"
#: What the rounding of corners may deviate by, mm.
TOLERANCE = 0.01


@pytest.mark.parametrize("text", [ARCS, MILL], ids=["arcs", "mill"])
def test_no_script_makes_an_axis_exceed_its_acceleration(text: str) -> None:
    cycle = 0.004
    jump = 1.2 * PULL * cycle  # what an axis may step by at a corner
    for seed in range(examples(40)):
        virtual = power_on(text)
        random = Random(seed)
        positions = [virtual.machine_position]
        virtual.cycle_start()
        for _ in range(4000):
            if random.random() < 0.05:
                disturb(virtual, random)
            virtual.step()
            positions.append(virtual.machine_position)
            if virtual.state is State.READY:
                break
        speeds = [[(b - a) / cycle for a, b in zip(p, q, strict=True)] for p, q in pairwise(positions)]
        assert max(abs(v) for speed in speeds for v in speed) <= max(TOP, 24000.0 / 60.0) * 1.001
        for before, after in pairwise(speeds):
            for a, b in zip(before, after, strict=True):
                assert abs(b - a) <= (PULL * cycle + jump) * 1.01, seed


@pytest.mark.parametrize("text", [ARCS, MILL, CORNERS], ids=["arcs", "mill", "corners"])
def test_no_script_makes_an_axis_exceed_its_jerk(text: str) -> None:
    """The third difference of positions is a mean of the jerk: never above its limit."""
    cycle = 0.004
    for seed in range(examples(25)):
        virtual, random = power_on(text), Random(seed)
        places = [virtual.machine_position[:2]] * 3
        virtual.cycle_start()
        for _ in range(1500):
            if random.random() < 0.05:
                disturb(virtual, random)
            virtual.step()
            places.append(virtual.machine_position[:2])
            if virtual.state is State.READY:
                break
        for a, b, c, d in zip(places, places[1:], places[2:], places[3:], strict=False):
            for p, q, r, s in zip(a, b, c, d, strict=True):
                assert abs(s - 3.0 * r + 3.0 * q - p) / cycle**3 <= JERK * 1.001, seed


def test_a_tool_that_brisk_moves_is_at_rest_as_soon_as_its_plan_is() -> None:
    brisk = power_on("BRISK G64 G1 X100 F6000\nM30\n", "sinumerik-840d")
    soft = power_on("SOFT G64 G1 X100 F6000\nM30\n", "sinumerik-840d")
    for virtual in (brisk, soft):
        virtual.cycle_start()
        virtual.step(0.4)
        virtual.feed_hold()
        virtual.run()
    assert brisk.time == pytest.approx(0.4 + 100.0 / PULL, abs=0.005)
    ramp = sqrt(100.0 / JERK)
    assert soft.time == pytest.approx(0.4 + 100.0 / (JERK * ramp) + ramp, abs=0.005)


def test_feed_hold_brakes_within_the_acceleration_and_stays() -> None:
    virtual = power_on("O1\nG1 X100. F6000\nM30\n")
    virtual.cycle_start()
    virtual.step(0.4)
    before = virtual.machine_position[0]
    virtual.feed_hold()
    virtual.run()
    assert virtual.state is State.HOLD
    # The axes are half of the line's ramp T = √(v/j) behind, then they brake at j·T (`kernels/alone.py`).
    ramp = sqrt(100.0 / JERK)
    braking = 100.0 * 0.5 * ramp + 100.0**2 / (2.0 * JERK * ramp)
    assert virtual.machine_position[0] - before == pytest.approx(braking)
    stands = virtual.machine_position
    virtual.step(5.0)
    assert virtual.machine_position == stands
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.positions.work["X"] == 100.0


def test_an_override_changes_the_speed_while_moving() -> None:
    virtual = power_on("O1\nG1 X1000. F1200\nM30\n")
    virtual.cycle_start()
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(1200.0)
    virtual.override(feed=0.5)
    assert virtual.feed == pytest.approx(1200.0)
    virtual.step(0.1)
    assert virtual.feed == pytest.approx(600.0)
    virtual.override(feed=0.0)
    virtual.step(1.0)
    assert virtual.feed == 0.0
    assert virtual.run() is State.RUNNING, "it waits for the override"
    virtual.override(feed=2.0)
    virtual.step(1.0)
    assert virtual.feed == pytest.approx(2400.0)


def test_an_override_of_the_feed_leaves_rapids_alone() -> None:
    virtual = power_on("O1\nG0 X100.\nM30\n")
    virtual.override(feed=0.0)
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_a_program_whose_last_move_knows_no_hold_ends_with_it() -> None:
    virtual = power_on(
        "G90 G0 X30. Z2.\nM3 S500\nG33 Z-10. F2.\nM30\n", "fanuc-0i-tf", setup={"parameters": {"3401#7": 1}}
    )
    virtual.cycle_start()
    virtual.run_until(lambda control: control.machine_position[1] < -5.0)
    virtual.feed_hold()
    assert virtual.run() is State.READY
    assert virtual.machine_position[1] == pytest.approx(-10.0)


def test_a_tap_knows_no_override_and_no_hold() -> None:
    text = "O1\nM29 S600\nG84 Z-20. R2. F600\nG80\nM30\n"
    plain, disturbed = power_on(text), power_on(text)
    plain.cycle_start()
    plain.run()
    disturbed.cycle_start()
    disturbed.run_until(lambda control: control.machine_position[2] < -5.0)
    disturbed.override(feed=0.1)
    disturbed.feed_hold()
    disturbed.run()
    assert disturbed.machine_position[2] == pytest.approx(
        0.0, abs=1e-6
    )  # the end of the cycle: its initial level
    disturbed.override(feed=1.0)
    disturbed.cycle_start()
    assert disturbed.run() is State.READY
    assert disturbed.time == pytest.approx(plain.time, abs=0.05)


#: Runs of SINUMERIK under SOFT, which a law leads (`execution/by_law.py`).
BY_LAW = {
    "lines": "SOFT G642 G1 X20 F6000\nY20\nX40 Y25\nY0\nX60\nX61 Y3\nX62 Y2\nX80\nM30\n",
    "arcs": "SOFT G645 G1 X20 F6000\nY20\nG2 X40 Y20 CR=10\nG3 X60 Y20 CR=15 Z3\nG1 X61\nG0 X70 Y30\nG1 Y40\nM30\n",
    "facets": "SOFT G642 CTOL=0.02 G1 F4000\n"
    + "".join(f"X{20 - 20 * cos(k / 20):.3f} Y{20 * sin(k / 20):.3f}\n" for k in range(1, 80))
    + "M30\n",
    "spline": "SOFT G642 G1 X10 F5000\nBSPLINE X20 Y10\nX30 Y0\nX40 Y15\nX50 Y0\nCSPLINE X60 Y5\nX70 Y0\nG1 X90\nM30\n",
    "distance": "SOFT G641 ADIS=1 G1 X20 F6000\nY20 M8\nX40 Y25\nG0 X50\nG1 X61 Y3\nX62 Y2\nM30\n",
    "sharp": "SOFT G64 G1 X20 F6000\nX30 Y1\nX40 Y2.5\nY0\nX60\nX61 Y.3\nX80\nM30\n",
    "back": "SOFT G64 G3 X10 Y10 J10 F6000\nG1 X10.8 Y0\nG2 X10.5 Y10 CR=30\nG1 X10\nG2 X20 Y0.5 CR=80\nM30\n",
}
#: Cuts of the word-address controls that are planned ahead, of which some blocks have corners with parameters.
AHEAD = "G90 G1 X20. F6000.\nX30. Y1.\nX40. Y0.5\nG3 X60. Y20. R20.\nG1 Y22.\nX60.4 Y24.\nX61. Y25.\nX62. Y25.6\nX80.\n"
BY_CONTROL: dict[str, tuple[str, str, dict[str, object]]] = {
    "syntec": ("syntec-mill", f"{AHEAD}M30\n", {}),
    "syntec, Pr406 and Pr408": ("syntec-mill", f"{AHEAD}M30\n", {"406": 120, "408": 500}),
    "fanuc": ("fanuc-m", f"O1\nG05.1 Q1\n{AHEAD}G05.1 Q0\nM30\n", {}),
    "fanuc, 1783 and 1737": (
        "fanuc-m",
        f"O1\nG05 P10000\n{AHEAD}G05 P0\nM30\n",
        {"1783 Y": 100, "1737 Y": 50},
    ),
    "meldas": ("meldas-m", f"O1\nG05 P10000\n{AHEAD}G05 P0\nM30\n", {}),
}
RUNS: dict[str, tuple[str, str, dict[str, object]]] = {
    name: ("sinumerik-840d", text, {}) for name, text in BY_LAW.items()
} | BY_CONTROL


def every_ms(virtual: VirtualControl, places: list[list[float]]) -> None:
    """Let a cycle pass; where the axes are at every millisecond of it."""
    clock = virtual._loop._clock
    begin, count = clock.time, round(clock.cycle_s / 0.001)
    for k in range(1, count):
        virtual._loop._advance(begin + 0.001 * k)
        places.append(virtual.machine_position)
    virtual.step()
    places.append(virtual.machine_position)


@pytest.mark.parametrize("name", RUNS)
def test_no_script_disturbs_a_run_by_law_beyond_its_limits(name: str) -> None:
    control, text, parameters = RUNS[name]
    setup = parse_setup({"parameters": parameters})
    whole = power_on(text, control, setup=setup)
    path: list[list[float]] = [whole.machine_position]
    whole.cycle_start()
    while whole.state is State.RUNNING:
        every_ms(whole, path)
    lines = np.array(path)
    start, way = lines[:-1], np.diff(lines, axis=0)
    moved = (way**2).sum(axis=1) > 1e-16
    start, way = start[moved], way[moved]
    for seed in range(2):
        virtual, random = power_on(text, control, setup=setup), Random(f"{name} {seed}")
        places = [virtual.machine_position] * 4
        virtual.cycle_start()
        for k in range(8000):
            if k < 1200 and random.random() < 0.03:
                disturb(virtual, random)
            elif k >= 1200:
                virtual.override(feed=1.0, rapid=1.0)
                virtual.set_switches(single_block=False)
                if virtual.state in (State.HOLD, State.STOPPED):
                    virtual.cycle_start()
            every_ms(virtual, places)
            if virtual.state is State.READY:
                break
        assert virtual.machine_position == whole.machine_position, seed
        found = np.array(places)
        assert np.abs(np.diff(found, axis=0)).max() <= 400.0 * 0.001 * 1.001, seed
        assert np.abs(np.diff(found, 2, axis=0)).max() <= PULL * 0.001**2 * 1.002, seed
        assert np.abs(np.diff(found, 3, axis=0)).max() <= JERK * 0.001**3 * 1.002, seed
        for place in found[::5]:
            share = np.clip(((place - start) * way).sum(axis=1) / (way**2).sum(axis=1), 0.0, 1.0)
            off = np.sqrt(((start + share[:, None] * way - place) ** 2).sum(axis=1)).min()
            assert off <= (1.0 if name == "distance" else 0.021), seed


def test_a_hold_of_a_run_by_law_takes_as_long_as_the_axes_need() -> None:
    for after in range(8):
        virtual = power_on(BY_LAW["facets"], "sinumerik-840d")
        virtual.cycle_start()
        virtual.step(0.3 + 0.05 * after)
        speed, time = execution_of(virtual).speed, virtual.time
        virtual.feed_hold()
        virtual.run()
        assert virtual.state is State.HOLD
        assert virtual.time - time <= 1.3 * 2.0 * sqrt(speed / JERK)
