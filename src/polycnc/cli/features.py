"""`polycnc features`: what works, from the project's own cases."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from polycnc.cli import options
from polycnc.cli.console import fail, show
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cases.features import Features

app = typer.Typer(add_completion=False, rich_markup_mode=None)


class Format(StrEnum):
    """How the features are written."""

    TEXT = "text"
    JSON = "json"


@app.command(help=text("help.features"))
def features(
    control: options.Control = None,
    cases: Annotated[
        Path | None, typer.Option("--from", metavar="DIR", help=text("help.features.from"))
    ] = None,
    form: Annotated[Format, typer.Option("--format", help=text("help.option.format"))] = Format.TEXT,
    output: options.Output = None,
    _lang: options.Lang = None,
) -> int:
    """Show the features that work, of one control or in short of all."""
    from polycnc.cases.features import proved, shipped
    from polycnc.cli.output import write_whole
    from polycnc.control.registry import ids

    if control is not None and control not in ids():
        return fail(text("session.control-unknown", control=control, known=", ".join(ids())), 2)
    if cases is not None and not cases.is_dir():
        return fail(text("file.unreadable", file=cases, reason=text("file.no-folder")), 2)
    found = shipped() if cases is None else proved(cases)
    if control is not None:
        found = {control: found.get(control, {})}
    if form is Format.JSON:
        content = json.dumps(found, indent=1) + "\n"
    else:
        lines = _short(found) if control is None else _all(found[control])
        content = "".join(f"{line}\n" for line in lines)
    if output is None:
        show(content)
    else:
        write_whole(output, content)
    return 0


def _short(found: Features) -> Iterator[str]:
    from polycnc.control.registry import ids

    for control in ids():
        counts = found.get(control, {})
        yield text("features.control", control=f"{control:14}", count=len(counts), cases=sum(counts.values()))


def _all(counts: dict[str, int]) -> Iterator[str]:
    width = max(map(len, counts), default=0)
    for feature, cases in counts.items():
        yield text("features.feature", feature=f"{feature:{width}}", cases=cases)
