"""Kernels that are compiled together, when polycnc is built.

Their machine code is good for one version of their sources, which lies beside it in the shared object.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from polycnc.deferred.modules import import_module
from polycnc.deferred.paths import package_path, parent_of
from polycnc.kernels import native

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import ModuleType

    from polycnc.kernels.description import Description

#: Where the packages lie of whose modules the names of libraries are.
_ROOT = parent_of(package_path())


class Library:
    """Kernels that are compiled together.

    They are named only: where there is machine code, nobody imports their modules to run them.

    Args:
        name: Of the library.
        modules: Modules with the functions that they rest on, by name.
        kernels: The functions that Python calls, by module and name. Their annotations say what they take (`layout`);
            they give a whole number or nothing. No two kernels of any libraries have one name.
        inline: Every call is replaced by what it calls.
        file: Shared object with their machine code; that of this installation where it is left out.
        root: Folder of the outermost packages.
    """

    def __init__(
        self,
        name: str,
        modules: Sequence[str],
        kernels: Sequence[str],
        *,
        inline: bool = False,
        file: str = native.FILE,
        root: str = _ROOT,
    ) -> None:
        self.name, self.module_names, self.inline, self.root = name, modules, inline, root
        self.symbol = f"about_{name}"
        self._file = file
        self._homes = {name: home for home, _, name in (kernel.rpartition(".") for kernel in kernels)}
        self._callers: dict[str, Callable[..., Any]] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the kernels."""
        return tuple(self._homes)

    @property
    def modules(self) -> list[ModuleType]:
        """The modules, imported."""
        return [import_module(name) for name in self.module_names]

    @cached_property
    def lack(self) -> str | None:
        """Why there is no machine code (`native.Lack`); None where there is."""
        if native.load(self._file) is None:
            return native.Lack.MISSING if native.is_wanted() else native.Lack.CHOSEN
        described = self._described
        if described is None or [*described.signatures] != [*self._homes] or not described.fits(self.root):
            return native.Lack.STALE
        return None

    @cached_property
    def _described(self) -> Description | None:
        """What the shared object says of the library; None where it was made before there was this one."""
        from polycnc.kernels.description import Description

        code = native.load(self._file)
        try:
            return None if code is None else Description(code, self.symbol)
        except ValueError:
            return None

    def plain(self, name: str) -> Callable[..., Any]:
        """A kernel as it is written."""
        found: Callable[..., Any] = getattr(import_module(self._homes[name]), name)
        return found

    def compiled(self, name: str) -> Callable[..., Any] | None:
        """A kernel as machine code, called like the plain one; None where there is none.

        Its arrays are `array.array`; they must not grow while it runs.
        """
        code, described = native.load(self._file), self._described
        if self.lack is not None or code is None or described is None:
            return None
        if name not in self._callers:
            from polycnc.kernels.call import caller

            self._callers[name] = caller(code.function(name), described.signatures[name])
        return self._callers[name]

    def kernel(self, name: str) -> Callable[..., Any]:
        """A kernel as machine code, or the plain one where there is none."""
        return self.compiled(name) or self.plain(name)
