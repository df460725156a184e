"""Modules that are named by texts: what `importlib` does, which need not be loaded for it."""

from __future__ import annotations

import sys

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType


def import_module(name: str) -> ModuleType:
    """The module of a full name, imported."""
    __import__(name)
    return sys.modules[name]


def is_installed(library: str) -> bool:
    """Whether there is a library, which is not imported."""
    from importlib.util import find_spec

    return find_spec(library) is not None
