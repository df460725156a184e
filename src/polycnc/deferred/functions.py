"""Functions whose modules are loaded when the first of them is called.

A table of a control names functions of most of its modules, and a short program calls few of them. Modules that only a
table names are imported by ordinary statements within `loaded_when_called`:

    with loaded_when_called():
        from polycnc.control.word_address.motion import nurbs, skip

    ROWS = table(GCode("G31", handler=skip.skip_or_torque_move), ...)

There `skip.skip_or_torque_move` is a `Deferred`: it loads `skip` when it is called, compared, or asked what a function
knows of itself, and then stands for the function. A class can be imported so too, to make objects or to call a method
of the class. Constants are not to be had: they stand in a module that is loaded. What else is not to be done with
these names, a test finds.
"""

from __future__ import annotations

import builtins
import sys
from _thread import RLock
from types import MethodType, SimpleNamespace

from polycnc.deferred.modules import import_module
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Deferred", "loaded_when_called"]


class Deferred:
    """Stands for a function or a class of a module, by its name; loads the module when that is needed."""

    __slots__ = ("_module", "_name", "function")

    def __init__(self, module: str, name: str) -> None:
        self._module, self._name = module, name

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """The function does it."""
        return self.function(*arguments, **named)

    def __getattr__(self, name: str) -> Any:
        if name != "function":
            return getattr(self.function, name)
        found = _function(self._module, self._name)
        self.function: Any = found
        return found

    def __get__(self, thing: object, _owner: type | None = None) -> Any:
        return self if thing is None else MethodType(self, thing)

    def __instancecheck__(self, thing: object) -> bool:
        return isinstance(thing, self.function)

    def __eq__(self, other: object) -> bool:
        return bool(self.function == (other.function if isinstance(other, Deferred) else other))

    def __hash__(self) -> int:
        return hash(self.function)

    def __repr__(self) -> str:
        return f"<{self._module}.{self._name}, loaded when called>"

    def __reduce__(self) -> tuple[object, ...]:
        return _function, (self._module, self._name)

    @property
    def __module__(self) -> str:  # type: ignore[override]  # of the function, where the library has that of a class
        return self._module

    @property
    def __doc__(self) -> str | None:  # type: ignore[override]
        return self.function.__doc__  # type: ignore[no-any-return]


def _function(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


class _DeferredModule:
    """Stands for a module of functions; keeps what stands for each."""

    def __init__(self, module: str) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Deferred:
        if name.startswith("_"):  # what the library asks of everything that it copies, unwraps or describes
            raise AttributeError(name)
        if name.isupper():
            raise AttributeError(
                f"{self._module} is loaded when it is called: {name} is no function and no class"
            )
        found = self.__dict__[name] = Deferred(self._module, name)
        return found


#: What stands for modules, by their names: a function has one that stands for it, whoever names it.
_MODULES: dict[str, _DeferredModule] = {}
#: Held while statements of a module import what is loaded later: only one may have put its `__import__` in place.
_LOCK = RLock()


class loaded_when_called:  # noqa: N801 - it reads as what holds within the statement
    """Within it `from … import …` of the module that says so gives what is loaded when it is called."""

    __slots__ = ("_before", "_names")

    def __enter__(self) -> None:
        _LOCK.acquire()
        self._names = sys._getframe(1).f_globals  # noqa: SLF001 - the module whose statement this is
        self._before = builtins.__import__
        builtins.__import__ = self._import  # type: ignore[assignment]  # it gives what stands for a module

    def __exit__(self, *_raised: object) -> None:
        builtins.__import__ = self._before
        _LOCK.release()

    def _import(
        self,
        name: str,
        names: dict[str, object] | None = None,
        local: dict[str, object] | None = None,
        wanted: Sequence[str] | None = (),
        level: int = 0,
    ) -> Any:
        if names is not self._names:  # another module that another thread loads
            return self._before(name, names, local, wanted or (), level)
        if level or not wanted:
            raise ImportError("what is loaded when called is told by `from … import …`")
        return SimpleNamespace(**{each: _found(name, each) for each in wanted})


def _found(place: str, name: str) -> Any:
    """What stands for a module of a package, or for a class of a module: classes alone have capitals."""
    if not name.islower():
        return getattr(_found(*place.rsplit(".", 1)), name)
    module = f"{place}.{name}"
    return _MODULES.get(module) or _MODULES.setdefault(module, _DeferredModule(module))
