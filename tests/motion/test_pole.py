"""Through the centre of polar interpolation: the path rests there while the rotary axis turns."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import polycnc
from polycnc.machine import load_machine
from polycnc.mainrun import State
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.samples import Sampler, Samples
from tests.mainrun.support import power_on

MACHINE = load_machine("lathe-c-transmit")
SLACK = 1.0 + 1e-6


def polar(*blocks: str) -> polycnc.Result:
    """The blocks in the polar plane (X60 C0, where X counts radius), and one row for each of them from line 4 on."""
    text = "\n".join(["O1", "G98 G0 X120. Z5. C0", "G12.1", *blocks, "G13.1", "G0 X100. C10.", "M30", ""])
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    return result


def samples_of(result: polycnc.Result) -> Samples:
    """The sampled motion of a program, 1 ms."""
    found: list[Samples] = []
    planner = Planner(result.toolpath, MACHINE, **result.lead, compiled=False)
    settings = result.lead["settings"]
    sampler = Sampler(result.toolpath, MACHINE, planner, settings, 0.001, found.append)
    for chunk in result.toolpath.chunks:
        sampler.take(chunk)
    planner.finish()
    sampler.close()
    return Samples(*(np.concatenate(column) for column in zip(*found, strict=True)))


def assert_within_limits(samples: Samples) -> None:
    """Velocity, acceleration and jerk of every axis; and velocity is the change of position: nothing leaps."""
    ways = np.diff(samples.position, axis=0)
    ways[:, 2] = (ways[:, 2] + 180.0) % 360.0 - 180.0
    for i, name in enumerate("XZC"):
        axis = MACHINE.axis[name]
        speeds = np.abs(np.concatenate([ways[:, i] / 0.001, samples.velocity[:, i]]))
        assert speeds.max() <= max(axis.rapid, axis.max_feed) * SLACK
        assert np.abs(samples.acceleration[:, i]).max() <= axis.acceleration * SLACK
        assert np.abs(np.diff(samples.acceleration[:, i])).max() / 0.001 <= axis.jerk * SLACK


def turn_s(degrees: float) -> float:
    """The least time of C for a turn from rest to rest, by velocity and acceleration."""
    c = MACHINE.axis["C"]
    return degrees / c.max_feed + c.max_feed / c.acceleration


def seconds_of(result: polycnc.Result, line: int) -> float:
    """Planned time of the rows of a line: a path through the pole is cut there."""
    lines = [own for chunk in result.toolpath.chunks for own in chunk.line]
    return sum(time for time, own in zip(result.plan.row_s, lines, strict=True) if own == line)


THROUGH = [
    ("a line", ["G1 X-60. F3000"], 4),
    ("a slow line", ["G1 X-60. F300"], 4),
    ("a line beside it by less than is displayed", ["G1 C0.001 F3000", "X-60."], 5),
    ("two half circles", ["G1 X20. F3000", "G3 X0 C0 I-10. J0", "G2 X-20. C0 I-10. J0"], 6),
    ("a full circle", ["G1 X20. F3000", "G3 X20. C0 I-10. J0"], 5),
]


@pytest.mark.parametrize(
    ("blocks", "line"), [case[1:] for case in THROUGH], ids=[case[0] for case in THROUGH]
)
def test_a_path_through_the_centre_rests_there_while_c_turns_by_half_a_round(
    blocks: list[str], line: int
) -> None:
    result = polar(*blocks)
    samples = samples_of(result)
    assert_within_limits(samples)
    assert samples.time[-1] == pytest.approx(result.plan.total_s, abs=0.01)
    turning = (samples.position[:, 0] < 2e-4) & (np.abs(samples.velocity[:, 2]) > 1.0)
    assert np.abs(samples.velocity[turning, 0]).max() < 1e-3
    assert turning.sum() * 0.001 == pytest.approx(turn_s(180.0), rel=0.6)
    turned = np.abs(np.trapezoid(samples.velocity[turning, 2], dx=0.001))
    assert turned == pytest.approx(180.0, abs=1.0)
    assert len([row for row in result.rows if row.get("line") == line]) == 1


@pytest.mark.parametrize("feed", [300, 3000])
def test_a_line_through_the_centre_takes_its_way_and_half_a_turn(feed: int) -> None:
    way, taken = 120.0 / (feed / 60.0), seconds_of(polar(f"G1 X-60. F{feed}"), 4)
    assert way + turn_s(180.0) * 0.7 < taken < way + turn_s(180.0) + 0.8


@pytest.mark.parametrize(
    ("to", "degrees"), [("C20.", 90.0), ("X20. C20.", 45.0), ("X30.", 0.0), ("X-20. C-1.", 177.1376)]
)
def test_a_row_that_ends_at_the_centre_is_left_after_a_turn_by_the_angle_between(
    to: str, degrees: float
) -> None:
    result = polar("G1 X0 F3000", to)
    samples = samples_of(result)
    assert_within_limits(samples)
    there = (samples.line == 5) & (samples.position[:, 0] < 1.5e-4)
    assert np.abs(np.trapezoid(samples.velocity[there, 2], dx=0.001)) == pytest.approx(degrees, abs=0.5)


def test_z_moves_at_the_centre_without_a_turn() -> None:
    samples = samples_of(polar("G1 X0 F3000", "Z-3.", "C20."))
    assert_within_limits(samples)
    drilling = samples.line == 5
    assert drilling.any()
    assert np.abs(samples.velocity[drilling, 2]).max() < 1e-6


def test_a_plane_that_is_entered_at_the_centre_is_left_in_any_direction() -> None:
    text = "O1\nG98 G0 X0. Z5. C30.\nG12.1\nG1 C20. F3000\nG13.1\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    samples = samples_of(result)
    assert_within_limits(samples)
    assert samples.position[-1].tolist() == pytest.approx([20.0, 5.0, 120.0], abs=1e-6)


def test_the_nearer_a_line_passes_the_centre_the_longer_it_takes_but_not_much() -> None:
    """At best C turns by half a round from rest to rest; the plan allows itself a few of them."""
    beside = [0.5, 0.1, 0.02, 0.005, 0.002]
    taken = [seconds_of(polar(f"G1 C{distance} F3000", "X-60."), 5) for distance in beside]
    assert taken == sorted(taken)
    assert max(taken) < 120.0 / 50.0 + 7.0 * turn_s(180.0)
    assert all(b < 1.2 * a for a, b in pairwise(taken))


@pytest.mark.parametrize(
    "blocks", [["G1 X-60. F3000"], ["G1 X20. F3000", "G3 X20. C0 I-10. J0"], ["G1 X0 F3000", "Z3.", "C5."]]
)
@pytest.mark.parametrize("override", [0.5, 1.0])
def test_the_main_run_turns_at_the_centre_too(blocks: list[str], override: float) -> None:
    text = "\n".join(["O1", "G98 G0 X120. Z5. C0", "G12.1", *blocks, "G13.1", "G0 X100. C10.", "M30", ""])
    virtual = power_on(text, "fanuc-0i-tf", machine="lathe-c-transmit")
    virtual.override(feed=override)
    virtual.cycle_start()
    cycle, places = 0.004, [virtual.machine_position]
    while virtual.state is State.RUNNING:
        virtual.step()
        places.append(virtual.machine_position)
    assert virtual.state is State.READY
    ways = np.diff(np.array(places), axis=0)
    ways[:, 2] = (ways[:, 2] + 180.0) % 360.0 - 180.0
    for i, name in enumerate("XZC"):
        axis = MACHINE.axis[name]
        assert np.abs(ways[:, i]).max() / cycle <= max(axis.rapid, axis.max_feed) * SLACK
        assert np.abs(np.diff(ways[:, i], 1)).max() / cycle**2 <= axis.acceleration * SLACK
        assert np.abs(np.diff(ways[:, i], 2)).max() / cycle**3 <= axis.jerk * SLACK


def test_an_axis_that_goes_on_across_the_centre_steps_over_it_within_its_jerk() -> None:
    text = "G18 G94 DIAMON SOFT G642 G0 X60 Z5\nTRANSMIT\nG3 X-60 Y0 CR=151.9627 F1000\nTRAFOOF\nM30\n"
    result = polycnc.run(text.encode(), control="sinumerik-840d", machine="lathe-c-transmit")
    places = samples_of(result).position[:, 0]
    assert places.min() < -1.0 < 1.0 < places.max()
    assert np.abs(np.diff(places, 3)).max() <= MACHINE.axis["X"].jerk * 0.001**3 * SLACK
