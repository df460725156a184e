"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.library import Library
from polycnc.parquet import pages

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
    (pages,),
    (pages.drop_nulls, pages.index_values, pages.pack_places, pages.put_steps),
    inline=True,
)
PLAIN = Kernels._make(LIBRARY.kernels)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    if LIBRARY.lack is not None:
        return PLAIN
    return Kernels._make(map(LIBRARY.compiled, PLAIN))
