"""The programs of a virtual control: what is loaded, what was typed in, and the text of their blocks."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.mainrun.errors import CommandRefused
from polycnc.program import Form, ProgramStore, decode

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from polycnc.channel.channel import Channel
    from polycnc.program import Program

#: Where SINUMERIK programs lie that come as texts.
_DIRECTORY = "/_N_WKS_DIR/_N_TEST_WPD"
_NUMBER = re.compile(r"\s*(?:/\d*\s*)?([N:]\d+)", re.IGNORECASE)


class Programs:
    """Programs by what a run of them needs.

    Args:
        form: How the control's program files are marked off.
        search: Folders in which calls look for subprograms.
        files: Further programs as texts, by name.
    """

    def __init__(self, form: Form, search: Sequence[str | Path], files: Mapping[str, str]) -> None:
        self._form = form
        self._search = tuple(search)
        self._files = dict(files)
        self.store = self._new_store()
        self.main: Program | None = None
        self._inserted = 0

    def _new_store(self) -> ProgramStore:
        return ProgramStore(search=self._search, form=self._form)

    def load(self, source: str | bytes | Path) -> Program:
        """Load a file, or a program as `bytes` or as a `str` with line ends; it becomes the main program.

        Raises:
            ProgramFileError: The file cannot be read.
        """
        store = self._new_store()
        content = decode(source).text if isinstance(source, bytes) else source
        if isinstance(source, bytes) or (isinstance(source, str) and "\n" in source):
            main = store.add_text(self._key("MAIN"), str(content))
        else:
            main = store.add_file(content)
        for name, text in self._files.items():
            store.add_text(name, text)
        self.store, self.main, self._inserted = store, main, 0
        return main

    def from_outside(self, source: str | bytes | Path) -> Program:
        """A program that is run without being stored; sources as for `load`."""
        content = decode(source).text if isinstance(source, bytes) else source
        if isinstance(source, bytes) or (isinstance(source, str) and "\n" in source):
            return self._new_store().add_text(self._key("TAPE"), str(content))
        return self._new_store().add_file(content)

    def insert(self, block: str, line: int | None) -> None:
        """Put a block behind a line of the main program's file, or behind the one that was put in last."""
        main = self.main
        if main is None:
            raise CommandRefused("mainrun.no-program")
        last = main.first_line + len(main.lines) - 1
        behind = line if line is not None else self._inserted or last
        if not main.first_line - 1 <= behind <= last:
            raise CommandRefused(
                "mainrun.value", name="line", allowed=f"{main.first_line} … {last}", value=line
            )
        at = behind - main.first_line + 1
        self.main = replace(main, lines=(*main.lines[:at], block, *main.lines[at:]))
        self._inserted = behind + 1
        self.store.replace(self.main)

    def line_of(self, target: int | str) -> int:
        """The line of a block of the main program: the line itself, or that of a block number."""
        if self.main is None:
            raise CommandRefused("mainrun.no-program")
        if isinstance(target, int):
            return target
        wanted = target.strip().upper()
        for i, text in enumerate(self.main.lines):
            match = _NUMBER.match(text)
            if match is not None and match[1].upper() == wanted:
                return self.main.line_number(i)
        raise CommandRefused("mainrun.search", target=target)

    def typed(self, text: str) -> Program:
        """What was typed in at MDI."""
        return self._new_store().add_text(self._key("MDI"), text)

    def _key(self, name: str) -> str:
        return f"{_DIRECTORY}/_N_{name}_MPF" if self._form is Form.SINUMERIK else name


def forget_skipped(channel: Channel) -> None:
    """Block skip has been switched: programs that keep what they skip read their blocks again."""
    language = getattr(channel.memory, "language", None)
    for code in language.programs if language is not None else ():
        code.forget_steps()


def text_of(program: Program | None, line: int) -> str:
    """The text of a line of a program's file; empty where there is none."""
    index = line - program.first_line if program is not None else -1
    return program.lines[index].strip() if program is not None and 0 <= index < len(program.lines) else ""
