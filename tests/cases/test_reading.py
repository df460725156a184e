from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest

from polycnc.cases.reading import UnreadableError, read_cases

if TYPE_CHECKING:
    from pathlib import Path

#: Every alias doubles what the one before it brings in.
BOMB = "".join(f"- &{b} [*{a}, *{a}]\n" for a, b in pairwise("abcdefghijklmnopqrstuvwxy"))


def read(tmp_path: Path, text: str) -> list[object]:
    path = tmp_path / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return read_cases(path)


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("033", "033"),
        ("12080", 12080),
        ("0", 0),
        ("-5", -5),
        ("1.5", 1.5),
        ("-.5", -0.5),
        ("10.", 10.0),
        ("1e3", 1000.0),
        ("1:30", "1:30"),
        ("on", "on"),
        ("Y", "Y"),
        ("true", True),
        ("null", None),
        ("", None),
        ("2024-01-02", "2024-01-02"),
        ("G54", "G54"),
        ("'5110'", "5110"),
    ],
)
def test_scalars_are_read_as_the_trade_means_them(tmp_path: Path, written: str, value: object) -> None:
    (case,) = read(tmp_path, f"- code: {written}\n")
    assert case == {"code": value}
    assert isinstance(case, dict)
    assert type(case["code"]) is type(value)


def test_an_empty_file_has_no_cases(tmp_path: Path) -> None:
    assert read(tmp_path, "# nothing yet\n") == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\n", "case.no-list"),
        ("- [unclosed\n", "case.no-yaml"),
        ("- !!python/object:os.system x\n", "case.no-yaml"),
        ("- {id: a, control: fanuc-m, control: syntec-mill}\n", "case.no-yaml"),
        ("- " + "[" * 200 + "]" * 200 + "\n", "case.no-yaml"),
        (
            "- &a [x, x]\n"
            + "".join(f"- &{b} [*{a}, *{a}]\n" for a, b in pairwise("abcdefghijklmnopqrstuvwxy")),
            "case.no-yaml",
        ),
    ],
)
def test_what_is_no_list_of_cases_is_unreadable(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UnreadableError) as caught:
        read(tmp_path, text)
    assert caught.value.message == message
    assert "case.yaml" in caught.value.text()


def test_a_missing_file_and_a_folder_are_unreadable(tmp_path: Path) -> None:
    for path in (tmp_path / "none.yaml", tmp_path):
        with pytest.raises(UnreadableError) as caught:
            read_cases(path)
        assert caught.value.message == "file.unreadable"
