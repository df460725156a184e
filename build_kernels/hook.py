"""The build hook: compiles the kernels into the wheel, or leaves them out where nothing here can compile or link them.

An editable installation gets them too, in its source tree. A wheel without them is pure: it runs everywhere, gives the
same results, and takes its time.
"""

from __future__ import annotations

import os
import platform
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.config import BuilderConfig
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "src")]

from build_kernels.linker import ZIG, system_linker  # noqa: E402

NUMBA = "numba>=0.61"
#: Where this variable of the environment is set, the wheel is built without machine code, for any platform.
PURE = "POLYCNC_PURE"
#: Where Numba comes ready made, by the names of Python for systems and processors.
_NUMBA_FOR = {
    ("Linux", "x86_64"), ("Linux", "aarch64"), ("Darwin", "arm64"), ("Windows", "AMD64"),
}  # fmt: skip


class KernelHook(BuildHookInterface[BuilderConfig]):
    """Is called by Hatchling for every wheel, an editable one too."""

    def dependencies(self) -> list[str]:
        """What the build needs here: Numba, and a linker where there is none."""
        if not _compiles():
            return []
        return [NUMBA] if system_linker() else [NUMBA, ZIG]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Put the shared object into the wheel."""
        from packaging.tags import platform_tags

        if not _compiles():
            return
        from build_kernels import shared_object
        from polycnc.kernels import native

        os.environ.pop(native.CHOICE, None)  # is about running
        if not shared_object.is_current():
            try:
                shared_object.make()
            except Exception as error:  # noqa: BLE001 - whatever a newer compiler trips over: a pure wheel runs, too
                self.app.display_warning(f"polycnc is built without compiled kernels: {error}")
                return
        if version == "editable":
            return  # the source tree has them
        build_data["artifacts"].append(f"/{Path(native.FILE).relative_to(ROOT).as_posix()}")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{next(platform_tags())}"


def _compiles() -> bool:
    """Whether Numba exists for this platform, and nobody asked for a pure wheel."""
    if os.environ.get(PURE):
        return False
    if platform.system() == "Linux" and platform.libc_ver()[0] != "glibc":
        return False
    return (platform.system(), platform.machine()) in _NUMBA_FOR
