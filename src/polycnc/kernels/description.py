"""What a shared object says of a library in it: its kernels, what they take, and the sources that they were made of.

It is a text, a zero behind it, and the contents of the sources one behind the other:

    lay (BIddii)#d#d(ddq)d(**d)        a kernel, and what it takes

    polycnc/motion/kernels/lay.py 4711  a source, by its path from the root, and how many bytes it has

What a kernel takes is told by a sign each: an array by the type of its items, as for `array.array`, else as below; a
group of arguments, which is a tuple in Python, stands in brackets. So nobody needs the sources to call a kernel, and to
know whether it is made of those that are there, it is enough to read them: to compare bytes costs a program less than
any digest, and no two sources are ever taken for each other.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.c_types import Text, contents

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.kernels.c_types import SharedObject

#: Signs of bytes that are only read, a record, a whole number and another one.
TEXT, RECORD, INTEGER, NUMBER = "$", "*", "#", "."


class Description:
    """Of a library in a shared object that is loaded.

    Args:
        code: The shared object.
        symbol: Name of the description in it.

    Attributes:
        signatures: By the name of each kernel, what it takes.

    Raises:
        ValueError: There is none.
    """

    def __init__(self, code: SharedObject, symbol: str) -> None:
        place = code.address(symbol)
        text = Text(place).value
        kernels, _, sources = text.decode("ascii").partition("\n\n")
        self.signatures: Mapping[str, str] = dict(line.split(" ") for line in kernels.split("\n"))
        self._sources = [line.split(" ") for line in sources.split("\n")]
        self._place = place + len(text) + 1

    def fits(self, root: str) -> bool:
        """Whether the sources that lie below a folder are those."""
        known, place = contents(self._place, sum(int(size) for _, size in self._sources)), 0
        for name, size in self._sources:
            try:
                with open(f"{root}/{name}", "rb", buffering=0) as file:  # noqa: PTH123  # `Path` takes twice as long
                    found = file.read()
            except OSError:
                return False
            if len(found) != int(size) or not known.startswith(found, place):
                return False
            place += len(found)
        return True


def description(signatures: Mapping[str, str], sources: Mapping[str, bytes]) -> bytes:
    """What the object holds: by the name of each kernel what it takes, by the name of each source its contents."""
    kernels = "\n".join(f"{name} {taken}" for name, taken in signatures.items())
    files = "\n".join(f"{name} {len(content)}" for name, content in sources.items())
    return b"\0".join((f"{kernels}\n\n{files}".encode("ascii"), b"".join(sources.values())))
