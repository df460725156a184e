"""The formats in which people and programs read diagnostics: text, JSON, GitHub commands, JUnit XML."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.cases.junit import Entry
    from polycnc.cli.diagnostics import Diagnostic


def as_text(found: Sequence[Diagnostic]) -> str:
    """One finding a line: `file:line:col: code message`, and what to do about it in the line below."""
    return "".join(f"{line}\n" for diagnostic in found for line in lines_of(diagnostic))


def lines_of(diagnostic: Diagnostic) -> list[str]:
    """A finding as people read it: its line, and the remedy where there is one."""
    remedy = [f"  {text('alarms.remedy')}: {diagnostic.remedy}"] if diagnostic.remedy else []
    return [str(diagnostic), *remedy]


def as_json(found: Sequence[Diagnostic]) -> str:
    """A list of objects with `file`, `line`, `column`, `code`, `message` and what else a finding has."""
    import json

    entries = [
        {
            "file": d.place.file,
            "line": d.place.line,
            "column": d.place.column,
            "code": d.code,
            "message": d.message,
            "rule": d.rule,
            "severity": d.severity,
            "cause": d.cause,
            "remedy": d.remedy,
            "calls": [{"file": call.file, "line": call.line} for call in d.calls],
        }
        for d in found
    ]
    return json.dumps(entries, ensure_ascii=False, indent=1) + "\n"


def as_github(found: Sequence[Diagnostic]) -> str:
    """Workflow commands of GitHub: `::error file=…,line=…,col=…,title=…::message`."""
    return "".join(_github_line(diagnostic) for diagnostic in found)


def _github_line(d: Diagnostic) -> str:
    values = {"file": d.place.file, "line": d.place.line, "col": d.place.column, "title": d.code}
    properties = ",".join(
        f"{key}={_github_escaped(str(value), ':,')}" for key, value in values.items() if value
    )
    return f"::{d.severity} {properties}::{_github_escaped(d.message)}\n"


def _github_escaped(value: str, more: str = "") -> str:
    for char in "%\r\n" + more:
        value = value.replace(char, f"%{ord(char):02X}")
    return value


def as_junit(found: Sequence[Diagnostic], files: Sequence[str]) -> str:
    """JUnit XML: one test case a file, failed where something was found in it or in what it calls."""
    from polycnc.cases.junit import as_xml

    return as_xml("polycnc check", [_entry(file, found) for file in files])


def _entry(file: str, found: Sequence[Diagnostic]) -> Entry:
    from polycnc.cases.junit import Entry

    own = [d for d in found if file in (d.place.file, _main_file(d))]
    failures = tuple(" ".join(line.strip() for line in lines_of(d)) for d in own if not d.unreadable)
    errors = tuple(d.message for d in own if d.unreadable)
    return Entry(file, "polycnc.check", failures, errors=errors)


def _main_file(diagnostic: Diagnostic) -> str:
    return diagnostic.calls[0].file if diagnostic.calls else diagnostic.place.file
