"""How a server is interrupted: it closes, and what is to last is written down, however often it is told."""

from __future__ import annotations

import signal
from time import monotonic

from polycnc.deferred.typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from collections.abc import Callable

#: So long, s, one interrupt is enough; while nothing serves yet, a later one is raised again.
AGAIN_S = 5.0
#: Ctrl-C, an order to end, a terminal that is closed.
_ENDS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


class Interrupts:
    """What comes while a server is loaded is raised at once; the first that comes while it serves closes it.

    All others do nothing: they would break what the first one began. `KeyboardInterrupt` is raised at the end of the
    context where there were any, unless something else is raised there.

    Args:
        close: Lets the server end.
    """

    def __init__(self, close: Callable[[], None]) -> None:
        self._close = close
        self._raises, self._serves = True, False
        self._heard: list[float] = []

    def __enter__(self) -> Self:
        """Answer to signals, but to those that this process has been told not to heed (nohup)."""
        handlers = {each: signal.getsignal(each) for each in _ENDS}
        self._before = {
            each: handler for each, handler in handlers.items() if handler not in (signal.SIG_IGN, None)
        }
        self._answer()
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Answer no more."""
        for each, handler in self._before.items():
            signal.signal(each, handler)
        if self._heard and (kind is None or issubclass(kind, KeyboardInterrupt)):
            raise KeyboardInterrupt

    def begin_to_serve(self) -> None:
        """The server is there, and has taken signals for itself."""
        self._raises, self._serves = False, True
        self._answer()

    def end(self) -> None:
        """It has closed: what follows is not to be interrupted."""
        self._raises = self._serves = False

    def _answer(self) -> None:
        for each in self._before:
            signal.signal(each, self._hear)

    def _hear(self, _number: int, _frame: object) -> None:
        now = monotonic()
        is_enough = bool(self._heard) and now < self._heard[0] + AGAIN_S
        self._heard.append(now)
        if self._serves:
            self._close()
        elif self._raises and not is_enough:
            raise KeyboardInterrupt
