"""The command line speaks the user's language also where Typer speaks for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.cli.commands import COMMANDS

if TYPE_CHECKING:
    from tests.cli.console import Console

_ENGLISH = (
    "Usage", "Options", "Commands", "Arguments", "required", "default", "Show this", "nvalid", "Missing", "No such",
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
    assert "'fr' is not one of 'en', 'zh-TW'" in said.err
