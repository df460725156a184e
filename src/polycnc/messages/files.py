"""Files that a user names: what keeps them from being read or written, in words of polycnc."""

from __future__ import annotations

import errno
import os
import stat
from io import StringIO

from polycnc.deferred.paths import is_same, text_of
from polycnc.deferred.typing import IO, TYPE_CHECKING
from polycnc.messages.catalogue import messages
from polycnc.messages.errors import UserError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

#: What is read of a file that says nothing of its size, bytes.
_PAGE = 4096


def read_regular(path: str | Path, most: int = -1) -> bytes:
    """The bytes of a regular file: a pipe, a socket or a device need not have an end, and may keep whoever reads it.

    Args:
        path: Of the file.
        most: So many bytes are read at most; -1 all.

    Raises:
        OSError: It cannot be read, or is no regular file.
        ValueError: A name that no file system takes.
    """
    status = os.stat(path)  # noqa: PTH116 - Path(path) hides what the user typed
    if stat.S_ISDIR(status.st_mode):
        raise _error(errno.EISDIR, path)
    if not stat.S_ISREG(status.st_mode):
        raise _error(errno.ENODEV, path)
    # What the system shows as a file (/proc) may wait for something all the same.
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0))
    with os.fdopen(handle, "rb") as file:
        data = file.read() if most < 0 else _at_most(most, file, status.st_size)
    if data is None:
        raise _error(errno.EAGAIN, path)
    return data


def _at_most(most: int, file: IO[bytes], size: int) -> bytes | None:
    """So many bytes of a file at most, which says that it has `size` bytes; None where nothing can be read now.

    Python takes memory for all that it asks for, and some systems must have it: no more is asked for than is there.
    """
    asked = min(most, max(size + 1, _PAGE))
    data: bytes | None = file.read(asked)
    while data and len(data) == asked < most:  # it has grown, or is one whose size nobody knows (/proc)
        asked = min(most, 2 * asked)
        data += file.read(asked - len(data)) or b""
    return data


def _error(number: int, path: str | Path) -> OSError:
    return OSError(number, os.strerror(number), str(path))


def read_utf_8(path: str | Path) -> str:
    """The text of a regular file, with or without a byte order mark; every end of line is a line feed.

    Raises:
        OSError: It cannot be read, or is no regular file.
        UnicodeError: It is not UTF-8.
        ValueError: A name that no file system takes.
    """
    return StringIO(read_regular(path).decode("utf-8-sig"), newline=None).read()


def reason_of(error: Exception) -> str:
    """Why a file cannot be used, in the active language; in the system's words where the reason is rare.

    Args:
        error: `OSError`, `UnicodeError`, or the `ValueError` of a name that no file system takes.
    """
    if isinstance(error, UnicodeError):
        return messages().text("reason.not-utf-8")
    key = f"reason.{errno.errorcode.get(error.errno or 0, '')}" if isinstance(error, OSError) else ""
    return messages().text(key) if key in messages() else getattr(error, "strerror", None) or str(error)


def reason_with_file(error: OSError) -> str:
    """Which file cannot be used, and why, in the active language."""
    return f"{error.filename or ''}: {reason_of(error)}".removeprefix(": ")


class OutputError(UserError):
    """A file that must not be written."""


def refuse_inputs(outputs: Iterable[str | Path | None], inputs: Iterable[str | Path | None]) -> None:
    """Raise `OutputError` where an output would be written in the place of an input.

    Args:
        outputs: Files to be written; None for those that nobody asked for.
        inputs: Files that are read; what is no file (standard input, the id of a machine) is passed over.
    """
    read = [each for each in inputs if each is not None]
    for output in outputs:
        if output is not None and any(_is_same(output, each) for each in read):
            raise OutputError("output.is-input", file=text_of(output))


def _is_same(one: str | Path, other: str | Path) -> bool:
    try:
        return is_same(one, other)
    except (OSError, ValueError):  # one of them is not there, or no file system takes its name
        return False
