"""How many files a reader walks through who follows a block: those that are entered while it is read and run."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import polycnc
from polycnc.session import open_session

if TYPE_CHECKING:
    from types import FrameType

SOURCE = Path(polycnc.__file__).parent
HEAD = "G90 G54 G17 G94 T1 D1 M6\nG0 X0 Y0 Z20 S800 M3 F300\nG1 X1 Y1\nM0\n"


def files_of(block: str) -> set[str]:
    """The files of polycnc that are entered from the text of a block, which is of a new shape, to its last row."""
    session = open_session(
        HEAD + block + "\nM30\n", control="sinumerik-840d", setup={"tools": {1: {"radius": 2}}}
    )
    channel, entered = session.channel, set()
    next(channel.run(session.result.program))
    main = channel.level
    here = main.index

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call":
            entered.add(frame.f_code.co_filename)

    sys.setprofile(note)
    try:
        while channel.level is not main or main.index == here:
            level = channel.level
            step = level.code.step(level.index)
            level.current, level.index = level.index, level.index + 1
            assert step is not None
            step(channel)
    finally:
        sys.setprofile(None)
    assert channel.toolpath.chunk.line[-1] == HEAD.count("\n") + 1
    paths = [Path(name) for name in entered]
    files = {path.relative_to(SOURCE) for path in paths if path.is_relative_to(SOURCE)}
    # What stands for the decorators of the standard library makes objects; nobody reads it to follow a block.
    return {path.as_posix() for path in files if path.parts[0] != "deferred"}


@pytest.mark.parametrize(
    ("block", "most_of_control", "most"), [("G1 X10 F200 Y5", 10, 23), ("CYCLE81(5,0,1,-4)", 14, 25)]
)
def test_a_reader_walks_through_few_files(block: str, most_of_control: int, most: int) -> None:
    files_of(block)  # modules that are only imported now
    files = files_of(block)
    assert len(files) <= most, "\n".join(sorted(files))
    behind_the_language = {name for name in files if not name.startswith("language/")}
    assert len(behind_the_language) <= most_of_control, "\n".join(sorted(behind_the_language))
