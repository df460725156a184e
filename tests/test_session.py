from __future__ import annotations

import itertools
import math
import pickle
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

import polycnc
from polycnc.machine import FileError
from polycnc.mainrun import VirtualControl
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.files import OutputError
from polycnc.program import ProgramFileError
from polycnc.session import SessionError, open_session

if TYPE_CHECKING:
    from pathlib import Path

PROGRAM = "O7\nT2 M6\nG90 G54 G0 X10. Z5.\nG1 Z-1. F60.\n#100=4\nM30\n"


def test_a_program_can_be_a_text_bytes_or_a_file(tmp_path: Path) -> None:
    path = tmp_path / "part.nc"
    path.write_text(PROGRAM, encoding="utf-8")
    results = [
        polycnc.run(source, control="fanuc-m") for source in (PROGRAM, PROGRAM.encode(), path, str(path))
    ]
    assert all(result.final["work"] == {"X": 10, "Y": 0, "Z": -1} for result in results)


def test_the_result_holds_rows_time_tools_and_variables() -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m")
    assert result.ok
    assert [row["type"] for row in result.rows if "to" in row] == ["rapid", "feed"]
    assert result.time > 6.0  # 6 mm at 60 mm/min
    assert [tool.tool for tool in result.tools if tool.tool] == [2]
    assert result.variables["#100"] == 4
    assert "#100" in list(result.variables)


def test_the_moves_are_an_arrow_table() -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m")
    table = result.moves
    assert table.num_rows == len(result.rows)
    assert table.schema.metadata[b"machine"] == b"mill3"


def test_moves_tell_tool_start_duration_length_and_feed_as_executed() -> None:
    program = (
        "G21 G90 G94\nT1 M6\nG0 X10.\nG1 Y30. F600\nG2 X20. Y40. R10.\nG4 X1.5\nT2 M6\nG1 X100. F1200\nM30\n"
    )
    result = polycnc.run(program, control="fanuc-m")
    kinds = {"rapid", "feed", "cw", "dwell"}
    rows: list[dict[str, Any]] = [row for row in result.moves.to_pylist() if row["type"] in kinds]
    assert [row["tool"] for row in rows] == ["1", "1", "1", "1", "2"]
    lengths = [10.0, 20.0 + 10.0, 5.0 * math.pi, 0.0, 80.0]
    assert [row["length"] for row in rows] == pytest.approx(lengths, abs=1e-3)
    for row, after in itertools.pairwise(rows):
        assert row["start"] + row["duration"] + after["wait"] == pytest.approx(after["start"], abs=1e-9)
    assert rows[0]["wait"] > 1.0  # the tool change
    assert rows[3]["duration"] == pytest.approx(1.5)
    assert rows[-1]["start"] + rows[-1]["duration"] == pytest.approx(result.time)
    line = rows[1]
    assert line["feed_executed"] == pytest.approx(60.0 * line["length"] / line["duration"])
    assert 0.9 * 600.0 < line["feed_executed"] < 600.0


def test_a_motion_of_many_rows_is_one_of_the_moves_with_all_its_time() -> None:
    program = 'TRAORI\nG1 X10 LEAD=10 F1000\nG3 X20 Y10 CR=10 LEAD=10\nMSG("a")\nG1 X0\nM30\n'
    result = polycnc.run(program, control="sinumerik-840d", machine="mill5-ca-head")
    rows: list[dict[str, Any]] = result.moves.to_pylist()
    assert len(rows) == len(result.rows) < len(result.toolpath)
    assert sum(row["wait"] + row["duration"] for row in rows) == pytest.approx(result.time)
    (arc,) = (row for row in rows if row["type"] == "ccw")
    assert arc["length"] == pytest.approx(5.0 * math.pi, abs=1e-3)
    assert arc["start"] == pytest.approx(rows[0]["start"] + rows[0]["duration"])


@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf", "meldas-m", "syntec-mill", "sinumerik-840d"])
def test_a_variable_that_does_not_exist_is_not_in_the_variables(control: str) -> None:
    variables = polycnc.run("G0 X0\nM30\n", control=control).variables
    for name in ("#999999", "foo", "", "#", " #1"):
        assert name not in variables
        with pytest.raises(KeyError):
            variables[name]


