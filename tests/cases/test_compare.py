from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import pytest

from polycnc.cases import compare
from polycnc.cases.format import ExpectedAlarm, ExpectedEvent, ExpectedMove, ExpectedPosition
from polycnc.control import registry
from polycnc.control.alarm_text import alarm_key
from polycnc.messages import Alarm

if TYPE_CHECKING:
    from polycnc.toolpath.trace import Record

NEAR = compare.Positions(0.001)


def moves(*written: dict[str, Any]) -> list[ExpectedMove]:
    return [ExpectedMove.model_validate(move) for move in written]


def events(*written: dict[str, Any]) -> list[ExpectedEvent]:
    return [ExpectedEvent.model_validate(event) for event in written]


def row(type_: str, line: int = 1, **to_and_more: Any) -> Record:
    to = {key: value for key, value in to_and_more.items() if key.isupper()}
    rest = {key: value for key, value in to_and_more.items() if not key.isupper()}
    head = {"type": type_, "program": "O1", "line": line, "to": to, "machine": to}
    return cast("Record", head | rest)


def event(type_: str, **values: float | str) -> Record:
    return cast("Record", {"type": type_, "program": "O1", "line": 1, **values})


CAME = [row("rapid", X=0.0, Z=2.0), row("feed", 2, X=0.0, Z=-5.0, feed=100.0), row("rapid", 3, X=50.0, Z=2.0)]


# ---- moves ---------------------------------------------------------------------------------------------


def test_exact_moves_must_be_all_moves() -> None:
    expected = moves(*({"type": r["type"], "to": r["to"]} for r in CAME))
    assert compare.compare_moves(expected, CAME, NEAR, exact=True) == []
    assert "move 3" in compare.compare_moves(expected[:2], CAME, NEAR, exact=True)[0]
    assert "move 3" in compare.compare_moves(expected, CAME[:2], NEAR, exact=True)[0]


def test_a_subsequence_may_leave_moves_out_but_keeps_the_order() -> None:
    first, last = {"type": "rapid", "to": {"Z": 2}}, {"to": {"X": 50}}
    assert compare.compare_moves(moves(first, last), CAME, NEAR, exact=False) == []
    assert compare.compare_moves(moves(last, first), CAME, NEAR, exact=False) != []


def test_what_a_move_does_not_name_is_not_compared() -> None:
    assert compare.compare_moves(moves({}, {}, {}), CAME, NEAR, exact=True) == []


@pytest.mark.parametrize(
    "wrong",
    [
        {"type": "rapid"},
        {"to": {"Z": -5.002}},
        {"to": {"Y": 0}},
        {"feed": 101},
        {"line": 3},
        {"seconds": 1},
        {"center": {"X": 0}},
        {"machine": {"Z": 0}},
        {"program": "O2"},
    ],
)
def test_each_named_value_is_compared(wrong: dict[str, Any]) -> None:
    (difference,) = compare.compare_moves(moves({}, wrong, {}), CAME, NEAR, exact=True)
    assert difference.startswith("move 2")


def test_positions_may_be_off_by_the_tolerance_and_no_more() -> None:
    assert NEAR.equal({"X": 1.001}, {"X": 1.0})
    assert not NEAR.equal({"X": 1.0011}, {"X": 1.0})


def test_modulo_axes_are_compared_around_the_turn() -> None:
    around = compare.Positions(0.001, {"C"})
    assert around.equal({"C": 0, "X": 0}, {"C": 359.9995, "X": 0})
    assert not around.equal({"X": 0}, {"X": 360})
    assert not around.equal({"C": 180}, {"C": 0})


# ---- final, variables ----------------------------------------------------------------------------------


def test_final_positions_are_compared_on_each_display() -> None:
    expected = ExpectedPosition(work={"X": 1}, machine={"X": 2})
    assert compare.compare_final(expected, {"X": 1}, {"X": 2}, NEAR) == []
    assert len(compare.compare_final(expected, {"X": 2}, {"X": 1}, NEAR)) == 2
    assert len(compare.compare_final(ExpectedPosition(work={"B": 0}), {"X": 1}, {}, NEAR)) == 1


@pytest.mark.parametrize(
    ("expected", "actual", "equal"),
    [
        (5, 5.0005, True),
        (5, 5.01, False),
        (1, True, True),
        (0, False, True),
        ("X", "X", True),
        ("10", 10, True),
        ("X", "x", False),
        (None, None, True),
        (None, 0, False),
        (0, None, False),
        (10, "10", True),
        ([1, 2], (1.0, 2.0), True),
        ([1, 2], (1.0,), False),
    ],
)
def test_variables_are_compared_by_kind(expected: object, actual: object, equal: bool) -> None:
    differences = compare.compare_variables({"#1": expected}, lambda _name: actual, 0.001)
    assert (differences == []) is equal


