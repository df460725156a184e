"""The list of functions that work, and what each is called."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from polycnc.cases.features import functions, in_manual_order, proved, shipped, shipped_of_tests
from polycnc.cases.reading import UnreadableError
from polycnc.control.registry import ids
from polycnc.messages.catalogue import LANGUAGES

HAN = re.compile(r"[\u4e00-\u9fff]")
#: The marker of a test, and the ids in it.
MARK = re.compile(r"pytest\.mark\.feature\(([^)]*)\)")
FEATURE = re.compile(r'"([a-z]+\.[\w.-]+)"')


@pytest.mark.parametrize("control", ids())
def test_every_function_that_works_has_a_name_and_its_words(control: str) -> None:
    nameless = set(shipped()[control]) - set(functions())
    assert not nameless, "name them in data/functions"


def test_every_function_is_called_something_in_both_languages() -> None:
    for feature in functions():
        entry = functions().entry(feature)
        assert all(entry[language].strip() for language in LANGUAGES), feature
        assert not HAN.search(entry["en"]), feature


def test_functions_stand_in_the_order_of_the_manual_and_unknown_ones_last() -> None:
    assert in_manual_order({"own.b": 1, "fan.g72": 1, "own.a": 1, "fan.g71": 1}) == [
        "fan.g71",
        "fan.g72",
        "own.a",
        "own.b",
    ]


def test_a_machine_file_is_found_from_the_case_file_that_names_it(tmp_path: Path) -> None:
    (tmp_path / "machines").mkdir()
    (tmp_path / "machines" / "own.toml").write_text('base = "mill4"\n')
    (tmp_path / "mill").mkdir()
    (tmp_path / "mill" / "table.yaml").write_text(
        "- {id: turn, feature: own.a, control: fanuc-m, setup: {machine: ../machines/own.toml},"
        ' program: "G0 A90.\\nM30", expect: {final: {work: {A: 90}}}}\n'
    )
    assert proved(tmp_path) == {"fanuc-m": {"own.a": 1}}


REPORT = """<testsuites><testsuite>
<testcase name="a[en]"><properties><property name="feature" value="x own.a"/></properties></testcase>
<testcase name="a[zh]"><properties><property name="feature" value="x own.a"/></properties></testcase>
<testcase name="b"><properties><property name="feature" value="x own.b"/><property name="feature" value="x own.c"/>
</properties><failure message="no"/></testcase>
<testcase name="c"><properties><property name="feature" value="x own.c"/></properties></testcase>
<testcase name="d"><properties><property name="feature" value="x own.d"/></properties><skipped/></testcase>
<testcase name="e"/>
</testsuite></testsuites>"""


def test_features_of_screens_are_those_whose_tests_all_passed(tmp_path: Path) -> None:
    (tmp_path / "report.xml").write_text(REPORT)
    assert proved(None, tmp_path / "report.xml") == {"x": {"own.a": 2}}


def test_what_is_no_report_is_refused(tmp_path: Path) -> None:
    (tmp_path / "report.xml").write_text("no report")
    with pytest.raises(UnreadableError, match=re.escape("--junitxml")):
        proved(None, tmp_path / "report.xml")
    with pytest.raises(UnreadableError):
        proved(None, tmp_path / "missing.xml")


def test_the_shipped_list_names_the_features_that_tests_are_marked_with() -> None:
    marked = set()
    for path in Path(__file__).parents[1].rglob("test_*.py"):
        for mark in MARK.findall(path.read_text(encoding="utf-8")):
            marked |= set(FEATURE.findall(mark))
    assert marked == {name for counts in shipped_of_tests().values() for name in counts}, (
        "run `make features`"
    )


def test_a_marked_test_says_in_the_report_what_it_proves(tmp_path: Path, pytestconfig: pytest.Config) -> None:
    (tmp_path / "test_own.py").write_text(
        "import pytest\n"
        "@pytest.mark.feature('own.a', 'own.b', control='x')\n"
        "def test_one(): pass\n"
        "@pytest.mark.parametrize('control', ['x', 'y'])\n"
        "@pytest.mark.feature('own.c')\n"
        "def test_two(control): assert control == 'x'\n"
    )
    report = tmp_path / "report.xml"
    own = [
        "-c",
        str(pytestconfig.inipath),
        "--rootdir",
        str(tmp_path),
        "-p",
        "tests.conftest",
        "-p",
        "no:cacheprovider",
    ]
    words = [sys.executable, "-m", "pytest", *own, str(tmp_path / "test_own.py"), "--junitxml", str(report)]
    subprocess.run(words, cwd=pytestconfig.rootpath, check=False, capture_output=True)
    assert proved(None, report) == {"x": {"own.a": 1, "own.b": 1, "own.c": 1}}
