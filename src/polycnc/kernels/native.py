"""The shared object that lies in this installation: kernels as machine code, made when it was built.

No compiler is needed when it runs, and only this file is ever loaded. A source tree has one of its own, made by
`make kernels`.
"""

from __future__ import annotations

import os
import sys
from functools import cache

from polycnc.deferred.paths import package_path
from polycnc.kernels.c_types import SharedObject

#: Where this variable of the environment says `python`, kernels run as they are written.
CHOICE, PLAIN = "POLYCNC_KERNELS", "python"
_SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
FILE = package_path("kernels", f"compiled{_SUFFIX}")


class Lack:
    """Why kernels run as they are written, as texts for users name it."""

    CHOSEN = "chosen"  # by the environment
    MISSING = "missing"  # polycnc was built without
    STALE = "stale"  # the sources have changed since


@cache
def load(file: str) -> SharedObject | None:
    """A shared object; None where there is none, none that can be loaded here, or where plain kernels are chosen."""
    try:
        return SharedObject(file) if is_wanted() and _is_whole(file) else None
    except OSError:
        return None


def _is_whole(file: str) -> bool:
    """Whether a file of ELF is as long as its head says: one that is cut short would end the process that loads it."""
    with open(file, "rb", 0) as opened:  # noqa: PTH123 - `pathlib` takes a twentieth of a short run to load
        head, size = opened.read(64), opened.seek(0, os.SEEK_END)
    if head[:6] != b"\x7fELF\x02\x01":  # 64 bit, the least significant byte first
        return True
    sections, each, count = (
        int.from_bytes(head[at:end], "little") for at, end in ((40, 48), (58, 60), (60, 62))
    )
    return len(head) == 64 and sections + each * count <= size


def is_wanted() -> bool:
    """Whether nobody chose plain kernels."""
    return os.environ.get(CHOICE) != PLAIN
