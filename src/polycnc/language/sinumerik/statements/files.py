"""File functions: WRITE, READ, DELETE, ISFILE, FILE…, CHECKSUM (job planning 1.18 to 1.23).

Files are the programs of the program store. Every procedure reports in its first argument instead of raising
an alarm.
"""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.rights import LOWEST
from polycnc.language.sinumerik.names.values import MAX_STRING, Type
from polycnc.language.sinumerik.names.variables import Array, Reference
from polycnc.messages import AlarmError
from polycnc.program import Form, Program
from polycnc.program.names import is_too_long, split_stored_path, stored_directory

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import NcChannel

OK, BAD_PATH, NO_PATH, NO_FILE, WRONG_TYPE, FULL, IN_USE, NO_RIGHT = 0, 1, 2, 3, 4, 10, 11, 13
NO_LINE, RESULT_TOO_SMALL, RANGE_TOO_LARGE = 21, 22, 23
MAX_NAME, MAX_PATH = 32, 128
_WRITABLE = ("_MPF", "_SPF")
#: Types that READ does not read.
_BINARY = ("_BIN", "_EXE", "_OBJ", "_LIB", "_BOT", "_TRC", "_ACC", "_CYC", "_NCK")
CHECKSUM_LENGTH = 16
#: The simulated control has no clock on the wall: all files are of its first day.
DATE, TIME, RIGHTS = "01.01.00", "00:00:00", "77777"


