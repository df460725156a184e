"""Paths as texts: `pathlib` takes a seventh of what a short run takes to load, counted in instructions.

What polycnc itself does with a file, it does with its path as a text. The functions here say of that what the members
of `pathlib.Path` say which are called alike. Only a text that the library would write in another way it writes itself.
Whoever uses polycnc may give a `Path` everywhere, and gets one where he is to get a path.
"""

from __future__ import annotations

import errno
import os
from stat import S_ISDIR, S_ISREG

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

__all__ = [
    "exists", "is_dir", "is_file", "is_same", "joined", "name_of", "names_in", "package_path", "parent_of", "read_text",
    "resolved", "stem_of", "suffix_of", "text_of",
]  # fmt: skip
#: Where one is.
_HERE = "."
#: Errors where nothing lies at a path: of all systems, and of Windows (no disk in the drive, no name of a file, a link
#: that leads nowhere). Of others, such as a folder that must not be looked into, whoever asks has to hear.
_NOTHING = frozenset((errno.ENOENT, errno.ENOTDIR, errno.EBADF, errno.ELOOP))
_NOTHING_ON_WINDOWS = frozenset((21, 123, 1921))


def text_of(path: str | Path) -> str:
    """A path as `str(Path(path))` writes it: without steps to where one is, and without a separator too many."""
    text = os.fspath(path)
    if os.sep == "/" and text and not text.startswith("./"):
        folder = f"{text}/"  # its end looks like all other places
        if "//" not in folder and "/./" not in folder:
            return text
    from pathlib import PurePath

    return str(PurePath(text))


def package_path(*names: str) -> str:
    """A file or folder that comes with polycnc: `package_path("machine", "builtin", "mill3.toml")`."""
    return os.path.join(_PACKAGE, *names)


def joined(folder: str, name: str) -> str:
    """`folder / name`: a path that starts in a folder, or an absolute one, which stays what it is."""
    return text_of(name if folder == _HERE else os.path.join(folder, name))


def parent_of(path: str | Path) -> str:
    """The folder in which it lies; `.` for a name alone."""
    return os.path.dirname(text_of(path)) or _HERE


def name_of(path: str | Path) -> str:
    """Its last part; empty for `.` and for a root."""
    text = text_of(path)
    return "" if text == _HERE else os.path.basename(text)


def suffix_of(path: str | Path) -> str:
    """The last ending of its name, with the point: `.nc`; empty where there is none."""
    name = name_of(path)
    at = name.rfind(".")
    return name[at:] if 0 < at < len(name) - 1 else ""


def stem_of(path: str | Path) -> str:
    """Its name without its suffix."""
    return name_of(path).removesuffix(suffix_of(path))


def resolved(path: str | Path) -> str:
    """The same file by its absolute path without links."""
    return os.path.realpath(text_of(path))


def is_same(one: str | Path, other: str | Path) -> bool:
    """Whether two paths lead to one file. Raises `OSError` where one of them leads to none."""
    return os.path.samefile(text_of(one), text_of(other))


def exists(path: str | Path) -> bool:
    """Whether something lies there. Raises `OSError` where nobody may look."""
    return _mode(path) is not None


def is_file(path: str | Path) -> bool:
    """Whether it is a regular file. Raises `OSError` where nobody may look."""
    mode = _mode(path)
    return mode is not None and S_ISREG(mode)


def is_dir(path: str | Path) -> bool:
    """Whether it is a folder. Raises `OSError` where nobody may look."""
    mode = _mode(path)
    return mode is not None and S_ISDIR(mode)


def _mode(path: str | Path) -> int | None:
    """Kind and permissions of what lies there; None for nothing."""
    try:
        return os.stat(text_of(path)).st_mode
    except OSError as error:
        if error.errno in _NOTHING or getattr(error, "winerror", None) in _NOTHING_ON_WINDOWS:
            return None
        raise
    except ValueError:  # a name that no system takes
        return None


def names_in(folder: str | Path) -> list[str]:
    """The names of all that lies in a folder, sorted; none where there is no such folder."""
    return sorted(os.listdir(text_of(folder))) if is_dir(folder) else []


def read_text(path: str | Path) -> str:
    """A text in UTF-8."""
    with open(text_of(path), encoding="utf-8") as file:
        return file.read()


_PACKAGE = text_of(os.path.dirname(os.path.dirname(__file__)))
