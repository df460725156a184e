"""Part programs as text: encodings, tape and archive formats, directories, search paths.

A file goes through `encoding` (bytes to characters), `text` (characters to lines; `long_text` makes lines when they are
asked for, of `pages`) and `split` (lines to programs: `program`, with its `names`; `line_runs` has numbers of many
lines); `archive` makes a text of programs again, `store` keeps what a run can call (`folders` reads the host's),
`detect` guesses the control, `heads` reads sequence numbers, `errors` has what cannot be read. Nothing here knows
what a block means.
"""

from typing import TYPE_CHECKING, Any

from polycnc.program.encoding import Decoded, decode
from polycnc.program.errors import ProgramFileError
from polycnc.program.program import Form, Program
from polycnc.program.split import split_channels, split_programs
from polycnc.program.store import ProgramStore, load_programs

if TYPE_CHECKING:
    from polycnc.program.archive import archive_of
    from polycnc.program.detect import Guess, guess_control

__all__ = [
    "Decoded",
    "Form",
    "Guess",
    "Program",
    "ProgramFileError",
    "ProgramStore",
    "archive_of",
    "decode",
    "guess_control",
    "load_programs",
    "split_channels",
    "split_programs",
]


def __getattr__(name: str) -> Any:
    """What most runs do without is loaded when it is asked for."""
    if name == "archive_of":
        from polycnc.program.archive import archive_of

        return archive_of
    if name in ("Guess", "guess_control"):
        from polycnc.program import detect

        return getattr(detect, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
