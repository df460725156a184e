"""Regular expressions that are compiled when they are first used."""

from __future__ import annotations

import re

from polycnc.deferred.typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from re import RegexFlag
    from typing import AnyStr

#: What a compiled one has, beside its source.
_MEMBERS = (
    "match", "fullmatch", "search", "split", "findall", "finditer", "sub", "subn", "flags", "groups", "groupindex",
)  # fmt: skip


def regex(pattern: AnyStr, flags: int | RegexFlag = 0) -> re.Pattern[AnyStr]:
    """As `re.compile`. A mistake in `pattern` shows when it is first used."""
    return cast("re.Pattern[AnyStr]", Regex(pattern, flags))


class Regex:
    """It finds a method missing once; from then on it has those of the compiled one as its own."""

    __slots__ = ("_wanted", "pattern", *_MEMBERS)

    def __init__(self, pattern: str | bytes, flags: int) -> None:
        self.pattern = pattern
        self._wanted = flags

    def __getattr__(self, name: str) -> Any:
        if name not in _MEMBERS:
            raise AttributeError(name)
        compiled = re.compile(self.pattern, self._wanted)
        for member in _MEMBERS:
            setattr(self, member, getattr(compiled, member))
        return getattr(compiled, name)

    def __reduce__(self) -> tuple[Any, ...]:
        return Regex, (self.pattern, self._wanted)
