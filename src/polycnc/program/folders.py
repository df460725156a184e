"""Files and folders of the host, read when they are first wanted. Every failure is a `ProgramFileError`."""

from __future__ import annotations

import errno
import os
import stat
from functools import cached_property

from polycnc.deferred.paths import joined, name_of, stem_of, suffix_of, text_of
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages.files import read_regular, reason_of
from polycnc.program.errors import ProgramFileError
from polycnc.program.names import stored_name
from polycnc.program.text import TAPE_CONTROLS

if TYPE_CHECKING:
    from pathlib import Path

MAX_FILE_BYTES = 2 * 1024**3

SUFFIXES = (
    "", ".nc", ".cnc", ".tap", ".ngc", ".mpf", ".spf", ".eia", ".min", ".h",
    ".gcode", ".fnc", ".pim", ".prg", ".txt",
)  # fmt: skip
"""Suffixes of part programs on a PC, in the order in which they are preferred."""

#: A longer number is none of a program.
_MOST_DIGITS = 9
_HEADING = regex(rb"(?:^|[\r\n])[ \t]*%?[ \t]*(?:[oO]|:)[ \t]*(\d{1,9})(?![\d.])")
_HEADING_BYTES = 65_536
#: What a name may lead to in place of a file.
_KINDS = {errno.EISDIR: "program.directory", errno.ENODEV: "program.not-a-file"}


def read_file(path: str) -> bytes:
    """All bytes of a regular file.

    Raises:
        ProgramFileError: Missing, a directory, a device, not readable or too large.
    """
    try:
        data = read_regular(path, MAX_FILE_BYTES + 1)
    except (FileNotFoundError, NotADirectoryError) as error:
        raise ProgramFileError("program.missing", path) from error
    except (OSError, ValueError) as error:
        # ValueError: a name that no file system takes, such as one with a zero byte.
        kind = _KINDS.get(error.errno or 0) if isinstance(error, OSError) else None
        if kind is not None:
            raise ProgramFileError(kind, path) from error
        raise ProgramFileError("program.unreadable", path, reason=reason_of(error)) from error
    if len(data) > MAX_FILE_BYTES:
        raise ProgramFileError("program.too-large", path, limit=MAX_FILE_BYTES)
    return data


def program_stem(path: str) -> str:
    """The file's name without a suffix of part programs; `PART.V2` has none."""
    return stem_of(path) if suffix_of(path).lower() in SUFFIXES else name_of(path)


def number_of_file(path: str) -> int | None:
    """The program number in a file's name: 10 for `O0010`, `O10.NC` and `0010.nc`."""
    stem = program_stem(path)
    digits = stem[1:] if stem.startswith(("o", "O")) else stem
    return int(digits) if digits.isdecimal() and len(digits) <= _MOST_DIGITS else None


def stored_name_of_file(path: str) -> str:
    """The name under which SINUMERIK stores a file of a PC; others than MPF and SPF are main programs."""
    suffix = suffix_of(path).lower()
    is_foreign = suffix in SUFFIXES and suffix not in (".mpf", ".spf")
    if is_foreign and not name_of(path).upper().startswith("_N_"):
        return stored_name(stem_of(path)) + "_MPF"
    return stored_name(name_of(path))


class Folder:
    """One folder of the host, its entries by the names under which controls ask for them.

    Entries are sorted by name, so that every machine finds the same one first.

    Raises:
        ProgramFileError: From any method, if the folder cannot be listed.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = text_of(path)

    @cached_property
    def _entries(self) -> tuple[list[str], list[str]]:
        """The names of files and of folders in it."""
        try:
            with os.scandir(self.path) as entries:
                found = sorted((entry.name, _kind(entry)) for entry in entries)
        except (OSError, ValueError) as error:
            raise ProgramFileError("program.unreadable", self.path, reason=reason_of(error)) from error
        files = [name for name, kind in found if kind == stat.S_IFREG]
        return files, [name for name, kind in found if kind == stat.S_IFDIR]

    def _path(self, name: str | None) -> str | None:
        return None if name is None else joined(self.path, name)

    @cached_property
    def _by_name(self) -> dict[str, str]:
        return {name.casefold(): name for name in reversed(self._entries[0])}

    @cached_property
    def _by_stored_name(self) -> dict[str, str]:
        return {stored_name(name): name for name in reversed(self._entries[0])}

    @cached_property
    def _folders(self) -> dict[str, str]:
        return {stored_name(name): name for name in reversed(self._entries[1])}

    @cached_property
    def _by_number(self) -> dict[int, list[str]]:
        found: dict[int, list[str]] = {}
        for name in self._entries[0]:
            number = number_of_file(name)
            if number is not None:
                found.setdefault(number, []).append(name)
        return found

    def folder(self, name: str) -> str | None:
        """The folder inside it with this SINUMERIK name (`_N_SPF_DIR` is `SPF.DIR` on a PC)."""
        return self._path(self._folders.get(name))

    def named(self, name: str, suffixes: tuple[str, ...]) -> str | None:
        """The file of this name with the first of the suffixes that exists; case does not matter."""
        wanted = (name.casefold() + suffix.casefold() for suffix in suffixes)
        return self._path(next((self._by_name[each] for each in wanted if each in self._by_name), None))

    def stored(self, name: str) -> str | None:
        """The file with this SINUMERIK name (`_N_SUB1_SPF` is `SUB1.SPF` on a PC)."""
        return self._path(self._by_stored_name.get(name))

    def stored_names(self) -> list[str]:
        """The SINUMERIK names of all files in it."""
        return list(self._by_stored_name)

    def numbered(self, number: int, digits: int) -> str | None:
        """The file whose name is this program number: `O0010` before `O10` before `0010`, then by suffix."""

        def preference(name: str) -> tuple[bool, bool, int, str]:
            stem = program_stem(name)
            figures = stem.lstrip("oO")
            suffix = name[len(stem) :].lower()
            return stem == figures, len(figures) != digits, SUFFIXES.index(suffix), name

        return self._path(min(self._by_number.get(number, []), key=preference, default=None))

    def headed(self, number: int) -> list[str]:
        """The program files, whatever their names, in which a program of this number starts near the top."""
        programs = (
            joined(self.path, name) for name in self._entries[0] if suffix_of(name).lower() in SUFFIXES
        )
        return [path for path in programs if number in _numbers_at_top(path)]


def _kind(entry: os.DirEntry[str]) -> int:
    """What a name leads to: a file, a folder, or something that no call may open; 0 for a link that leads nowhere."""
    try:
        return stat.S_IFMT(entry.stat().st_mode)
    except OSError:
        return 0


def _numbers_at_top(path: str) -> set[int]:
    try:
        top = read_regular(path, _HEADING_BYTES)
    except OSError:
        return set()  # It may be anybody's file: only one that is asked for by name has to be readable.
    return {int(number) for number in _HEADING.findall(top.translate(None, TAPE_CONTROLS.encode("ascii")))}
