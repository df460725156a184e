"""What a round of bending leaves to the next is what it would find itself."""

from __future__ import annotations

from array import array
from math import cos, sin
from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.motion.third_order import parts
from polycnc.motion.third_order.bend import bend
from polycnc.motion.third_order.bends import bending, keeping
from polycnc.motion.third_order.compiled import plain
from tests.motion.third_order.programmed import Bounds, ProgrammedPath

if TYPE_CHECKING:
    from polycnc.kernels.layout import Floats
    from polycnc.motion.third_order.bends.controls import Spline

TOPS = array("d", (250.0, 250.0, 250.0))


def wandering(seed: int, count: int = 80) -> ProgrammedPath:
    """Lines of 0.2 to 2 mm in random directions of half a plane: some of their corners are bent twice."""
    draw, x, y = Random(seed), 0.0, 0.0
    path = ProgrammedPath([0.0] * 3, TOPS)
    for row in range(count):
        heading, length = draw.uniform(-1.3, 1.3), draw.uniform(0.2, 2.0)
        x, y = x + length * cos(heading), y + length * sin(heading)
        path.line([x, y, 0.0], row, Bounds(0.01, 80.0))
    return path


@pytest.mark.parametrize("seed", range(6))
def test_the_path_is_that_of_rounds_that_keep_nothing(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parts, "kernels", plain)
    kept, rounds = list[int](), list[int]()

    def note(spline: Spline, n: int, k: int, before: Floats, at: int) -> None:
        kept.append(k)
        put_back(spline, n, k, before, at)

    def nothing(spline: Spline, n: int, pieces: int, before: Floats, count: int) -> None:
        rounds.append(pieces)
        keeping.forget(spline, pieces)

    put_back = keeping.put_back
    monkeypatch.setattr(keeping, "put_back", note)
    (path,) = bend(wandering(seed).path)
    monkeypatch.setattr(bending, "take_over", nothing)
    (anew,) = bend(wandering(seed).path)
    assert len(kept) >= 0.5 * sum(rounds)
    assert path.way == pytest.approx(anew.way, abs=1e-9)
    for name in ("place", "first", "second"):
        assert np.abs(getattr(path, name) - getattr(anew, name)).max() < 1e-5, name


def test_some_of_these_paths_are_bent_more_than_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parts, "kernels", plain)
    found = list[int]()

    def note(spline: Spline, n: int, pieces: int, before: Floats, count: int) -> None:
        found.append(pieces)
        keeping.take_over(spline, n, pieces, before, count)

    monkeypatch.setattr(bending, "take_over", note)
    for seed in range(6):
        bend(wandering(seed).path)
    assert len(found) >= 3
