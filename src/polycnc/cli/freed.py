"""What becomes of memory that a run frees."""

from __future__ import annotations

import sys

from polycnc.deferred.contexts import suppress
from polycnc.kernels.c_types import SharedObject

#: `mallopt` of the GNU C library: from which size on a piece of memory is a mapping of its own, and how much may lie
#: free at the end of the heap; the most that it takes for the first.
_MMAP_THRESHOLD, _TRIM_THRESHOLD = -3, -1
_LARGEST_MMAP_THRESHOLD, _MOST_FREE = 32 << 20, 128 << 20


def keep_freed_memory() -> None:
    """Let the process keep what it frees, for the next page, chunk or plan: to get it anew costs a tenth of a long run.

    The system fills each of its pages with zeros again. Other C libraries are left as they are.
    """
    if sys.platform == "linux":
        with suppress(AttributeError):
            mallopt = SharedObject(None).function("mallopt")
            mallopt(_MMAP_THRESHOLD, _LARGEST_MMAP_THRESHOLD)
            mallopt(_TRIM_THRESHOLD, _MOST_FREE)
