"""Finds and loads the modules of polycnc itself, of which a short run needs two hundred.

The library looks for a module by lists of what the folders of a path hold, and reads its byte code in a dozen calls of
the system: a sixth of a short run. Where a module of ours lies follows from its name, and one call reads it. Whatever
else can be is the library's: byte code that is missing, stale, elsewhere or told by a hash, an archive or a frozen
program that has no such files, a module that is not there.

The module itself is what stands in `sys.meta_path`, behind all finders that others have put before those of the
library. The command line installs it in its own process; where polycnc is imported, nothing is changed.
"""

from __future__ import annotations

import marshal
import os
import sys
from _frozen_importlib import BuiltinImporter, ModuleSpec
from _frozen_importlib_external import MAGIC_NUMBER, SourceFileLoader  # `importlib` itself would load more
from types import ModuleType

TYPE_CHECKING = False  # for type checkers true
if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import CodeType

__all__ = ["find_spec", "install"]
_PACKAGE = f"{__name__.partition('.')[0]}."
#: How byte code begins that holds for one time and size of its source, four bytes each, which follow.
_BEGIN = MAGIC_NUMBER + bytes(4)
_HEAD = len(_BEGIN) + 8
#: So many bytes are read of a file, more than any of ours has.
_MOST = 1 << 16
_FLAGS = os.O_RDONLY | getattr(os, "O_BINARY", 0)
_CACHE = f"{os.sep}__pycache__{os.sep}"
_LEVEL = f".opt-{sys.flags.optimize}" if sys.flags.optimize else ""
_ENDING = f".{sys.implementation.cache_tag}{_LEVEL}.pyc"


def install() -> None:
    """Let imports of this process find modules of polycnc here."""
    own = sys.modules[__name__]
    if own not in sys.meta_path and BuiltinImporter in sys.meta_path and sys.implementation.cache_tag:
        sys.meta_path.insert(sys.meta_path.index(BuiltinImporter), own)


def find_spec(
    name: str,
    path: Sequence[str] | None = None,
    target: ModuleType | None = None,  # noqa: ARG001 - what a finder is given
) -> ModuleSpec | None:
    """Where a module of polycnc lies; None for other names, and where the library has to look.

    Args:
        name: Full name of the module.
        path: Folders of the package that it is in.
        target: What is loaded once more; makes no difference.
    """
    if not name.startswith(_PACKAGE) or path is None or len(path) != 1 or sys.pycache_prefix is not None:
        return None
    folder, stem = path[0], name.rpartition(".")[2]
    if not stem.islower():  # some systems would find it, though no module has such a name
        return None
    inner = f"{folder}{os.sep}{stem}"
    is_package = os.access(f"{inner}{os.sep}__init__.py", os.F_OK)
    if is_package:
        folder, stem = inner, "__init__"
    file = f"{folder}{os.sep}{stem}.py"
    if not is_package and not os.access(file, os.F_OK):
        return None
    spec = ModuleSpec(name, _Loader(name, file), origin=file, is_package=is_package)
    if spec.submodule_search_locations is not None:
        spec.submodule_search_locations.append(inner)
    spec.has_location = True
    spec.cached = f"{folder}{_CACHE}{stem}{_ENDING}"
    return spec


class _Loader(SourceFileLoader):
    """The library's, with a shorter way to byte code that is as it usually is."""

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """The module with what the library would ask it for, which takes an error for each that it does not have."""
        made = ModuleType(spec.name)
        made.__file__ = self.path
        made.__cached__ = spec.cached  # type: ignore[attr-defined]
        if spec.submodule_search_locations is not None:
            made.__path__ = spec.submodule_search_locations
        return made

    def get_code(self, fullname: str) -> CodeType | None:
        """The byte code of the module.

        Raises:
            ImportError: It is not the name of this module.
            SyntaxError: As for the library, as all else that it raises.
        """
        return self._byte_code() or super().get_code(fullname)

    def _byte_code(self) -> CodeType | None:
        """What lies beside the source, where it was made of it; None where the library has to look."""
        folder, _, file = self.path.rpartition(os.sep)
        try:
            number = os.open(f"{folder}{_CACHE}{file[:-3]}{_ENDING}", _FLAGS)
            try:
                data = os.read(number, _MOST)
            finally:
                os.close(number)
            source = os.stat(self.path)  # noqa: PTH116 - no path of the library is loaded yet
            time, size = int(source.st_mtime) & 0xFFFF_FFFF, source.st_size & 0xFFFF_FFFF
            if data[:_HEAD] != _BEGIN + time.to_bytes(4, "little") + size.to_bytes(4, "little"):
                return None
            code = marshal.loads(memoryview(data)[_HEAD:])
        except (OSError, EOFError, ValueError, TypeError):
            return None
        return code if getattr(code, "co_filename", "") == self.path else None  # else the folder has moved
