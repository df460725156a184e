"""The tip and the axes under TRAORI, at every sample of the motion."""

from __future__ import annotations

import random
from math import hypot
from typing import TYPE_CHECKING

import numpy as np
import pytest

import polycnc
from polycnc.control.sinumerik.transformations.data_sets import in_order
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.samples import Sampler, Samples
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

if TYPE_CHECKING:
    from polycnc.machine import Machine

LENGTH = 120.0
HEADS = ("mill5-ca-head", "mill5-bc-head", "mill5-ac-table")
SLACK = 1.0 + 1e-6


def run(text: str, machine: str) -> polycnc.Result:
    result = polycnc.run(
        text, control="sinumerik-840d", machine=machine, setup={"tools": {1: {"length": LENGTH}}}
    )
    assert not result.alarms, result.alarms
    return result


def samples_of(result: polycnc.Result, machine: Machine) -> Samples:
    """The sampled motion of the real axes, a millisecond each."""
    found: list[Samples] = []
    planner = Planner(result.toolpath, machine, **result.lead, compiled=False)
    sampler = Sampler(result.toolpath, machine, planner, result.lead["settings"], 0.001, found.append)
    for chunk in result.toolpath.chunks:
        sampler.take(chunk)
    planner.finish()
    sampler.close()
    return Samples(*(np.concatenate(column) for column in zip(*found, strict=True)))


def direction(chance: random.Random) -> str:
    """A direction within 60 degrees of Z."""
    a, b = (round(chance.uniform(-1.0, 1.0), 4) for _ in range(2))
    return f"A3={a} B3={b} C3=1"


def tips_of(samples: Samples, machine: Machine) -> np.ndarray:
    names = machine.channel_axes(1)
    point = ToolCentrePoint(
        Kinematics.of(machine), names, (0, 1, 2), (0.0,) * len(names), (0.0, 0.0, -LENGTH)
    )
    return np.stack(point.to_work(list(samples.position.T)), axis=1)[:, :3]


@pytest.mark.parametrize("name", HEADS)
def test_the_tip_keeps_to_its_line_at_every_sample(name: str) -> None:
    machine, chance = load_machine(name), random.Random(name)
    for _ in range(6):
        start, end = ([round(chance.uniform(-80.0, 80.0), 3) for _ in range(3)] for _ in range(2))
        x, y, z = start
        text = (
            f"T1 D1 F3000\nG60\nTRAORI\nG0 X{x} Y{y} Z{z} {direction(chance)}\n"
            f"G1 X{end[0]} Y{end[1]} Z{end[2]} {direction(chance)}\nM30\n"
        )
        tips = tips_of(samples_of(run(text, name), machine), machine)
        begin, way = np.array(start), np.array(end) - np.array(start)
        along = way / hypot(*way)
        beside = tips - begin
        cut = beside[np.argmin(np.linalg.norm(beside, axis=1)) + 1 :]
        off = cut - np.outer(cut @ along, along)
        assert np.linalg.norm(off, axis=1).max() < 1e-3
        # The last sample is up to a millisecond before the end: braking, the tip has less left than it went before.
        left, gone = hypot(*(end - tips[-1])), hypot(*(tips[-1] - tips[-2]))
        assert left < max(1e-3, gone)


@pytest.mark.parametrize("name", ["mill5-ca-head", "mill5-ac-table"])
@pytest.mark.parametrize("miss", [0.0, 0.02, 0.05, 0.2])
def test_near_the_pole_no_axis_exceeds_its_limits(name: str, miss: float) -> None:
    """The direction passes Z by 0 to 11 degrees: the first rotary axis turns by half a round."""
    machine = load_machine(name)
    text = (
        "T1 D1 F8000\nSOFT G64\nTRAORI\nG0 X0 Y0 Z0 A3=-1 C3=1.5\n"
        f"G1 X30 A3=0 B3={miss} C3=1\nX60 A3=1 C3=1.5\nM30\n"
    )
    samples = samples_of(run(text, name), machine)
    for i, axis_name in enumerate(machine.channel_axes(1)):
        axis = machine.axis[axis_name]
        ways = np.abs(np.diff(samples.position[:, i])) / 0.001
        top = max(axis.rapid, axis.max_feed)
        assert ways.max() <= top * 1.001, axis_name
        assert np.abs(samples.velocity[:, i]).max() <= top * 1.001, axis_name
        assert np.abs(samples.acceleration[:, i]).max() <= axis.acceleration * 1.05, axis_name


def test_the_axes_of_a_head_count_from_the_base() -> None:
    assert in_order(Kinematics.of(load_machine("mill6-cac-head"))) == ("C", "A", "B")


def test_a_spline_whose_rotary_axes_turn_far_on_a_short_way_has_a_time() -> None:
    """Its chords bend by more than any path can: the tip stands nearly still while the axes turn."""
    text = (
        "T1 D1 F1000\nTRAORI\nD0\nTOFFL=0.1\nCSPLINE X-30 Y-1 A3=0.3 C3=1\n"
        "X-22 A4=0 B4=0.1 C4=1 A5=0.7 B5=0 C5=1\nLEAD=39 TILT=32 A5=0 B5=-0.2 C5=1\nM30\n"
    )
    result = polycnc.run(
        text,
        control="sinumerik-840d",
        machine="mill5-ac-table",
        setup={"tools": {1: {"length": 100, "radius": 3}}},
    )
    samples = samples_of(result, load_machine("mill5-ac-table"))
    assert np.isfinite(samples.position).all()
