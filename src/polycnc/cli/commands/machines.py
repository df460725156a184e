"""`polycnc machines`: the built-in machines, and one of them as a file to start one's own from."""

from __future__ import annotations

from polycnc.cli import options
from polycnc.cli.console import say, show
from polycnc.cli.declaration import Argument, Commands
from polycnc.deferred.typing import Annotated


def list_machines() -> None:
    """One machine a line: its id, the axes of its channels, its name."""
    from polycnc.machine import builtin_ids, load_machine

    built = [load_machine(machine_id) for machine_id in builtin_ids()]
    width = max(len(machine.id) for machine in built)
    for machine in built:
        axes = " | ".join(" ".join(channel.names) for channel in machine.channels)
        say(f"{machine.id:{width}}  {axes:28}  {machine.name}")


commands = Commands("help.machines", alone=list_machines)


@commands.command("help.machines.show", "show")
def show_machine(
    machine: Annotated[str, Argument("help.option.machine", metavar="ID|FILE", values=options.machines)],
    _lang: options.Lang = None,
) -> None:
    """Write one machine as a TOML file, complete with all defaults."""
    from polycnc.machine import load_machine
    from polycnc.machine.render import machine_toml

    show(machine_toml(load_machine(machine)))
