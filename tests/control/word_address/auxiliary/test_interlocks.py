"""The machine's own controller as tables, and what it refuses while a program is calculated."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest

from polycnc.channel.channel import Channel
from polycnc.control.alarm_text import catalogue_of
from polycnc.control.registry import control
from polycnc.machine import load_machine
from polycnc.machine.plc import Plc, PlcAlarm
from polycnc.messages import Catalogue
from tests import support
from tests.support import codes

#: Alarms and messages that a program, a key or a state of the control brings about: without any input of the machine.
RAISED = {
    "fanuc-m": {
        *(
            "1007",
            "1041",
            "1045",
            "1046",
            "1054",
            "1093",
            "1094",
            "1095",
            "1097",
            "1098",
            "1102",
            "1103",
            "1104",
        ),
        *("1105", "2001", "2004", "2009", "2021", "2026", "2027", "2031", "2098"),
    },
    "meldas-m": {
        *(
            "4008",
            "3006",
            "3007",
            "3008",
            "3009",
            "3010",
            "3011",
            "3012",
            "3013",
            "3014",
            "3015",
            "3017",
            "3018",
        ),
        *(
            "3019",
            "3023",
            "3024",
            "3027",
            "3028",
            "3031",
            "3032",
            "3034",
            "3036",
            "3038",
            "3073",
            "3074",
            "3075",
        ),
        *("1000", "1002", "1003", "1004", "1006", "1007", "1009", "1011", "1012", "1013"),
    },
}
#: Signals that the control gives: states, modes, positions.
STATES = {
    *(
        "READY",
        "RUNNING",
        "HOLD",
        "STOPPED",
        "ALARM",
        "EMERGENCY",
        "AUTO",
        "MDI",
        "TAPE",
        "JOG",
        "HANDLE",
        "MANUAL",
    ),
    *("Z_AT_REFERENCE", "Z_AT_CHANGE_POINT", "SPINDLE_COMMANDED", "T_NOT_IN_MAGAZINE", "HAS_AXIS_A"),
    *("X_BEYOND_REFERENCE", "Y_BEYOND_REFERENCE", "Z_BEYOND_REFERENCE"),
    *("NOT_REFERENCED_X", "NOT_REFERENCED_Y", "NOT_REFERENCED_Z", "NOT_REFERENCED_B"),
}
#: Numbers of the lists that nothing raises: the manual gives them no text, or they belong to inputs that do not exist.
WITHOUT_A_RULE = {
    "fanuc-m": set[str](),
    "meldas-m": {
        *(str(number) for number in (*range(4010, 4016), 3051, 3057, 3059, 3060)),
        *(str(number) for number in (*range(3064, 3072), *range(3076, 3084), *range(1024, 1029))),
    },
}


def tables(control_id: str) -> Plc:
    return load_machine("hartford").plc(control_id)


def texts(control_id: str) -> Catalogue:
    return catalogue_of(control(control_id), load_machine("hartford"))


def run(text: str, control_id: str = "fanuc-m", machine: str = "hartford", **more: Any) -> Channel:
    return support.run(text, control_id, machine=machine, **more)


@pytest.mark.parametrize("control_id", RAISED)
def test_every_alarm_of_the_tables_is_in_the_catalogue(control_id: str) -> None:
    assert {row.code for row in tables(control_id).alarms} <= set(texts(control_id))


@pytest.mark.parametrize("control_id", RAISED)
def test_every_alarm_with_a_text_has_a_rule(control_id: str) -> None:
    listed = {code for code in texts(control_id) if code.isdigit()}
    assert listed - {row.code for row in tables(control_id).alarms} == WITHOUT_A_RULE[control_id]


@pytest.mark.parametrize("control_id", RAISED)
def test_what_a_program_or_an_operator_can_bring_about_is_raised_without_inputs(control_id: str) -> None:
    plc = tables(control_id)
    known = STATES | {rule.output for rule in plc.rules}
    raised = {row.code for row in plc.alarms if can_hold(row, known)}
    assert raised == RAISED[control_id]


def can_hold(row: PlcAlarm, known: set[str]) -> bool:
    """Whether a condition holds in some state of known signals, every other one being off."""
    free = sorted(name for name in row.signals if name in known or name in row.words)
    states = [frozenset(on) for count in range(len(free) + 1) for on in combinations(free, count)]
    return any(row.condition(lambda name: float(name in on)) for on in states)  # noqa: B023 - asked at once


@pytest.mark.parametrize("control_id", RAISED)
def test_messages_are_those_that_do_not_stop(control_id: str) -> None:
    own = {"fanuc-m": "2", "meldas-m": "1"}[control_id]
    for row in tables(control_id).alarms:
        assert row.stops is not (row.code.startswith(own) or row.code == "3074"), row.code


REFUSED = [
    ("fanuc-m", "M6\n", "1054"),
    ("fanuc-m", "T1 M6\nM6\n", "1054"),
    ("fanuc-m", "T0 M6\n", ""),
    ("fanuc-m", "T3\nG0 Z-5.\nM6\n", "1046"),
    ("fanuc-m", "T3\nG0 Z-5.\nG91 G28 Z0 M6\n", ""),
    ("fanuc-m", "M11\nM3 S500\n", "1095"),
    ("fanuc-m", "M11\nM14\n", "1095"),
    ("fanuc-m", "M11\nS500\n", "1105"),
    ("fanuc-m", "M11\nM19\n", "1094"),
    ("fanuc-m", "M11\nM10\nM3 S5\n", ""),
    ("fanuc-m", "M3 S9\nM11\n", "1104"),
    ("fanuc-m", "M3 S9\nM5\nM11\n", ""),
    ("fanuc-m", "M4 S9\nM19\nM11\n", ""),
    ("fanuc-m", "M77\n", ""),
    ("fanuc-m", "M88\n", "1093"),
    ("fanuc-m", "M177\n", ""),
    ("fanuc-m", "M60\n", ""),
    ("meldas-m", "M6\n", ""),
    ("meldas-m", "T1\nG0 Z-5.\nM6\n", "3017"),
    ("meldas-m", "M11\nM3 S500\n", "3009"),
    ("meldas-m", "M11\nS500\n", "3007"),
    ("meldas-m", "M11\nM60\n", "3038"),
    ("meldas-m", "M82\nM60\n", "3031"),
    ("meldas-m", "G0 Z-1.\nM60\n", "3014"),
    ("meldas-m", "M82\nM3\n", "3036"),
    ("meldas-m", "M82\nM83\nM3\n", ""),
    ("meldas-m", "G0 Z-1.\nM82\n", "3034"),
    ("meldas-m", "M84\nM6\n", "3028"),
    ("meldas-m", "M84\nM85\nM6\n", ""),
    ("meldas-m", "M86\nM6\n", "3027"),
    ("meldas-m", "M86\nM86\nM6\n", ""),
    ("meldas-m", "M20\nM21\n", "3032"),
    ("meldas-m", "M21\n", ""),
    ("meldas-m", "M35\n", "3010"),
    ("meldas-m", "M77\n", ""),
    ("meldas-m", "M24\nB90\n", "3024"),
]


@pytest.mark.parametrize(("control_id", "text", "code"), REFUSED)
def test_the_machine_refuses(control_id: str, text: str, code: str) -> None:
    assert codes(run(f"{text}M30\n", control_id)) == ([code] if code else [])


BY_INPUT = [
    ("fanuc-m", "T1 M6\n", "POCKET_FULL", "1042"),
    ("fanuc-m", "T1 M6\n", "TOOLS_DIFFER", "1015"),
    ("fanuc-m", "M87\n", "MAGAZINE_MANUAL", "1062"),
    ("fanuc-m", "M4\n", "SPINDLE_EMPTY", "1091"),
    ("fanuc-m", "M3\n", "DOOR_OPEN", "1098"),
    ("meldas-m", "M6\n", "NOT_REFERENCED_Z", "3013"),
    ("meldas-m", "M6\n", "NOT_REFERENCED_Y", "3023"),
    ("meldas-m", "G28 Z0\nM6\n", "NOT_REFERENCED_Z", ""),
    ("meldas-m", "G91 G30 Z0\nM6\n", "NOT_REFERENCED_Z", ""),
    ("meldas-m", "M8\n", "COOLANT_SWITCH_OFF", "3072"),
    ("meldas-m", "M4\n", "SPINDLE_BRAKE", "3022"),
    ("meldas-m", "M96\n", "MAGAZINE_MANUAL", "3062"),
    ("meldas-m", "M3\n", "DOOR_OPEN", "3006"),
]


@pytest.mark.parametrize(("control_id", "text", "signal", "code"), BY_INPUT)
def test_inputs_of_the_machine_refuse_too(control_id: str, text: str, signal: str, code: str) -> None:
    channel = run(f"{text}M30\n", control_id, setup={"switches": {signal: 1}})
    assert codes(channel) == ([code] if code else [])


@pytest.mark.parametrize(("control_id", "code"), [("fanuc-m", "1097"), ("meldas-m", "3008")])
def test_a_clamped_axis_does_not_move(control_id: str, code: str) -> None:
    assert codes(run("M24\nG0 X5.\nA90.\nM30\n", control_id, machine=support.HARTFORD_MILL4)) == [code]
    assert codes(run("M24\nM25\nG1 A90. F500\nM30\n", control_id, machine=support.HARTFORD_MILL4)) == []


def test_plain_blocks_are_asked_for_too_while_a_brake_is_on() -> None:
    plain = "".join(f"G1 X{i} A{i}. F500\n" for i in range(200))
    assert codes(run(f"{plain}M24\n{plain}M30\n", machine=support.HARTFORD_MILL4)) == ["1097"]
    assert codes(run(f"M24\nM25\n{plain}M30\n", machine=support.HARTFORD_MILL4)) == []


def test_the_fifth_axis_has_its_own_brake() -> None:
    assert codes(run("M26\nG0 A9.\nM30\n", "meldas-m", machine=support.HARTFORD_MILL5)) == []
    assert codes(run("M26\nG0 C9.\nM30\n", "meldas-m", machine=support.HARTFORD_MILL5)) == ["3075"]


def test_maintenance_codes_need_mdi_and_their_switch() -> None:
    mdi = {"mode": "mdi"}
    assert codes(run("M36\nM30\n", "meldas-m", setup={"switches": mdi})) == []
    assert codes(run("M36\nM30\n", "meldas-m", setup={"switches": {**mdi, "PLC_SWITCH_32_OFF": 1}})) == [
        "3030"
    ]


def test_a_machine_that_checks_refuses_an_m_code_that_no_list_has() -> None:
    checked = {"switches": {"M_CODES_CHECKED": 1}}
    assert codes(run("M77\nM30\n", setup=checked)) == ["1093"]
    assert codes(run("M77\nM30\n", setup=checked | {"parameters": {"6071": 77}})) != ["1093"]
