"""Any order of commands: an alarm or rows without a gap, never anything else."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, sin
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.compensation.policy import Policy
from polycnc.geometry.offset import Joint, Outer
from polycnc.messages import AlarmError
from tests.compensation import policies
from tests.compensation.support import CODES, Reader

_AVOIDS = replace(policies.FANUC_A, avoids=True, read_blocks=8)
POLICIES = [
    policies.FANUC_A, policies.FANUC_B, policies.FANUC_C, policies.SYNTEC, policies.HARTFORD,
    policies.SINUMERIK_NORM_G450, policies.SINUMERIK_KONT_G451, _AVOIDS, replace(_AVOIDS, outer=Outer(90.0, Joint.ARC)),
    replace(_AVOIDS, outer=Outer(90.0, Joint.ARC), dares=True),
]  # fmt: skip


def line_to(random: Random, at: list[float]) -> str:
    """The words of a point, near or far, often on a line along an axis."""
    u, v = (at[i] + random.choice([random.uniform(-20, 20), random.uniform(-3, 3), 0.0]) for i in (0, 1))
    return f"X{u:.3f} Y{v:.3f}"


def arc(random: Random, at: list[float]) -> str:
    """An arc of any angle, sometimes a full circle."""
    i, j, angle = random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(0, 7)
    radius = hypot(i, j)
    end = (at[0] + i + radius * cos(angle), at[1] + j + radius * sin(angle))
    if random.random() < 0.05:
        end = (at[0], at[1])
    return f"G{random.choice([2, 3])} X{end[0]:.4f} Y{end[1]:.4f} I{i:.6f} J{j:.6f}"


def direction(random: Random) -> str:
    return f"I{random.uniform(-1, 1):.2f} J{random.uniform(-1, 1):.2f}"


def block(random: Random, at: list[float]) -> str:
    """Mostly lines and arcs, and every command of compensation."""
    dice = random.random()
    if dice < 0.5:
        return f"G1 {line_to(random, at)}"
    if dice < 0.75:
        return arc(random, at)
    to = line_to(random, at)
    return random.choice(
        [
            f"G41 G1 {to}", f"G42 G1 {to}", "G41", "G42", "G40", "G40 I1 J2", f"G40 G1 {to}", f"G40 G1 {to} I1 J-1",
            f"G1 {to} {direction(random)}", f"G38 G1 {to}", "G39", f"G39 {direction(random)}", "M7",
            f"Z{random.uniform(-9, 9):.1f}", f"D{random.choice([-3, 2, 8])}", f"G1 X{at[0]:.3f}",
        ]
    )  # fmt: skip


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 10**9), st.sampled_from(POLICIES), st.booleans())
def test_any_commands_give_rows_without_a_gap_or_an_alarm(seed: int, policy: Policy, checks: bool) -> None:
    random = Random(seed)
    reader = Reader(policy, violations=CODES if checks else {})
    try:
        for _ in range(random.randint(3, 25)):
            reader.block(block(random, reader.position))
        reader.stage.flush()
    except AlarmError:
        assert checks
    for one, two in pairwise(reader.recorder.moves):
        assert one.end == pytest.approx(two.start, abs=1e-6)
