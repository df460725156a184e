"""JUnit XML, as CI servers read it."""

from __future__ import annotations

from xml.etree import ElementTree

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True)
class Entry:
    """One test case of a suite; `failures` are messages, `errors` why it could not run, `skipped` why it need not."""

    name: str
    group: str
    failures: tuple[str, ...] = ()
    skipped: str = ""
    errors: tuple[str, ...] = ()


def as_xml(suite_name: str, entries: Sequence[Entry]) -> str:
    """A suite as XML."""
    suite = ElementTree.Element(
        "testsuite",
        name=suite_name,
        tests=str(len(entries)),
        failures=str(sum(bool(entry.failures) for entry in entries)),
        errors=str(sum(bool(entry.errors) for entry in entries)),
        skipped=str(sum(bool(entry.skipped) for entry in entries)),
    )
    for entry in entries:
        case = ElementTree.SubElement(
            suite, "testcase", name=_clean(entry.name), classname=_clean(entry.group)
        )
        for message in entry.failures:
            ElementTree.SubElement(case, "failure", message=_clean(message))
        for message in entry.errors:
            ElementTree.SubElement(case, "error", message=_clean(message))
        if entry.skipped:
            ElementTree.SubElement(case, "skipped", message=_clean(entry.skipped))
    ElementTree.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(suite, encoding="unicode") + "\n"


def _clean(value: str) -> str:
    """Without the control characters that XML cannot hold."""
    return "".join(char if char >= " " or char in "\t\n" else "�" for char in value)
