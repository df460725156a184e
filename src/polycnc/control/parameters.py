"""The parameters of a control that polycnc reads: their numbers, meaning and delivered values."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from polycnc.machine.setup.values import parameter_key

if TYPE_CHECKING:
    from polycnc.machine.setup.values import ParameterKey


@dataclass(frozen=True, slots=True)
class KnownParameter:
    """A parameter of the list.

    Attributes:
        name: Number, with `#bit` for a bit.
        texts: Meaning by language.
        unit: Unit of the value, empty for bits and plain numbers.
        delivered: Value that a control has without a setup; None where it depends on the machine.
        by_axis: Every axis has its own value.
    """

    name: str
    texts: dict[str, str]
    unit: str
    delivered: float | None
    by_axis: bool

    @property
    def key(self) -> ParameterKey:
        """The parameter as setups name it, without an axis."""
        return parameter_key(self.name)


def known_parameters(control: object) -> tuple[KnownParameter, ...]:
    """The parameters of a control, in the order of their numbers; none where polycnc has no list."""
    return _load(getattr(control, "parameter_file", ""))


@cache
def _load(name: str) -> tuple[KnownParameter, ...]:
    if not name:
        return ()
    content = files("polycnc.control").joinpath(name).read_text(encoding="utf-8")
    return tuple(
        KnownParameter(
            number,
            {"en": entry["en"], "zh-TW": entry["zh-TW"]},
            entry.get("unit", ""),
            entry.get("delivered", None if entry.get("axis") else 0),
            bool(entry.get("axis")),
        )
        for number, entry in tomllib.loads(content).items()
    )