def test_one_folder_can_be_searched_without_a_list(tmp_path: Path) -> None:
    (tmp_path / "O0002.nc").write_text("O2\nG0 X7.\nM99\n")
    result = polycnc.run("O1\nM98 P2\nM30\n", control="fanuc-m", search=str(tmp_path))
    assert result.final["work"]["X"] == 7.0


@pytest.mark.parametrize("limit", [0, -3])
def test_a_block_limit_below_one_is_refused(limit: int) -> None:
    with pytest.raises(polycnc.SessionError, match=str(limit)):
        polycnc.run("M30\n", control="fanuc-m", block_limit=limit)


def test_an_alarm_is_a_value_with_its_text() -> None:
    result = polycnc.run("G999\n", control="fanuc-m")
    (alarm,) = result.alarms
    assert not result.ok
    assert (alarm.code, alarm.line) == ("PS0010", 1)
    assert result.alarm_text(alarm, "en") != result.alarm_text(alarm, "zh-TW")


@pytest.mark.parametrize(
    ("control", "program"),
    [
        ("fanuc-m", "G999\nM30\n"),
        ("fanuc-0i-tf", "G999\nM30\n"),
        ("meldas-m", "G999\nM30\n"),
        ("syntec-mill", "M98 P77\nM30\n"),
        ("sinumerik-840d", "R1=FOO\nM30\n"),
    ],
)
def test_an_alarm_carries_place_text_and_remedy_in_both_languages(control: str, program: str) -> None:
    (alarm,) = polycnc.run(program, control=control).alarms
    assert alarm.line == 1
    assert alarm.column > 0
    assert alarm.text == alarm.text_in("en") != alarm.text_in("zh-TW")
    assert alarm.remedy == alarm.note_in("remedy", "en") != alarm.note_in("remedy", "zh-TW") != ""
    assert str(alarm).endswith(f":1:{alarm.column}: {alarm.code} {alarm.text}")


def test_the_alarms_of_a_virtual_control_have_texts_too() -> None:
    control = VirtualControl("fanuc-m")
    control.load("O1\nG999\nM30\n")
    control.cycle_start()
    control.run()
    assert control.alarms[0].text == control.alarm_text(control.alarms[0])
    assert control.alarm_history[0].text


def test_a_result_goes_to_another_process_as_a_record() -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m")
    record = pickle.loads(pickle.dumps(result))
    assert record == result.record
    assert (record.ok, record.program, record.control) == (True, "O0007", "fanuc-m")
    assert (record.final, record.time, record.rows) == (result.final, result.time, result.rows)
    assert record.variables["#100"] == 4
    bad = pickle.loads(pickle.dumps(polycnc.run("O1\nG999\n", control="fanuc-m")))
    assert (bad.ok, bad.alarms[0].code) == (False, "PS0010")
    assert bad.alarms[0].remedy


