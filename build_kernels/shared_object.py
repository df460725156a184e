"""All kernels of polycnc as one shared object in the source tree."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from build_kernels.compiler import described, object_code
from build_kernels.linker import link
from polycnc.kernels import native
from polycnc.kernels.library import Library

#: Modules with a `LIBRARY`.
MODULES = (
    "polycnc.compensation.runs.compiled",
    "polycnc.language.bulk.compiled",
    "polycnc.motion.compiled",
    "polycnc.motion.explain.compiled",
    "polycnc.motion.third_order.compiled",
    "polycnc.motion.third_order.laws.compiled",
    "polycnc.parquet.compiled",
    "polycnc.toolpath.columns.compiled",
    "polycnc.toolpath.compiled",
)


def libraries() -> list[Library]:
    """What is compiled."""
    found: list[Library] = [import_module(name).LIBRARY for name in MODULES]
    return found


def is_current() -> bool:
    """Whether the shared object is there, fits its sources, and was made by this compiler."""
    if any(library.lack is not None for library in libraries()):
        return False
    made = Path(native.FILE).stat().st_mtime
    return all(file.stat().st_mtime <= made for file in Path(__file__).parent.glob("*.py"))


def make() -> None:
    """Compile and link.

    Raises:
        ImportError: Numba is not installed.
        OSError: No linker, or no place to write to.
        subprocess.CalledProcessError: The linker refuses.
    """
    about = [(library, described(library)) for library in libraries()]  # before minutes pass
    link([object_code(library, text) for library, text in about], Path(native.FILE))
