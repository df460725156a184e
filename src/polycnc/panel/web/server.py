"""The server: every control under its own address, an index of them, and the JSON interface of each."""

from __future__ import annotations

import errno
import logging
import socket
from importlib import resources

from fastapi import Response, WebSocket, WebSocketDisconnect
from nicegui import app, ui

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import UserError, text
from polycnc.panel.web.guard import LOOPBACK, Guard
from polycnc.panel.web.interrupts import Interrupts
from polycnc.panel.web.messages import answer
from polycnc.panel.web.page import Page
from polycnc.view.web import delivery

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.panel.web.desk import Desk

#: A browser that a busy computer keeps away for so long, s, goes on with the same page.
RECONNECT_S = 30.0
#: So long, s, the server waits for answers that it has begun when it closes.
CLOSING_S = 5
#: How often the time of the controls goes on, s.
TICK_S = 0.02
#: Why no server can listen at an address, by what the system says; for everything else there is no such address.
_REASONS = {
    errno.EADDRINUSE: "panel.port-used",
    errno.EACCES: "panel.port-refused",
    errno.EPERM: "panel.port-refused",
}


def build(desks: Mapping[str, Desk], lang: str, token: str = "") -> None:
    """Put the pages of all desks into NiceGUI's application.

    Args:
        desks: The desks by the name in their address.
        lang: Language of pages at first.
        token: What a browser must know; empty where none is needed.
    """
    style = resources.files("polycnc.panel.web").joinpath("panel.css").read_text(encoding="utf-8")

    def page_of(name: str) -> Callable[[], None]:
        def show() -> None:
            ui.add_css(style)
            Page(desks[name], lang, name)

        return show

    def index() -> None:
        ui.add_css(style)
        ui.run_javascript(f"document.documentElement.lang = '{lang}'")
        with ui.element("div").classes("half index"):
            ui.html(f"<h1>{text('panel.index', lang)}</h1>", sanitize=False)
            for name, desk in desks.items():
                ui.link(f"{name}: {desk.control.control.id}", f"/{name}")

    async def talk(socket: WebSocket, name: str) -> None:
        if name not in desks:
            await socket.close(4404)
            return
        await socket.accept()
        try:
            while True:
                await socket.send_text(answer(desks[name], await socket.receive_text()))
        except WebSocketDisconnect:
            return

    def line(name: str, which: str, era: int = -1, first: int = 0) -> Response:
        lines = desks[name].course.lines.get(which) if name in desks else None
        return Response(status_code=404) if lines is None else delivery.answer(lines, era, first)

    ui.page("/", title="polycnc")(page_of(next(iter(desks))) if len(desks) == 1 else index)
    for name in desks:
        ui.page(f"/{name}", title=f"polycnc {name}")(page_of(name))
    app.add_api_route("/lines/{name}/{which}", line)
    app.add_api_websocket_route("/api/{name}", talk)
    app.add_middleware(Guard, token=token)

    def tick() -> None:
        for desk in desks.values():
            desk.tick()

    app.timer(TICK_S, tick)


def needs_token(host: str) -> bool:
    """Whether a server at this address is reached from elsewhere."""
    return host not in LOOPBACK


def check_address(host: str, port: int) -> None:
    """Try whether a server could listen there.

    Raises:
        UserError: The port is in use or not allowed, or the computer has no such address.
    """
    try:
        with socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET):
            return
    except OSError as error:
        told = _REASONS.get(error.errno or 0, "panel.no-address")
        raise UserError(told, host=host, port=port) from None


def serve(interrupts: Interrupts, *, host: str, port: int, opens: bool) -> None:
    """Run the server until it is interrupted.

    Args:
        interrupts: By `closing`, entered.
        host: Where it listens.
        port: See `host`.
        opens: A browser is opened.
    """
    app.on_startup(interrupts.begin_to_serve)
    try:
        ui.run(
            host=host, port=port, show=opens, reload=False, title="polycnc", favicon="⚙",
            show_welcome_message=False, binding_refresh_interval=None, reconnect_timeout=RECONNECT_S,
            timeout_graceful_shutdown=CLOSING_S,
        )  # fmt: skip
    finally:
        interrupts.end()


def closing() -> Interrupts:
    """What closes the server when it is interrupted."""

    def close() -> None:
        logging.getLogger("uvicorn.error").disabled = True  # it tells of answers that nobody waits for
        app.shutdown()

    return Interrupts(close)
