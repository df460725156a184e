"""The options that all commands share."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from polycnc.messages import text


class Language(StrEnum):
    """The languages that polycnc speaks."""

    EN = "en"
    ZH_TW = "zh-TW"


def _option(name: str, *flags: str, metavar: str | None = None) -> object:
    return typer.Option(*flags, help=text(f"help.option.{name}"), metavar=metavar, show_default=False)


Control = Annotated[str | None, _option("control", "--control", metavar="ID")]
Machine = Annotated[str | None, _option("machine", "--machine", metavar="ID|FILE")]
Setup = Annotated[Path | None, _option("setup", "--setup", metavar="FILE")]
Search = Annotated[list[Path] | None, _option("search", "--search", metavar="DIR")]
Encoding = Annotated[str | None, _option("encoding", "--encoding", metavar="NAME")]
Lang = Annotated[Language | None, _option("lang", "--lang", metavar="en|zh-TW")]
BlockLimit = Annotated[int, typer.Option("--block-limit", min=1, help=text("help.option.block-limit"))]
NoBulk = Annotated[bool, typer.Option("--no-bulk", help=text("help.option.no-bulk"))]
Output = Annotated[Path | None, _option("output", "--output", "-o", metavar="FILE")]
