"""The FANUC machining centre as a declaration: tables, alarms, registered codes."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import pytest

import polycnc.control.word_address as base
from polycnc.control.fanuc.code_calls import registered_codes
from polycnc.control.registry import control
from polycnc.messages import text
from tests.support import codes, run

FANUC: Any = control("fanuc-m")


def mistakes_named_in(folder: Path) -> set[str]:
    """Names of mistakes that the modules of a folder raise by `fail("…")`."""
    found: set[str] = set()
    for path in folder.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr == "fail"
            ):
                first = node.args[0] if node.args else None
                if isinstance(first, ast.Constant):
                    found.add(str(first.value))
    return found


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_every_mistake_of_the_base_has_an_alarm_of_the_control(control_id: str) -> None:
    chosen: Any = control(control_id)
    folder = Path(base.__file__).parent
    assert mistakes_named_in(folder) - set(chosen.alarms) == set()


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_every_alarm_has_a_text_and_a_remedy_in_both_languages(control_id: str) -> None:
    chosen: Any = control(control_id)
    for code in chosen.alarms.values():
        entry = chosen.catalogue.entry(code)
        assert all(entry.get(field) for field in ("en", "zh-TW", "remedy", "remedy-zh-TW")), code


def test_every_hint_at_another_maker_exists() -> None:
    assert all(text(hint) for hint in FANUC.foreign_codes.values())


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_every_group_has_a_code_at_power_on_and_each_such_code_is_known(control_id: str) -> None:
    chosen: Any = control(control_id)
    groups = {row.group for row in chosen.g_codes.values() if row.group}
    assert groups <= set(chosen.power_on)
    assert {chosen.power_on[group] for group in groups} <= set(chosen.g_codes)


def test_a_negative_number_registers_a_modal_call() -> None:
    channel = run("M30\n", setup={"parameters": {"6050": -150, "6051": 65, "6080": 30, "6079": 40}})
    calls = registered_codes(channel.memory.parameters)
    assert {code: (call.program, call.kind) for code, call in calls.g.items()} == {"G150": (9010, "modal")}
    assert {code: (call.program, call.kind) for code, call in calls.m.items()} == {40: (9009, "sub")}


@pytest.mark.parametrize("code", ["G103", "G154 P1", "G187", "G12 I5.", "G150"])
def test_codes_of_other_makers_come_with_a_hint(code: str) -> None:
    (alarm,) = run(f"{code}\nM30\n").alarms
    assert alarm.code == "PS0010"
    assert alarm.hint


def test_nothing_leaks_from_one_run_into_the_next() -> None:
    first = "G91 G20 G41 D1 G43 H1\n#101=5\nM96 P1\nM30\n"
    run(first)
    channel = run("#102=#101\n#103=#4003\n#104=#4006\n#105=#4007\nM30\n")
    assert [channel.memory.read(n) for n in (102, 103, 104, 105)] == [None, 90, 21, 40]


def test_start_up_types_are_parameters() -> None:
    def policy(**parameters: int) -> Any:
        channel = run("M30\n", setup={"parameters": parameters})
        return FANUC.compensation_policy(channel)

    assert policy().approach.name == "SQUARE"
    assert policy(**{"5003#0": 1}).approach.name == "CORNER"
    assert policy(**{"5003#1": 1}).shifts_without_motion
    assert [policy(**{"19625": n}).read_blocks for n in (2, 3, 6, 12)] == [3, 3, 6, 8]


@pytest.mark.parametrize("bits", [{}, {"3404#7": 1}])
def test_several_m_codes_in_a_block(bits: dict[str, int]) -> None:
    channel = run("M3 S5 M8\nM30\n", setup={"parameters": bits})
    sent = [r.event.data["code"] for r in channel.toolpath.rows() if r.event and r.event.type == "m"]
    assert sent == ([3, 8, 30] if bits else [8, 30])


def test_an_unknown_m_code_is_an_event_of_the_machine() -> None:
    channel = run("M777\nM30\n")
    assert codes(channel) == []
