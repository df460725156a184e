"""Files that a user names: what keeps them from being read or written, in words of polycnc."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from polycnc.messages.catalogue import messages


def read_utf_8(path: str | Path) -> str:
    """The text of a file, with or without a byte order mark.

    Raises:
        OSError: It cannot be read, or is a device, which need not have an end.
        UnicodeError: It is not UTF-8.
    """
    mode = Path(path).stat().st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISFIFO(mode) or stat.S_ISDIR(mode)):
        raise OSError(errno.ENODEV, os.strerror(errno.ENODEV), str(path))
    return Path(path).read_text(encoding="utf-8-sig")


def reason_of(error: Exception) -> str:
    """Why a file cannot be used, in the active language; in the system's words where the reason is rare.

    Args:
        error: `OSError`, `UnicodeError`, or the `ValueError` of a name that no file system takes.
    """
    if isinstance(error, UnicodeError):
        return messages().text("reason.not-utf-8")
    key = f"reason.{errno.errorcode.get(error.errno or 0, '')}" if isinstance(error, OSError) else ""
    return messages().text(key) if key in messages() else getattr(error, "strerror", None) or str(error)
