"""polycnc: an open CNC control in software.

    import polycnc

    result = polycnc.run("part.nc", control="fanuc-m", machine="mill3")
    result.alarms, result.time, result.final
    result.moves.to_pandas()

`import polycnc` alone loads nothing; the parts come when they are asked for.
"""

from __future__ import annotations

TYPE_CHECKING = False  # for type checkers true; `typing` would be the first thing that a start imports

if TYPE_CHECKING:
    from polycnc.mainrun import VirtualControl
    from polycnc.messages.catalogue import set_language
    from polycnc.session import Result, Session, SessionError, open_session, run
    from polycnc.version import __version__

__all__ = [
    "Result",
    "Session",
    "SessionError",
    "VirtualControl",
    "__version__",
    "open_session",
    "run",
    "set_language",
]


def __getattr__(name: str) -> object:
    if name == "set_language":
        from polycnc.messages.catalogue import set_language

        return set_language
    if name == "__version__":
        from polycnc.version import __version__

        return __version__
    if name == "VirtualControl":
        from polycnc.mainrun import VirtualControl

        return VirtualControl
    if name in __all__:
        from polycnc import session

        return getattr(session, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
