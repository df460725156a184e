"""Retained memory in one SQLite file: the second form of `RetainedStore`.

What the tables hold is written down by `commit`, in one transaction: either all of it lasts or nothing. A process
that is killed loses what it has not committed. One process at a time has a file open; it is locked from the first
moment on.

Rows are the entries of tables, key and value as JSON (`encoding`). The schema has a number; `_MIGRATIONS` leads files
of older schemas on, and a file of a newer one is refused. A damaged file is refused and left as it is.
"""

from __future__ import annotations

import errno
import os
import sqlite3
from contextlib import contextmanager, suppress
from pathlib import Path

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import is_frozen
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar
from polycnc.memory.encoding import decode, encode
from polycnc.messages import UserError
from polycnc.messages.files import reason_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import TracebackType

    from polycnc.deferred.typing import Self

#: "pcnc": marks a file as a memory of polycnc (`PRAGMA application_id`).
APPLICATION_ID = 0x70636E63
_TABLES = """
CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE entry (
    name TEXT NOT NULL, channel INTEGER NOT NULL, key TEXT NOT NULL, place INTEGER NOT NULL, value TEXT NOT NULL,
    PRIMARY KEY (name, channel, key)
) WITHOUT ROWID;
"""
#: What leads a file of schema n on to n + 1; a new file goes through all of them.
_MIGRATIONS: tuple[str, ...] = (_TABLES,)
SCHEMA = len(_MIGRATIONS)
#: Errors of SQLite by name, and the message that tells of each.
_TOLD = {
    "SQLITE_BUSY": "memory.in-use",
    "SQLITE_LOCKED": "memory.in-use",
    "SQLITE_READONLY": "memory.read-only",
    "SQLITE_FULL": "memory.full",
    "SQLITE_CORRUPT": "memory.damaged",
    "SQLITE_NOTADB": "memory.damaged",
}


class MemoryFileError(UserError):
    """A memory file cannot be used, or what is new could not be written into it."""


class _Row(NamedTuple):
    """An entry as it stands in the file: its place in the table, its value as a line and as it was then."""

    place: int
    line: str
    value: object


