"""Radius compensation in space beside that of a plane: with an upright tool both go the same way."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support import codes, ends, run

WAYS = st.tuples(st.sampled_from((-1, 1)), st.integers(15_000, 40_000)).map(
    lambda way: way[0] * way[1] / 1000
)
STEPS = st.lists(st.tuples(WAYS, WAYS), min_size=2, max_size=5)


def program(length: str, compensation: str, steps: list[tuple[float, float]]) -> str:
    blocks, x, y = [f"G90 {length} H1", "G00 X0 Y0 Z0", f"{compensation} D1"], 0.0, 0.0
    for dx, dy in steps:
        x, y = x + dx, y + dy
        blocks.append(f"G01 X{x:.3f} Y{y:.3f} F500")
    return "\n".join([*blocks, "G40 X-90. Y-90.", "M30", ""])


@settings(max_examples=10, deadline=None)
@given(
    steps=STEPS,
    radius=st.sampled_from((3.0, -3.0)),
    code=st.sampled_from(("G41", "G42")),
    type_b=st.integers(0, 1),
)
def test_an_upright_tool_goes_as_in_the_plane(
    steps: list[tuple[float, float]], radius: float, code: str, type_b: int
) -> None:
    tools, machine = {1: {"length": 50, "radius": radius}}, "mill5-bc-head"
    setup = {"tools": tools, "parameters": {"5003#0": type_b}}
    plane = run(program("G43", code, steps), setup=setup, machine=machine)
    space = run(program("G43.4", f"{code}.2", steps), setup=setup, machine=machine)
    assert codes(space) == codes(plane)
    if not codes(plane):
        assert len(ends(space)) == len(ends(plane))
        for a, b in zip(ends(space), ends(plane), strict=True):
            assert a == pytest.approx(b, abs=1e-5)


@pytest.mark.parametrize("code", ["G41.3", "G41.4", "G42.4", "G41.5", "G42.5"])
def test_forms_that_are_not_known_for_sure_are_refused(code: str) -> None:
    assert codes(run(f"G43.4 H1\n{code} D1\nM30\n", machine="mill5-ac-table")) == ["PC0001"]


def test_start_up_type_c_is_refused() -> None:
    setup = {"parameters": {"5003#1": 1}}
    assert codes(run("G43.4 H1\nG41.2 D1\nM30\n", setup=setup, machine="mill5-ac-table")) == ["PC0001"]


def test_type_b_ends_in_a_block_with_motion() -> None:
    setup = {"parameters": {"5003#0": 1}, "tools": {1: {"length": 50, "radius": 5}}}
    text = "G90 G43.4 H1\nG41.2 D1 G01 X10. F500\nX20.\nG40\nM30\n"
    assert codes(run(text, setup=setup, machine="mill5-ac-table")) == ["PC0001"]
