"""The kernel of compensation as machine code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.compensation.runs import kernels
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

LIBRARY = Library("compensation", (kernels,), (kernels.lead,), inline=True)


def lead() -> Callable[..., int]:
    """What leads moves through a window: machine code, or the same as it is written."""
    return LIBRARY.compiled(kernels.lead) or kernels.lead
