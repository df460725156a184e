"""The bytes of lines over HTTP."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("fastapi")

from polycnc.view.lines import FEED, Lines
from polycnc.view.web import delivery


@pytest.fixture
def lines() -> Lines:
    made = Lines()
    for i in range(10):
        made.add((float(i), 0.0, 0.0), 100.0, FEED, made.colour("T1"))
    return made


def told(lines: Lines, era: int, first: int) -> tuple[dict[str, object], bytes]:
    answer = delivery.answer(lines, era, first)
    return json.loads(answer.headers["X-Line"]), bytes(answer.body)


def test_a_browser_gets_what_it_has_not_got_yet(lines: Lines) -> None:
    head, body = told(lines, 0, 7)
    assert head == {"era": 0, "first": 7, "count": 10, "tools": ["T1"]}
    assert body == lines.part(7, 3)


def test_a_browser_of_another_era_begins_anew(lines: Lines) -> None:
    for era, first in ((-1, 0), (3, 7), (0, -5), (0, 99)):
        head, body = told(lines, era, first)
        assert head["first"] == 0
        assert body == lines.part(0, 10)


def test_no_answer_is_longer_than_agreed(lines: Lines, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(delivery, "POINTS", 4)
    assert told(lines, 0, 0)[1] == lines.part(0, 4)