def test_a_notebook_shows_alarms_time_and_tools() -> None:
    assert "<td>T2</td>" in polycnc.run(PROGRAM, control="fanuc-m")._repr_html_()
    shown = polycnc.run("O1\n(<B>) G999\nM30\n", control="fanuc-m")
    assert "PS0010" in shown._repr_html_()
    assert repr(shown) == "<Result of O0001 on fanuc-m, mill3: PS0010>"


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_tables_of_other_libraries_are_made_where_they_are_installed(
    library: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m")
    monkeypatch.setattr("polycnc.session.result.is_installed", lambda name: name != library)
    with pytest.raises(SessionError, match=f"pip install {library}"):
        getattr(result, f"to_{library}")()


def test_polars_takes_the_arrow_table(monkeypatch: pytest.MonkeyPatch) -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m")
    monkeypatch.setattr("polycnc.session.result.is_installed", lambda _name: True)
    monkeypatch.setitem(sys.modules, "polars", SimpleNamespace(from_arrow=lambda table: table.num_rows))
    assert result.to_polars() == len(result.rows)


def test_a_setup_can_be_given_as_values_and_moves_the_machine() -> None:
    result = polycnc.run(PROGRAM, control="fanuc-m", setup={"work_offsets": {"G54": {"X": -100}}})
    assert result.final["machine"]["X"] == -90


def test_nothing_leaks_from_one_run_into_the_next() -> None:
    first = polycnc.run(PROGRAM, control="fanuc-m")
    polycnc.run("G91 G0 X5.\n#100=9\nM0\n", control="fanuc-m")
    again = polycnc.run(PROGRAM, control="fanuc-m")
    assert first.rows == again.rows
    assert first.time == again.time


def test_a_long_run_gives_the_same_whether_its_path_is_kept_or_not() -> None:
    program = "O1\nWHILE [#1 LT 70000] DO1\n#1=#1+1\nG1 X[#1/1000] F500.\nEND1\nM30\n".replace("#1 ", "#101 ")
    program = (
        program.replace("#1=#1+1", "#101=#101+1")
        .replace("[#1/1000]", "[#101/1000.]")
        .replace("WHILE [", "#101=0\nWHILE [")
    )
    kept = open_session(program, control="fanuc-m").run()
    rows: list[int] = []
    session = open_session(program, control="fanuc-m", keep=False)
    session.consumers.append(lambda chunk: rows.append(len(chunk)))
    dropped = session.run()
    assert len(rows) > 1
    assert sum(rows) == len(kept.toolpath)
    assert dropped.time == pytest.approx(kept.time)
    assert len(dropped.toolpath.chunks) == 1


def test_prints_go_to_a_file(tmp_path: Path) -> None:
    out = tmp_path / "out.txt"
    polycnc.run("#101=2.5\nPOPEN\nDPRNT[X#101[23]]\nPCLOS\nM30\n", control="fanuc-m", print_to=out)
    assert out.read_text(encoding="utf-8").startswith("X")


def test_prints_replace_no_file_that_the_run_reads(tmp_path: Path) -> None:
    program, called, setup = (tmp_path / name for name in ("O1.nc", "O2.nc", "setup.yaml"))
    program.write_text("O1\nM98 P2\nM30\n", encoding="utf-8")
    called.write_text("O2\nPOPEN\nDPRNT[X]\nPCLOS\nM99\n", encoding="utf-8")
    setup.write_text("parameters: {}\n", encoding="utf-8")
    for each in (program, called, setup):
        before = each.read_bytes()
        with pytest.raises(OutputError) as caught:
            polycnc.run(program, control="fanuc-m", setup=setup, search=tmp_path, print_to=each)
        assert caught.value.message == "output.is-input"
        assert each.read_bytes() == before


@pytest.mark.parametrize(
    ("options", "error"),
    [
        ({"control": "nothing"}, SessionError),
        ({}, SessionError),
        ({"control": "fanuc-m", "machine": "nothing"}, FileError),
        ({"control": "fanuc-m", "setup": {"nothing": 1}}, FileError),
        ({"control": "fanuc-m", "search": ["nothing"]}, ProgramFileError),
        ({"control": "fanuc-m", "setup": {"channels": {1: ["Q"]}}}, SessionError),
    ],
)
def test_what_cannot_begin_raises_a_readable_error(
    options: dict[str, object], error: type[Exception]
) -> None:
    with pytest.raises(error) as caught:
        polycnc.run(PROGRAM, **options)  # type: ignore[arg-type]
    assert len(str(caught.value)) > 10


def test_evidence_for_two_controls_is_told() -> None:
    with pytest.raises(SessionError) as caught:
        polycnc.run("#1:=5\nDEF REAL A\n")
    assert caught.value.message == "session.control-doubtful"


def test_the_package_hands_out_what_it_names() -> None:
    for name in polycnc.__all__:
        assert getattr(polycnc, name) is not None
    with pytest.raises(AttributeError):
        polycnc.nothing  # noqa: B018


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d"])
def test_the_tool_in_the_spindle_at_the_start_counts_for_what_comes_before_the_first_change(
    control: str,
) -> None:
    tools = {1: {"length": 10}, 2: {"length": 10}}
    text = "G90 G94 G1 X50. F600.\nT2 M6\nX40.\nT1 M6\nX0.\nM30\n"
    result = polycnc.run(text, control=control, setup={"tools": tools, "spindle_tool": 2})
    assert not result.alarms
    change = result.machine.magazine.change_time_s
    assert [(tool.tool, tool.times.tool_change_s) for tool in result.tools] == [(2, 0.0), (1, change)]


def test_a_lathe_knows_the_turret_position_of_the_start() -> None:
    text = "G99 G0 X100. Z100.\nT0303\nG0 X50.\nT0101\nG0 X40.\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", setup={"spindle_tool": 3})
    change = result.machine.magazine.change_time_s
    assert [(tool.tool, tool.times.tool_change_s) for tool in result.tools] == [(3, 0.0), (1, change)]


