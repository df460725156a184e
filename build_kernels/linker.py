"""Object code becomes a shared object: by the system's C compiler, or by the one that comes as a Python package."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

#: A C compiler on PyPI, with libraries of every platform: about 100 MB, and only where the system has none.
ZIG = "ziglang>=0.13,<1"


#: What Windows has of the functions of mathematics, from which Python has them, too.
_MATHEMATICS = """LIBRARY api-ms-win-crt-math-l1-1-0.dll
EXPORTS
acos
asin
atan
atan2
cos
cosh
exp
fmod
hypot
log
pow
sin
sinh
tan
tanh
"""


def system_linker() -> str | None:
    """The C compiler of the system, or the one that CC names; never one of Windows, whose linkers differ too much."""
    if platform.system() == "Windows":
        return None
    return shutil.which(os.environ.get("CC") or "cc") or shutil.which("gcc") or shutil.which("clang")


def _command() -> list[str]:
    found = system_linker()
    # What it adds of its own is for any processor, too.
    return [found] if found else [*_zig("cc"), "-mcpu=baseline"]


def _zig(tool: str) -> list[str]:
    return [sys.executable, "-m", "ziglang", tool]


def _mathematics(folder: str) -> str:
    """What the linker takes functions of mathematics from: those of the system that Python calls.

    On Windows the compiler has ones of its own, which round otherwise, and prefers them to those of any `-l`.
    """
    if platform.system() != "Windows":
        return "-lm"
    declared, library = Path(folder, "mathematics.def"), Path(folder, "mathematics.lib")
    declared.write_text(_MATHEMATICS, encoding="ascii")
    subprocess.run([*_zig("dlltool"), "-m", "i386:x86-64", "-d", declared, "-l", library], check=True)
    return str(library)


def link(objects: Sequence[Path], file: Path) -> None:
    """Write a shared object of files with object code, whole or not at all.

    Raises:
        OSError: No linker, or no place to write to.
        subprocess.CalledProcessError: The linker refuses.
    """
    with TemporaryDirectory(dir=file.parent) as folder:
        made = Path(folder, file.name)
        subprocess.run([*_command(), "-shared", "-s", "-o", made, *objects, _mathematics(folder)], check=True)
        made.replace(file)
