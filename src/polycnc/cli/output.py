"""Output files: whole or not at all, and never in the place of an input."""

from __future__ import annotations

import io
import os
import stat
from pathlib import Path

from polycnc.deferred.contexts import contextmanager, suppress
from polycnc.deferred.paths import resolved
from polycnc.deferred.typing import IO, TYPE_CHECKING, Any
from polycnc.messages.files import OutputError
from polycnc.program.folders import SUFFIXES

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

#: Suffixes of files that are part programs and nothing else.
PROGRAMS = frozenset(SUFFIXES) - {"", ".txt", ".h", ".min"}

#: So many bytes are handed to the system at a time.
_BUFFERED = 1 << 16


def refuse_programs(output: Path | None) -> None:
    """Raise `OutputError` where a report would replace a part program: `-o *.nc` names one that nobody meant."""
    if output is not None and output.suffix.lower() in PROGRAMS and output.is_file():
        raise OutputError("output.is-program", file=output)


@contextmanager
def whole_file(path: Path, mode: str = "w") -> Iterator[IO[Any]]:
    """Open a file for writing that appears under its name only when everything has been written.

    Until then it has no name where the system can do that, so that nothing is left of it if the process is killed. A
    file that was there before keeps its mode. A device or pipe is written directly. Raises `OSError` as `open` does.
    """
    if path.exists() and not path.is_file():
        with _stream(str(path), path, mode) as stream:
            yield stream
        return
    target = _target(path)
    beside = _beside(target)  # known before there is a file of this name: an interrupt may come at any time
    try:
        handle = _opened(beside, path)
        with _stream(handle, path, mode) as stream:
            yield stream
            stream.flush()
            if not beside.exists():
                _name(handle, beside)
        beside.chmod(_mode_of(target))
        beside.replace(target)
    except BaseException:
        with suppress(OSError):  # most often it has no name
            beside.unlink()
        raise


def refuse_unwritable(path: Path) -> None:
    """Raise `OSError`, as `whole_file` would, where no file can be written: before somebody has worked for it."""
    if path.exists() and not path.is_file():
        return
    target = _target(path)
    beside = _beside(target)
    try:
        os.close(_opened(beside, path))
    finally:
        with suppress(OSError):  # most often it has no name
            beside.unlink()


def refuse_twice(outputs: Iterable[Path | None]) -> None:
    """Raise `OutputError` where two outputs would be one file, of which the first would be lost; devices take both."""
    files = [each for each in outputs if each is not None and (each.is_file() or not each.exists())]
    taken: set[Path] = set()
    for file in files:
        target = _target(file)
        if target in taken:
            raise OutputError("output.is-twice", file=file)
        taken.add(target)


def _target(path: Path) -> Path:
    """The file that is written, to which links may lead. Raises `OSError` where they lead in a circle."""
    with suppress(FileNotFoundError, NotADirectoryError):
        path.stat()
    return Path(resolved(path))


class _File(io.FileIO):
    """A file whose errors say which one it is: where several are written, one may be on a full disk."""

    def __init__(self, file: str | int, path: Path) -> None:
        super().__init__(file, "w")
        self._path = path

    def write(self, data: Any, /) -> int:
        """Write as `FileIO` does. Raises `OSError` with the name of the file."""
        try:
            return super().write(data)
        except BrokenPipeError:
            raise
        except OSError as error:
            raise _named_error(error, self._path) from error


def _named_error(error: OSError, path: Path) -> OSError:
    return type(error)(error.errno, error.strerror, str(path))


def _stream(file: str | int, path: Path, mode: str) -> IO[Any]:
    """The stream of a file (by name or number): of bytes, else of text in UTF-8.

    Names of files that are not in the encoding of the system have characters that no text can have: these are written
    with a backslash, as JSON writes them.
    """
    stream = io.BufferedWriter(_File(file, path), _BUFFERED)
    if "b" in mode:
        return stream
    return io.TextIOWrapper(stream, encoding="utf-8", errors="backslashreplace", newline="\n")


def _beside(target: Path) -> Path:
    """A name that no file has; with 50 letters of the target's it has less than the 255 bytes that systems allow."""
    return target.with_name(f".{target.name[:50]}.{os.urandom(6).hex()}")


def _opened(beside: Path, path: Path) -> int:
    """A new file: without a name where the system has such, else one beside the target. Errors name the target."""
    try:
        if hasattr(os, "O_TMPFILE") and Path("/proc/self/fd").is_dir():
            with suppress(OSError):
                return os.open(beside.parent, os.O_TMPFILE | os.O_RDWR | os.O_CLOEXEC, 0o600)
        return os.open(beside, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600)
    except OSError as error:
        raise _named_error(error, path) from error


def _name(handle: int, beside: Path) -> None:
    """Give a file without a name one."""
    # With a folder named, the call is `linkat`, which alone follows the link to the file.
    os.link(f"/proc/self/fd/{handle}", beside, src_dir_fd=handle, follow_symlinks=True)


def _mode_of(target: Path) -> int:
    """The mode of the file that is replaced, else that of any new file."""
    try:
        return stat.S_IMODE(target.stat().st_mode)
    except OSError:
        return 0o666 & ~_umask()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_whole(path: Path, content: str) -> None:
    """Write a text file, whole or not at all."""
    with whole_file(path) as stream:
        stream.write(content)
