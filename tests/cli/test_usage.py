"""The command line speaks the user's language also where Click speaks for it."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from polycnc.cli.commands import COMMANDS

if TYPE_CHECKING:
    from pathlib import Path

    from tests.cli.console import Console

_ENGLISH = (
    "Usage", "Options", "Commands", "Positional", "arguments", "required", "default", "Show this", "nvalid", "Missing",
    "No such", "Did you",
)  # fmt: skip


@pytest.mark.parametrize("words", [(), *((command,) for command in COMMANDS)])
def test_a_page_of_help_has_no_english_left_in_traditional_chinese(
    words: tuple[str, ...], console: Console
) -> None:
    page = console(*words, "--help", "--lang", "zh-TW").out
    assert page.startswith("用法：polycnc")
    assert [word for word in _ENGLISH if word in page] == []


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("run",), "缺少引數 FILE（請參閱 polycnc run --help）"),
        (("plot", "x.nc"), "缺少選項"),
        (("frobnicate",), "沒有此指令：frobnicate"),
        (("run", "x.nc", "--contrl", "y"), "沒有此選項：--contrl"),
        (("run", "x.nc", "y.nc"), "多出的引數：y.nc"),
        (("run", "x.nc", "--block-limit", "0"), "0 不在範圍 x>=1 之內"),
        (("run", "x.nc", "--block-limit", "many"), "many 不是整數"),
        (("check", "x.nc", "--format", "xml"), "--format 的值不正確：xml 不是下列之一"),
        (("panel", "--speed", "fast"), "fast 不是數字"),
        (("rn", "x.nc"), "沒有此指令：rn；是否要寫 'run'？"),
        (("run", "x.nc", "--no-tim"), "沒有此選項：--no-tim；是否要寫 '--explain-time', '--no-time'？"),
        (("run", "x.nc", "--sample", "1ms"), "選項 --sample 需要 2 個值"),
        (("run", "x.nc", "--no-time=1"), "選項 --no-time 不接受值"),
        (("data",), "缺少指令"),
    ],
)
def test_wrong_usage_is_told_in_traditional_chinese(
    words: tuple[str, ...], told: str, console: Console
) -> None:
    said = console("--lang", "zh-TW", *words)
    assert said.status == 2
    assert told in said.err
    assert [word for word in _ENGLISH if word in said.err] == []


def test_the_language_may_stand_in_front_of_the_command(console: Console) -> None:
    assert "找不到此檔案" in console("--lang", "zh-TW", "run", "missing.nc", "--control", "fanuc-m").err


def test_an_unknown_language_in_front_of_the_command_is_refused(console: Console) -> None:
    said = console("--lang", "fr", "machines")
    assert said.status == 2
    assert "Invalid value for '--lang': 'fr' is not one of 'en', 'zh-TW'" in said.err


def test_a_page_of_help_comes_in_the_characters_that_the_terminal_has(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "polycnc", "check", "--help"]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "POLYCNC_LANG": "en"}
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False, env=environment
    )
    assert done.returncode == 0
    assert done.stdout.startswith("Usage: polycnc check [OPTIONS] FILE?\n")


def test_what_may_be_left_out_stands_in_brackets(console: Console) -> None:
    assert console("alarms", "-h").out.startswith("Usage: polycnc alarms [OPTIONS] [CODE]\n")
    assert console("machines", "-h").out.startswith("Usage: polycnc machines [OPTIONS] [COMMAND] [ARGS]...\n")
    assert console("data", "-h").out.startswith("Usage: polycnc data [OPTIONS] COMMAND [ARGS]...\n")


def test_defaults_and_limits_are_told(console: Console) -> None:
    page = " ".join(console("panel", "-h").out.split())
    assert "--port NUMBER Port of the server. [default: 8620; 1<=x<=65535]" in page
    assert "[default: 127.0.0.1]" in page
    assert (
        "--exercise FILE[#ID] A file of exercises; FILE#ID names one of them. It says which control and setup. --sheet"
        in page
    )
    assert "[default: text]" in console("check", "-h").out


def test_a_mistyped_command_is_guessed(console: Console) -> None:
    assert "No such command 'chek'. Did you mean 'check'?" in console("chek", "x.nc").err
