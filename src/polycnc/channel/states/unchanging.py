"""Classes whose objects a snapshot does not follow. Apart from `snapshot`, which few runs need."""

from __future__ import annotations

from polycnc.deferred.typing import TypeVar

_Class = TypeVar("_Class", bound=type)
#: Classes of which `unchanging` has said so.
UNCHANGING: set[type] = set()


def unchanging(cls: _Class) -> _Class:
    """Class decorator: snapshots do not follow its objects. They do not change, are a cache, or lie outside."""
    UNCHANGING.add(cls)
    return cls
