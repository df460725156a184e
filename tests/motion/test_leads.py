"""Threads whose lead changes: at every angle of the spindle they are where the lead asks them to be."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.motion.explain import Cause, TimeAccount
from polycnc.motion.kernels.speeds import rising_time, ways_to_cap
from polycnc.motion.planner import Planner
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode
from tests.motion.paths import LATHE, Build
from tests.motion.sampling.test_samples import SOFT, sampled

if TYPE_CHECKING:
    from polycnc.motion.sampling.run import Numbers
    from polycnc.motion.sampling.samples import Samples

BRISK = Settings(acceleration=AccelerationMode.CONSTANT)
RPM = 600.0
TURNS_S = RPM / 60.0
TURNING = Context(spindle_rpm=RPM, spindle_direction=1)
#: Part of a row that lies before what is looked at, and behind it: ways in and out, and what averages reach.
FIRST, LAST = 0.35, 0.7
#: Ends of rows, lead and its growth each revolution: along Z, across, oblique; shrinking; chains.
CHAINS = {
    "grows": [((20.0, -60.0), 2.0, 0.4)],
    "shrinks": [((20.0, -60.0), 5.0, -0.15)],
    "across": [((60.0, 5.0), 2.0, 0.4)],
    "oblique": [((30.0, -55.0), 2.0, 0.4)],
    "grows and shrinks": [
        ((20.0, -20.0), 2.0, 0.0),
        ((20.0, -60.0), 2.0, 0.2),
        ((20.0, -90.0), sqrt(20.0), 0.0),
        ((20.0, -130.0), sqrt(20.0), -0.2),
        ((20.0, -160.0), 2.0, 0.0),
    ],
    "from growing into shrinking": [
        ((20.0, -35.0), 2.0, 0.2),
        ((20.0, -75.0), sqrt(20.0), -0.2),
        ((20.0, -100.0), 2.0, 0.0),
    ],
    "grows on": [((20.0, -35.0), 2.0, 0.2), ((20.0, -75.0), sqrt(20.0), 0.2)],
}
Chain = list[tuple[tuple[float, float], float, float]]


def cut(rows: Build, chain: Chain) -> Build:
    """A chain of threads from X20 Z5 on, and the way back."""
    rows.rapid(20.0, 5.0)
    for end, lead, growth in chain:
        rows.row(Kind.THREAD, *end, curve=(lead, 0.0, growth))
    return rows.rapid(80.0, rows.end[1]).rapid(80.0, 5.0)


def turns_of(chain: Chain, way: Numbers) -> Numbers:
    """Revolutions behind which a chain has done a way along the axis that has the longest one."""
    done = turns = 0.0
    found, before = np.full(len(way), np.nan), (20.0, 5.0)
    for end, lead, growth in chain:
        own = max(abs(b - a) for a, b in zip(before, end, strict=True))
        here = way - done
        inside = (here > FIRST * own) & (here < LAST * own)
        found[inside] = turns + revolutions(lead, growth, here[inside])
        turns += float(revolutions(lead, growth, np.array([own]))[0])
        done, before = done + own, end
    return found


def revolutions(lead: float, growth: float, way: Numbers) -> Numbers:
    """The n for which `lead·n + growth·n²/2` is a way."""
    last: Numbers = np.sqrt(lead * lead + 2.0 * growth * way)
    return 2.0 * way / (lead + last)


def angles(samples: Samples, chain: Chain, first: int) -> Numbers:
    """The spindle's turns less those that the ways of a chain ask for, whose first row has a number."""
    at = (samples.line >= first) & (samples.line < first + len(chain))
    ways = np.abs(samples.position[at] - (20.0, 5.0))
    way = ways[:, int(np.argmax(ways[-1]))]
    apart: Numbers = samples.spindle_angle[at] / 360.0 - turns_of(chain, way)
    return apart[~np.isnan(apart)]


@pytest.mark.parametrize("lead", [BRISK, SOFT], ids=["brisk", "soft"])
@pytest.mark.parametrize("name", CHAINS)
def test_the_places_are_those_of_the_formula(name: str, lead: Settings) -> None:
    rows = cut(Build(axes=("X", "Z"), context=TURNING), CHAINS[name])
    total, samples = sampled(rows, LATHE, lead=lead)
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)
    apart = angles(samples, CHAINS[name], 2)
    assert len(apart) > 200
    assert np.abs(apart - apart[0]).max() < 1e-7


