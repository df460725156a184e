"""Archives of SINUMERIK programs: several files in one text, each with its name and its path (job planning 2.1)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.program.program import Program


def archive_of(programs: Iterable[Program]) -> str:
    """The archive that brings programs back to the directories in which they lie.

    Each begins with `%_N_NAME_TYPE` and, in the line below, `;$PATH=` and its directory. `split_programs` reads it.
    """
    parts: list[str] = []
    for program in programs:
        parts.append(f"%{program.name}")
        if program.directory:
            parts.append(f";$PATH={program.directory}")
        parts += program.lines
    return "".join(line + "\n" for line in parts)
