"""`polycnc machines`: the built-in machines, and one of them as a file to start one's own from."""

from __future__ import annotations

from typing import Annotated

import typer

from polycnc.cli import options
from polycnc.cli.console import say, show
from polycnc.messages import text

app = typer.Typer(add_completion=False, rich_markup_mode=None, help=text("help.machines"))


@app.callback(invoke_without_command=True)
def machines(ctx: typer.Context, _lang: options.Lang = None) -> None:
    """List the built-in machines."""
    if ctx.invoked_subcommand is not None:
        return
    from polycnc.machine import builtin_ids, load_machine

    built = [load_machine(machine_id) for machine_id in builtin_ids()]
    width = max(len(machine.id) for machine in built)
    for machine in built:
        axes = " | ".join(" ".join(channel.names) for channel in machine.channels)
        say(f"{machine.id:{width}}  {axes:28}  {machine.name}")


@app.command(name="show", help=text("help.machines.show"))
def show_machine(
    machine: Annotated[str, typer.Argument(metavar="ID|FILE", help=text("help.option.machine"))],
    _lang: options.Lang = None,
) -> None:
    """Write one machine as a TOML file, complete with all defaults."""
    from polycnc.machine import load_machine
    from polycnc.machine.render import machine_toml

    show(machine_toml(load_machine(machine)))
