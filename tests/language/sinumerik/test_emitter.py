"""What the code of a block says of itself, and how many shapes a program has."""

from __future__ import annotations

from typing import Any
from unittest.mock import patch

import pytest

from polycnc.control.registry import control
from polycnc.control.sinumerik.control import Sinumerik
from polycnc.language.sinumerik.blocks import compile_block
from polycnc.language.sinumerik.emitter import Emitter
from polycnc.session import open_session
from tests.language.sinumerik.running import run, value


def emitter_of(line: str) -> Emitter:
    """The code of the second block of a program."""
    session = open_session(f"DEF INT COUNT\n{line}\nG94 F50\nDONE: M30\n", control="sinumerik-840d")
    result = session.run()
    assert result.alarms == []
    code: Any = result.channel.stack[0].code
    return compile_block(code, 1, result.channel).emitter


@pytest.mark.parametrize("line", ["G1 G94 X10 Y=-5.5 F=100", "N20 G0 Z5", "G0 X=+3"])
def test_a_block_of_its_own_numbers_is_plain(line: str) -> None:
    assert emitter_of(line).plain is not None


@pytest.mark.parametrize(
    "line",
    [
        "G0 X=R1",
        "G0 X=1+1",
        "R1=5",
        "IF COUNT>5 GOTOF DONE",
        "G0 X=$AA_IM[X]",
        "STOPRE",
        "COUNT=2",
    ],
)
def test_a_block_that_calculates_or_does_more_is_not_plain(line: str) -> None:
    emitter = emitter_of(line)
    assert emitter.plain is None
    assert not emitter.is_empty


def test_a_block_without_words_is_empty_and_not_plain() -> None:
    emitter = emitter_of("N10")
    assert emitter.is_empty
    assert emitter.plain is None


def test_assignments_to_other_parameters_with_other_numbers_share_one_shape() -> None:
    lines = "\n".join(f"R{i}=R{i + 1}*{i}.5+SIN(R{i + 2})" for i in range(90))
    shapes = Sinumerik().shapes
    registered = control("sinumerik-840d")
    with patch.object(registered, "shapes", shapes):
        run(f"{lines}\nM30")
    assert 0 < len(shapes) <= 3


def test_texts_in_joined_blocks_stay_what_they_are() -> None:
    program = """DEF STRING[20] LABELLED
FOR COUNT=1 TO 5
LABELLED="n0 o1 k[2]"
IF LABELLED=="n0 o1 k[2]"
R1=R1+STRLEN(LABELLED)
ENDIF
ENDFOR"""
    assert value(f"DEF INT COUNT\n{program}") == 50
