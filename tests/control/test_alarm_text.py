"""Every text that the code can raise is formatted with the values that the code gives: no value is left open."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import pytest

import polycnc
from polycnc.cases.format import parse_case
from polycnc.control import registry
from polycnc.messages.catalogue import messages, placeholders
from polycnc.session import open_session
from tests.conformance.reading import FILES, cases_in

if TYPE_CHECKING:
    from collections.abc import Iterator

SOURCE = Path(polycnc.__file__).parent
CONTROLS = [registry.control(name) for name in registry.ids()]
#: What a raise gives beside its own arguments: the classes of SINUMERIK's language take the text by place.
GIVEN = {"AlarmError": set(), "WordAlarm": set(), "NcSyntaxError": {"text", "code"}, "fail": {"word", "code"}}
#: A text that a module names, as the formatter writes it.
CONSTANT = re.compile(r'^(\w+) = "([^"\\\n]*)"', re.MULTILINE)
MODULES = sorted(SOURCE.rglob("*.py"))
CALLED = re.compile(rf"\b(?:{'|'.join(GIVEN)})\(")
RAISING = [path for path in MODULES if CALLED.search(path.read_text(encoding="utf-8"))]
FAMILIES = {"fanuc", "meldas", "syntec", "sinumerik"}
#: Arguments that say where, and not what.
PLACES = {"column", "line", "program", "address", "hint", "detail"}


class Raise(NamedTuple):
    """A place in the code that makes an alarm: its code or the name of its mistake, and the values it gives."""

    where: str
    code: str
    by_mistake: bool
    values: frozenset[str]
    hint: str


def constants(path: Path) -> dict[str, str]:
    """The texts that a module names."""
    return dict(CONSTANT.findall(path.read_text(encoding="utf-8")))


@cache
def all_constants() -> dict[str, str]:
    """The texts that any module names."""
    return {name: text for path in MODULES for name, text in constants(path).items()}


def codes_in(node: ast.expr, own: dict[str, str]) -> Iterator[tuple[str, bool]]:
    """The codes that an argument can be, and whether they are names of mistakes."""
    match node:
        case ast.Constant(value=str(code)):
            yield code, False
        case ast.Name(id=name) if name in own or name in all_constants():
            yield own.get(name, all_constants().get(name, "")), False
        case ast.IfExp(body=body, orelse=orelse):
            yield from codes_in(body, own)
            yield from codes_in(orelse, own)
        case ast.Subscript(value=ast.Attribute(attr="alarms"), slice=ast.Constant(value=str(mistake))):
            yield mistake, True


def raises(path: Path) -> Iterator[Raise]:
    """The places of a module."""
    own = constants(path)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Call) or not node.args:
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name not in GIVEN or any(keyword.arg is None for keyword in node.keywords):
            continue
        keywords = {str(keyword.arg): keyword.value for keyword in node.keywords}
        hint = keywords.get("hint")
        for code, by_mistake in codes_in(node.args[0], own):
            yield Raise(
                f"{path.relative_to(SOURCE)}:{node.lineno}",
                code,
                by_mistake or name == "fail",
                frozenset(set(keywords) - PLACES | GIVEN[name]),
                str(hint.value) if isinstance(hint, ast.Constant) else "",
            )


def families(where: str) -> set[str]:
    """The families of controls whose alarms a module raises, told by its folders."""
    named = FAMILIES & set(where.split("/"))
    return named or (FAMILIES - {"sinumerik"} if "word_address" in where else FAMILIES)


def missing(text: str, values: frozenset[str]) -> str:
    """The text, if it cannot be told with these values."""
    return text if placeholders(text, needed=True) - values else ""


def untold(each: Raise) -> Iterator[str]:
    """The texts of an alarm, in both languages, on every control that has it, that cannot be told; "" for others."""
    for control in CONTROLS:
        if control.id.partition("-")[0] not in families(each.where):
            continue
        tables: list[dict[str, str]] = [
            getattr(control, "alarms", {}),
            getattr(getattr(control, "grammar", None), "alarms", {}),
        ]
        for code in {table.get(each.code, "") for table in tables} if each.by_mistake else {each.code}:
            if code in control.catalogue:
                yield from (missing(text, each.values) for text in control.catalogue.entry(code).values())
    if each.hint:
        yield from (missing(text, each.values) for text in messages().entry(each.hint).values())


def test_the_places_that_raise_are_found() -> None:
    found = [each for path in RAISING for each in raises(path)]
    assert len(found) > 1600
    assert sum(1 for each in found if list(untold(each))) > 600


@pytest.mark.parametrize("path", RAISING, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_texts_that_a_module_raises_have_all_their_values(path: Path) -> None:
    open_texts = [(each.where, each.code, text) for each in raises(path) for text in untold(each) if text]
    assert open_texts == []


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_an_alarm_of_a_case_leaves_no_value_open(path: Path) -> None:
    for data in cases_in(path):
        case = parse_case(data)
        if not case.expect.alarms or case.operate:
            continue
        program = case.program.removesuffix("\n") + "\n"
        result = open_session(
            program,
            control=case.control,
            setup=case.setup,
            files=case.files,
            folder=path.parent,
            block_limit=50_000,
        ).run()
        for alarm in result.alarms:
            for lang in ("en", "zh-TW"):
                shown = result.alarm_text(alarm, lang)
                assert "…" not in shown, f"{case.id}: {shown}"
                assert "{" not in shown.replace(alarm.detail or " ", ""), f"{case.id}: {shown}"
