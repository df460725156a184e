"""What `polycnc test` writes: text for people, JSON and JUnit XML for programs."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.cases.runner import Outcome


def summary(outcomes: Sequence[Outcome]) -> str:
    """The last line, `N passed, N failed, N skipped`: in English always, because programs read it."""
    counts = [
        sum(1 for outcome in outcomes if outcome.status == status)
        for status in ("passed", "failed", "skipped")
    ]
    return "{} passed, {} failed, {} skipped".format(*counts)


def failure_line(outcome: Outcome) -> str:
    """The one line that tells of a failing case."""
    return text("case.failed", id=outcome.id, message=" ".join(outcome.message.split()))


def as_json(outcomes: Sequence[Outcome]) -> str:
    """A list of `{"id", "status", "message"}`."""
    entries = [{"id": o.id, "status": o.status, "message": o.message} for o in outcomes]
    return json.dumps(entries, ensure_ascii=False, indent=1) + "\n"


def as_junit(outcomes: Sequence[Outcome]) -> str:
    """JUnit XML as CI servers read it; the feature stands in `classname`."""
    suite = ElementTree.Element(
        "testsuite",
        name="polycnc",
        tests=str(len(outcomes)),
        failures=str(sum(o.status == "failed" for o in outcomes)),
        skipped=str(sum(o.status == "skipped" for o in outcomes)),
    )
    for outcome in outcomes:
        name = _xml_text(outcome.id)
        case = ElementTree.SubElement(
            suite, "testcase", name=name, classname=_xml_text(outcome.feature or "polycnc")
        )
        if outcome.status != "passed":
            tag = {"failed": "failure", "skipped": "skipped"}[outcome.status]
            ElementTree.SubElement(case, tag, message=_xml_text(outcome.message))
    ElementTree.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(suite, encoding="unicode") + "\n"


def _xml_text(value: str) -> str:
    """Without the control characters that XML cannot hold."""
    return "".join(char if char >= " " or char in "\t\n" else "�" for char in value)
