"""Who may come in: off the loopback whoever has the token, and in every case only pages of this server.

On the loopback requests have to name it: a page elsewhere whose name has been led to this computer does not.
"""

from __future__ import annotations

from http.cookies import CookieError, SimpleCookie
from secrets import compare_digest
from urllib.parse import parse_qs, urlsplit

from polycnc.deferred.typing import TYPE_CHECKING, Any

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
        names_it = bool(self._token) or names_loopback(headers)
        if not names_it or not is_own_origin(headers) or not self._has_token(headers, given):
            await _refuse(scope, receive, send)
            return
        is_token = bool(self._token) and self._is_token(given)

        async def sending(message: MutableMapping[str, Any]) -> None:
            if is_token and message["type"] == "http.response.start":
                cookie = f"{COOKIE}={self._token}; HttpOnly; SameSite=Strict; Path=/".encode("latin-1")
                message["headers"] = [*message.get("headers", ()), (b"set-cookie", cookie)]
            await send(message)

        await self._application(scope, receive, sending)

    def _has_token(self, headers: dict[str, str], given: str) -> bool:
        if not self._token:
            return True
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            cookie = None
        return self._is_token(given) or (cookie is not None and self._is_token(cookie.value))

    def _is_token(self, given: str) -> bool:
        return compare_digest(self._token.encode(), given.encode("utf-8", "surrogatepass"))


def is_own_origin(headers: dict[str, str]) -> bool:
    """Whether a request comes from a page of this server, or from no page at all."""
    origin = headers.get("origin", "")
    try:
        return not origin or urlsplit(origin).netloc == headers.get("host", "")
    except ValueError:
        return False


def names_loopback(headers: dict[str, str]) -> bool:
    """Whether a request names this computer as itself; where it names nothing, no browser has sent it."""
    host = headers.get("host", "")
    try:
        return not host or urlsplit(f"//{host}").hostname in LOOPBACK
    except ValueError:
        return False


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 4403})
        return
    await send({"type": "http.response.start", "status": 403, "headers": [(b"content-type", b"text/plain")]})
    await send({"type": "http.response.body", "body": b"forbidden"})
