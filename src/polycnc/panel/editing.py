"""A program under edit: what a check of its text finds, and which parts of it are comments, codes and variables."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from polycnc.channel.channel import Channel
from polycnc.deferred.records import dataclass
from polycnc.program import Form, ProgramStore

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.mainrun import VirtualControl

#: A check while someone types ends after so many blocks.
LONGEST_LOOK = 5_000
#: What stands in a line, the first that fits: comments and texts, block numbers, G and M codes, variables, numbers.
_SINUMERIK = (("comment", r";.*"), ("text", r'"[^"]*"?'))
_SYNTEC = (("comment", r"//.*|\(\*.*?(?:\*\)|$)"), ("text", r'"[^"]*"?'))
_WORD_ADDRESS = (("comment", r"\([^)]*\)?"),)
_ALL = (
    ("block", r"^\s*/?\d?\s*N\d+"),
    ("code", r"\b[GM]\d+(?:\.\d+)?"),
    ("variable", r"[#@]\d+|\$[A-Z]+_\w+(?:\[[^\]]*\])?|\bR\d+(?==)"),
    ("word", r"\b[A-Z_]{2,}\d*\b"),
)
_OWN = {"sinumerik-840d": _SINUMERIK, "syntec-mill": _SYNTEC}


@dataclass(frozen=True, slots=True)
class Finding:
    """An alarm that a check has found; line and column count from 1, 0 is unknown."""

    line: int
    column: int
    code: str
    text: str


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a text from `start` up to `end`: `comment`, `text`, `block`, `code`, `variable`, `word`."""

    start: int
    end: int
    kind: str


def findings(control: VirtualControl, name: str, source: str, lang: str | None = None) -> tuple[Finding, ...]:
    """What alarms when the text runs, as `polycnc check` finds it: without motion, other programs being as they are.

    Args:
        control: The control; nothing of it changes.
        name: Name of the program that has this text.
        source: The text.
        lang: Language of the findings; the active one where none is named.
    """
    if not source.strip():
        return ()
    store = ProgramStore(form=control.control.form)
    main = store.add_text(_key(control, name), source if source.endswith("\n") else source + "\n")
    for entry in control.programs:
        if entry.name.casefold() != main.name.casefold():
            text = "\n".join(control.program_lines(entry.name)) + "\n"
            store.add_text(f"{entry.directory}/{entry.name}" if entry.directory else entry.name, text)
    setup = control.channel.setup
    channel = Channel(control.control, control.machine, setup, store, block_limit=LONGEST_LOOK)
    for _ in channel.run(main):
        pass
    end_of_look = control.control.block_limit().code
    return tuple(
        Finding(
            alarm.line if alarm.program == main.name else 0, alarm.column if alarm.program == main.name else 0,
            alarm.code, control.alarm_text(alarm, lang),
        )
        for alarm in channel.alarms
        if alarm.code != end_of_look
    )  # fmt: skip


def _key(control: VirtualControl, name: str) -> str:
    """The name under which a store takes a text: with its directory where the control has it."""
    known = next((each for each in control.programs if each.name.casefold() == name.casefold()), None)
    if known is not None and known.directory:
        return f"{known.directory}/{known.name}"
    return name if known is not None or control.control.form is not Form.SINUMERIK else f"{name}.MPF"


def parts(control_id: str, source: str) -> Iterator[Part]:
    """The parts of a text that an editor shows in colours, in order."""
    kinds = (*_OWN.get(control_id, _WORD_ADDRESS), *_ALL)
    pattern = re.compile(
        "|".join(f"(?P<{kind}>{form})" for kind, form in kinds), re.IGNORECASE | re.MULTILINE
    )
    for found in pattern.finditer(source):
        if found.lastgroup is not None:
            yield Part(*found.span(), found.lastgroup)
