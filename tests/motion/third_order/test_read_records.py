"""Who reads records of a jerk law: samples, the account of time, the follower of the main run."""

from __future__ import annotations

from array import array
from math import pi
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest

from polycnc.mainrun.motion.follower import Follower
from polycnc.mainrun.motion.geometry import piece_cubic
from polycnc.motion import Settings
from polycnc.motion.explain import Cause, TimeAccount
from polycnc.motion.kernels.columns import PieceRecord
from polycnc.motion.law import Phase
from polycnc.motion.phases.speed import Profile
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.samples import Sampler, Samples
from polycnc.motion.third_order.bend import bend
from polycnc.motion.third_order.law import quickest_law
from tests.motion.jerk_paths import JerkPath, polygon, zigzag
from tests.motion.paths import MILL
from tests.motion.third_order.laws import AXES
from tests.motion.third_order.recorded import Numbers, recorded

if TYPE_CHECKING:
    from polycnc.mainrun.preparation.items import Piece
    from polycnc.motion.third_order.bent_path import BentPath
    from polycnc.motion.third_order.law import JerkLaw

CENTRE = (0.0, 20.0)


def driven(path: JerkPath) -> tuple[BentPath, JerkLaw, Numbers]:
    """It, bent, with its law and records; these have the numbers of rows in the toolpath."""
    (bent,) = bend(path.programmed.path)
    law = quickest_law(bent, AXES)
    pieces = recorded(bent, law)
    pieces[:, PieceRecord.ROW] -= 1.0
    return bent, law, pieces


def causes(path: JerkPath) -> dict[Cause, float]:
    """The share of the time for which each cause held."""
    _, law, pieces = driven(path)
    rows = path.rows.toolpath
    planner = Planner(rows, MILL, settings=Settings(), compiled=False)
    account = TimeAccount(rows, planner, compiled=False)
    for chunk in rows.chunks:
        planner.take(chunk)
    assert planner.on_pieces is not None
    planner.on_pieces(array("d", pieces.ravel().tolist()), len(pieces))
    parts = account.parts
    assert sum(part.seconds for part in parts.values()) == pytest.approx(law.seconds, rel=1e-9)
    assert sum(part.way for part in parts.values()) == pytest.approx(law.length, rel=1e-9)
    return {cause: part.seconds / law.seconds for cause, part in parts.items() if part.seconds > 0.0}


def test_samples_are_places_of_the_law() -> None:
    path = polygon(JerkPath("square", 0.1, 80.0), 15.0, 4)
    bent, law, pieces = driven(path)
    rows, given = path.rows.toolpath, list[Samples]()
    planner = Planner(rows, MILL, settings=Settings(), compiled=False)
    sampler = Sampler(rows, MILL, planner, Settings(), 0.001, given.append)
    for chunk in rows.chunks:
        sampler.take(chunk)
    assert planner.on_pieces is not None
    half = len(pieces) // 2
    for part in (pieces[:half], pieces[half:]):
        planner.on_pieces(array("d", part.ravel().tolist()), len(part))
    sampler.close()
    times = np.concatenate([samples.time for samples in given])
    places = np.concatenate([samples.position for samples in given])
    assert times[-1] == pytest.approx(law.seconds, abs=0.001)
    assert np.abs(places - bent.at(law.at(times)[0])[0]).max() <= 1e-9
    # the line changes where the row ends
    lines = np.concatenate([samples.line for samples in given])
    ends = law.times_at(bent.row_way)
    assert lines.tolist() == (1 + np.searchsorted(ends, times, "right")).tolist()


UP_AND_DOWN = {Cause.ACCELERATION, Cause.JERK, Cause.STANDSTILL}


def test_a_long_slow_line_runs_at_its_feed() -> None:
    found = causes(JerkPath("line", 0.01, 100.0).line(150.0, 120.0, 40.0))
    assert found[Cause.FEED] > 0.9
    assert set(found) == {Cause.FEED, *UP_AND_DOWN}


