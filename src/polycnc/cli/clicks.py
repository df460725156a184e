"""Click's commands, made of what `declaration` says: pages of help, refusals, completion, and words of every form.

It is Click itself and not Typer, which is built upon it: Typer demands Rich, and Rich demands Pygments, a quarter of
all that an installation takes.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from enum import StrEnum
from types import GenericAlias

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem, shell_complete

from polycnc.cli import completion, options
from polycnc.cli.commands import COMMANDS, call, commands_of
from polycnc.cli.console import say
from polycnc.cli.declaration import REQUIRED, Argument, Command, Path, without_none
from polycnc.cli.plain import COMPLETION
from polycnc.cli.usage import HELP, translated
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from polycnc.cli.declaration import Commands, Option, Parameter

#: Exit status.
BAD_USE = 2
#: Types of numbers within limits.
_RANGES: dict[Any, Callable[..., click.ParamType[Any]]] = {int: click.IntRange, float: click.FloatRange}


def run(words: Sequence[str]) -> object:
    """Do what the words of the command line ask for; gives what the command gives. Raises `click.ClickException`."""
    root = _root()
    if asked := os.environ.get(COMPLETION):
        return shell_complete(root, {}, completion.PROGRAM, COMPLETION, asked)
    try:
        with root.make_context(completion.PROGRAM, list(words)) as context:
            return root.invoke(context)
    except click.exceptions.Exit as left:
        return left.exit_code


# ---- commands --------------------------------------------------------------------------------------------------------


class _Modules(Mapping[str, click.Command]):
    """All commands by their names: the module of each is imported when it is asked for."""

    def __getitem__(self, name: str) -> click.Command:
        if name not in COMMANDS:
            raise KeyError(name)
        return made_of(commands_of(name), name)

    def __iter__(self) -> Iterator[str]:
        return iter(COMMANDS)

    def __len__(self) -> int:
        return len(COMMANDS)


class _Group(click.Group):
    """A group that lists its commands as they are declared."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        return list(self.commands)


def _root() -> click.Group:
    version = _page("--version", told=_version, shown=text("help.version"))
    return _group(
        "help.polycnc", _Modules(), _usage, version, _language(), *completion.options(),
        subcommand_metavar="COMMAND [ARGS]...",  # without a command it is wrong usage
    )  # fmt: skip


def made_of(offered: Commands, name: str) -> click.Command:
    """What a module of `cli.commands` offers, as Click has it."""
    if not offered.text:
        return _command(offered.members[0], name)
    members = {each.name: _command(each, each.name) for each in offered.members}
    return _group(offered.text, members, offered.alone, _language(), name=name)


def _command(command: Command, name: str) -> click.Command:
    kinds = {each.name: without_none(each.kind) for each in command.parameters}

    @click.pass_context
    def called(context: click.Context, /, **values: Any) -> int | None:
        said = ParameterSource.COMMANDLINE
        given = {name: value for name, value in values.items() if context.get_parameter_source(name) is said}
        return call(
            command, {name: [*value] if _is_list(kinds[name]) else value for name, value in given.items()}
        )

    parameters = [*map(_parameter, command.parameters), _help()]
    return click.Command(
        name, callback=called, params=parameters, help=text(command.text), add_help_option=False
    )


def _group(
    about: str,
    commands: Mapping[str, click.Command],
    alone: Callable[[], object] | None,
    *parameters: click.Parameter,
    **more: Any,
) -> click.Group:
    """A group of commands, and what it does without one of them."""

    @click.pass_context
    def head(context: click.Context, /, **_: object) -> object:
        return alone() if alone is not None and context.invoked_subcommand is None else None

    return _Group(
        commands=commands,  # type: ignore[arg-type]  # which are only looked up
        callback=head, params=[*parameters, _help()], help=text(about),
        invoke_without_command=alone is not None, no_args_is_help=False, add_help_option=False, **more,
    )  # fmt: skip


