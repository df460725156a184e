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
#: Bytes of the head of an ELF file, and what systems write of a file at a time; so many of these are read together.
_HEAD, _PAGE, _PAGES = 64, 4096, 16


class Lack:
    """Why kernels run as they are written, as texts for users name it."""

    CHOSEN = "chosen"  # by the environment
    MISSING = "missing"  # polycnc was built without
    STALE = "stale"  # the sources have changed since


@cache
def load(file: str) -> SharedObject | None:
    """A shared object; None where there is none, none that can be loaded here, or where plain kernels are chosen."""
    try:
        return SharedObject(file) if is_wanted() and is_whole(file) else None
    except OSError:
        return None


def is_whole(file: str) -> bool:
    """Whether a file of ELF has all that its head says, and no page that was never written.

    The loader of the system believes what it reads: it would end the process, or run zeros. An interrupted copy, a
    full disk or a lost power supply leave such files: without their end, or with pages of zeros. The loaders of other
    systems look themselves.

    Raises:
        OSError: It cannot be read.
    """
    with open(file, "rb", 0) as opened:  # noqa: PTH123 - `pathlib` takes a twentieth of a short run to load
        head, size = opened.read(_HEAD), opened.seek(0, os.SEEK_END)
        if head[:6] != b"\x7fELF\x02\x01":  # 64 bit, the least significant byte first
            return True
        begin, each, count = (
            int.from_bytes(head[at:end], "little") for at, end in ((40, 48), (58, 60), (60, 62))
        )
        end = begin + each * count  # of the table of sections, which stands behind everything
        if size < max(end, _HEAD) or count == 0:
            return False
        opened.seek(end - each)
        if not any(opened.read(each)):
            return False
        opened.seek(0)
        zeros, pages = (
            bytes(_PAGE),
            bytearray(_PAGES * _PAGE),
        )  # the same memory: new memory takes longer than to read
        while count := opened.readinto(pages):
            if any(pages.startswith(zeros, at) for at in range(0, count - _PAGE + 1, _PAGE)):
                return False
    return True


def is_wanted() -> bool:
    """Whether nobody chose plain kernels."""
    return os.environ.get(CHOICE) != PLAIN
