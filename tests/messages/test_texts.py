"""Every text that a user reads exists in both languages, and every id that the code names exists."""

from __future__ import annotations

import ast
import re
import tomllib
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import polycnc
from polycnc.messages.catalogue import Catalogue, fill, set_language

if TYPE_CHECKING:
    from collections.abc import Iterator

SOURCE = Path(polycnc.__file__).parent
CATALOGUES = sorted(
    path
    for path in SOURCE.rglob("*.toml")
    if path.name.endswith(("messages.toml", "alarms.toml")) or path.stem == "fields"
)
DECLARED = ("Option", "_option", "Argument", "Commands", "commands.command")
ERRORS = ("SessionError", "UnreadableError", "CommandRefused")
OWN = tomllib.loads((SOURCE / "messages" / "messages.toml").read_text(encoding="utf-8"))


def placeholders(text: str) -> set[str]:
    return set(re.findall(r"\{(\w+)\}", text))


@pytest.mark.parametrize("path", CATALOGUES, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_every_text_exists_in_both_languages_with_the_same_values_in_it(path: Path) -> None:
    for key, entry in tomllib.loads(path.read_text(encoding="utf-8")).items():
        for english, chinese, optional in (
            ("en", "zh-TW", False),
            ("cause", "cause-zh-TW", True),
            ("remedy", "remedy-zh-TW", True),
        ):
            texts = [entry.get(english, ""), entry.get(chinese, "")]
            assert all(texts) or (optional and not any(texts)), f"{key}: one language only: {texts}"
            assert placeholders(texts[0]) == placeholders(texts[1]), f"{key}: {texts}"


def named_in(path: Path) -> set[str]:
    """Ids that a module passes to `text(…)`, to commands and options, and to errors with these texts."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            first = node.args[0]
            if ast.unparse(node.func) in ("text", *DECLARED, *ERRORS):
                found.add(str(first.value))
    return found


@pytest.mark.parametrize("folder", ["cli", "cases", "mainrun", "panel", "session"])
def test_every_text_that_a_folder_asks_for_exists(folder: str) -> None:
    paths = [SOURCE / folder] if folder.endswith(".py") else sorted((SOURCE / folder).rglob("*.py"))
    named = set().union(*map(named_in, paths))
    assert named
    assert named - set(OWN) == set()


def asked_for(path: Path) -> Iterator[str]:
    """Patterns of all strings of a module: what stands in an f-string's braces may be anything."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):
            parts = (str(v.value) if isinstance(v, ast.Constant) else None for v in node.values)
            yield "".join(".+" if part is None else re.escape(part) for part in parts)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and len(node.value) < 80:
            yield re.escape(node.value)


def test_every_own_text_is_asked_for() -> None:
    asked = re.compile("|".join(sorted(set(chain.from_iterable(map(asked_for, SOURCE.rglob("*.py")))))))
    assert [key for key in OWN if not asked.fullmatch(key)] == []


def test_a_value_that_is_not_given_is_left_open() -> None:
    assert fill("{code} at {line}", {"line": 3}) == "… at 3"


@pytest.mark.parametrize(
    ("args", "shown"),
    [({"text": "X"}, "Error at X"), ({"text": ""}, "Error at the end"), ({}, "Error at the end")],
)
def test_a_text_has_a_form_for_a_missing_value(args: dict[str, object], shown: str) -> None:
    assert fill("Error <at {text}|at the end>", args) == shown


def test_a_language_that_polycnc_does_not_speak_is_refused() -> None:
    with pytest.raises(ValueError, match="de"):
        set_language("de")


def test_a_missing_id_is_a_mistake_of_polycnc() -> None:
    catalogue = Catalogue(SOURCE / "messages" / "messages.toml")
    with pytest.raises(KeyError):
        catalogue.text("no such id")


def test_a_text_is_that_of_its_table_in_the_file() -> None:
    for file in SOURCE.rglob("*.toml"):
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
        if all(isinstance(table, dict) and "en" in table for table in tables.values()):
            catalogue = Catalogue(file)
            assert {key: catalogue.entry(key) for key in catalogue} == tables


def test_catalogues_over_the_same_file_read_it_once(tmp_path: Path) -> None:
    file = tmp_path / "texts.toml"
    file.write_text('[a]\nen = "one"\n', encoding="utf-8")
    assert Catalogue(file).text("a", "en") == "one"
    file.unlink()
    assert Catalogue(file).text("a", "en") == "one"
