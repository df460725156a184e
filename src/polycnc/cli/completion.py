"""Completion by the shell: the script with which it asks polycnc for words, shown or installed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import click
from click.shell_completion import (
    CompletionItem,
    FishComplete,
    PowerShellComplete,
    ShellComplete,
    ZshComplete,
    add_completion_class,
    get_completion_class,
)

from polycnc.cli.console import say, show
from polycnc.cli.output import write_whole
from polycnc.cli.plain import COMPLETION
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Callable

PROGRAM = "polycnc"
#: The shell that has called polycnc.
CALLING = "auto"
#: The shells that Click knows, with Click's name of each.
SHELLS = {
    "bash": "bash", "zsh": "zsh", "fish": "fish", "powershell": "powershell", "pwsh": "powershell",
}  # fmt: skip
#: Below the home folder: the script of a shell, and the file that the shell reads when it starts with the line that
#: loads the script. A fish finds it.
_PLACES = {
    "bash": (f".bash_completions/{PROGRAM}.sh", ".bashrc", f"source ~/.bash_completions/{PROGRAM}.sh"),
    "zsh": (f".zfunc/_{PROGRAM}", ".zshrc", "fpath+=~/.zfunc; autoload -Uz compinit; compinit"),
    "fish": (f".config/fish/completions/{PROGRAM}.fish", None, ""),
}
#: A PowerShell names the file that it reads when it starts. Where it may run no file at all it may run its own ones
#: from now on.
_PROFILE = """
if ((Get-ExecutionPolicy) -eq 'Restricted') { Set-ExecutionPolicy RemoteSigned -Scope CurrentUser -Force }
[Console]::OutputEncoding = [System.Text.Encoding]::UTF8
$PROFILE
"""


class _WholeWords(ShellComplete):
    """A shell that takes `--control=fanuc-m` for one word, and wants it whole; a Bash asks for what is behind `=`."""

    def get_completions(self, args: list[str], incomplete: str) -> list[CompletionItem]:
        """What may stand in place of a word that is begun."""
        name, sign, _ = incomplete.partition("=")
        is_option = bool(sign) and name.startswith("--") and "--" not in args
        return [
            CompletionItem(f"{name}={item.value}", item.type, item.help)
            if is_option and item.type == "plain"
            else item
            for item in super().get_completions(args, incomplete)
        ]


class _Zsh(_WholeWords, ZshComplete):
    """Files are looked for behind the `=`."""

    source_template = ZshComplete.source_template.replace("_path_files", "compset -P 1 '--*='; _path_files")


class _Fish(_WholeWords, FishComplete):
    """Files are looked for behind the `=`; texts of help may hold commas."""

    source_template = FishComplete.source_template.replace('split ","', 'split --max 1 ","').replace(
        "__fish_complete_path $metadata[2];",
        "set -l option (string match --regex -- '^--[^=]+=' (commandline -t));\n"
        '            for path in (__fish_complete_path $metadata[2]); echo "$option$path"; end;',
    )


class _PowerShell(_WholeWords, PowerShellComplete):
    """A PowerShell replaces the word."""


for _each in _Zsh, _Fish, _PowerShell:
    add_completion_class(_each)


def options() -> list[click.Option]:
    """The options of polycnc that install the script of a shell, and show it."""
    return [
        _for_shell("--install-completion", text("help.install-completion", shells=listed(SHELLS)), _install),
        _for_shell("--show-completion", text("help.show-completion"), lambda _, script: show(script)),
    ]


def _for_shell(flag: str, shown: str, act: Callable[[str, str], None]) -> click.Option:
    """An option with or without the name of a shell, that does something with its script and leaves."""

    def called(context: click.Context, _parameter: object, name: str | None) -> None:
        if name is not None and not context.resilient_parsing:
            shell = _calling(context) if name == CALLING else name
            act(shell, _script(context.command, SHELLS[shell]))
            context.exit()

    return click.Option(
        [flag], type=click.Choice([CALLING, *SHELLS]), is_flag=False, flag_value=CALLING,
        metavar="[SHELL]", expose_value=False, callback=called, help=shown,
    )  # fmt: skip


def _script(command: click.Command, shell: str) -> str:
    made = get_completion_class(shell)
    assert made is not None
    return made(command, {}, PROGRAM, COMPLETION).source().rstrip("\n") + "\n"


def _calling(context: click.Context) -> str:
    """The shell that has called polycnc. Raises `click.UsageError` where it is none that is known."""
    from shellingham import ShellDetectionFailure, detect_shell

    try:
        shell = detect_shell()[0]
    except ShellDetectionFailure:
        shell = ""
    if shell not in SHELLS:
        raise click.UsageError(text("completion.unknown", shell=shell or "?", known=listed(SHELLS)), context)
    return shell


def _install(shell: str, script: str) -> None:
    file, startup, line = _places(shell)
    file.parent.mkdir(parents=True, exist_ok=True)
    write_whole(file, script)
    if startup is not None:
        _load(startup, line)
    say(text("completion.installed", shell=shell, file=file))


def _load(startup: Path, line: str) -> None:
    """Have a shell load the script when it starts; all else in that file stays as it is, to the byte."""
    try:
        before = startup.read_bytes().decode() if startup.exists() else ""
    except UnicodeDecodeError as error:
        raise click.UsageError(text("completion.startup", file=startup, line=line)) from error
    if line not in before.splitlines():
        end = "\n" if before and not before.endswith("\n") else ""
        write_whole(startup, f"{before}{end}{line}\n")


def _places(shell: str) -> tuple[Path, Path | None, str]:
    """The script of a shell; the file that the shell reads when it starts, and the line there that loads the script."""
    if shell in _PLACES:
        place, startup, line = _PLACES[shell]
        return Path.home() / place, Path.home() / startup if startup else None, line
    command: Any = [shell, "-NoProfile", "-Command", _PROFILE]
    told = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout
    profile = Path(told.decode().strip().removeprefix("\ufeff"))
    file = profile.with_name(f"{PROGRAM}-completion.ps1")
    return file, profile, f". '{file}'"
