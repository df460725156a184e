"""`polycnc check`: diagnostics, one a line."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from polycnc.cli import diagnostics, options
from polycnc.cli.console import note, show
from polycnc.messages import text

app = typer.Typer(add_completion=False, rich_markup_mode=None)
STDIN = "-"


class Format(StrEnum):
    """How the findings are written."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"
    GITHUB = "github"
    JUNIT = "junit"


@app.command(help=text("help.check"))
@options.with_opening
def check(
    files: Annotated[list[str], typer.Argument(metavar="FILE…", help=text("help.check.files"))],
    form: Annotated[Format, typer.Option("--format", help=text("help.option.format"))] = Format.TEXT,
    output: options.Output = None,
    exit_zero: Annotated[bool, typer.Option("--exit-zero", help=text("help.check.exit-zero"))] = False,
    stdin_filename: Annotated[
        str, typer.Option(metavar="NAME", help=text("help.check.stdin-filename"))
    ] = "<stdin>",
    *,
    opening: options.Opening,
) -> int:
    """Run each program without keeping its motion, and tell what alarmed."""
    from polycnc.machine.errors import FileError
    from polycnc.program import ProgramFileError
    from polycnc.session import SessionError

    found: list[diagnostics.Diagnostic] = []
    names = [stdin_filename if file == STDIN else file for file in files]
    unreadable = False
    for file, name in zip(files, names, strict=True):
        try:
            source: bytes | Path = sys.stdin.buffer.read() if file == STDIN else Path(file)
            session = opening.session(source, name=name, keep=False, timed=False)
            found += diagnostics.diagnostics_of(session.run(), name)
        except (SessionError, FileError, ProgramFileError) as error:
            note(f"polycnc: {error}")
            unreadable = True
    failed = any(diagnostic.severity == "error" for diagnostic in found)
    status = 2 if unreadable else int(failed and not exit_zero)
    _write(found, names, form, status, output)
    return status


def _write(
    found: list[diagnostics.Diagnostic], names: list[str], form: Format, status: int, output: Path | None
) -> None:
    from polycnc.cli import formats
    from polycnc.cli.output import write_whole
    from polycnc.cli.sarif import as_sarif

    content = {
        Format.TEXT: lambda: formats.as_text(found),
        Format.JSON: lambda: formats.as_json(found),
        Format.SARIF: lambda: as_sarif(found, status),
        Format.GITHUB: lambda: formats.as_github(found),
        Format.JUNIT: lambda: formats.as_junit(found, names),
    }[form]()
    if output is not None:
        write_whole(output, content)
    else:
        show(content)
