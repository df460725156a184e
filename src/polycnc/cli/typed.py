"""Typer's commands, made of what `declaration` says: pages of help, refusals, completion, and words of every form."""

from __future__ import annotations

import inspect
import pathlib
from types import GenericAlias, UnionType
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer
from typer.core import TyperGroup

from polycnc.cli import options
from polycnc.cli.commands import COMMANDS, commands_of
from polycnc.cli.declaration import REQUIRED, Argument, Command, Path
from polycnc.cli.usage import HELP
from polycnc.messages import text
from polycnc.messages.catalogue import LANGUAGES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from polycnc.cli.declaration import Commands, Parameter

#: Exit status.
BAD_USE = 2
Function = TypeVar("Function", bound="Callable[..., int | None]")


def run(words: Sequence[str]) -> object:
    """Do what the words of the command line ask for; gives what the command gives."""
    return _root()(words, prog_name="polycnc", standalone_mode=False)


class _Commands(TyperGroup):
    """Imports the module of a command when the command is called."""

    def list_commands(self, ctx: Any) -> list[str]:  # noqa: ARG002
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:  # noqa: ARG002
        if cmd_name not in COMMANDS:
            return None
        command = typer.main.get_command(app_of(commands_of(cmd_name)))
        command.name = cmd_name
        return command


def _root() -> typer.Typer:
    app = typer.Typer(
        cls=_Commands,
        add_completion=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": list(HELP)},
    )

    @app.callback(invoke_without_command=True, help=text("help.polycnc"))
    def root(
        ctx: typer.Context,
        version: Annotated[bool, typer.Option("--version", help=text("help.version"), is_eager=True)] = False,
        lang: Annotated[
            str | None, typer.Option(metavar="|".join(LANGUAGES), help=text("help.option.lang"))
        ] = None,
    ) -> None:
        if lang is not None and lang not in LANGUAGES:
            raise typer.BadParameter(f"{lang!r} is not one of {', '.join(map(repr, LANGUAGES))}.")
        if version:
            from polycnc import __version__

            typer.echo(f"polycnc {__version__}")
        elif ctx.invoked_subcommand is None:
            typer.echo(ctx.get_help())
            raise typer.Exit(BAD_USE)

    return app


def app_of(offered: Commands) -> typer.Typer:
    """What a module of `cli.commands` offers, as Typer has it."""
    is_group = bool(offered.text)
    app = typer.Typer(
        add_completion=False, rich_markup_mode=None, help=text(offered.text) if is_group else None
    )
    if is_group:
        app.callback(invoke_without_command=offered.alone is not None)(_head(offered.alone))
    for command in offered.members:
        app.command(name=command.name if is_group else None, help=text(command.text))(_called(command))
    return app


def _head(alone: Callable[[], None] | None) -> Callable[..., None]:
    """What a group does before its commands, which has an option of its own: the language."""

    def head(ctx: typer.Context, **_: object) -> None:
        if alone is not None and ctx.invoked_subcommand is None:
            alone()

    def language(_lang: options.Lang = None) -> None:
        pass

    return _signed(head, Command(language).parameters, ctx=typer.Context)


def _called(command: Command) -> Callable[..., int | None]:
    def called(**given: object) -> int | None:
        return command(given)

    return _signed(called, command.parameters)


def _signed(function: Function, parameters: Iterable[Parameter], **others: type) -> Function:
    """The function with these parameters: Typer reads them from its signature and its annotations."""
    kinds, empty = inspect.Parameter, inspect.Parameter.empty
    signed = [kinds(name, kinds.KEYWORD_ONLY, annotation=kind) for name, kind in others.items()]
    signed += [
        kinds(
            each.name,
            kinds.KEYWORD_ONLY,
            default=empty if each.default is REQUIRED else each.default,
            annotation=Annotated[_kind(each.kind), _role(each)],
        )
        for each in parameters
    ]
    function.__signature__ = inspect.Signature(signed)  # type: ignore[attr-defined]
    function.__annotations__ = {each.name: each.annotation for each in signed}
    return function


def _kind(kind: Any) -> Any:
    """A type as Typer knows it: with the library's own class of paths."""
    if isinstance(kind, UnionType):
        return _kind(kind.__args__[0]) | None
    if isinstance(kind, GenericAlias):
        outer: Any = kind.__origin__
        return outer[tuple(map(_kind, kind.__args__))]
    return pathlib.Path if kind is Path else kind


def _role(parameter: Parameter) -> object:
    """An option or an argument as Typer has it."""
    role = parameter.role
    shown = text(role.text) if role.text else None
    if isinstance(role, Argument):
        return typer.Argument(metavar=role.metavar, help=shown)
    return typer.Option(
        *parameter.flags,
        help=shown,
        metavar=role.metavar,
        show_default=role.shows_default,
        autocompletion=role.values,
        min=role.limits[0],
        max=role.limits[1],
        callback=_refusing(role.refusal) if role.refusal is not None else None,
    )


def _refusing(refusal: Callable[[Any], str]) -> Callable[[Any], Any]:
    def checked(value: Any) -> Any:
        if reason := refusal(value):
            raise typer.BadParameter(reason)
        return value

    return checked
