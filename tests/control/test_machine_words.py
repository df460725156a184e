"""What a machine file refuses, on every control, before the main run and on its clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

import polycnc
from polycnc.control.registry import ids
from polycnc.mainrun import State
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from pathlib import Path

ROWS = {
    "S": ("S_CODE", "S500"),
    "T": ("T_CODE", "T1"),
    "X": ("MOVE_X", "G0 X5."),
    "M": ("M77", "M77"),
}
#: Controls to which a machine file can add G codes.
EXTENSIBLE = [control for control in ids() if control != "sinumerik-840d"]
SETUP = {"tools": {1: {"radius": 5}}}
SUBPROGRAM = "O9100\n#1=1\nM99\n"


def machine_of(tmp_path: Path, control: str, tables: str) -> Path:
    base = "lathe-c" if control == "fanuc-0i-tf" else "mill4"
    path = tmp_path / "shop.toml"
    path.write_text(f'base = "{base}"\n{tables}', encoding="utf-8")
    return path


def refusing(word: str) -> str:
    return f'[[alarm]]\ncode = "1500"\nwhen = "{word} & LOOSE"\ntext = "Loose"\n'


def codes(control: str, program: str, machine: Path, **switches: Any) -> list[str]:
    setup = {**SETUP, "switches": switches}
    result = polycnc.run(program, control=control, machine=machine, setup=setup)
    return [alarm.code for alarm in result.alarms]


@pytest.mark.parametrize("control", ids())
@pytest.mark.parametrize("row", ROWS)
def test_a_word_is_refused_on_every_control(tmp_path: Path, control: str, row: str) -> None:
    word, block = ROWS[row]
    machine = machine_of(tmp_path, control, refusing(word))
    assert codes(control, f"{block}\nM30\n", machine) == []
    assert codes(control, f"{block}\nM30\n", machine, LOOSE=1) == ["1500"]


@pytest.mark.parametrize("control", EXTENSIBLE)
@pytest.mark.parametrize("block", ["G28 X0", "G53 G0 X-5.", "G31 X5. F100"])
def test_codes_that_move_once_are_refused(tmp_path: Path, control: str, block: str) -> None:
    machine = machine_of(tmp_path, control, refusing("MOVE_X"))
    assert codes(control, f"{block}\nM30\n", machine) == []
    assert codes(control, f"{block}\nM30\n", machine, LOOSE=1) == ["1500"]
    assert codes(control, f"{block.replace('X', 'Z')}\nM30\n", machine, LOOSE=1) == []


@pytest.mark.parametrize("control", ids())
@pytest.mark.parametrize("row", ROWS)
def test_the_main_run_refuses_the_same(tmp_path: Path, control: str, row: str) -> None:
    word, block = ROWS[row]
    machine = str(machine_of(tmp_path, control, refusing(word)))
    virtual = power_on(f"{block}\nM30\n", control, machine=machine, setup=SETUP)
    virtual.signals["LOOSE"] = 1.0
    virtual.cycle_start()
    assert virtual.run() is State.ALARM
    assert [alarm.code for alarm in virtual.alarms] == ["1500"]


@pytest.mark.parametrize("control", ids())
def test_a_brake_holds_its_axis_in_a_long_program(tmp_path: Path, control: str) -> None:
    axis = "C" if control == "fanuc-0i-tf" else "A"
    tables = refusing(f"MOVE_{axis}") + '[[rule]]\nwhen = "M77"\noutput = "LOOSE"\nlatch = "on"\n'
    moves = "".join(f"G1 X{n % 7}.5 F100\n" for n in range(300))
    program = f"G98\nM77\n{moves}G1 {axis}5. F100\nM30\n"
    program = program if control == "fanuc-0i-tf" else program.removeprefix("G98\n")
    result = polycnc.run(program, control=control, machine=machine_of(tmp_path, control, tables), setup=SETUP)
    last = len(program.splitlines()) - 1
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("1500", last)]


@pytest.mark.parametrize("control", ids())
def test_a_move_may_depend_on_where_another_axis_stands(tmp_path: Path, control: str) -> None:
    tables = '[[alarm]]\ncode = "1500"\nwhen = "MOVE_X & !Z_AT_REFERENCE"\ntext = "Z stands low"\n'
    machine = machine_of(tmp_path, control, tables)
    free = "".join(f"G0 X{n % 7}.5\n" for n in range(300))
    assert codes(control, f"{free}G0 Z-5.\nG0 Z0\n{free}M30\n", machine) == []
    assert codes(control, f"{free}G0 Z-5.\n{free}M30\n", machine) == ["1500"]


@pytest.mark.parametrize("control", EXTENSIBLE)
@pytest.mark.parametrize("calls", ["", 'calls = "O9100"\n'])
@pytest.mark.parametrize("code", ["G877", "M77"])
def test_a_code_of_the_builder_is_refused(tmp_path: Path, control: str, calls: str, code: str) -> None:
    table = f'[g_function."{code[1:]}"]' if code[0] == "G" else f"[m_function.{code[1:]}]"
    machine = machine_of(tmp_path, control, f"{table}\n{calls}{refusing(code)}")
    program = f"O1\n{code}\nM30\n{SUBPROGRAM}"
    assert codes(control, program, machine) == []
    assert codes(control, program, machine, LOOSE=1) == ["1500"]
    virtual = power_on(program, control, machine=str(machine), setup=SETUP)
    virtual.signals["LOOSE"] = 1.0
    virtual.cycle_start()
    assert virtual.run() is State.ALARM


@pytest.mark.parametrize("control", EXTENSIBLE)
def test_a_g_code_of_the_builder_takes_its_time(tmp_path: Path, control: str) -> None:
    machine = machine_of(tmp_path, control, '[g_function."877"]\nseconds = 3.5\n')
    program = "O1\nG877\nG877 Q1\nM30\n"
    result = polycnc.run(program, control=control, machine=machine)
    assert result.time == pytest.approx(7.0)
    virtual = power_on(program, control, machine=str(machine))
    virtual.cycle_start()
    virtual.run()
    assert virtual.time == pytest.approx(7.0, abs=0.1)
