"""The walk of a plain block through the code: rules that do not concern a block are not asked of it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import polycnc
from polycnc.language.word_address import WordBlock
from tests.support import run

if TYPE_CHECKING:
    from types import FrameType

SOURCES = str(Path(polycnc.__file__).parent)
#: How many files a plain G1 enters at most; a control with features of its own at every block has some more.
MOST = {"fanuc-m": 13, "meldas-m": 13, "syntec-mill": 14, "fanuc-0i-tf": 14}


def files_entered(control_id: str, signature: tuple[str, ...], values: list[float]) -> list[str]:
    """The files of the package that a block enters whose shape is new, in the order entered; classes write nothing."""
    channel = run("G0 X1.\nM30\n", control_id)
    block = WordBlock(signature, values)
    files: dict[str, None] = {}

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(SOURCES):
            files[frame.f_code.co_filename.removeprefix(SOURCES + "/")] = None

    sys.setprofile(note)
    try:
        block(channel)
    finally:
        sys.setprofile(None)
    assert not channel.alarms
    return [name for name in files if not name.startswith("deferred/")]


@pytest.mark.parametrize(("control_id", "most"), MOST.items())
def test_a_plain_line_of_a_new_shape_enters_few_files(control_id: str, most: int) -> None:
    entered = files_entered(control_id, ("G1", "X.", "Z.", "F"), [2.0, 3.0, 100.0])
    assert len(entered) <= most, "\n".join(entered)


def test_a_rule_is_asked_where_it_concerns_the_block() -> None:
    corner = "control/word_address/motion/corners.py"
    assert corner in files_entered("fanuc-m", ("G1", "X.", "F", ",C."), [2.0, 100.0, 0.5])
    assert corner not in files_entered("fanuc-m", ("G1", "X.", "F"), [2.0, 100.0])
