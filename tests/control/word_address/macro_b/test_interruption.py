"""Interruption macros."""

from __future__ import annotations

from tests.support import ends, run


def test_an_interruption_acts_once() -> None:
    setup = {"switches": {"interrupts": [{"input": 1, "line": 3, "at": {"X": 4}}]}}
    text = "O0001\nM96 P2\nN5 G1 X8. F100\nG0 X0\n#1=#1+1\nIF [#1 LT 2] GOTO 5\nM30\nO0002\nG0 Z1.\nM99\n"
    assert ends(run(text, setup=setup)) == [(4, 0, 0), (4, 0, 1), (0, 0, 1), (8, 0, 1), (0, 0, 1)]


def test_without_m96_an_input_interrupts_nothing() -> None:
    setup = {"switches": {"interrupts": [{"input": 1, "line": 1, "at": {"X": 4}}]}}
    assert ends(run("G1 X8. F100\nM30\n", setup=setup)) == [(8, 0, 0)]
