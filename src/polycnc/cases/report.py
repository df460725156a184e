"""What `polycnc test` writes: text for people, JSON and JUnit XML for programs."""

from __future__ import annotations

import json

from polycnc.cases.junit import Entry, as_xml
from polycnc.deferred.typing import TYPE_CHECKING
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
    """JUnit XML; the feature stands in `classname`."""
    return as_xml("polycnc", [_entry(outcome) for outcome in outcomes])


def _entry(outcome: Outcome) -> Entry:
    failures = (outcome.message,) if outcome.status == "failed" else ()
    skipped = outcome.message if outcome.status == "skipped" else ""
    return Entry(outcome.id, outcome.feature or "polycnc", failures, skipped)
