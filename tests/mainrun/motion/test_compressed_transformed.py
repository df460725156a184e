"""Cuts led beside their ends under a transformation: one motion, the tip and its direction within tolerance."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest

import polycnc
from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.session import open_session
from polycnc.toolpath import Kind
from tests.examples import examples
from tests.mainrun.motion.drawn.beside import (
    InPolarPlane,
    OnCylinder,
    OnTip,
    OnTipByVectors,
    OnTipOfSyntec,
    on_a_machine,
)
from tests.mainrun.motion.test_compressed import farthest
from tests.mainrun.motion.test_disturbed import JERK, disturb
from tests.mainrun.motion.test_one_motion import compare
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from polycnc.motion.sampling.samples import Samples
    from polycnc.toolpath import Toolpath
    from tests.mainrun.motion.random_programs import Compressed

#: Programs of each kind.
DRAWN = 16
#: What is drawn: the writer of its programs, and its control.
KINDS: dict[str, tuple[type[Compressed], str]] = {
    "tip": (OnTip, "sinumerik-840d"),
    "vectors": (OnTipByVectors, "sinumerik-840d"),
    "syntec": (OnTipOfSyntec, "syntec-mill"),
    "polar plane": (InPolarPlane, "sinumerik-840d"),
    "cylinder": (OnCylinder, "sinumerik-840d"),
}
PERIOD, CYCLE = 0.001, 0.004
#: Between two samples the axes are beside their chord, by an eighth of their acceleration times the time squared, mm.
SLACK = 1e-3


def written(seed: int, kind: str) -> Compressed:
    made, control = KINDS[kind]
    draw = Random(seed)
    return on_a_machine(made, draw, control) if issubclass(made, OnTip) else made(draw, control)


def sampled(text: str, writer: Compressed) -> np.ndarray:
    """Machine positions, a row for each sample."""
    given: list[Samples] = []
    session = open_session(
        text.encode(), control=writer.control, machine=writer.machine, setup=writer.setup, keep=False
    )
    sampler = session.sample(PERIOD, given.append)
    session.run().plan  # noqa: B018 - plans to the end
    sampler.close()
    return np.concatenate([samples.position for samples in given])


def toolpath_of(text: str, writer: Compressed) -> Toolpath:
    run = polycnc.run(text.encode(), control=writer.control, machine=writer.machine, setup=writer.setup)
    assert run.ok, text
    return run.toolpath


def moved(toolpath: Toolpath) -> float:
    """How far ends are moved at most, mm."""
    cuts = (row for row in toolpath.rows() if row.kind is Kind.FEED and row.curve)
    return max((float(np.hypot.reduce(row.curve[:3])) for row in cuts), default=0.0)


def against_lines(text: str, writer: OnTip, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where the path is at places of the axes, the ends of its lines, and what it may be off them."""
    rows = [row for row in toolpath_of(text, writer).rows() if row.kind is Kind.FEED]
    transformation = rows[0].context.transformation
    assert transformation is not None
    on_path = np.stack(transformation.to_work(list(places.T)), axis=1)
    lines = np.array([on_path[0].tolist(), *(row.end for row in rows)])
    return on_path, lines, np.array([writer.tolerance + SLACK, *(writer.turn_tolerance + SLACK,) * 2])


def check_tip(text: str, writer: OnTip) -> None:
    """At every sample the tip is within the tolerance of its lines, and each axis that turns the tool of its own."""
    on_path, lines, bounds = against_lines(text, writer, sampled(text, writer))
    assert farthest(on_path, lines, bounds) <= 1.0, text
    assert farthest(lines, on_path, bounds) <= 1.0, text


@pytest.mark.parametrize("kind", KINDS)
def test_they_are_one_motion(kind: str) -> None:
    for seed in range(examples(DRAWN)):
        writer = written(seed, kind)
        text = writer.program()
        try:
            compare(text, writer)
        except Exception as error:
            error.add_note(f"seed {seed}:\n{text}")
            raise


@pytest.mark.parametrize("kind", ["tip", "vectors", "syntec"])
def test_the_tip_and_its_direction_keep_their_tolerances(kind: str) -> None:
    for seed in range(examples(DRAWN)):
        writer = written(seed, kind)
        text = writer.program()
        assert isinstance(writer, OnTip)
        check_tip(text, writer)


@pytest.mark.parametrize("kind", KINDS)
def test_ends_are_moved_in_many_of_them(kind: str) -> None:
    shifts = []
    for seed in range(DRAWN):
        writer = written(seed, kind)
        shifts.append(moved(toolpath_of(writer.program(), writer)) / writer.tolerance)
    assert sum(shift > 0.01 for shift in shifts) > DRAWN // 4
    assert max(shifts) <= 0.8 + 1e-9


@pytest.mark.parametrize("kind", ["tip", "vectors", "syntec"])
def test_no_script_leads_the_tip_off_its_tolerance_or_the_axes_beyond_their_jerk(kind: str) -> None:
    """Overrides, holds and single block."""
    for seed in range(examples(6)):
        writer = written(seed, kind)
        assert isinstance(writer, OnTip)
        text, draw = writer.program(), Random(seed)
        virtual = power_on(text, writer.control, machine=writer.machine, setup=parse_setup(writer.setup))
        places = [virtual.machine_position]
        virtual.cycle_start()
        while virtual.state is not State.READY and len(places) < 20_000:
            if draw.random() < 0.05 and len(places) < 1000:
                disturb(virtual, draw)
            elif len(places) >= 1000:
                virtual.override(feed=1.0, rapid=1.0)
                virtual.set_switches(single_block=False)
            if virtual.state in (State.HOLD, State.STOPPED) and draw.random() < 0.1:
                virtual.cycle_start()
            virtual.step()
            places.append(virtual.machine_position)
        on_path, lines, bounds = against_lines(text, writer, np.array(places))
        assert on_path[-1] == pytest.approx(lines[-1], abs=1e-9)
        assert farthest(on_path, lines, bounds) <= 1.0, text
        if "BRISK" not in text:
            assert np.abs(np.diff(places, 3, axis=0)).max() / CYCLE**3 <= JERK * 1.001, text