class FileError(Exception):
    """Why a file cannot be used; `number` is what the error argument gets."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def _place(channel: Channel, name: str) -> tuple[str, str]:
    """Directory and stored name; a bare name lies beside the selected program and means an MPF."""
    if not name or len(name) > MAX_PATH or any(character <= " " for character in name):
        raise FileError(BAD_PATH)
    directory, stored = split_stored_path(name.removesuffix("/"))
    if len(stored) > MAX_NAME or is_too_long(stored) or (directory and not name.startswith("/")):
        raise FileError(BAD_PATH)
    if len(stored) < 4 or stored[-4] != "_" or stored[-4:] == stored[2:6]:
        stored += "_MPF"
    return directory or stored_directory(channel.stack[0].code.program.directory), stored


def _existing(channel: Channel, name: str) -> Program:
    directory, stored = _place(channel, name)
    if not channel.store.has_directory(directory):
        raise FileError(NO_PATH)
    program = channel.store.find_in(directory, stored)
    if program is None:
        raise FileError(NO_FILE)
    return program


def _need_idle(channel: Channel, program: Program) -> None:
    key = program.directory, program.name
    if any((level.code.program.directory, level.code.program.name) == key for level in channel.stack):
        raise FileError(IN_USE)


def size_of(program: Program) -> int:
    """Size in bytes: every line and its end."""
    return sum(len(line.encode()) + 1 for line in program.lines)


def write(channel: Channel, name: str, text: str) -> None:
    """WRITE: append a line; a file that does not exist is made.

    A program that is running can be written to as well: what is added stands behind its end (1.18).
    """
    directory, stored = _place(channel, name)
    if not stored.endswith(_WRITABLE):
        raise FileError(WRONG_TYPE)
    if not channel.store.has_directory(directory):
        raise FileError(NO_PATH)
    memory = channel.memory.language
    if memory.access_level > memory.write_levels.get(directory, LOWEST):
        raise FileError(NO_RIGHT)
    program = channel.store.find_in(directory, stored)
    if program is None:
        program = Program(stored, (), directory=directory, form=Form.SINUMERIK)
    written = replace(program, lines=(*program.lines, text))
    limit = channel.control.system_variable("$MN_LEN_PROTOCOL_FILE").read(channel, ())
    if limit and size_of(written) > limit * 1024:
        raise FileError(FULL)
    channel.store.replace(written)
    memory.programs.forget_steps()


def delete(channel: Channel, name: str) -> None:
    """DELETE."""
    program = _existing(channel, name)
    _need_idle(channel, program)
    channel.store.remove(program)
    channel.memory.language.programs.forget_steps()


def read(channel: Channel, name: str, start: int, count: int, result: Array | Reference) -> None:
    """READ: lines from `start` on, counted from 1, or the last ones for 0; longer lines are cut."""
    if _place(channel, name)[1].endswith(_BINARY):
        raise FileError(WRONG_TYPE)
    lines = _existing(channel, name).lines
    if not 0 <= start <= len(lines) or not 0 <= count <= len(lines):
        raise FileError(NO_LINE)
    first = len(lines) - count if start == 0 else start - 1
    if first + count > len(lines):
        raise FileError(RANGE_TOO_LARGE)
    capacity = len(result.items) if isinstance(result, Array) else 1
    if count > capacity:
        raise FileError(RESULT_TOO_SMALL)
    length = min(result.variable.length, MAX_STRING)
    texts = [line[:length] for line in lines[first : first + count]]
    if isinstance(result, Array):
        result.items[:count] = texts
    elif texts:
        result.value = texts[0]


def _report(text: Callable[[Program], str | int]) -> Callable[[Channel, str, Reference], None]:
    def report(channel: Channel, name: str, result: Reference) -> None:
        value = text(_existing(channel, name))
        if isinstance(value, str) and len(value) > result.variable.length:
            raise FileError(RESULT_TOO_SMALL)
        result.value = value

    return report


def _information(program: Program) -> str:
    return f"{RIGHTS} {size_of(program):8d} {DATE} {TIME}"


_PROCEDURES: dict[str, Callable[..., None]] = {
    "WRITE": write,
    "DELETE": delete,
    "READ": read,
    "FILEDATE": _report(lambda _: DATE),
    "FILETIME": _report(lambda _: TIME),
    "FILESIZE": _report(size_of),
    "FILESTAT": _report(lambda _: RIGHTS),
    "FILEINFO": _report(_information),
}


def file_procedure(channel: Channel, name: str, args: tuple[Any, ...]) -> None:
    """Run a file procedure; its first argument gets the error number."""
    error, *rest = args
    if not isinstance(error, Reference):
        raise AlarmError("12330", text=name)
    try:
        _PROCEDURES[name](channel, *rest)
        error.value = OK
    except FileError as problem:
        error.value = problem.number


def is_file(channel: Channel, name: str) -> bool:
    """ISFILE."""
    try:
        _existing(channel, name)
    except FileError:
        return False
    return True


def checksum(channel: NcChannel, result: Reference, name: str, first: int | None, last: int | None) -> int:
    """CHECKSUM: 16 hexadecimal digits for the content of an array, or of some of its columns.

    Returns:
        0, 1 no such variable, 2 no array, 3 first column beyond it, 4 last column beyond it, 5 type, 10 the
        result is too short for it.
    """
    scope = channel.level.code.whole.scope_of(channel)
    variable = scope.find(name.strip().upper())
    if variable is None:
        return 1
    array = scope.value_of(variable, channel)
    if not isinstance(array, Array):
        return 2
    if variable.type in (Type.AXIS, Type.FRAME):
        return 5
    columns = array.dims[0]
    start, end = 0 if first is None else first, columns - 1 if last is None else last
    if not 0 <= start < columns:
        return 3
    if not start <= end < columns:
        return 4
    width = len(array.items) // columns
    import hashlib

    content = repr((variable.type.value, array.items[start * width : (end + 1) * width]))
    if result.variable.length < CHECKSUM_LENGTH:
        return 10
    result.value = hashlib.sha256(content.encode()).hexdigest()[:CHECKSUM_LENGTH].upper()
    return 0


def file_function(channel: Channel, name: str, args: tuple[Any, ...]) -> bool | int:
    """The value of ISFILE or CHECKSUM."""
    return is_file(channel, *args) if name == "ISFILE" else checksum(channel, *args)