# ---- parameters ------------------------------------------------------------------------------------------------------


class _Words(click.Choice[str]):
    """The words of an enumeration."""

    def __init__(self, kind: type[StrEnum]) -> None:
        super().__init__([each.value for each in kind])
        self._kind = kind

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        return self._kind(super().convert(value, param, ctx))


def _parameter(declared: Parameter) -> click.Parameter:
    """An option or an argument as Click has it."""
    role, kind = declared.role, without_none(declared.kind)
    is_required, is_list = declared.default is REQUIRED, _is_list(kind)
    type_ = _type(kind.__args__[0] if is_list else kind, role)
    settings: dict[str, Any] = {"type": type_, "required": is_required}
    if not isinstance(type_, click.Choice):
        settings["shell_complete"] = _offering(role.values)
    shown = text(role.text) if role.text else ""
    if isinstance(role, Argument):
        return click.Argument(
            [declared.name], nargs=-1 if is_list else 1,
            metavar=role.metavar if is_required else f"[{role.metavar}]",
            help=f"{shown}  [required]".strip() if is_required else shown, **settings,
        )  # fmt: skip
    if role.shows_default and declared.default and not is_required:
        settings["default"] = str(declared.default)  # only shown: `Command` has its own
    if role.refusal is not None:
        settings["callback"] = _refusing(role.refusal)
    return click.Option(
        [declared.name, *declared.flags], multiple=is_list, is_flag=kind is bool or None,
        metavar=role.metavar, show_default=True, help=shown, **settings,
    )  # fmt: skip


def _is_list(kind: Any) -> bool:
    return isinstance(kind, GenericAlias) and kind.__origin__ is list


def _type(kind: Any, role: Option | Argument) -> click.ParamType[Any]:
    """What Click makes of one word, or of several for a tuple."""
    if isinstance(kind, GenericAlias):
        return click.Tuple([_type(each, role) for each in kind.__args__])
    if issubclass(kind, StrEnum):
        return _Words(kind)
    if issubclass(kind, Path):
        return click.Path(path_type=Path)
    if kind in _RANGES and not isinstance(role, Argument):
        return _RANGES[kind](*role.limits)
    return click.BOOL if kind is bool else click.STRING


def _offering(values: Callable[[], Iterable[str]] | None) -> Callable[..., list[CompletionItem]]:
    """What the shell offers for a word: the values that begin so, or else files."""

    def offered(_context: object, _parameter: object, begun: str) -> list[CompletionItem]:
        known = [CompletionItem(each) for each in values() if each.startswith(begun)] if values else []
        return known or [CompletionItem(begun, type="file")]

    return offered


def _refusing(refusal: Callable[[Any], str]) -> Callable[..., Any]:
    def checked(_context: object, _parameter: object, value: Any) -> Any:
        if value is not None and (reason := refusal(value)):
            raise click.BadParameter(reason)
        return value

    return checked


def _language() -> click.Parameter:
    """The option of every group; `usage.language_of` has read it already."""

    def language(_lang: options.Lang = None) -> None:
        pass

    return _parameter(Command(language).parameters[0])


# ---- pages -----------------------------------------------------------------------------------------------------------


def _help() -> click.Option:
    return _page(*HELP, told=_help_of, shown=text("help.help"))


def _page(*flags: str, told: Callable[[click.Context], str], shown: str) -> click.Option:
    """An option that tells something and leaves."""

    def tell(context: click.Context, _parameter: object, is_asked: bool) -> None:
        if is_asked and not context.resilient_parsing:
            say(told(context))
            context.exit()

    return click.Option(flags, is_flag=True, is_eager=True, expose_value=False, callback=tell, help=shown)


def _help_of(context: click.Context) -> str:
    return translated(context.get_help())


def _version(_context: object) -> str:
    from polycnc import __version__

    return f"polycnc {__version__}"


def _usage() -> int:
    """No command is named."""
    say(_help_of(click.get_current_context()))
    return BAD_USE
