"""All kernels of polycnc as one shared object in the source tree."""

from __future__ import annotations

import platform
from hashlib import sha256
from importlib import import_module
from importlib.metadata import version
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

#: Object code as last made, each in a file named by all it was made of.
KEPT = Path(__file__).resolve().parents[1] / "build" / "kernels"


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
    compiler = _compiler()
    KEPT.mkdir(parents=True, exist_ok=True)
    files = [_object_file(library, text, compiler) for library, text in about]
    link(files, Path(native.FILE))
    for file in set(KEPT.iterdir()) - set(files):
        file.unlink(missing_ok=True)


def _object_file(library: Library, about: bytes, compiler: bytes) -> Path:
    """Where the object code of a library is: who changes one kernel does not wait for those of other libraries."""
    of = [compiler, library.symbol.encode(), bytes([library.inline]), about]
    file = KEPT / f"{sha256(b' '.join(of)).hexdigest()}.o"
    if not file.exists():
        made = file.with_suffix(".new")  # whole or not at all
        made.write_bytes(object_code(library, about))
        made.replace(file)
    return file


def _compiler() -> bytes:
    """What object code depends on beside its sources."""
    own = [file.read_bytes() for file in sorted(Path(__file__).parent.glob("*.py"))]
    tools = (
        platform.system(),
        platform.machine(),
        platform.python_version(),
        version("numba"),
        version("llvmlite"),
    )
    return " ".join(tools).encode() + b"".join(own)
