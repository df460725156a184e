"""Plain words are read as Click reads them; all others are left to it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.cli import plain
from polycnc.cli.clicks import made_of
from polycnc.cli.commands import COMMANDS, commands_of
from polycnc.cli.declaration import Command, Commands, without_none

if TYPE_CHECKING:
    from collections.abc import Mapping

PLAIN = [
    "run a.nc",
    "run a.nc --control fanuc-m --setup -",
    "run --control fanuc-m a.nc --no-time",
    "run - --trace out.parquet --machine mill3 --setup ./s.yaml --lang zh-TW --print p --state s.json --no-bulk",
    "run a.nc --explain-time --memory m --encoding cp950 --control x",
    "check a.nc b.nc c.nc --control fanuc-m",
    "check a.nc --format sarif --output out --exit-zero --stdin-filename x",
    "check a.nc -o out",
    "plot a.nc -o out.svg --view xz --profile",
    "test a.yaml b.yaml -k word --report r.json --memory m",
    "features --from cases --format json",
    "alarms 10 --control fanuc-m",
    "alarms",
    "panel",
    "panel a.nc --host 0.0.0.0 --no-open --exercise x --lang en",
]
#: Right or wrong, these are Click's.
OTHERS = [
    "",
    "--version",
    "--lang en run a.nc",
    "runn a.nc",
    "run",
    "run --help",
    "run a.nc -h",
    "run a.nc b.nc",
    "run a.nc --control",
    "run a.nc --control --no-time",
    "run a.nc --control=fanuc-m",
    "run a.nc --contr fanuc-m",
    "run a.nc --control a --control b",
    "run a.nc --no-time --no-time",
    "run a.nc --search x",
    "run a.nc --block-limit 5",
    "run a.nc --sample 1ms x.csv",
    "run a.nc --lang de",
    "run -- a.nc",
    "run -x",
    "plot a.nc",
    "check a.nc --format xml",
    "check a.nc -oout",
    "test a.yaml --feature x",
    "panel --port 1",
    "machines",
    "memory show m",
]


@pytest.fixture
def given(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What commands are called with, in place of calling them."""
    calls: list[dict[str, Any]] = []

    def called(command: Command, given: Mapping[str, object]) -> int:
        calls.append({each.name: each.taken(given) for each in command.parameters})
        return 7

    monkeypatch.setattr(Command, "__call__", called)
    return calls


def by_click(words: list[str]) -> object:
    return made_of(commands_of(words[0]), words[0]).main(words[1:], words[0], standalone_mode=False)


@pytest.mark.parametrize("line", PLAIN)
def test_plain_words_mean_what_they_mean_to_click(line: str, given: list[dict[str, Any]]) -> None:
    words = line.split()
    asked = plain.read(words)
    assert asked is not None
    assert asked() == by_click(words) == 7
    ours, theirs = given
    assert ours == theirs
    assert {name: type(value) for name, value in ours.items()} == {
        name: type(value) for name, value in theirs.items()
    }


@pytest.mark.parametrize("line", OTHERS)
def test_other_words_are_left_to_click(line: str) -> None:
    assert plain.read(line.split()) is None


def test_an_empty_word_is_left_to_click() -> None:
    assert plain.read(["run", ""]) is None
    assert plain.read(["run", "a.nc", "--setup", ""]) is None


def test_a_line_that_the_shell_completes_is_left_to_click(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_POLYCNC_COMPLETE", "complete_bash")
    assert plain.read(["run", "a.nc"]) is None


def test_a_file_that_may_not_be_read_is_left_to_click(tmp_path: Path) -> None:
    setup = tmp_path / "setup.yaml"
    setup.touch(0)
    if os.access(setup, os.R_OK):
        pytest.skip("this user may read everything")
    assert plain.read(["run", "a.nc", "--setup", str(setup)]) is None


@pytest.mark.parametrize("name", COMMANDS)
def test_every_parameter_is_declared(name: str) -> None:
    offered: Commands = commands_of(name)
    assert offered.members
    for command in offered.members:
        for parameter in command.parameters:
            assert without_none(parameter.kind) is not type(None)
            assert all(flag.startswith("-") for flag in parameter.flags)