class FileStore:
    """Retained memory in a file, which is made where there is none.

    Use it as a context, or `close` it: what was not committed by then is lost.

    Args:
        path: The file.
        control: Id of the control that it belongs to; empty where any may be (`control` says which).
        machine: Id of its machine; empty where any may be.

    Raises:
        MemoryFileError: It is in use, damaged, read-only, of a newer schema, of another control, or no such file.
    """

    #: A snapshot brings back what the tables hold; the file follows with the next `commit`.
    UNFOLLOWED: ClassVar = frozenset({"path", "_base", "_written"})

    def __init__(self, path: str | Path, control: str = "", machine: str = "") -> None:
        self.path = Path(path)
        self._tables: dict[tuple[str, int], dict[Any, Any]] = {}
        self._written: dict[tuple[str, int], dict[str, _Row]] = {}
        if not control and not self.path.exists():
            raise MemoryFileError("memory.missing", file=self.path)
        with self._told():
            self._base = sqlite3.connect(self.path, timeout=0.0, isolation_level=None)
        try:
            with self._told():
                self._open()
            self.control = self._belongs("control", control)
            self.machine = self._belongs("machine", machine)
        except BaseException:
            self._base.close()
            raise

    # ---- opening -------------------------------------------------------------------------------------------

    def _open(self) -> None:
        """Lock the file, look at it, lead it on to the schema of today."""
        run = self._base.execute
        run("PRAGMA locking_mode = EXCLUSIVE")
        version, application = self._number("user_version"), self._number("application_id")
        holds_something = self._number("schema_version") > 0
        if holds_something and application != APPLICATION_ID:
            raise MemoryFileError("memory.damaged", file=self.path)
        if version > SCHEMA:
            raise MemoryFileError("memory.newer", file=self.path, schema=version, known=SCHEMA)
        if holds_something and run("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise MemoryFileError("memory.damaged", file=self.path)
        run("PRAGMA journal_mode = WAL")
        run("PRAGMA synchronous = FULL")
        with self._transaction():
            for number in range(version, SCHEMA):
                for statement in filter(str.strip, _MIGRATIONS[number].split(";")):
                    run(statement)
            run(f"PRAGMA user_version = {SCHEMA}")
            run(f"PRAGMA application_id = {APPLICATION_ID}")

    def _number(self, pragma: str) -> int:
        return int(self._base.execute(f"PRAGMA {pragma}").fetchone()[0])

    def _belongs(self, what: str, wanted: str) -> str:
        """What the file says of itself, or from now on: its control, its machine."""
        row = self._base.execute("SELECT value FROM about WHERE name = ?", (what,)).fetchone()
        if row is None:
            if wanted:
                with self._told():
                    self._base.execute("INSERT INTO about VALUES (?, ?)", (what, wanted))
            return wanted
        if wanted and row[0] != wanted:
            raise MemoryFileError(f"memory.other-{what}", file=self.path, held=row[0], wanted=wanted)
        return str(row[0])

    # ---- the interface of a store --------------------------------------------------------------------------

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The one table of a name.

        Raises:
            MemoryFileError: What stands in the file cannot be read.
        """
        known = self._tables.get((name, channel))
        if known is not None:
            return known
        table: dict[Any, Any] = {}
        written: dict[str, _Row] = {}
        with self._told():
            rows = self._base.execute(
                "SELECT key, place, value FROM entry WHERE name = ? AND channel = ? ORDER BY place",
                (name, channel),
            ).fetchall()
        try:
            for key, place, line in rows:
                table[decode(key)] = value = decode(line)
                written[key] = _Row(place, line, value)
        except (ValueError, TypeError, LookupError, AttributeError) as error:
            raise MemoryFileError("memory.damaged", file=self.path) from error
        self._tables[name, channel], self._written[name, channel] = table, written
        return table

    def commit(self) -> None:
        """Write down what differs from what stands in the file.

        Raises:
            MemoryFileError: It cannot be written; the file holds what it held before.
        """
        changes = {of: self._changes(of) for of in self._tables}
        changes = {of: each for of, each in changes.items() if each != ({}, set())}
        if not changes:
            return
        with self._told(), self._transaction():
            for (name, channel), (put, gone) in changes.items():
                self._base.executemany(
                    "DELETE FROM entry WHERE name = ? AND channel = ? AND key = ?",
                    [(name, channel, key) for key in gone],
                )
                self._base.executemany(
                    "INSERT OR REPLACE INTO entry VALUES (?, ?, ?, ?, ?)",
                    [(name, channel, key, row.place, row.line) for key, row in put.items()],
                )
        for of, (put, gone) in changes.items():
            self._written[of].update(put)
            for key in gone:
                del self._written[of][key]

    def _changes(self, of: tuple[str, int]) -> tuple[dict[str, _Row], set[str]]:
        """Entries of a table that are to be written, and keys of those that have gone."""
        written = self._written[of]
        last = max((row.place for row in written.values()), default=0)
        put: dict[str, _Row] = {}
        gone = set(written)
        for key, value in self._tables[of].items():
            name = encode(key)
            gone.discard(name)
            before = written.get(name)
            if before is not None and before.value is value and is_frozen(type(value)):
                continue  # a program of 100,000 lines is not encoded again
            line = encode(value)
            if before is None or line != before.line:
                last += before is None
                put[name] = _Row(last if before is None else before.place, line, value)
        return put, gone

    def contents(self) -> list[tuple[str, int, int]]:
        """What the file holds: name and channel of every table, and how many entries say something.

        Raises:
            MemoryFileError: It cannot be read.
        """
        with self._told():
            rows = self._base.execute(
                "SELECT name, channel, count(*) FROM entry WHERE value != 'null' "
                "GROUP BY name, channel ORDER BY name, channel"
            ).fetchall()
        return [(str(name), int(channel), int(count)) for name, channel, count in rows]

    def copy_to(self, table: Callable[[str, int], dict[Any, Any]]) -> None:
        """Put what the file holds into tables elsewhere: whoever works with these leaves the file alone.

        Args:
            table: Gives the table of a name and a channel.

        Raises:
            MemoryFileError: It cannot be read.
        """
        with self._told():
            rows = self._base.execute("SELECT name, channel, key, value FROM entry ORDER BY place").fetchall()
        try:
            for name, channel, key, line in rows:
                table(name, channel)[decode(key)] = decode(line)
        except (ValueError, TypeError, LookupError, AttributeError) as error:
            raise MemoryFileError("memory.damaged", file=self.path) from error

    # ---- ending --------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Let the file go; another process may open it."""
        with suppress(sqlite3.Error):
            self._base.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # ---- what SQLite says ----------------------------------------------------------------------------------

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._base.execute("BEGIN IMMEDIATE")
        try:
            yield
            self._base.execute("COMMIT")
        except BaseException:
            with suppress(sqlite3.Error):
                self._base.execute("ROLLBACK")
            raise

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Errors of SQLite in words of polycnc."""
        try:
            yield
        except sqlite3.Error as error:
            name = getattr(error, "sqlite_errorname", "") or ""
            message = next(
                (told for start, told in _TOLD.items() if name.startswith(start)), "memory.unusable"
            )
            if (
                message == "memory.unusable" and self._is_read_only
            ):  # SQLite says only that it could not lock it
                message = "memory.read-only"
            reason = self._reason(error)
            raise MemoryFileError(message, file=self.path, reason=reason) from error

    @property
    def _is_read_only(self) -> bool:
        return self.path.is_file() and os.access(self.path, os.R_OK) and not os.access(self.path, os.W_OK)

    def _reason(self, error: sqlite3.Error) -> str:
        """Why a file cannot be opened: what the system says of it, where it says something.

        It is not opened to find out: where a process closes a file a second time, its locks are gone (POSIX).
        """
        number = errno.EISDIR if self.path.is_dir() else 0
        if not number and not self.path.parent.is_dir():
            number = errno.ENOENT
        if not number and not os.access(
            self.path if self.path.exists() else self.path.parent, os.R_OK | os.W_OK
        ):
            number = errno.EACCES
        return reason_of(OSError(number, os.strerror(number))) if number else str(error)
