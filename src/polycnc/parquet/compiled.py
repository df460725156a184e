"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable


class Kernels(NamedTuple):
    """See `pages`."""

    drop_nulls: Callable[..., int]
    index_values: Callable[..., int]
    pack_places: Callable[..., int]
    put_steps: Callable[..., int]


LIBRARY = Library(
    "parquet",
    ("polycnc.parquet.pages",),
    tuple(f"polycnc.parquet.pages.{name}" for name in Kernels._fields),
    inline=True,
)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return Kernels._make(map(LIBRARY.kernel, Kernels._fields))
