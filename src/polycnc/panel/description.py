"""What stands on an operator panel: keys, lamps, switches, the mode switch, MDI units; read from data."""

from __future__ import annotations

import tomllib
from functools import cached_property
from importlib import resources

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.machine.rules import condition_of
from polycnc.mainrun.commands.states import Mode

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.machine.rules import Values

#: Files of a control's panel; of two rows with an id the later counts.
PANELS = {
    "fanuc-m": ("hartford.toml", "fanuc-m.toml"),
    "meldas-m": ("hartford.toml", "meldas-m.toml"),
    "fanuc-0i-tf": ("standard.toml", "fanuc-0i-tf.toml"),
    "sinumerik-840d": ("standard.toml", "sinumerik-840d.toml"),
    "syntec-mill": ("standard.toml", "syntec-mill.toml"),
}
#: Mark of an axis that is back at its restart position (Hartford 5.2.4.8 f: the figure has RP, the text PR).
RETURNED = "RP"


def is_returned(left: float) -> bool:
    """Whether an axis with this way left (mm, degrees) is back at its restart position."""
    return abs(left) <= 1e-3


@dataclass(frozen=True)
class Lamp:
    """A lamp, of its own or in a key.

    Attributes:
        id: The manual's name of it.
        name: What it says, by language.
        when: Condition over the signals under which it is on; empty for never.
        blinks: Condition under which it blinks.
        codes: Alarms that switch it on.
    """

    id: str
    name: Mapping[str, str]
    when: str = ""
    blinks: str = ""
    codes: tuple[str, ...] = ()

    def is_on(self, value: Values) -> bool:
        """Whether its condition holds."""
        return bool(self.when) and condition_of(self.when)(value)

    def is_blinking(self, value: Values) -> bool:
        """Whether it blinks."""
        return bool(self.blinks) and condition_of(self.blinks)(value)


@dataclass(frozen=True)
class Key(Lamp):
    """A key, with the lamp in it where it has one.

    Attributes:
        switch: Panel switch that it turns over.
        signal: Signal that it turns over; one that acts while it is held gives it so long.
        command: What the control does.
        hold: It acts as long as it is pressed.
        safety: It acts only together with the safety key.
        modes: Positions of the mode switch where it acts; empty for all.
    """

    switch: str = ""
    signal: str = ""
    command: str = ""
    hold: bool = False
    safety: bool = False
    modes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Switch:
    """A rotary or key switch: its positions, and what each of them means.

    Attributes:
        rights: What its positions mean is the protection level that programs have.
    """

    id: str
    name: Mapping[str, str]
    positions: tuple[str, ...]
    values: tuple[float, ...]
    start: str
    signal: str = ""
    rights: bool = False

    def value(self, position: str) -> float:
        """What a position means; raises `ValueError` where there is none of that name."""
        return self.values[self.positions.index(position)]


@dataclass(frozen=True)
class ModePosition:
    """A position of the mode switch, and the mode of the control that it stands for.

    Attributes:
        signal: A signal that is on in this position; empty for none.
    """

    id: str
    name: Mapping[str, str]
    mode: Mode
    signal: str = ""


@dataclass(frozen=True)
class MdiUnit:
    """A display with its keys.

    Attributes:
        soft_keys: Soft keys below it.
        label: What stands on the key that chooses it; empty for its inches.
        side_keys: Soft keys at its side, where a chapter's pages stand then; 0 for none.
    """

    id: str
    name: Mapping[str, str]
    inches: float
    soft_keys: int
    keys: tuple[str, ...]
    side_keys: int = 0
    label: str = ""

    @property
    def short(self) -> str:
        """What stands on the key that chooses it."""
        return self.label or f"{self.inches:g}″"


@dataclass(frozen=True)
class PanelDescription:
    """All that stands on a panel, each by its id."""

    keys: Mapping[str, Key]
    lamps: Mapping[str, Lamp]
    switches: Mapping[str, Switch]
    modes: Mapping[str, ModePosition]
    mdi_units: tuple[MdiUnit, ...]

    @cached_property
    def lights(self) -> Mapping[str, Lamp]:
        """Every lamp, those in the keys too."""
        in_keys = {key.id: key for key in self.keys.values() if key.when}
        return {**in_keys, **self.lamps}


def describe(control: str, axes: Sequence[str]) -> PanelDescription:
    """The panel of a control whose machine has these axes; raises `KeyError` where polycnc knows none."""
    tables: dict[str, list[dict[str, Any]]] = {"key": [], "lamp": [], "switch": [], "mdi_unit": []}
    modes: dict[str, ModePosition] = {}
    for file in PANELS[control]:
        data = tomllib.loads(resources.files("polycnc.panel").joinpath(file).read_text(encoding="utf-8"))
        for kind, rows in tables.items():
            rows += data.get(kind, [])
        for name, row in data.get("mode", {}).items():
            names = {k: row[k] for k in ("en", "zh-TW")}
            modes[name] = ModePosition(name, names, Mode(row["mode"]), row.get("signal", ""))
    lamps = [lamp for row in tables["lamp"] if (lamp := _lamp(row, axes)) is not None]
    return PanelDescription(
        keys={row["id"]: Key(**_tuples(row)) for row in tables["key"]},
        lamps={lamp.id: lamp for lamp in lamps},
        switches={row["id"]: _switch(row) for row in tables["switch"]},
        modes=modes,
        mdi_units=tuple(MdiUnit(**_tuples(row)) for row in tables["mdi_unit"]),
    )


def _lamp(row: dict[str, Any], axes: Sequence[str]) -> Lamp | None:
    """A lamp; none where it belongs to an axis that the machine has not."""
    names = {f"axis{i}": axis for i, axis in enumerate(axes, 1)}
    try:
        return Lamp(**_tuples({**row, "when": row.get("when", "").format(**names)}))
    except KeyError:
        return None


def _switch(row: dict[str, Any]) -> Switch:
    return Switch(**_tuples(row))


def _tuples(row: dict[str, Any]) -> dict[str, Any]:
    return {name: tuple(value) if isinstance(value, list) else value for name, value in row.items()}
