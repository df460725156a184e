"""Every text that the code can raise is formatted with the values that the code gives: no value is left open."""

from __future__ import annotations

import ast
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import pytest

import polycnc
from polycnc.cases.features import case_files
from polycnc.cases.format import parse_case
from polycnc.cases.reading import read_cases
from polycnc.control import registry
from polycnc.messages.catalogue import messages, placeholders
from polycnc.session import open_session
from tests import conformance

if TYPE_CHECKING:
    from collections.abc import Iterator

SOURCE = Path(polycnc.__file__).parent
MODULES = {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(SOURCE.rglob("*.py"))}
CONTROLS = [registry.control(name) for name in registry.ids()]
#: What a raise gives beside its own arguments: the classes of SINUMERIK's language take the text by place.
GIVEN = {"AlarmError": set(), "WordAlarm": set(), "NcSyntaxError": {"text", "code"}, "fail": {"word", "code"}}
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


def constants(module: ast.Module) -> dict[str, str]:
    """The texts that a module names."""
    named: dict[str, str] = {}
    for node in module.body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
            named |= {t.id: str(node.value.value) for t in node.targets if isinstance(t, ast.Name)}
    return named


ALL_CONSTANTS = dict(chain.from_iterable(constants(module).items() for module in MODULES.values()))


def codes_in(node: ast.expr, own: dict[str, str]) -> Iterator[tuple[str, bool]]:
    """The codes that an argument can be, and whether they are names of mistakes."""
    match node:
        case ast.Constant(value=str(code)):
            yield code, False
        case ast.Name(id=name) if name in own or name in ALL_CONSTANTS:
            yield own.get(name, ALL_CONSTANTS.get(name, "")), False
        case ast.IfExp(body=body, orelse=orelse):
            yield from codes_in(body, own)
            yield from codes_in(orelse, own)
        case ast.Subscript(value=ast.Attribute(attr="alarms"), slice=ast.Constant(value=str(mistake))):
            yield mistake, True


def raises() -> Iterator[Raise]:
    for path, module in MODULES.items():
        own = constants(module)
        for node in ast.walk(module):
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


RAISES = list(raises())


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
    assert len(RAISES) > 700
    assert sum(1 for each in RAISES if list(untold(each))) > 600


@pytest.mark.parametrize("each", RAISES, ids=lambda each: f"{each.where}-{each.code}")
def test_a_text_that_the_code_raises_has_all_its_values(each: Raise) -> None:
    assert [text for text in untold(each) if text] == []


FOLDER = Path(str(conformance.__file__)).parent


@pytest.mark.parametrize("path", case_files(FOLDER), ids=lambda path: f"{path.parent.name}/{path.name}")
def test_an_alarm_of_a_case_leaves_no_value_open(path: Path) -> None:
    for data in read_cases(path):
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
