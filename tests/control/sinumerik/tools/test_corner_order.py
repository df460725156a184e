"""Where functions and dwells stand that are programmed between the two moves of a chamfer or rounding."""

from __future__ import annotations

from typing import Any

import pytest

import polycnc


def order(text: str, behind: int = 0) -> list[tuple[str, int]]:
    """Type and line of all rows."""
    setup: dict[str, Any] = {"parameters": {"20201": behind, "20200": 2}}
    result = polycnc.run(text, control="sinumerik-840d", setup=setup)
    assert not result.alarms
    return [(row["type"], row["line"]) for row in result.rows]


@pytest.mark.parametrize("word", ["M8", "G4 F1", "Z-5", "H5"])
@pytest.mark.parametrize("shape", ["RND=3", "RNDM=3", "CHR=3", "CHF=3"])
def test_a_block_between_comes_in_front_of_the_shape_or_behind_it(word: str, shape: str) -> None:
    text = f"G1 F100 X20 {shape}\n{word}\nY20\nM30\n"
    assert [line for _, line in order(text)][:4] == [1, 2, 1, 3]
    assert [line for _, line in order(text, behind=1)][:4] == [1, 1, 2, 3]


def test_what_the_second_block_does_first_is_behind_the_shape() -> None:
    text = "G1 F100 X20 RND=3\nM7\nY20 M8\nM30\n"
    assert order(text)[:5] == [("feed", 1), ("m", 2), ("ccw", 1), ("m", 3), ("feed", 3)]


def test_order_holds_under_compensation() -> None:
    setup = {"tools": {1: {"radius": 2}}}
    text = "T1 D1 G1 F100\nG41 X5 Y0\nX20 RND=5\nM8\nY20\nG40 X40\nM30\n"
    rows = polycnc.run(text, control="sinumerik-840d", setup=setup).rows
    assert [row["line"] for row in rows][-6:] == [2, 3, 4, 3, 5, 6]
