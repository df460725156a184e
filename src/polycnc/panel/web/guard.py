"""Who may come in: off the loopback whoever has the token, and in every case only pages of this server."""

from __future__ import annotations

from http.cookies import SimpleCookie
from secrets import compare_digest
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs, urlsplit

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, MutableMapping

    Scope = MutableMapping[str, Any]
    Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
    Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
    Application = Callable[[Scope, Receive, Send], Awaitable[None]]

COOKIE = "polycnc_token"
LOOPBACK = frozenset({"127.0.0.1", "::1", "localhost"})


class Guard:
    """Refuses requests without the token, and those that a page of another server sends (ASGI middleware).

    Args:
        application: What is guarded.
        token: The token; empty where none is needed.
    """

    def __init__(self, application: Application, token: str = "") -> None:
        self._application = application
        self._token = token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer 403, or go on; the token of an address goes into a cookie."""
        if scope["type"] not in ("http", "websocket"):
            await self._application(scope, receive, send)
            return
        headers = {
            name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]
        }
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]
        if not is_own_origin(headers) or not self._has_token(headers, given):
            await _refuse(scope, receive, send)
            return

        async def sending(message: MutableMapping[str, Any]) -> None:
            if given and message["type"] == "http.response.start":
                cookie = f"{COOKIE}={given}; HttpOnly; SameSite=Strict; Path=/".encode("latin-1")
                message["headers"] = [*message.get("headers", ()), (b"set-cookie", cookie)]
            await send(message)

        await self._application(scope, receive, sending)

    def _has_token(self, headers: dict[str, str], given: str) -> bool:
        if not self._token:
            return True
        cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        kept = cookie.value if cookie is not None else ""
        return any(compare_digest(self._token.encode(), each.encode()) for each in (given, kept) if each)


def is_own_origin(headers: dict[str, str]) -> bool:
    """Whether a request comes from a page of this server, or from no page at all."""
    origin = headers.get("origin", "")
    return not origin or urlsplit(origin).netloc == headers.get("host", "")


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 4403})
        return
    await send({"type": "http.response.start", "status": 403, "headers": [(b"content-type", b"text/plain")]})
    await send({"type": "http.response.body", "body": b"forbidden"})