def test_sinumerik_calls_the_tool_of_the_start_by_its_name_and_gives_it_no_offsets() -> None:
    setup = {"tools": {"FACE": {"z": 10, "length": 10}}, "spindle_tool": "face", "machine": "mill3"}
    text = 'R1=$P_TOOLNO R2=$P_TOOL\nG1 Z5 F600\nT="FACE" M6\nG1 Z0\nM30\n'
    result = polycnc.run(text, control="sinumerik-840d", setup=setup)
    assert not result.alarms
    assert (result.variables["R1"], result.variables["R2"]) == (1, 0)
    assert [(tool.name, tool.times.tool_change_s) for tool in result.tools] == [("FACE", 0.0)]


def test_a_tool_of_the_start_that_is_not_there_is_the_controls_alarm() -> None:
    result = polycnc.run("M30\n", control="sinumerik-840d", setup={"spindle_tool": 9})
    assert [alarm.code for alarm in result.alarms] == ["17190"]


@pytest.mark.parametrize("setup", [{"spindle_tool": "FACE"}, {"tools": {"FACE": {"length": 10}}}])
def test_a_control_that_counts_its_tools_takes_no_name(setup: dict[str, object]) -> None:
    with pytest.raises(SessionError, match="FACE"):
        polycnc.run("M30\n", control="fanuc-m", setup=setup)
    with pytest.raises(CommandRefused, match="FACE"):
        VirtualControl("fanuc-m", setup=setup)


def test_every_channel_has_a_result_of_its_own() -> None:
    side = "GET(Y)\nG1 Y50 F3000\nR1=7\nG1 Y60 F=0\nM30\n"
    main = 'INIT(2,"B")\nSTART(2)\nRELEASE(Y)\nG0 X10\nR1=3\nWAITE(2)\nM30\n'
    session = open_session(main, control="sinumerik-840d", machine="mill3-2ch", files={"B.MPF": side})
    result = session.run()
    first, second = result.channels[1], result.channels[2]
    assert [first.number, second.number] == [1, 2]
    assert first.rows == result.rows
    assert list(result.rows_of_other_channels) == [{"channel": 2, **row} for row in second.rows]
    assert second.final["work"]["Y"] == 50.0
    assert [first.variables["R1"], second.variables["R1"]] == [3, 7]
    assert second.alarms
    assert first.alarms == []
    assert result.alarms == second.alarms


@pytest.mark.parametrize("line", ["R9=1/0", 'SETAL(65000,"WORN")'])
def test_channels_that_run_the_same_subprogram_do_not_share_its_alarms(line: str) -> None:
    main = 'INIT(2,"B")\nSUB\nSTART(2)\nWAITE(2)\nM30\n'
    files = {"B.MPF": "R1=2\nSUB\nM30\n", "SUB.SPF": f"IF R1<>2 GOTOF DONE\n{line}\nDONE: M17\n"}
    result = open_session(main, control="sinumerik-840d", machine="mill3-2ch", files=files).run()
    assert [(alarm.program, alarm.channel) for alarm in result.alarms] == [("_N_SUB_SPF", 2)]
    assert result.channels[2].alarms == result.alarms
    assert result.channels[1].alarms == []
