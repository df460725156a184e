"""What one memory holds and another one does not: which data a file could not say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from math import isclose

from polycnc.deferred.records import fields, is_dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.memory import retained

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.memory.retained import RetainedStore
    from polycnc.program import Program

#: Tables that files say; the alarm history and the panel's own data have none.
TABLES = (
    retained.WORK_OFFSETS,
    retained.TOOL_OFFSETS,
    retained.VARIABLES,
    retained.VARIABLE_NAMES,
    retained.WORK_SHIFT,
    retained.WORK_TURNS,
    retained.WORKPIECE_ERRORS,
    retained.MACHINING_CONDITIONS,
    retained.REGISTERS,
    retained.PARAMETERS,
    retained.TOOLS,
    retained.TOOL_CARRIERS,
    retained.USER_VARIABLES,
    retained.PROGRAMS,
)
#: Lengths and angles that differ by less are one: frames are worked out from their components again.
TOLERANCE = 1e-9


def missing(held: RetainedStore, other: RetainedStore, channels: int) -> Iterator[tuple[str, object]]:
    """Table and key of everything that one memory holds and the other does not hold so.

    Args:
        held: What is looked at.
        other: Where it is looked for.
        channels: Number of channels.
    """
    for name in TABLES:
        for channel in range(channels + 1):
            of_other = other.table(name, channel)
            for key, value in held.table(name, channel).items():
                if not _is_same(value, of_other.get(key)):
                    yield name, key


def _is_same(one: object, other: object) -> bool:
    if other is None:
        return _is_empty(one)
    if isinstance(one, bool | str | Enum) or one is None:
        return one == other or (_is_empty(one) and _is_empty(other))
    if isinstance(one, int | float):
        return isinstance(other, int | float) and isclose(one, other, rel_tol=TOLERANCE, abs_tol=TOLERANCE)
    if _is_program(one):
        return _text_of(one) == _text_of(other)
    if is_dataclass(one):
        return type(one) is type(other) and all(
            _is_same(getattr(one, each.name), getattr(other, each.name)) for each in fields(one) if each.init
        )
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return all(_is_same(one.get(key), other.get(key)) for key in {**one, **other})
    if isinstance(one, Sequence) and isinstance(other, Sequence):
        length = max(len(one), len(other))
        return all(_is_same(_at(one, i), _at(other, i)) for i in range(length))
    return one == other


def _at(values: Sequence[object], index: int) -> object:
    return values[index] if index < len(values) else None


def _is_empty(value: object) -> bool:
    """Whether a memory that does not have a value says the same: zero, nothing, what a class begins with."""
    if value is None or value in (0, "", False):
        return True
    if is_dataclass(value) and not isinstance(value, type):
        try:
            return _is_same(value, type(value)())
        except TypeError:
            return False
    if isinstance(value, Mapping):
        return all(map(_is_empty, value.values()))
    return isinstance(value, Sequence) and not isinstance(value, str) and all(map(_is_empty, value))


def _is_program(value: object) -> bool:
    return hasattr(value, "lines") and hasattr(value, "directory")


def _text_of(program: object) -> tuple[str, list[str]]:
    """What a program says, without its heading: a tape gives one to each."""
    held: Program = program  # type: ignore[assignment]
    lines = [line for line in held.lines if not line.strip().startswith(("O", "<", "%", ":"))]
    return held.directory, lines