def test_a_variable_that_the_control_does_not_have_is_a_difference() -> None:
    values: dict[str, object] = {}
    (difference,) = compare.compare_variables({"#9x": 1}, values.__getitem__, 0.001)
    assert "#9x" in difference


# ---- alarms --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("control", "one", "other", "same"),
    [
        ("fanuc-m", "033", "PS0033", True),
        ("fanuc-m", 33, "33", True),
        ("fanuc-0i-tf", "PS0010", "PS0011", False),
        ("meldas-m", "P62", "62", True),
        ("sinumerik-840d", 12080, "12080", True),
        ("sinumerik-840d", "12080", "14080", False),
        ("syntec-mill", "COR-012", "COR-12", True),
        ("syntec-mill", "COR-012", "MAR-012", False),
        ("syntec-mill", "MAR-001", "MACRO-001", True),
        ("syntec-mill", "cor-012", "COR-012", True),
    ],
)
def test_alarm_codes_are_compared_as_each_control_counts_them(
    control: str, one: str | int, other: str | int, same: bool
) -> None:
    known = registry.control(control)
    assert (alarm_key(known, one) == alarm_key(known, other)) is same


def alarms(expected: list[dict[str, Any]], *codes: str, line: int = 2) -> list[str]:
    came = [Alarm("fanuc-m", code, "O1", line) for code in codes]
    wanted = [ExpectedAlarm.model_validate(alarm) for alarm in expected]
    return compare.compare_alarms(
        registry.control("fanuc-m"), wanted, came, lambda _: "N0040", lambda alarm: alarm.code
    )


def test_alarms_must_come_in_order_none_missing_and_none_more() -> None:
    assert alarms([{"code": "PS0010", "line": 2}], "PS0010") == []
    assert alarms([], "PS0010") != []
    assert alarms([{"code": "PS0010"}]) != []
    assert alarms([{"code": "PS0010", "line": 3}], "PS0010") != []
    assert alarms([{"code": "PS0010"}, {"code": "PS0011"}], "PS0011", "PS0010") != []


def test_any_matches_every_alarm_but_not_its_absence() -> None:
    assert alarms([{"code": "any"}], "PS0010") == []
    assert alarms([{"code": "any"}], "PS0010", "PS0011") == []
    assert alarms([{"code": "any"}]) != []
    assert alarms([{"code": "any", "line": 9}], "PS0010") != []


def test_an_alarm_can_be_placed_by_its_block_number() -> None:
    assert alarms([{"code": 10, "block": "N40"}], "PS0010") == []
    assert alarms([{"code": 10, "block": "N50"}], "PS0010") != []


# ---- events, stops -------------------------------------------------------------------------------------

HAPPENED = [
    event("s", speed=1200.0, spindle=1),
    event("m", code=3),
    event("t", tool=2),
    event("message", text="DOOR"),
    event("print", text="X1.5"),
    event("stop", code="M00"),
    event("s", speed=500.0, spindle=2),
]


@pytest.mark.parametrize(
    "expected",
    [
        [{"m": 3}, {"t": 2}],
        [{"s": 1200}, {"stop": "M0"}],
        [{"message": "DOOR"}, {"print": "X1.5"}],
        [{"spindle": 2, "s": 500}],
        [{"m": 0}],
        [{"t": "2"}],
    ],
)
def test_events_may_leave_others_out(expected: list[dict[str, Any]]) -> None:
    assert compare.compare_events(events(*expected), HAPPENED, 0.001) == []


@pytest.mark.parametrize(
    "expected",
    [
        [{"t": 2}, {"m": 3}],
        [{"m": 4}],
        [{"m": 3}, {"m": 3}],
        [{"s": 501}],
        [{"spindle": 1, "s": 500}],
        [{"message": "X1.5"}],
        [{"stop": "M01"}],
    ],
)
def test_events_that_did_not_come_in_this_order_are_missed(expected: list[dict[str, Any]]) -> None:
    assert len(compare.compare_events(events(*expected), HAPPENED, 0.001)) == 1


def test_stops_are_compared_by_block_number() -> None:
    came = ["N10", "N020", "N30"]
    assert compare.compare_stops(["N10", "N20", "N30"], came, [], exact=True) == []
    assert compare.compare_stops(["N10", "N30"], came, [], exact=True) != []
    assert compare.compare_stops(["N10", "N30"], came, ["N40"], exact=False) == []
    assert compare.compare_stops(["N30", "N10"], came, [], exact=False) != []
    assert compare.compare_stops(None, came, [20], exact=False) != []
