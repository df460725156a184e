"""Cuts that a compressor leads beside their ends: one motion in plan, samples and main run, within the tolerance.

`pytest --hypothesis-profile=explore` draws 2,000 others.
"""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from polycnc.toolpath import Kind
from tests.examples import examples
from tests.mainrun.motion.random_programs import Compressed
from tests.mainrun.motion.test_disturbed import JERK, disturb
from tests.mainrun.motion.test_one_motion import compare
from tests.mainrun.support import power_on

CI, EXPLORE = 24, 2000
#: Between two samples the axes are beside their chord, by an eighth of their acceleration times the time squared, mm.
SLACK = 3e-5


def written(seed: int) -> tuple[str, Compressed]:
    writer = Compressed(Random(seed), "sinumerik-840d")
    return writer.program(), writer


def distances(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """How far points are from a polygon."""
    start, way = line[:-1], np.diff(line, axis=0)
    length2 = np.maximum((way**2).sum(axis=1), 1e-30)
    found = np.empty(len(points))
    for i, point in enumerate(points):
        share = np.clip(((point - start) * way).sum(axis=1) / length2, 0.0, 1.0)
        found[i] = np.sqrt(((start + share[:, None] * way - point) ** 2).sum(axis=1).min())
    return found


def check_tolerance(text: str, tolerance: float) -> None:
    """Samples of a program without arcs lie within the tolerance of its lines, and its ends within that of them."""
    given: list[Samples] = []
    session = open_session(text.encode(), control="sinumerik-840d", keep=False)
    sampler = session.sample(0.0002, given.append)
    session.run().plan  # noqa: B018 - plans to the end
    sampler.close()
    toolpath = polycnc.run(text.encode(), control="sinumerik-840d").toolpath
    rows = [row for row in toolpath.rows() if row.kind is not Kind.EVENT]
    if any(row.kind not in (Kind.FEED, Kind.RAPID) for row in rows):
        return
    if " G64 " in text and any(row.kind is Kind.RAPID for row in rows):
        return  # what a corner to a rapid leaves the path by is up to the axes
    ends = np.array([(0.0, 0.0, 0.0), *(row.end[:3] for row in rows)])
    places = np.concatenate([samples.position for samples in given])[:, :3]
    assert distances(places, ends).max() <= tolerance + SLACK, text
    assert distances(ends, places).max() <= tolerance + SLACK, text


def check(seed: int) -> None:
    text, writer = written(seed)
    compare(text, writer)
    check_tolerance(text, writer.tolerance)


@pytest.mark.parametrize("seed", range(examples(CI)))
def test_compressed_programs_are_one_motion_within_their_tolerance(seed: int) -> None:
    check(seed)


@given(st.integers(1000, 10**6))
@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
def test_random_compressed_programs(seed: int) -> None:
    check(seed)


def noisy(code: str, mode: str) -> float:
    """Seconds of a straight line in facets of 0.1 mm with 4 µm of noise."""
    draw = Random(3)
    body = "".join(f"X{k * 0.1:.4f} Y{draw.uniform(-0.004, 0.004):.4f}\n" for k in range(1, 400))
    text = f"G71 G90 {mode} G642 {code} CTOL=0.01\nG1 F6000\n{body}M30\n"
    return polycnc.run(text.encode(), control="sinumerik-840d").time


@pytest.mark.parametrize(("mode", "least"), [("BRISK", 0.432), ("SOFT", 0.488)])
@pytest.mark.parametrize("code", ["COMPON", "COMPCURV", "COMPCAD"])
def test_noise_within_the_tolerance_costs_no_time(mode: str, least: float, code: str) -> None:
    assert noisy(code, mode) < 1.03 * least < 0.7 * noisy("COMPOF", mode)


@pytest.mark.parametrize("seed", range(examples(12)))
def test_no_script_leads_the_axes_off_the_tolerance_or_beyond_their_limits(seed: int) -> None:
    """Overrides, holds and single block: the path stays, and under SOFT so does the jerk."""
    text, writer = written(seed)
    toolpath = polycnc.run(text.encode(), control="sinumerik-840d").toolpath
    rows = [row for row in toolpath.rows() if row.kind is not Kind.EVENT]
    ends = np.array([(0.0, 0.0, 0.0), *(row.end[:3] for row in rows)])
    virtual, draw = power_on(text, "sinumerik-840d"), Random(seed)
    places = [virtual.machine_position[:3]]
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
        places.append(virtual.machine_position[:3])
    assert virtual.machine_position[:3] == pytest.approx(ends[-1].tolist(), abs=1e-9)
    path = np.array(places)
    if all(row.kind in (Kind.FEED, Kind.RAPID) for row in rows):
        assert distances(path, ends).max() <= writer.tolerance + SLACK, text
    if "SOFT" in text:
        assert np.abs(np.diff(path, 3, axis=0)).max() / 0.004**3 <= JERK * 1.001, text
