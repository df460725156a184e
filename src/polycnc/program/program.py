"""One part program: its text by lines, and where each line stands in its file."""

from __future__ import annotations

from enum import Enum

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.heads import sequence_number

if TYPE_CHECKING:
    from collections.abc import Sequence


class Form(Enum):
    """How a file marks where its programs begin and end."""

    WORD_ADDRESS = "word-address"
    """Tape format: `%`, program numbers `O0001` or `:0001`, names `<NAME>`."""
    MACRO = "macro"
    """SYNTEC macro file: header `%@MACRO`, one program a file."""
    SINUMERIK = "sinumerik"
    """One program a file, or an archive with `%_N_NAME_MPF` lines."""


@dataclass(frozen=True, slots=True, eq=False)
class Program:
    """A part program. Two programs are the same only if they are the same object, so it may be a key.

    Attributes:
        name: As the control shows it: `O0001`, `MAIN.NC`, `_N_MAIN_MPF`.
        lines: Text without line ends; tape marks and headers such as `%@MACRO` are not part of it.
        number: Program number (O word or file name), if it has one.
        path: File on the host; empty for a text that came from elsewhere.
        directory: SINUMERIK directory such as `/_N_WKS_DIR/_N_TEST_WPD`; empty on other controls.
        first_line: Number of `lines[0]` in its file, from 1.
        form: How the file was written; `Form.MACRO` turns on the SYNTEC macro language.
        encoding: Python codec by which the bytes were read.
        replaced: Count of characters in the file that the encoding could not read.
    """

    name: str
    lines: Sequence[str] = field(repr=False)
    number: int | None = None
    path: str = ""
    directory: str = ""
    first_line: int = 1
    form: Form = Form.WORD_ADDRESS
    encoding: str = "utf-8"
    replaced: int = 0

    def line_number(self, index: int) -> int:
        """The line of the file, from 1, in which `lines[index]` stands."""
        return self.first_line + index

    def block_name(self, line: int) -> str:
        """The sequence number of the block in a line of the file, else the number of the line."""
        index = line - self.first_line
        number = sequence_number(self.lines[index]) if 0 <= index < len(self.lines) else ""
        return number or str(line)