def test_a_line_that_is_asked_to_be_faster_than_its_axis_runs_at_the_axis() -> None:
    found = causes(JerkPath("line", 0.01).line(200.0, 0.0, 0.0))
    assert found[Cause.AXES] == pytest.approx(0.69, abs=0.03)
    assert set(found) == {Cause.AXES, *UP_AND_DOWN}


def test_a_short_line_builds_up_its_acceleration_and_brakes_for_its_end() -> None:
    found = causes(JerkPath("line", 0.01).line(1.0, 0.0, 0.0))
    assert found == {Cause.JERK: pytest.approx(0.5, abs=0.02), Cause.STANDSTILL: pytest.approx(0.5, abs=0.02)}


def test_a_circle_is_bound_by_its_curve() -> None:
    found = causes(JerkPath("circle", 0.01).arc(*CENTRE, 4.0 * pi))
    assert found[Cause.CURVATURE] + found[Cause.CORNER_JERK] > 0.8
    assert set(found) == {Cause.CURVATURE, Cause.CORNER_JERK, *UP_AND_DOWN}


def test_a_square_is_bound_at_its_corners_and_accelerates_between_them() -> None:
    found = causes(polygon(JerkPath("square", 0.2), 50.0, 4))
    assert found[Cause.CORNER_JERK] > 0.3
    assert found[Cause.ACCELERATION] + found[Cause.JERK] > 0.3


def test_a_zigzag_of_short_lines_is_bound_at_its_corners() -> None:
    assert causes(zigzag(JerkPath("zigzag", 0.05), 2.0, 20, pi / 9.0))[Cause.CORNER_JERK] > 0.7


@pytest.mark.parametrize(("feed", "cause"), [(50.0, Cause.FEED), (1000.0, Cause.CURVATURE)])
def test_a_helix_runs_at_its_feed_or_at_what_its_curve_allows(feed: float, cause: Cause) -> None:
    found = causes(JerkPath("helix", 0.01, feed).arc(*CENTRE, 6.0 * pi, rise=5.0))
    assert found[cause] > 0.75
    assert len(found.keys() & {Cause.FEED, Cause.CURVATURE}) == 1


def test_a_phase_under_a_jerk_is_followed() -> None:
    phase = Phase(0.2, 0.2 * (30.0 + 0.2 * (50.0 - 0.2 * 1000.0 / 6.0)), 30.0, 100.0, -1000.0)
    profile = Profile((phase,), 30.0**2, arrives=True)
    way, speed = profile.after(0.1)
    assert way == pytest.approx(3.0 + 0.5 - 1000.0 * 0.001 / 6.0)
    assert speed == pytest.approx(30.0 + 10.0 - 5.0)
    assert profile.after(0.2) == pytest.approx((phase.way, 30.0))


def test_the_axes_follow_phases_under_a_jerk_along_their_pieces() -> None:
    path = polygon(JerkPath("square", 0.1), 15.0, 4)
    bent, law, pieces = driven(path)
    follower, time, behind = Follower(), 0.0, 0.0
    follower.begin(0.0, 0.0, 0.0)
    for piece in pieces.tolist():
        seconds, length = piece[PieceRecord.TIME], piece[PieceRecord.LENGTH]
        follower.enter(cast("Piece", piece_cubic(piece, 3)), length, behind)
        phase = Phase(
            seconds,
            length,
            piece[PieceRecord.SPEED2] ** 0.5,
            piece[PieceRecord.PULL],
            piece[PieceRecord.JERK],
        )
        follower.follow(time, 0.0, (phase,))
        for share in (0.3, 0.9):
            at = time + share * seconds
            place = bent.at(law.at(np.array([at]))[0])[0][0]
            assert follower.machine(at) == pytest.approx(place.tolist(), abs=1e-9)
            assert follower.speed(at) == pytest.approx(float(law.at(np.array([at]))[1][0]), abs=1e-6)
        time, behind = time + seconds, length
    assert follower.window == 0.0
