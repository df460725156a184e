"""What a row in the tables of system variables is made of."""

from __future__ import annotations

from collections.abc import Callable

from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Ints, axes or frame components (text) as programmed.
Indices: TypeAlias = tuple[Any, ...]
Reader: TypeAlias = Callable[["SinumerikChannel", Indices], Any]
Writer: TypeAlias = Callable[["SinumerikChannel", Indices, Any], None]
#: Type, how it is read, and how it is written where it can be.
Row: TypeAlias = tuple[Type, Reader, Writer | None]
#: The same with whether it belongs to the main run: the program waits for that.
RowWithStop: TypeAlias = tuple[Type, Reader, Writer | None, bool]
