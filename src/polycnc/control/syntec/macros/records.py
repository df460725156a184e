"""Cycle records of macros: DBNEW, DBOPEN, DBLOAD, DBSAVE, DBINSERT, DBDELETE (macro manual, files).

A file holds records, one is open at a time. A record has a cycle's name and the values of the variables that the
schema of that cycle names. Schemas are the builder's: the setup gives each as a switch `cycle NAME` with variables
(`"cycle DRILL": "@100 @101"`). Files are those that DBNEW has made in this run.
"""

from __future__ import annotations

import re

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.values import Text, Vacant, Value, whole
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.syntec.memory import SyntecMemory

WRONG_TYPE = "COR-023"
DONE, FAILED = 1, 0
#: What DBNEW gives back where it makes no file.
NAME_TOO_LONG, EXISTS = -1, -2
#: What DBINSERT and DBDELETE give back where they do nothing.
NO_SUCH_RECORD, NOT_OPEN, NO_SUCH_CYCLE = -1, -2, -3
LONGEST_NAME = 30
_VARIABLE = regex(r"([#@])(\d+)(?:\[(\d)\])?")


@dataclass(slots=True)
class Record:
    """A cycle and the values of its variables, in the order of its schema."""

    cycle: str
    values: list[Value]


@dataclass(slots=True)
class Records(State, lifetime=Lifetime.POWER):
    """Files of records.

    Attributes:
        files: By name.
        opened: The name of the open one; empty for none.
        cycle: The cycle of the record that was loaded or inserted last; empty before.
    """

    files: dict[str, list[Record]] = field(default_factory=dict)
    opened: str = ""
    cycle: str = ""

    @property
    def records(self) -> list[Record] | None:
        """Those of the open file."""
        return self.files.get(self.opened)


def _name(memory: SyntecMemory, text: Value) -> str:
    """A name with its variables replaced: `AB#1[3]` has #1 with three digits."""
    if not isinstance(text, Text):
        raise AlarmError(WRONG_TYPE)

    def replaced(match: re.Match[str]) -> str:
        index = int(match[2])
        value = memory.variable(index) if match[1] == "#" else memory.register(index)
        if isinstance(value, Text | Vacant):
            return str(value) if isinstance(value, Text) else ""
        return f"{int(value):0{int(match[3] or 1)}d}"

    return _VARIABLE.sub(replaced, text)


def _schema(memory: SyntecMemory, cycle: str) -> list[tuple[str, int]] | None:
    """The variables of a cycle; None for a cycle that nobody has defined."""
    text = memory.channel.setup.switches.signals.get(f"cycle {cycle}")
    if text is None:
        return None
    return [(found[1], int(found[2])) for found in _VARIABLE.finditer(str(text))]


def _values(memory: SyntecMemory, cycle: str) -> list[Value]:
    return [
        memory.variable(index) if family == "#" else memory.register(index)
        for family, index in _schema(memory, cycle) or ()
    ]


def new_file(memory: SyntecMemory, name: Value) -> Value:
    """DBNEW("f"): an empty file."""
    state, wanted = Records.of(memory.channel), _name(memory, name)
    if len(wanted) > LONGEST_NAME:
        return NAME_TOO_LONG
    if wanted in state.files:
        return EXISTS
    if not wanted:
        return FAILED
    state.files[wanted] = []
    return DONE


def open_records(memory: SyntecMemory, name: Value) -> Value:
    """DBOPEN("f"): how many records the file has; the one before is closed."""
    state, wanted = Records.of(memory.channel), _name(memory, name)
    state.opened, state.cycle = (wanted if wanted in state.files else ""), ""
    return len(state.records or ())


def load(memory: SyntecMemory, place: Value) -> Value:
    """DBLOAD(i): the values of a record, counted from 0, go into the variables of its cycle."""
    state, at = Records.of(memory.channel), whole(place, WRONG_TYPE)
    if state.records is None or not 0 <= at < len(state.records):
        return FAILED
    record = state.records[at]
    for (family, index), value in zip(_schema(memory, record.cycle) or (), record.values, strict=False):
        write: Callable[[int, Value], None] = memory.set_variable if family == "#" else memory.set_register
        write(index, value)
    state.cycle = record.cycle
    return DONE


def save(memory: SyntecMemory, place: Value) -> Value:
    """DBSAVE(i): the values of the variables now become those of a record, with the cycle loaded or inserted last."""
    state, at = Records.of(memory.channel), whole(place, WRONG_TYPE)
    if state.records is None or not state.cycle or not 0 <= at < len(state.records):
        return FAILED
    state.records[at] = Record(state.cycle, _values(memory, state.cycle))
    return DONE


def insert(memory: SyntecMemory, place: Value, cycle: Value) -> Value:
    """DBINSERT(i, "cycle"): a record with the values of the variables now, in front of record i or at the end."""
    state, at = Records.of(memory.channel), whole(place, WRONG_TYPE)
    if not isinstance(cycle, Text):
        raise AlarmError(WRONG_TYPE)
    if state.records is None:
        return NOT_OPEN
    if not 0 <= at <= len(state.records):
        return NO_SUCH_RECORD
    if _schema(memory, str(cycle)) is None:
        return NO_SUCH_CYCLE
    state.records.insert(at, Record(str(cycle), _values(memory, str(cycle))))
    state.cycle = str(cycle)
    return DONE


def delete(memory: SyntecMemory, place: Value) -> Value:
    """DBDELETE(i)."""
    state, at = Records.of(memory.channel), whole(place, WRONG_TYPE)
    if state.records is None:
        return NOT_OPEN
    if not 0 <= at < len(state.records):
        return NO_SUCH_RECORD
    del state.records[at]
    return DONE


FUNCTIONS: dict[str, Callable[..., Value]] = {
    "DBNEW": new_file,
    "DBOPEN": open_records,
    "DBLOAD": load,
    "DBSAVE": save,
    "DBINSERT": insert,
    "DBDELETE": delete,
}
