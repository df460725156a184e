from __future__ import annotations

import csv
import io
import json
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest

from polycnc.cli.report import clock
from tests.cli.console import BAD, GOOD

if TYPE_CHECKING:
    from tests.cli.console import Console

FANUC = ("--control", "fanuc-m")


def test_a_run_tells_time_travel_and_tools(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("run", "good.nc", "--control", "fanuc-m")
    assert said.status == 0
    assert said.err == ""
    assert "O0001 on fanuc-m, machine mill3" in said.out
    assert "no alarm" in said.out
    assert "cycle time" in said.out
    # 55 + 90 + a quarter of a circle of radius 20
    assert "cutting 176.4 mm" in said.out
    assert "  T1  " in said.out


@pytest.mark.skipif(sys.platform == "win32", reason="no such names there")
def test_a_file_is_one_however_it_is_called(console: Console) -> None:
    (console.folder / "folder").mkdir()
    for name in ("two\nlines.nc", "-part.nc", "folder/a b.nc", "\udcff.nc"):
        console.file(name, GOOD)
        assert console("run", f"./{name}", *FANUC).status == 0


@pytest.mark.parametrize("name", ["folder/none.nc", "./folder//none.nc", "folder/./none.nc/"])
def test_a_path_is_told_without_what_it_need_not_have(console: Console, name: str) -> None:
    (console.folder / "folder").mkdir()
    assert console("run", name, *FANUC).err == "polycnc: folder/none.nc: there is no such file\n"


def test_a_run_speaks_chinese(console: Console) -> None:
    console.file("good.nc", GOOD)
    assert "加工時間" in console("run", "good.nc", "--control", "fanuc-m", "--lang", "zh-TW").out


def test_the_control_is_guessed_where_the_text_is_certain(console: Console) -> None:
    console.file("part.mpf", "DEF REAL A=1\nIF A>0 GOTOF ENDE\nENDE: M30\n")
    said = console("check", "part.mpf")
    assert "--control" not in said.err


def test_the_report_names_units_where_the_program_is_in_inches(console: Console) -> None:
    console.file(
        "inch.nc", "O1\nG20 G90 G94 G17 G54\nT1 M6\nS1200 M3\nG0 X1. Y0 Z.1\nG1 Z-.2 F10.\nX2.\nM30\n"
    )
    said = console("run", "inch.nc", *FANUC).out
    assert "cuts, work (inch): X 1.000 … 2.000  Y 0.000  Z -0.200 … 0.100" in said
    assert "cuts, machine (mm): X 25.400 … 50.800  Y 0.000  Z -5.080 … 2.540" in said
    assert "machine positions of all moves (mm): X 25.400 … 50.800" in said


def test_the_report_tells_extents_speeds_feeds_and_offsets(console: Console) -> None:
    console.file(
        "two.nc",
        "O1\nG21 G90 G94 G17 G54\nT1 M6\nS1200 M3\nG0 X10. Y0 Z5.\nG1 Z-2. F100\nX60. F400\nG3 X60. Y40. R20.\n"
        "G0 Z50.\nT2 M6\nG55 G0 X5. Y5.\nG1 Z-7. F80\nG0 Z20.\nM30\n",
    )
    console.file("two.setup.yaml", "work_offsets: {G54: {X: -300, Z: -400}}\n")
    said = console("run", "two.nc", *FANUC, "--setup", "two.setup.yaml", "--state", "s.json").out
    assert "S1200  F100–400 mm/min" in said
    assert "cuts, work: X 10.000 … 80.000  Y 0.000 … 40.000  Z -2.000 … 5.000" in said
    assert "cuts, machine: X -290.000 … -220.000  Y 0.000 … 40.000  Z -402.000 … -395.000" in said
    assert "machine positions of all moves: X -290.000 … 5.000" in said
    assert "work offsets used: G54, G55" in said
    state = json.loads((console.folder / "s.json").read_text(encoding="utf-8"))
    assert state["work_offsets"] == ["G54", "G55"]
    assert state["extents"]["tools"][1]["work"]["Z"] == [-350.0, -7.0]
    assert "work offsets" not in console("run", "two.nc", *FANUC, "--no-time").out


@pytest.mark.parametrize(
    ("option", "name"), [(["--explain-time"], "--explain-time"), (["--sample", "1ms", "s.csv"], "--sample")]
)
def test_what_needs_the_cycle_time_is_refused_without_it(
    console: Console, option: list[str], name: str
) -> None:
    said = console("run", "good.nc", "--control", "fanuc-m", "--no-time", *option)
    assert (said.status, said.out) == (2, "")
    assert (
        said.err
        == f"polycnc: --no-time leaves out the cycle time, which {name} needs: give one or the other\n"
    )


def test_an_alarm_in_the_report_says_what_to_do(console: Console) -> None:
    console.file("bad.nc", BAD)
    assert "\n  remedy: " in console("run", "bad.nc", *FANUC).out


def test_an_ambiguous_program_asks_for_the_control(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("run", "good.nc")
    assert "--control" in said.err
    assert "fanuc-m" in said.err


def test_the_trace_is_json_lines_with_what_the_report_counts(console: Console) -> None:
    console.file("good.nc", GOOD)
    console("run", "good.nc", "--control", "fanuc-m", "--trace", "out.jsonl")
    records = [
        json.loads(line) for line in (console.folder / "out.jsonl").read_text(encoding="utf-8").splitlines()
    ]
    moves = [record for record in records if "to" in record]
    assert [move["type"] for move in moves] == ["rapid", "feed", "feed", "cw", "rapid"]
    assert moves[3]["center"] == {"X": 120, "Y": 20}
    assert moves[3]["line"] == 7


def test_rows_of_further_channels_stand_behind_those_of_the_first(console: Console) -> None:
    console.file("main.mpf", 'INIT(2,"SECOND")\nSTART(2)\nG0 X10\nWAITE(2)\nM30\n')
    console.file("second.mpf", "G0 Z5\nM30\n")
    console.file("setup.yaml", "channels: {1: [X, Y], 2: [Z]}\n")
    machine = ("--control", "sinumerik-840d", "--machine", "mill3-2ch", "--setup", "setup.yaml")
    console("run", "main.mpf", *machine, "--trace", "out.jsonl")
    lines = (console.folder / "out.jsonl").read_text(encoding="utf-8").splitlines()
    records = [json.loads(line) for line in lines]
    assert [(record.get("channel"), record["to"]) for record in records] == [
        (None, {"X": 10, "Y": 0}),
        (2, {"Z": 5}),
    ]


def test_the_trace_is_csv_by_its_suffix(console: Console) -> None:
    console.file("good.nc", GOOD)
    console("run", "good.nc", "--control", "fanuc-m", "--trace", "out.CSV")
    rows = list(csv.DictReader(io.StringIO((console.folder / "out.CSV").read_text(encoding="utf-8"))))
    assert rows[-1]["type"] == "m"


def test_the_trace_is_parquet_by_its_suffix(console: Console) -> None:
    from pyarrow import parquet

    console.file("good.nc", GOOD)
    console("run", "good.nc", "--control", "fanuc-m", "--trace", "out.parquet")
    table = parquet.read_table(console.folder / "out.parquet")
    assert table.schema.metadata[b"control"] == b"fanuc-m"
    assert "cw" in table.column("type").to_pylist()


def test_parquet_needs_no_library(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("numpy", "pyarrow", "pyarrow.parquet"):
        monkeypatch.setitem(sys.modules, name, None)
    console.file("good.nc", GOOD)
    assert console("run", "good.nc", "--control", "fanuc-m", "--trace", "out.parquet").status == 0
    content = (console.folder / "out.parquet").read_bytes()
    assert (content[:4], content[-4:]) == (b"PAR1", b"PAR1")


def test_a_trace_without_its_library_says_what_to_install_and_leaves_no_file(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "numpy", None)
    console.file("polar.nc", "%\nO1\nG94 G90 G01 X20. C0 F100\nG12.1\nG01 C20.\nG13.1\nM30\n%\n")
    said = console(
        "run", "polar.nc", "--control", "fanuc-m", "--machine", "mill4-xyzc", "--trace", "out.parquet"
    )
    assert said.status == 2
    assert "polycnc[tables]" in said.err
    assert not (console.folder / "out.parquet").exists()


def test_the_trace_of_an_alarm_ends_with_it_in_words(console: Console) -> None:
    console.file("bad.nc", BAD)
    console("run", "bad.nc", "--control", "fanuc-m", "--trace", "out.jsonl")
    last = json.loads((console.folder / "out.jsonl").read_text(encoding="utf-8").splitlines()[-1])
    assert (last["type"], last["code"], last["line"]) == ("alarm", "PS0010", 3)
    assert last["text"]


def test_the_state_is_json_also_where_a_number_has_grown_beyond_all_bounds(console: Console) -> None:
    console.file("grown.mpf", "R2=1EX300\nR1=R2*R2\nR3=2\nM30\n")
    console("run", "grown.mpf", "--control", "sinumerik-840d", "--state", "s.json")
    text = (console.folder / "s.json").read_text(encoding="utf-8")
    state = json.loads(text, parse_constant=pytest.fail)
    assert state["variables"]["R2"] == 1e300
    assert state["variables"].get("R1") is None


@pytest.mark.parametrize(
    ("control", "code"), [("fanuc-m", "PS0003"), ("fanuc-0i-tf", "PS0003"), ("meldas-m", "P35")]
)
def test_a_number_in_an_expression_may_not_have_more_digits_than_any_number(
    console: Console, control: str, code: str
) -> None:
    console.file("long.nc", f"O1\n#1={'9' * 310}\nM30\n")
    said = console("run", "long.nc", "--control", control)
    assert said.status == 1
    assert f"long.nc:2:4: {code}" in said.out


def test_the_state_holds_positions_modes_variables_and_times(console: Console) -> None:
    console.file("good.nc", GOOD.replace("M30", "#100=7\nM30"))
    console("run", "good.nc", "--control", "fanuc-m", "--state", "state.json")
    state = json.loads((console.folder / "state.json").read_text(encoding="utf-8"))
    assert state["final"]["work"] == {"X": 120, "Y": 40, "Z": 50}
    assert state["variables"]["#100"] == 7
    assert state["alarms"] == []
    assert state["time_s"] > 0
    assert state["tools"][-1]["tool"] == 1
    assert "G90" in state["modes"].values()


def test_what_the_program_prints_goes_to_its_own_file(console: Console) -> None:
    console.file("print.nc", "O1\n#101=1.5\nPOPEN\nDPRNT[A#101[23]]\nPCLOS\nM30\n")
    said = console("run", "print.nc", "--control", "fanuc-m", "--print", "out.txt")
    assert said.status == 0
    assert (console.folder / "out.txt").read_text(encoding="utf-8").startswith("A")


def test_an_output_file_is_written_whole_or_not_at_all(console: Console) -> None:
    console.file("good.nc", GOOD)
    console.file("out.csv", "precious")
    said = console(
        "run", "good.nc", "--control", "fanuc-m", "--trace", "out.csv", "--print", "missing/out.txt"
    )
    assert said.status == 2
    assert (console.folder / "out.csv").read_text(encoding="utf-8") == "precious"
    assert sorted(path.name for path in console.folder.iterdir()) == ["good.nc", "out.csv"]


def test_a_setup_file_and_a_machine_file_are_used(console: Console) -> None:
    console.file("good.nc", GOOD)
    console.file("small.toml", 'base = "mill3"\n[axis.X]\nlimit_plus = 50\n')
    console.file("setup.yaml", "machine: small.toml\n")
    assert console("run", "good.nc", "--control", "fanuc-m").status == 0
    assert console("run", "good.nc", "--control", "fanuc-m", "--machine", "small.toml").status == 1
    assert console("run", "good.nc", "--control", "fanuc-m", "--setup", "setup.yaml").status == 1


def test_subprograms_are_found_beside_the_program_and_in_search_folders(console: Console) -> None:
    console.file("main.nc", "O1\nM98 P9001\nM98 P9002\nM30\n")
    console.file("O9001.nc", "O9001\nG0 X1.\nM99\n")
    (console.folder / "lib").mkdir()
    console.file("lib/O9002.nc", "O9002\nG0 X2.\nM99\n")
    assert console("run", "main.nc", "--control", "fanuc-m").status == 1
    assert console("run", "main.nc", "--control", "fanuc-m", "--search", "lib").status == 0


def test_a_program_can_come_from_standard_input(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(GOOD.encode())))
    assert console("run", "-", "--control", "fanuc-m").status == 0


def test_the_block_limit_ends_a_loop(console: Console) -> None:
    console.file("loop.nc", "O1\nN1 #100=#100+1\nGOTO 1\n")
    assert console("run", "loop.nc", "--control", "fanuc-m", "--block-limit", "500").status == 1


@pytest.mark.parametrize(
    ("seconds", "shown"),
    [(0, "0:00.0"), (59.96, "1:00.0"), (61.5, "1:01.5"), (3725, "1:02:05.0"), (0.04, "0:00.0")],
)
def test_times_are_shown_as_on_a_clock(seconds: float, shown: str) -> None:
    assert clock(seconds) == shown


def test_a_long_list_of_messages_is_cut(console: Console) -> None:
    console.file("loud.nc", "O1\nWHILE [#100 LT 60] DO1\n#100=#100+1\n#3006=1(LOOK)\nEND1\nM30\n")
    said = console("run", "loud.nc", "--control", "fanuc-m")
    assert said.out.count("LOOK") < 60
    assert "more messages" in said.out


def test_a_run_without_time_tells_none(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("run", "good.nc", "--control", "fanuc-m", "--no-time", "--state", "state.json")
    assert said.status == 0
    assert "no alarm" in said.out
    assert "cycle time" not in said.out
    state = json.loads((console.folder / "state.json").read_text(encoding="utf-8"))
    assert "time_s" not in state
    assert state["final"]


def test_a_long_program_is_the_same_with_and_without_bulk(console: Console) -> None:
    console.file("long.nc", "O1\nG90 G1 F1000.\n" + "X10. Y5.\nX0 Y0\n" * 3000 + "X1. Q1.\nM30\n")
    bulk = console("run", "long.nc", "--control", "fanuc-m", "--no-time", "--trace", "a.csv")
    none = console("run", "long.nc", "--control", "fanuc-m", "--no-time", "--trace", "b.csv", "--no-bulk")
    assert bulk.out == none.out
    assert (console.folder / "a.csv").read_text() == (console.folder / "b.csv").read_text()


def test_where_the_time_goes_is_told_where_one_asks(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("run", "good.nc", "--explain-time", *FANUC)
    assert "where the time goes:" in said.out
    assert "programmed feed, over" in said.out
    assert said.out.endswith("\n")  # the prompt of a shell stands on a line of its own
    shares = [
        float(line.split("%")[0])
        for line in said.out.splitlines()
        if line.startswith("  ") and " %  " in line
    ]
    assert sum(shares) == pytest.approx(100.0, abs=0.5)
    assert "where the time goes:" not in console("run", "good.nc", *FANUC).out


BESIDE = """base = "mill3"
[defaults.linear]
after_interpolation_s = 0.064
[magazine]
place_time_s = 0.4
[spindle.1]
speed_wait = "cut"
"""


def test_where_the_time_goes_names_time_constants_and_what_went_on_beside(console: Console) -> None:
    console.file("mine.toml", BESIDE)
    console.file("part.nc", "O1\nG90 T9\nM3 S3000\nG0 X200.\nG1 X0 F6000\nM6\nM30\n")
    said = console("run", "part.nc", "--explain-time", "--control", "fanuc-m", "--machine", "mine.toml")
    assert "time constant of the acceleration after interpolation" in said.out
    # 3000 rpm are reached after 0.5 s of 0.69 s; the cut takes 2 s and 0.064 s, eight places 3.2 s:
    # the last of them while the spindle comes to rest, 0.5 s.
    assert "and 0:00.5 in which a spindle went to its speed beside that" in said.out
    assert "and 0:03.2 in which the magazine turned beside that" in said.out
