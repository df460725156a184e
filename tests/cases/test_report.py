from __future__ import annotations

import json
from xml.etree import ElementTree

from polycnc.cases.report import as_json, as_junit, failure_line, summary
from polycnc.cases.runner import Outcome

OUTCOMES = [
    Outcome("a", "passed", feature="f1"),
    Outcome("b", "failed", "move 1:\n expected <x>\x00", feature="f1"),
    Outcome("c", "skipped", "not run"),
]


def test_the_summary_counts_every_status() -> None:
    assert summary(OUTCOMES) == "1 passed, 1 failed, 1 skipped"


def test_a_failure_takes_one_line() -> None:
    assert failure_line(Outcome("b", "failed", "one\ntwo")) == "FAILED b: one two"


def test_json_lists_id_status_and_message() -> None:
    assert json.loads(as_json(OUTCOMES))[0] == {"id": "a", "status": "passed", "message": ""}


def test_junit_is_readable_xml_whatever_the_message_holds() -> None:
    suite = ElementTree.fromstring(as_junit(OUTCOMES))
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("3", "1", "1")
    failure = suite.find("testcase/failure")
    assert failure is not None
    assert "<x>" in str(failure.get("message"))
