"""A program under edit: what a check of its text finds, and which parts of it are comments, codes and variables."""

from __future__ import annotations

import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.panel.checking import FarCheck

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.mainrun import VirtualControl
    from polycnc.messages import Alarm

#: A check while someone types ends after so many blocks, one in another process after so many.
LONGEST_LOOK, LONGEST_FAR_LOOK = 5_000, 20_000_000
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


class Check:
    """Looks for what alarms when a text runs, as `polycnc check` does: without motion; other programs are as they are.

    Args:
        control: The control; nothing of it changes.
        name: Name of the program that has this text.
        source: The text.
        lang: Language of the findings; the active one where none is named.
    """

    def __init__(self, control: VirtualControl, name: str, source: str, lang: str | None = None) -> None:
        self._control, self._lang = control, lang
        self._forecast = control.forecast(name, text=_ended(source), block_limit=LONGEST_LOOK)

    def go_on(self) -> bool:
        """Look at some further blocks; gives whether there are more."""
        return self._forecast.go_on()

    @property
    def ends_early(self) -> bool:
        """Whether it has ended at its limit of blocks: there is more to look at."""
        return self._forecast.is_over and self._forecast.has_reached_limit

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What has been found so far."""
        return told(self._control, self._forecast.main.name, self._forecast.alarms, self._lang)


def check_elsewhere(control: VirtualControl, name: str, source: str) -> FarCheck:
    """A check of the whole text in another process; arguments as for `Check`."""
    return FarCheck(control.forecast(name, text=_ended(source), block_limit=LONGEST_FAR_LOOK).job)


def told(
    control: VirtualControl, main: str, alarms: Iterable[Alarm], lang: str | None
) -> tuple[Finding, ...]:
    """Alarms of a check as an editor tells them; `main` is the name of the program that it has."""
    end_of_look = control.control.block_limit().code
    return tuple(
        Finding(
            alarm.line if alarm.program == main else 0, alarm.column if alarm.program == main else 0,
            alarm.code, control.alarm_text(alarm, lang),
        )
        for alarm in alarms
        if alarm.code != end_of_look
    )  # fmt: skip


def _ended(source: str) -> str:
    return source if source.endswith("\n") else source + "\n"


def findings(control: VirtualControl, name: str, source: str, lang: str | None = None) -> tuple[Finding, ...]:
    """What alarms when a text runs: a whole `Check` at once."""
    if not source.strip():
        return ()
    check = Check(control, name, source, lang)
    while check.go_on():
        pass
    return check.findings


def parts(control_id: str, source: str) -> Iterator[Part]:
    """The parts of a text that an editor shows in colours, in order."""
    kinds = (*_OWN.get(control_id, _WORD_ADDRESS), *_ALL)
    pattern = re.compile(
        "|".join(f"(?P<{kind}>{form})" for kind, form in kinds), re.IGNORECASE | re.MULTILINE
    )
    for found in pattern.finditer(source):
        if found.lastgroup is not None:
            yield Part(*found.span(), found.lastgroup)
