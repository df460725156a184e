"""What a machine file says of its builder: the machine of the page, and rules of one's own."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import pytest

import polycnc
from polycnc.machine import MachineFileError, load_machine
from tests.pages import page

if TYPE_CHECKING:
    from pathlib import Path

MILLS = ("fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d")
MACROS = "O9100\n#101=#20\n#102=#13\nM99\nO9200\n#103=#24\n#104=#19\nM99\n"


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    """The machine that the page shows."""
    (shown,) = re.findall(
        r"```toml\n(base = \"mill3\"\nname = \"Shop 4\".*?)```", page("machines.md"), re.DOTALL
    )
    path = tmp_path / "shop.toml"
    path.write_text(shown, encoding="utf-8")
    return path


def events(result: polycnc.Result) -> list[dict[str, object]]:
    """M and G events with their words."""
    rows: list[dict[str, Any]] = [dict(row) for row in result.rows if row["type"] in ("m", "g")]
    return [{row["type"]: row["code"], **(row.get("words") or {})} for row in rows]


@pytest.mark.parametrize("control", MILLS)
def test_two_tools_are_changed_anywhere_on_mill3(control: str) -> None:
    program = "T1\nM6\nG0 X10. Z-5.\nM3 S500\nT2\nM6\nG1 X20. F100\nM30\n"
    setup = {"tools": {1: {"radius": 5}, 2: {"radius": 4}}}
    assert polycnc.run(program, control=control, machine="mill3", setup=setup).alarms == []


@pytest.mark.parametrize(("control", "code"), [("fanuc-m", "1046"), ("meldas-m", "3017")])
def test_the_same_on_hartford_is_its_alarm(control: str, code: str) -> None:
    program = "T1\nM6\nG0 X10. Z-5.\nT2\nM6\nM30\n"
    result = polycnc.run(program, control=control, machine="hartford")
    assert [alarm.code for alarm in result.alarms] == [code]
    assert result.alarm_text(result.alarms[0])


@pytest.mark.parametrize("control", MILLS)
def test_m06_leads_z_to_its_point_by_itself(control: str, shop: Path) -> None:
    result = polycnc.run(
        "G0 X7. Z-50.\nT1\nM6\nM30\n", control=control, machine=shop, setup={"tools": {1: {"radius": 5}}}
    )
    assert result.alarms == []
    assert result.final["machine"] == {"X": 7, "Y": 0, "Z": -20}


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_codes_of_the_page_act(control: str, shop: Path) -> None:
    program = "O1\nG0 X1. M165 P9832\nG120.1 P1 Q2\nG100 T1 M6\nM200 X10. S3\nM444 P500\nM30\n"
    result = polycnc.run(program + MACROS, control=control, machine=shop)
    assert result.alarms == []
    assert [result.variables[f"#{number}"] for number in (101, 102, 103, 104)] == [1, 6, 10, 3]
    told = events(result)
    assert {"m": 165, "P": 9832} in told
    assert {"g": "G120.1", "P": 1, "Q": 2} in told
    assert {"m": 444, "P": 500} in told
    kinds = [row["type"] for row in result.rows]
    assert kinds.index("rapid") < kinds.index("m")  # behind the motion of its block


@pytest.mark.parametrize("control", MILLS)
def test_an_alarm_of_ones_own_has_its_text(control: str, shop: Path) -> None:
    result = polycnc.run("G0 X1.\nM88\nG0 X2.\nM30\n", control=control, machine=shop)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("1500", 2)]
    assert result.alarm_text(result.alarms[0]) == "This M code has no function here"


def test_syntec_calls_the_programs_of_the_machine_file(shop: Path, tmp_path: Path) -> None:
    (tmp_path / "O9100").write_text("%@MACRO\n@101 := #20;\nM99;\n", encoding="utf-8")
    (tmp_path / "O9200").write_text("%@MACRO\n@103 := #24;\nM99;\n", encoding="utf-8")
    main = tmp_path / "O0001"
    main.write_text("G100 T7\nM200 X10.\nM30\n", encoding="utf-8")
    result = polycnc.run(main, control="syntec-mill", machine=shop)
    assert result.alarms == []
    assert (result.variables["@101"], result.variables["@103"]) == (7, 10)


def test_what_a_control_cannot_do_says_so(shop: Path) -> None:
    shop.write_text(shop.read_text().replace("spindle_clockwise", "mirror_off"), encoding="utf-8")
    for control in ("syntec-mill", "sinumerik-840d"):
        result = polycnc.run("M13\nM30\n", control=control, machine=shop)
        assert [alarm.code for alarm in result.alarms] == ["PC0001"]


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "fanuc-0i-tf"])
def test_m_codes_of_no_table_are_events_with_their_words(control: str) -> None:
    result = polycnc.run("M165 P9832\nM203 P11 Q2\nM30\n", control=control)
    assert result.alarms == []
    assert events(result)[:2] == [{"m": 165, "P": 9832}, {"m": 203, "P": 11, "Q": 2}]


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "fanuc-0i-tf"])
def test_a_g_code_of_no_table_says_how_it_is_declared(control: str) -> None:
    result = polycnc.run("G120.1 P1 Q1\nM30\n", control=control)
    (alarm,) = result.alarms
    assert '[g_function."120.1"]' in result.alarm_text(alarm)


def test_a_declared_code_is_not_refused_outright_by_the_builder(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('base = "hartford"\nname = "Mine"\n[m_function.88]\nname = "Door"\n', encoding="utf-8")
    result = polycnc.run("M88\nM89\nM30\n", control="fanuc-m", machine=path)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("1093", 2)]


def test_rules_may_stand_in_a_file_beside(tmp_path: Path) -> None:
    (tmp_path / "ours.toml").write_text(
        '[[rule]]\nwhen = "M40"\noutput = "OPEN"\nlatch = "on"\n'
        '[[alarm]]\ncode = "77"\nwhen = "M3 & OPEN"\ntext = { en = "The door is open", zh-TW = "門未關" }\n',
        encoding="utf-8",
    )
    path = tmp_path / "mine.toml"
    path.write_text('base = "mill3"\nname = "Mine"\nrules = "ours.toml"\n', encoding="utf-8")
    result = polycnc.run("M3 S5\nM40\nM3\nM30\n", control="fanuc-m", machine=path)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("77", 3)]
    assert result.alarm_text(result.alarms[0], "zh-TW") == "門未關"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ('rules = "nobody"\n', 3, "no-such-builder"),
        ("[magazine]\nretracts = true\n", 4, "retracts-nowhere"),
        ('[[alarm]]\ncode = "1"\nwhen = "M3 &"\n', 5, "no-condition"),
        ('[m_function.5]\ndoes = "fly"\n', 4, "not-one-of"),
    ],
)
def test_mistakes_have_their_line(tmp_path: Path, text: str, line: int, message: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f'base = "mill3"\nname = "Mine"\n{text}', encoding="utf-8")
    with pytest.raises(MachineFileError) as raised:
        load_machine(path)
    assert (raised.value.line, raised.value.message) == (line, message)


def mistake_of(tmp_path: Path, tables: str) -> str:
    path = tmp_path / "own.toml"
    path.write_text(f'base = "mill3"\n{tables}', encoding="utf-8")
    with pytest.raises(MachineFileError) as caught:
        load_machine(path)
    return str(caught.value)


@pytest.mark.parametrize("key", ["seconds = 3", 'timing = "after"', 'takes = ["P"]', 'does = "tool_change"'])
def test_a_code_that_calls_does_nothing_else(tmp_path: Path, key: str) -> None:
    told = mistake_of(tmp_path, f'[m_function.100]\ncalls = "O9100"\n{key}\n')
    assert ":4:" in told
    assert key.split(" ", maxsplit=1)[0] in told


@pytest.mark.parametrize("code", ["0", "02", "30", "98", "99"])
def test_stops_ends_and_calls_stay_the_controls(tmp_path: Path, code: str) -> None:
    assert f"M{int(code)}" in mistake_of(tmp_path, f'[m_function.{code}]\ncalls = "O9100"\n')


@pytest.mark.parametrize("word", ["MOVE_A", "HOME_Q", "MOVE_"])
def test_a_move_of_no_axis_is_a_mistake(tmp_path: Path, word: str) -> None:
    assert ":4:" in mistake_of(tmp_path, f'[[alarm]]\ncode = "1500"\nwhen = "{word} & LOOSE"\n')


@pytest.mark.parametrize("control", MILLS)
def test_zeros_in_front_of_a_code_mean_nothing(tmp_path: Path, control: str) -> None:
    path = tmp_path / "own.toml"
    path.write_text('base = "mill3"\n[[alarm]]\ncode = "1500"\nwhen = "M08"\n', encoding="utf-8")
    result = polycnc.run("M8\nM30\n", control=control, machine=path)
    assert [alarm.code for alarm in result.alarms] == ["1500"]
