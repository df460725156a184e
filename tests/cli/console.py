"""Runs the command line inside the test process."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import pytest

from polycnc.cli import main
from polycnc.messages.catalogue import set_language

if TYPE_CHECKING:
    from pathlib import Path

GOOD = """%
O0001 (GOOD)
T1 M6
G90 G54 G0 X10. Y20. Z50. S1000 M3
G1 Z-5. F100.
X100. F300.
G2 X120. Y40. R20.
G0 Z50.
M30
%
"""
BAD = "O0002\nG90 G0 X1.\nG1 X2. F100. G999\nM30\n"


@dataclass
class Said:
    """What a command said, and its exit status."""

    status: int
    out: str
    err: str


class Console:
    """Calls `polycnc` with words."""

    def __init__(self, capsys: pytest.CaptureFixture[str], folder: Path) -> None:
        self._capsys = capsys
        self.folder = folder

    def __call__(self, *words: str | Path) -> Said:
        try:
            with pytest.raises(SystemExit) as left:
                main([str(word) for word in words])
        finally:
            set_language("en")
        captured = self._capsys.readouterr()
        assert isinstance(left.value.code, int)
        return Said(left.value.code, captured.out, captured.err)

    def file(self, name: str, content: str) -> Path:
        """A file in the working folder."""
        path = self.folder / name
        path.write_text(content, encoding="utf-8")
        return path
