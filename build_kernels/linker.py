"""Object code becomes a shared object: by the system's C compiler, or by the one that comes as a Python package."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

#: A C compiler on PyPI, with libraries of every platform: about 100 MB, and only where the system has none.
ZIG = "ziglang>=0.13,<1"


def system_linker() -> str | None:
    """The C compiler of the system, or the one that CC names."""
    return shutil.which(os.environ.get("CC") or "cc") or shutil.which("gcc") or shutil.which("clang")


def _command() -> list[str]:
    found = system_linker()
    return [found] if found else [sys.executable, "-m", "ziglang", "cc"]


def link(objects: Sequence[bytes], file: Path) -> None:
    """Write a shared object, whole or not at all.

    Raises:
        OSError: No linker, or no place to write to.
        subprocess.CalledProcessError: The linker refuses.
    """
    with TemporaryDirectory(dir=file.parent) as folder:
        names = []
        for i, code in enumerate(objects):
            names.append(Path(folder, f"{i}.o"))
            names[-1].write_bytes(code)
        made = Path(folder, file.name)
        subprocess.run([*_command(), "-shared", "-s", "-o", made, *names, "-lm"], check=True)
        made.replace(file)
