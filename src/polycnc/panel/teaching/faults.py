"""Faults that a teacher puts into a machine."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.machine.plc import PlcAlarm
from polycnc.machine.rules import signals_in
from polycnc.machine.text import Text
from polycnc.mainrun import CommandRefused
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.machine.model import Machine
    from polycnc.mainrun import VirtualControl


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault: the signals that stand for it, and the alarm of a machine whose own controller looks at none of them."""

    id: str
    name: Mapping[str, str]
    signals: Mapping[str, float]
    code: str
    when: tuple[str, ...]
    cause: Mapping[str, str]
    remedy: Mapping[str, str]

    def alarms(self) -> tuple[PlcAlarm, ...]:
        """The rows of its alarm."""
        name, cause, remedy = (
            Text(each["en"], each["zh-TW"]) for each in (self.name, self.cause, self.remedy)
        )
        return tuple(PlcAlarm(self.code, when, text=name, cause=cause, remedy=remedy) for when in self.when)

    def is_in(self, control: VirtualControl) -> bool:
        """Whether a machine has it now."""
        return all(control.signals[name] == value for name, value in self.signals.items())


@cache
def faults() -> Mapping[str, Fault]:
    """All faults by their ids."""
    content = resources.files("polycnc.panel.teaching").joinpath("faults.toml").read_text(encoding="utf-8")
    rows: list[dict[str, Any]] = tomllib.loads(content)["fault"]
    return {row["id"]: Fault(**{**row, "when": tuple(row["when"])}) for row in rows}


def with_faults(machine: Machine, control: str) -> Machine:
    """A machine that answers to every fault, on a control: with its own alarms, or with those of the faults."""
    plc = machine.plc(control)
    seen = {name for row in plc.alarms for name in signals_in(row.when)}
    more = [row for fault in faults().values() if not seen & fault.signals.keys() for row in fault.alarms()]
    return replace(machine, alarms=(*machine.alarms, *more))


def inject(control: VirtualControl, name: str, *, on: bool = True) -> None:
    """Put a fault into a machine, or take it away.

    Raises:
        CommandRefused: There is no such fault.
    """
    if name not in faults():
        raise CommandRefused("mainrun.value", name="fault", allowed=listed(faults()), value=name)
    for signal, value in faults()[name].signals.items():
        control.signals[signal] = value if on else 0.0