@pytest.mark.parametrize("lead", [BRISK, SOFT], ids=["brisk", "soft"])
def test_every_cut_begins_at_the_same_angle(lead: Settings) -> None:
    rows, starts, line = Build(axes=("X", "Z"), context=TURNING), [], 2
    chains: list[Chain] = [
        [((20.0, -60.0), 2.0, 0.0)],
        [((20.0, -60.0), 2.0, 0.4)],
        [((20.0, -60.0), 5.0, -0.15)],
        CHAINS["oblique"],
        CHAINS["grows and shrinks"],
    ]
    for chain in chains:
        cut(rows, chain)
    _, samples = sampled(rows, LATHE, lead=lead)
    for chain in chains:
        starts.append(angles(samples, chain, line)[0])
        line += len(chain) + 3
    for start in starts[1:]:
        assert (start - starts[0] + 0.5) % 1.0 == pytest.approx(0.5, abs=1e-6)


def test_an_axis_that_is_at_its_velocity_stays_there() -> None:
    machine = slow_lathe()
    for growth, first in ((0.4, 2.0), (-0.4, sqrt(56.0))):
        rows = cut(Build(axes=("X", "Z"), context=TURNING), [((20.0, -60.0), first, growth)])
        _, samples = sampled(rows, machine, lead=BRISK)
        speeds = np.abs(samples.velocity[samples.line == 2, 1])
        assert speeds.max() == pytest.approx(60.0, rel=1e-9)
        assert (speeds > 59.999).sum() > 20
        # Elsewhere it follows its lead.
        way = 5.0 - samples.position[samples.line == 2, 1]
        asked = TURNS_S * np.sqrt(first * first + 2.0 * growth * way)
        inside = (way > 5.0) & (way < 60.0) & (asked < 59.9)
        assert inside.sum() > 50
        assert speeds[inside] == pytest.approx(asked[inside], rel=1e-9)


def slow_lathe() -> Any:
    """The lathe with axes that are fast in rapids alone."""
    return replace(LATHE, axes=tuple(replace(axis, max_feed=60.0) for axis in LATHE.axes))


@pytest.mark.parametrize("growth", [40.0, -40.0])
def test_an_axis_that_cannot_accelerate_so_does_what_it_can(growth: float) -> None:
    first = 2.0 if growth > 0.0 else sqrt(2.0 * 40.0 * 65.0 + 4.0)
    rows = cut(Build(axes=("X", "Z"), context=TURNING), [((20.0, -60.0), first, growth)])
    _, samples = sampled(rows, LATHE, lead=BRISK)
    assert np.abs(samples.acceleration[:, 1]).max() <= LATHE.axis["Z"].acceleration * (1.0 + 1e-9)
    assert np.abs(samples.velocity[:, 1]).max() <= LATHE.axis["Z"].rapid * (1.0 + 1e-9)


@pytest.mark.parametrize("lead", [BRISK, SOFT], ids=["brisk", "soft"])
def test_what_the_lead_asks_for_counts_as_the_programmed_feed(lead: Settings) -> None:
    rows = cut(Build(axes=("X", "Z"), context=TURNING), CHAINS["grows and shrinks"])
    planner = Planner(rows.toolpath, LATHE, settings=lead, compiled=False)
    account = TimeAccount(rows.toolpath, planner, compiled=False)
    times = planner.finish().times
    asked = sum(
        revolutions(first, growth, np.array([way]))[0] / TURNS_S
        for (_, first, growth), way in zip(CHAINS["grows and shrinks"], (25, 40, 30, 40, 30), strict=True)
    )
    total = times.cutting_s + times.rapid_s
    assert sum(part.seconds for part in account.parts.values()) == pytest.approx(total, rel=1e-9)
    assert account.parts[Cause.FEED].seconds == pytest.approx(asked, rel=0.08)
    assert account.parts[Cause.AXES].seconds == 0.0


