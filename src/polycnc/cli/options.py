"""The options that all commands share."""

from __future__ import annotations

import inspect
from dataclasses import fields
from enum import StrEnum
from functools import wraps
from glob import glob, has_magic
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT
from polycnc.deferred.records import dataclass
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from polycnc.session import Session


class Language(StrEnum):
    """The languages that polycnc speaks."""

    EN = "en"
    ZH_TW = "zh-TW"


def _option(
    name: str, *flags: str, metavar: str | None = None, values: Callable[[], Iterable[str]] | None = None
) -> object:
    """An option; `values` are those that the shell offers."""
    return typer.Option(
        *flags, help=text(f"help.option.{name}"), metavar=metavar, show_default=False, autocompletion=values
    )


def controls() -> tuple[str, ...]:
    """The ids of all controls."""
    from polycnc.control import registry

    return tuple(registry.ids())


def machines() -> tuple[str, ...]:
    """The ids of the built-in machines."""
    from polycnc.machine import builtin_ids

    return builtin_ids()


def expanded(names: Iterable[str]) -> list[str]:
    """File names with patterns resolved that the shell has left as they are, as on Windows."""
    files: list[str] = []
    for name in names:
        found = sorted(glob(name)) if has_magic(name) and not Path(name).exists() else []  # noqa: PTH207 - names stay as typed
        files += found or [name]
    return files


Control = Annotated[str | None, _option("control", "--control", metavar="ID", values=controls)]
Machine = Annotated[str | None, _option("machine", "--machine", metavar="ID|FILE", values=machines)]
Setup = Annotated[Path | None, _option("setup", "--setup", metavar="FILE")]
Search = Annotated[list[Path] | None, _option("search", "--search", metavar="DIR")]
Encoding = Annotated[str | None, _option("encoding", "--encoding", metavar="NAME")]
Lang = Annotated[Language | None, _option("lang", "--lang", metavar="en|zh-TW")]
BlockLimit = Annotated[int, typer.Option("--block-limit", min=1, help=text("help.option.block-limit"))]
Memory = Annotated[Path | None, _option("memory", "--memory", metavar="FILE")]
NoBulk = Annotated[bool, typer.Option("--no-bulk", help=text("help.option.no-bulk"))]
Output = Annotated[Path | None, _option("output", "--output", "-o", metavar="FILE")]


@dataclass(frozen=True, slots=True)
class Opening:
    """How a program is opened: the options of every command that runs one, in the order of its help."""

    control: Control = None
    machine: Machine = None
    setup: Setup = None
    search: Search = None
    encoding: Encoding = None
    block_limit: BlockLimit = DEFAULT_BLOCK_LIMIT
    no_bulk: NoBulk = False
    _lang: Lang = None

    def inputs(self, *files: str | Path) -> list[str | Path]:
        """The files that a command reads, which none of its outputs may replace."""
        return [*files, *(each for each in (self.setup, self.machine) if each is not None)]

    def session(
        self,
        source: bytes | Path,
        *,
        name: str = "",
        keep: bool,
        timed: bool = True,
        memory: Path | None = None,
    ) -> Session:
        """Open a session of a file, or of a text that has no file; `session.open_session` has the errors."""
        from polycnc.cli.freed import keep_freed_memory
        from polycnc.session import open_session

        keep_freed_memory()
        return open_session(
            source, name=name, control=self.control, machine=self.machine, setup=self.setup,
            search=self.search or (), encoding=self.encoding, block_limit=self.block_limit,
            keep=keep, timed=timed, bulk=not self.no_bulk, memory=memory,
        )  # fmt: skip


def with_opening(command: Callable[..., int]) -> Callable[..., int]:
    """Give a command the options of `Opening` in place of its parameter `opening`, which is the last one."""
    names = [field.name for field in fields(Opening)]

    @wraps(command)
    def called(**arguments: Any) -> int:
        opening = Opening(**{name: arguments.pop(name) for name in names})
        return command(**arguments, opening=opening)

    # Typer reads the options of a command from its signature and its annotations.
    options = get_type_hints(Opening, include_extras=True)
    own = get_type_hints(command, include_extras=True)
    kinds = inspect.Parameter
    parameters = [
        parameter.replace(annotation=own[parameter.name])
        for parameter in inspect.signature(command).parameters.values()
        if parameter.name != "opening"
    ]
    parameters += [
        kinds(field.name, kinds.KEYWORD_ONLY, default=field.default, annotation=options[field.name])
        for field in fields(Opening)
    ]
    called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    called.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return called
