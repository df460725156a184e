from __future__ import annotations

import _thread
import io
import json
import multiprocessing
import os
import sys
from contextlib import nullcontext
from time import monotonic, sleep
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import jsonschema
import pytest

from polycnc.cli.commands import check
from polycnc.cli.progress import Watch
from polycnc.session import Session
from tests.cli.console import BAD, GOOD
from tests.cli.sarif_schema import SARIF

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from polycnc.session import Result
    from tests.cli.console import Console

MAIN = "O1\nG0 X1.\nM98 P9001\nM30\n"
SUB = "O9001\nG0 X2.\nG999\nM99\n"
FANUC = ("--control", "fanuc-m")


def sarif(console: Console, *words: str) -> dict[str, Any]:
    report: dict[str, Any] = json.loads(console("check", *words, *FANUC, "--format", "sarif").out)
    jsonschema.Draft202012Validator(SARIF).validate(report)
    (run,) = report["runs"]
    assert isinstance(run, dict)
    return run


def test_a_good_program_says_nothing(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("check", "good.nc", *FANUC)
    assert (said.status, said.out, said.err) == (0, "", "")


def test_a_finding_is_one_line_with_its_place(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("check", "bad.nc", *FANUC)
    assert said.status == 1
    line, remedy = said.out.splitlines()
    assert line.startswith("bad.nc:3:")
    assert ": PS0010 " in line
    assert remedy.startswith("  remedy: ")


def test_a_finding_in_a_called_file_names_that_file(console: Console) -> None:
    console.file("main.nc", MAIN)
    console.file("O9001.nc", SUB)
    line = console("check", "main.nc", *FANUC).out.splitlines()[0]
    assert line.startswith("O9001.nc:3:")


def test_exit_zero_keeps_the_findings_and_drops_the_status(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("check", "bad.nc", *FANUC, "--exit-zero")
    assert said.status == 0
    assert "PS0010" in said.out


def test_a_name_that_is_too_long_is_told_as_elsewhere(console: Console) -> None:
    name = "x" * 300
    for lang, said in (("en", "the name is too long"), ("zh-TW", "名稱過長")):
        for command in ("check", "run"):
            assert console(command, name, *FANUC, "--lang", lang).err == f"polycnc: {name}: {said}\n"


def test_one_unreadable_file_does_not_hide_the_findings_of_the_others(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("check", "missing.nc", "bad.nc", *FANUC, "--exit-zero")
    assert said.status == 2
    assert "PS0010" in said.out
    assert "missing.nc" in said.err


@pytest.mark.parametrize("form", ["json", "github", "sarif", "junit"])
def test_every_format_tells_of_an_unreadable_file(console: Console, form: str) -> None:
    console.file("good.nc", GOOD)
    said = console("check", "missing.nc", "good.nc", *FANUC, "--format", form)
    assert said.status == 2
    assert "missing.nc" in said.out


def test_junit_counts_an_unreadable_file_as_an_error(console: Console) -> None:
    console.file("good.nc", GOOD)
    suite = ElementTree.fromstring(console("check", "missing.nc", "good.nc", *FANUC, "--format", "junit").out)
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("2", "0", "1")
    assert [case.find("error") is not None for case in suite] == [True, False]


def test_a_mistake_of_polycnc_in_one_file_leaves_the_others(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    console.file("bad.nc", BAD)
    console.file("crash.nc", "O1\nG0 X4321.\nM30\n")

    def run(session: Session, *watching: Any) -> Result:
        if "X4321." in session.result.program.lines[1]:
            raise RuntimeError("oops")
        return run_session(session, *watching)

    run_session = Session.run
    monkeypatch.setattr(Session, "run", run)
    said = console("check", "crash.nc", "bad.nc", *FANUC)
    assert said.status == 2
    assert "PS0010" in said.out
    assert "crash.nc: a mistake of polycnc itself (RuntimeError: oops" in said.err


def test_the_control_that_the_text_names_is_told(console: Console) -> None:
    console.file("turn.nc", "O1\nG50 S2000\nM30\n")
    console.file("mill.nc", "%@MACRO\nM30;\n")
    said = console("check", "turn.nc", "mill.nc")
    assert "checked as fanuc-0i-tf" in said.err
    assert "(1: turn.nc)" in said.err
    assert "checked as syntec-mill" in said.err
    assert "checked as" not in console("check", "turn.nc", "--control", "fanuc-0i-tf").err


def test_a_pattern_that_the_shell_has_left_is_resolved(console: Console) -> None:
    console.file("one.nc", BAD)
    console.file("two.nc", BAD)
    said = console("check", "*.nc", *FANUC)
    assert [line.split(":")[0] for line in said.out.splitlines() if "PS0010" in line] == ["one.nc", "two.nc"]
    assert "none?.nc" in console("check", "none?.nc", *FANUC).err


def test_standard_input_is_called_by_the_name_it_is_given(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(BAD.encode())))
    said = console("check", "-", "--stdin-filename", "editor.nc", *FANUC)
    assert said.out.startswith("editor.nc:3:")


def test_json_names_place_code_rule_and_calls(console: Console) -> None:
    console.file("main.nc", MAIN)
    console.file("O9001.nc", SUB)
    (finding,) = json.loads(console("check", "main.nc", *FANUC, "--format", "json").out)
    assert (finding["file"], finding["line"], finding["rule"]) == ("O9001.nc", 3, "fanuc/PS0010")
    assert finding["calls"] == [{"file": "main.nc", "line": 3}]


def test_github_commands_are_escaped(console: Console) -> None:
    console.file("50%.nc", BAD)
    said = console("check", "50%.nc", *FANUC, "--format", "github")
    assert said.out.startswith("::error file=50%25.nc,line=3,")


def test_junit_has_a_test_case_for_every_file(console: Console) -> None:
    console.file("good.nc", GOOD)
    console.file("bad.nc", BAD)
    suite = ElementTree.fromstring(console("check", "good.nc", "bad.nc", *FANUC, "--format", "junit").out)
    assert (suite.get("tests"), suite.get("failures")) == ("2", "1")


def test_sarif_of_a_good_program_has_no_results(console: Console) -> None:
    console.file("good.nc", GOOD)
    run = sarif(console, "good.nc")
    assert run["results"] == []
    assert run["invocations"] == [{"executionSuccessful": True, "exitCode": 0}]


@pytest.mark.skipif(sys.getfilesystemencoding() != "utf-8", reason="names of files are plain there")
def test_sarif_places_a_finding_relative_to_the_working_folder(console: Console) -> None:
    console.file("größe 1.nc", BAD)
    (result,) = sarif(console, "größe 1.nc")["results"]
    place = result["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "gr%C3%B6%C3%9Fe%201.nc", "uriBaseId": "%SRCROOT%"}
    assert place["region"]["startLine"] == 3
    assert result["ruleId"] == "fanuc/PS0010"


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are text there")
@pytest.mark.parametrize("form", check.Format)
def test_a_name_in_another_encoding_is_told_in_every_form(console: Console, form: str) -> None:
    name = os.fsdecode(b"gr\xf6\xdfe.nc")
    console.file(name, BAD)
    words = ("check", name, *FANUC, "--format", form)
    said = console(*words)
    assert (said.status, said.err) == (1, "")
    assert console(*words, "--output", "found").status == 1
    found = (console.folder / "found").read_text(encoding="utf-8")
    told = "gr%F6%DFe.nc" if form == check.Format.SARIF else "gr\\udcf6\\udcdfe.nc"
    assert told in found
    if form in (check.Format.JSON, check.Format.SARIF):
        json.loads(found)
    if form == check.Format.JSON:
        assert json.loads(found)[0]["file"] == name


def test_sarif_tells_the_way_of_the_calls(console: Console) -> None:
    console.file("main.nc", MAIN)
    console.file("O9001.nc", SUB)
    (result,) = sarif(console, "main.nc")["results"]
    steps = result["codeFlows"][0]["threadFlows"][0]["locations"]
    places = [step["location"]["physicalLocation"] for step in steps]
    lines = [(place["artifactLocation"]["uri"], place["region"]["startLine"]) for place in places]
    assert lines == [("main.nc", 3), ("O9001.nc", 3)]


def test_sarif_has_one_rule_for_many_findings_and_different_fingerprints(console: Console) -> None:
    for name in ("a.nc", "b.nc"):
        console.file(name, BAD)
    run = sarif(console, "a.nc", "b.nc")
    assert len(run["tool"]["driver"]["rules"]) == 1
    assert {result["ruleIndex"] for result in run["results"]} == {0}
    assert len({result["partialFingerprints"]["primaryLocationLineHash"] for result in run["results"]}) == 2


def test_a_fingerprint_survives_lines_that_are_put_in_above(console: Console) -> None:
    console.file("a.nc", BAD)
    before = sarif(console, "a.nc")["results"][0]["partialFingerprints"]
    console.file("a.nc", BAD.replace("G90", "(NEW)\nG90"))
    assert sarif(console, "a.nc")["results"][0]["partialFingerprints"] == before


def test_a_report_file_is_written_instead_of_standard_output(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("check", "bad.nc", *FANUC, "--format", "sarif", "--output", "out.sarif")
    assert said.out == ""
    assert json.loads((console.folder / "out.sarif").read_text(encoding="utf-8"))["version"] == "2.1.0"


def test_characters_that_cannot_be_read_are_a_warning_without_a_status(console: Console) -> None:
    (console.folder / "odd.nc").write_bytes(b"O1\n(\xff\xfe\x80)\nG0 X1.\nM30\n")
    said = console("check", "odd.nc", *FANUC, "--encoding", "utf-8")
    assert said.status == 0
    assert "odd.nc: encoding" in said.out


def test_a_program_that_no_call_reaches_is_a_warning(console: Console) -> None:
    console.file("twice.nc", "%\nO1\nM98 P2\nM30\nO2\nG0 X1.\nM99\nO2\nG0 X2.\nM99\n%\n")
    said = console("check", "twice.nc", *FANUC)
    assert said.status == 0
    assert "twice.nc:8: shadowed" in said.out


@pytest.mark.parametrize("content", ["", "%\n%\n", "\n \n"])
def test_a_file_without_a_block_is_a_warning(content: str, console: Console) -> None:
    path = console.file("empty.nc", content)
    said = console("check", path, "--control", "fanuc-m")
    assert said.status == 0
    assert said.out == f"{path}: empty there is no block in it\n"


def test_a_mistake_in_the_head_of_a_called_program_is_shown_there(console: Console) -> None:
    main = console.file("MAIN.MPF", "EXTERN UP9(REAL)\nUP9(1)\nM30\n")
    called = console.file("UP9.SPF", "PROC UP9(REAL A1)\nRET\n")
    said = console("check", main, "--control", "sinumerik-840d")
    assert said.status == 1
    assert said.out.startswith(f"{called}:1:15: 12080 ")


def test_many_files_are_checked_on_all_cores_in_their_order(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = [f"part{i:02d}.nc" for i in range(2 * check.SHARED)]
    for i, name in enumerate(names):
        console.file(name, BAD if i % 5 == 0 else GOOD)
    monkeypatch.setattr(check, "_cores", lambda: 2)
    shared = console("check", *names, *FANUC, "--lang", "zh-TW")
    monkeypatch.setattr(check, "_cores", lambda: 1)
    alone = console("check", *names, *FANUC, "--lang", "zh-TW")
    assert shared == alone
    assert [line[:9] for line in shared.out.splitlines() if line.startswith("part")] == names[::5]


@pytest.mark.parametrize("lack", [ImportError, NotImplementedError, PermissionError])
def test_where_processes_can_share_no_locks_one_checks_all(
    console: Console, monkeypatch: pytest.MonkeyPatch, lack: type[Exception]
) -> None:
    """As where `/dev/shm` cannot be written."""

    def fails(*_: object, **__: object) -> None:
        raise lack

    monkeypatch.setattr(check, "_cores", lambda: 2)
    monkeypatch.setattr("concurrent.futures.ProcessPoolExecutor.__init__", fails)
    names = [f"{i}.nc" for i in range(2 * check.SHARED)]
    for name in names:
        console.file(name, BAD if name == "7.nc" else GOOD)
    said = console("check", *names, *FANUC)
    assert (said.status, said.err, said.out[:5]) == (1, "", "7.nc:")


def test_workers_that_begin_anew_find_the_same(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on Windows and macOS: each imports what it needs, and is told what the command has been told."""
    names = [f"part{i:02d}.nc" for i in range(2 * check.SHARED)]
    for i, name in enumerate(names):
        console.file(name, BAD if i % 5 == 0 else GOOD)
    monkeypatch.setattr(check, "_cores", lambda: 1)
    alone = console("check", *names, *FANUC, "--lang", "zh-TW")
    spawning = multiprocessing.get_context("spawn")
    monkeypatch.setattr(multiprocessing, "get_context", lambda _: spawning)
    monkeypatch.setattr(check, "_cores", lambda: 2)
    assert console("check", *names, *FANUC, "--lang", "zh-TW") == alone


def test_nobody_looks_on_while_the_process_is_copied(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A worker would have the locks of a thread that it has not; from 3.12 on Python warns of that."""
    watch, threads = Watch("polycnc check"), []
    begun = _thread._count()

    def copied(_: object, run: Callable[[Any], Any], files: list[Any], **__: int) -> Iterable[Any]:
        threads.append(_counted())
        return map(run, files)

    def _counted() -> int:
        end = monotonic() + 10.0  # Python counts a thread as long as it cleans up behind it
        while (count := _thread._count()) > begun and monotonic() < end:
            sleep(0.01)
        return count

    monkeypatch.setattr(check, "_cores", lambda: 2)
    monkeypatch.setattr("concurrent.futures.ProcessPoolExecutor.map", copied)
    monkeypatch.setattr("polycnc.cli.app.watched", lambda _: nullcontext())
    monkeypatch.setattr(Watch, "of_command", watch)
    names = [f"{number}.nc" for number in range(2 * check.SHARED)]
    for name in names:
        console.file(name, GOOD)
    watch.begin()
    try:
        assert console("check", *names, "--control", "fanuc-m").status == 0
        assert watch._is_seen
    finally:
        watch.end()
    assert threads == [begun]