@given(
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
    st.floats(0.1, 3.0),
    st.floats(-0.95, 0.95),
    st.floats(0.1, 40.0),
)
def test_a_cap_that_rises_is_met_and_left_within_the_piece(
    start: float, end: float, cap: float, slope: float, length: float
) -> None:
    pull = 2.0
    rise, cap2 = 2.0 * pull * slope, 10.0 * cap
    last2 = cap2 + rise * length
    if last2 <= 0.0:
        return
    start2 = start * cap2
    end2 = min(end * last2, start2 + 2.0 * pull * length)
    start2 = min(start2, end2 + 2.0 * pull * length)
    up, down = ways_to_cap(start2, end2, cap2, rise, pull, length)
    assert 0.0 <= up <= length
    assert 0.0 <= down <= length
    assert up + down <= length * (1.0 + 1e-12)
    ways = np.linspace(0.0, length, 20_001)
    squares = np.minimum(
        cap2 + rise * ways, np.minimum(start2, end2 + 2.0 * pull * length) + 2.0 * pull * ways
    )
    squares = np.minimum(squares, np.minimum(start2 + 2.0 * pull * ways, end2 + 2.0 * pull * (length - ways)))
    speeds = np.sqrt(np.maximum(squares, 0.0))
    seconds = float((2.0 * np.diff(ways) / np.maximum(speeds[1:] + speeds[:-1], 1e-12)).sum())
    found, peak2 = rising_time(start2, end2, cap2, rise, pull, length)
    assert found == pytest.approx(seconds, rel=2e-3)
    assert peak2 == pytest.approx(float(squares.max()), rel=1e-3)


WAYS = [(1.0, 0.5), (0.01, 0.02), (4.0, 0.0), (0.0, 3.0)]


@pytest.mark.parametrize("growth", [0.0, 0.4, -0.04])
@pytest.mark.parametrize("ways", WAYS)
def test_a_thread_takes_up_its_speed_and_brakes_over_the_ways_that_it_names(
    ways: tuple[float, float], growth: float
) -> None:
    rows = Build(axes=("X", "Z"), context=TURNING).rapid(20.0, 5.0)
    rows.row(Kind.THREAD, 20.0, -25.0, curve=(3.0, 0.0, growth, *ways)).rapid(80.0, -25.0)
    _, samples = sampled(rows, LATHE, period=1e-4, lead=BRISK)
    way, speed = 5.0 - samples.position[:, 1], -samples.velocity[:, 1]
    asked = TURNS_S * np.sqrt(np.maximum(9.0 + 2.0 * growth * way, 0.0))
    own = LATHE.axis["Z"].acceleration
    for named, left in zip(ways, (way, 30.0 - way), strict=True):
        at = asked[np.argmin(np.abs(left - named))]
        reached = named or at * at / (2.0 * own)
        before = (samples.line == 2) & (left < 0.95 * reached) & (left > 1e-9)
        behind = (samples.line == 2) & (left > 1.1 * reached) & (left < 15.0)
        expected = np.sqrt(np.maximum(left, 0.0) * at * at / reached)
        assert speed[behind] == pytest.approx(asked[behind], rel=1e-9)
        assert speed[before] == pytest.approx(expected[before], rel=2e-2)


def test_only_the_ends_of_a_chain_take_up_speed_and_brake_so() -> None:
    rows, one = Build(axes=("X", "Z"), context=TURNING), (3.0, 0.0, 0.0, 2.0, 2.0)
    rows.rapid(20.0, 5.0).row(Kind.THREAD, 20.0, -10.0, curve=one).row(Kind.THREAD, 20.0, -20.0, curve=one)
    rows.row(Kind.THREAD, 20.0, -30.0, curve=(3.0, 0.0, 0.2, 2.0, 2.0)).rapid(80.0, -30.0)
    _, samples = sampled(rows, LATHE, lead=BRISK)
    way = 5.0 - samples.position[:, 1]
    middle = (samples.line >= 2) & (samples.line <= 4) & (way > 2.01) & (way < 32.9)
    asked = TURNS_S * np.sqrt(9.0 + 0.4 * np.maximum(way - 25.0, 0.0))
    assert -samples.velocity[middle, 1] == pytest.approx(asked[middle], rel=1e-9)
