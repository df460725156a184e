"""Cuts that are led beside their ends: one motion in plan, samples and main run, within the tolerance.

Compressors of SINUMERIK lead them there, G05 and G05.1 Q1 of SYNTEC.

`pytest --hypothesis-profile=explore` draws 2,000 others.
"""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from polycnc.toolpath import Kind
from tests.examples import examples
from tests.mainrun.motion.random_programs import (
    Compressed,
    CompressedTurns,
    Smoothed,
    SmoothedTurns,
    Turning,
)
from tests.mainrun.motion.test_disturbed import JERK, disturb
from tests.mainrun.motion.test_one_motion import compare
from tests.mainrun.support import power_on

CI, EXPLORE = 24, 2000
#: Between two samples the axes are beside their chord, by an eighth of their acceleration times the time squared, mm.
SLACK = 3e-5
#: The same of a rotary axis, degrees.
TURN_SLACK = 1e-4


#: What is drawn: the writer of its programs, and its control.
DRAWN = {
    "compressors": (Compressed, "sinumerik-840d"),
    "rotary axes": (CompressedTurns, "sinumerik-840d"),
    "syntec": (Smoothed, "syntec-mill"),
    "rotary axes of syntec": (SmoothedTurns, "syntec-mill"),
}


def written(seed: int, kind: str) -> tuple[str, Compressed]:
    made, control = DRAWN[kind]
    writer = made(Random(seed), control)
    return writer.program(), writer


def start_of(writer: Compressed) -> dict[str, Any]:
    return {"control": writer.control, "setup": {**writer.setup, "machine": writer.machine}}


def bounds_of(writer: Compressed) -> np.ndarray:
    """What X, Y and Z together, and each rotary axis, may leave the lines by."""
    turns = [writer.turn_tolerance] if isinstance(writer, Turning) else []
    return np.array([writer.tolerance + SLACK, *(each + TURN_SLACK for each in turns)])


def farthest(points: np.ndarray, line: np.ndarray, bounds: np.ndarray) -> float:
    """How far points leave a polygon, as a part of what they may: at the place of it that is best for all bounds."""
    scale = np.array([bounds[0]] * 3 + [*bounds[1:]])
    start, way = line[:-1] / scale, np.diff(line, axis=0) / scale
    found = 0.0
    for point in points / scale:
        best = np.inf
        for columns in (slice(3), slice(None), slice(3, None)):
            of = way[:, columns]
            length2 = np.maximum((of**2).sum(axis=1), 1e-30)
            share = np.clip(((point[columns] - start[:, columns]) * of).sum(axis=1) / length2, 0.0, 1.0)
            off = np.abs(start + share[:, None] * way - point)
            parts = np.maximum(np.sqrt((off[:, :3] ** 2).sum(axis=1)), off[:, 3:].max(axis=1, initial=0.0))
            best = min(best, parts.min())
        found = max(found, best)
    return found


def check_tolerance(text: str, writer: Compressed) -> None:
    """Samples of a program without arcs lie within the tolerance of its lines, and its ends within that of them."""
    given: list[Samples] = []
    session = open_session(text.encode(), **start_of(writer), keep=False)
    sampler = session.sample(0.0002, given.append)
    session.run().plan  # noqa: B018 - plans to the end
    sampler.close()
    toolpath = polycnc.run(text.encode(), **start_of(writer)).toolpath
    rows = [row for row in toolpath.rows() if row.kind is not Kind.EVENT]
    if any(row.kind not in (Kind.FEED, Kind.RAPID) for row in rows):
        return
    if " G64 " in text and any(row.kind is Kind.RAPID for row in rows):
        return  # what a corner to a rapid leaves the path by is up to the axes
    bounds = bounds_of(writer)
    ends = np.array([(0.0,) * (2 + len(bounds)), *(row.end[: 2 + len(bounds)] for row in rows)])
    places = np.concatenate([samples.position for samples in given])[:, : 2 + len(bounds)]
    places[:, 3:] = np.rad2deg(np.unwrap(np.deg2rad(places[:, 3:]), axis=0))
    assert farthest(places, ends, bounds) <= 1.0, text
    assert farthest(ends, places, bounds) <= 1.0, text


def check(seed: int, kind: str) -> None:
    text, writer = written(seed, kind)
    compare(text, writer)
    check_tolerance(text, writer)


@pytest.mark.parametrize("kind", DRAWN)
@pytest.mark.parametrize("seed", range(examples(CI)))
def test_they_are_one_motion_within_their_tolerance(seed: int, kind: str) -> None:
    check(seed, kind)


@given(st.integers(1000, 10**6), st.sampled_from([*DRAWN]))
@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
def test_so_they_are_in_random_programs(seed: int, kind: str) -> None:
    check(seed, kind)


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


@pytest.mark.parametrize("kind", ["compressors", "syntec"])
@pytest.mark.parametrize("seed", range(examples(12)))
def test_no_script_leads_the_axes_off_the_tolerance_or_beyond_their_limits(seed: int, kind: str) -> None:
    """Overrides, holds and single block: the path stays, and with limited jerk so does the jerk."""
    text, writer = written(seed, kind)
    toolpath = polycnc.run(text.encode(), **start_of(writer)).toolpath
    rows = [row for row in toolpath.rows() if row.kind is not Kind.EVENT]
    ends = np.array([(0.0, 0.0, 0.0), *(row.end[:3] for row in rows)])
    virtual, draw = power_on(text, writer.control, setup=parse_setup(writer.setup)), Random(seed)
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
        assert farthest(path, ends, bounds_of(writer)) <= 1.0, text
    if "BRISK" not in text:
        assert np.abs(np.diff(path, 3, axis=0)).max() / 0.004**3 <= JERK * 1.001, text
