"""The kernel of compensation as machine code."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

_KERNELS = "polycnc.compensation.runs.kernels"
LIBRARY = Library("compensation", (_KERNELS,), (f"{_KERNELS}.lead",), inline=True)


def lead() -> Callable[..., int]:
    """What leads moves through a window: machine code, or the same as it is written."""
    return LIBRARY.kernel("lead")
