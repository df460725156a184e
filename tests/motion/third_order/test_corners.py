"""Corners of runs that a law leads: parameters bound the speed there, and the axes rest where that takes less time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.session import open_session

if TYPE_CHECKING:
    from polycnc.motion.sampling.samples import Samples

PERIOD = 0.0002
#: A line of 20 mm, another one that turns by 1 in 10, and a third one.
GENTLE = "G90 G1 X20. F6000.\nX40. Y2.\nX60. Y2.\n"
#: The turn of Y at its first corner, by the way.
TURN = 0.1 / np.hypot(1.0, 0.1)


def speeds(text: str, control: str, parameters: dict[str, object]) -> tuple[np.ndarray, np.ndarray]:
    """Places and speeds along the path."""
    given: list[Samples] = []
    session = open_session(
        text.encode(), control=control, machine="mill3", setup={"parameters": parameters}, keep=False
    )
    sampler = session.sample(PERIOD, given.append)
    assert session.run().plan.total_s > 0.0
    sampler.close()
    place, velocity = (np.concatenate([getattr(s, name) for s in given]) for name in ("position", "velocity"))
    return place, np.linalg.norm(velocity, axis=1)


def at_corner(place: np.ndarray, reach: float) -> np.ndarray:
    """Which places are so near to (20, 0)."""
    return np.abs(place[:, 0] - 20.0) <= reach


@pytest.mark.parametrize(
    ("control", "text", "parameters"),
    [
        ("syntec-mill", f"{GENTLE}M30\n", {"406": 300}),
        ("fanuc-m", f"O1\nG05.1 Q1\n{GENTLE}G05.1 Q0\nM30\n", {"1783 Y": 300}),
    ],
    ids=["Pr406", "1783"],
)
def test_the_velocity_of_no_axis_changes_by_more_at_a_corner(
    control: str, text: str, parameters: dict[str, object]
) -> None:
    most = 300.0 / 60.0 / TURN
    place, speed = speeds(text, control, parameters)
    assert 0.95 * most <= speed[at_corner(place, 0.003 * most)].max() <= most * 1.001
    assert speed[at_corner(place, 5.0)].max() > 1.5 * most
    _, free = speeds(text, control, {})
    assert len(free) < len(speed)


@pytest.mark.parametrize("length", [0.4, 20.0])
def test_what_it_changes_by_is_spread_over_the_shorter_line(length: float) -> None:
    """1737 bounds the speed on short lines all along, on long ones where the path bends."""
    zigzag = "".join(f"G1 X{length * k:.2f} Y{length * 0.05 * (k % 2):.3f} F6000.\n" for k in range(1, 20))
    text = f"O1\nG90\nG05.1 Q1\n{zigzag}G05.1 Q0\nM30\n"
    place, speed = speeds(text, "fanuc-m", {"1737 Y": 20})
    most = np.sqrt(20.0 * length / 0.1)
    within = (place[:, 0] > 1.5 * length) & (place[:, 0] < 17.5 * length)
    if length < 1.0:
        assert 0.95 * most <= speed[within].max() <= most * 1.01
    else:
        near = np.abs((place[:, 0] + 0.5 * length) % length - 0.5 * length) < 0.02
        assert speed[within & near].max() <= most * 1.01
        assert speed[within].max() > 1.2 * most


@pytest.mark.parametrize(
    ("control", "head"), [("syntec-mill", "G71"), ("sinumerik-840d", "SOFT G642 CTOL=0.01")]
)
def test_the_axes_rest_at_a_sharp_corner_of_long_lines_and_pass_a_gentle_one(control: str, head: str) -> None:
    place, speed = speeds(f"{head}\nG90 G1 X20. F6000.\nX20. Y20.\nX40. Y20.\nM30\n", control, {})
    corner = np.linalg.norm(place[:, :2] - [20.0, 0.0], axis=1) < 0.02
    assert speed[corner].min() < 1.0
    assert np.linalg.norm(place[:, :2] - [20.0, 0.0], axis=1).min() < 1e-4
    place, speed = speeds(f"{head}\n{GENTLE}M30\n", control, {})
    assert speed[at_corner(place, 1.0)].min() > 20.0


def test_the_axes_do_not_rest_for_what_is_slow_anyhow() -> None:
    place, speed = speeds("G71\nG90 G1 X20. F240.\nX20. Y20.\nX40. Y20.\nM30\n", "syntec-mill", {})
    corner = np.linalg.norm(place[:, :2] - [20.0, 0.0], axis=1) < 0.02
    assert speed[corner].min() > 1.0
