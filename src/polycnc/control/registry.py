"""The controls that polycnc knows, by id. A control's tables are imported when it is first asked for."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.modules import import_module
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.interface import Control

#: Control id to module and class.
_CONTROLS = {
    "syntec-mill": ("polycnc.control.syntec.control", "SyntecMill"),
    "fanuc-m": ("polycnc.control.fanuc.milling.control", "FanucMilling"),
    "meldas-m": ("polycnc.control.meldas.milling", "MeldasMilling"),
    "sinumerik-840d": ("polycnc.control.sinumerik.control", "Sinumerik"),
    "fanuc-0i-tf": ("polycnc.control.fanuc.lathe.control", "FanucTurning"),
}


def ids() -> tuple[str, ...]:
    """Ids of all controls."""
    return tuple(_CONTROLS)


@cache
def control(control_id: str) -> Control:
    """The control with an id; raises `KeyError` for an unknown one."""
    module, name = _CONTROLS[control_id]
    made: Control = getattr(import_module(module), name)()
    return made
