"""`polycnc panel`: a control to operate in the browser."""

from __future__ import annotations

from pathlib import Path
from secrets import token_urlsafe
from typing import Annotated

import typer

from polycnc.cli import options
from polycnc.cli.console import fail, say
from polycnc.messages import text
from polycnc.messages.catalogue import language

app = typer.Typer(add_completion=False, rich_markup_mode=None)
PORT = 8620


@app.command(help=text("help.panel"))
def panel(
    file: Annotated[Path | None, typer.Argument(metavar="[FILE]", help=text("help.panel.file"))] = None,
    control: Annotated[
        list[str] | None, typer.Option("--control", metavar="ID", help=text("help.option.control"))
    ] = None,
    machine: options.Machine = None,
    setup: options.Setup = None,
    search: options.Search = None,
    memory: options.Memory = None,
    card: Annotated[Path | None, typer.Option("--card", metavar="DIR", help=text("help.panel.card"))] = None,
    host: Annotated[
        str, typer.Option("--host", metavar="ADDRESS", help=text("help.panel.host"))
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option("--port", min=1, max=65535, help=text("help.panel.port"))] = PORT,
    speed: Annotated[
        float, typer.Option("--speed", min=0.01, max=1000.0, help=text("help.panel.speed"))
    ] = 1.0,
    no_open: Annotated[bool, typer.Option("--no-open", help=text("help.panel.no-open"))] = False,
    _lang: options.Lang = None,
) -> int:
    """Serve one control, or several, each under its own address."""
    from polycnc.control.registry import ids
    from polycnc.mainrun import VirtualControl
    from polycnc.messages.catalogue import listed
    from polycnc.panel.web.desk import Desk
    from polycnc.panel.web.server import build, needs_token, serve
    from polycnc.session import SessionError

    chosen = control or []
    if not chosen:
        raise SessionError("session.control-wanted", known=listed(ids()))
    if memory is not None and len(chosen) > 1:
        return fail(text("panel.one-memory"), 2)
    if card is not None and not card.is_dir():
        return fail(text("file.unreadable", file=card, reason=text("file.no-folder")), 2)
    desks: dict[str, Desk] = {}
    for each in chosen:
        made = VirtualControl(each, machine=machine, setup=setup, search=search or (), retained=memory)
        if file is not None:
            made.load(file)
        name = each if each not in desks else f"{each}-{len(desks) + 1}"
        desks[name] = Desk(made, speed, card)
    token = token_urlsafe(16) if needs_token(host) else ""
    build(desks, language(), token)
    say(f"http://{host}:{port}/" + (f"?token={token}" if token else ""))
    try:
        serve(host=host, port=port, opens=not no_open)
    finally:
        for desk in desks.values():
            desk.control.close()
    return 0
