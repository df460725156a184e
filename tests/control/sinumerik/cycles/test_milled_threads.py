"""CYCLE78: what it refuses; the rest stands in the conformance cases."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

#: Arguments of a call that works, by their places.
CALL = {0: 20, 1: 0, 2: 2, 3: -10, 5: 5, 7: 8, 8: 1.25, 9: 1, 14: 1.5, 15: 900, 17: 300}


def alarms(changes: dict[int, object], *before: str) -> list[str]:
    values = CALL | changes
    call = ",".join(str(values.get(place, "")) for place in range(26))
    tools = {1: {"radius": 3.25}}
    return [code for code, _ in codes(run("T1 D1 M6", "S3000 M3", *before, f"CYCLE78({call})", tools=tools))]


def test_a_call_without_mistakes() -> None:
    assert alarms({}) == []


@pytest.mark.parametrize(
    ("changes", "alarm"),
    [
        ({3: 5}, "61101"),  # depth above the reference plane
        ({8: 0}, "61001"),
        ({9: 4}, "PC0001"),  # pitch by module
        ({10: 0.5}, "PC0001"),  # factor or per cent?
        ({10: 120}, "PC0001"),
        ({12: -1}, "61002"),
        ({12: 1}, "PC0001"),
        ({12: 10}, "PC0001"),
        ({12: 1000}, "PC0001"),  # a last part without length
        ({4: 2}, "PC0001"),  # a first part that no digit asks for
        ({6: 2}, "PC0001"),
        ({12: 2000, 6: 2, 16: 100}, "61002"),
        ({12: 100000}, "PC0001"),
        ({12: 11000, 4: 6, 6: 5, 16: 100}, "61107"),
        ({12: 1000, 6: 5}, "61003"),
        ({13: 2}, "61109"),
        ({13: 4}, "PC0001"),
        ({15: 0}, "61003"),
        ({17: 0}, "61003"),
        ({19: 1}, "PC0001"),
    ],
)
def test_wrong_values(changes: dict[int, object], alarm: str) -> None:
    assert alarms(changes) == [alarm]


@pytest.mark.parametrize(
    ("before", "alarm"),
    [("M5", "61102"), ("D0", "61000"), ("G95 F0.1", "PC0001"), ("SCALE X2 Y2", "61011"), ("G41", "61815")],
)
def test_wrong_surroundings(before: str, alarm: str) -> None:
    assert alarms({}, before) == [alarm]
