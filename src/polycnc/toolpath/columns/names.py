"""The columns of a table of rows, and a record by them."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from polycnc.toolpath.trace import Display, Record

#: Columns that stand before the positions, and behind them. Values of events go into the last ones.
FIRST = ("type", "program", "line", "unit")
NUMBERS = ("feed", "turns", "seconds", "revolutions", "lead", "start_angle", "speed", "spindle")
TEXTS = ("code", "tool", "text")
#: Columns of few names.
NAMES = ("type", "program", "unit")
#: Prefixes of the columns of positions.
POSITIONS: tuple[tuple[Literal["to", "machine", "center"], str], ...] = (
    ("to", ""),
    ("machine", "machine_"),
    ("center", "center_"),
)
_NOWHERE: dict[str, float] = {}


def table_columns(display: Display) -> tuple[str, ...]:
    """Names of the columns: positions as `x`, `machine_x`, `center_x`.

    Where the work display calls an axis otherwise (Y of TRANSMIT, X of GEOAX), its value stands under that name.
    """
    positions = [name for key, _ in POSITIONS for name in positions_of(key, display)]
    return (*FIRST, *positions, *NUMBERS, *TEXTS)


def positions_of(key: Literal["to", "machine", "center"], display: Display) -> list[str]:
    """Names of the columns of one kind of positions; the work display may call an axis by several."""
    prefix = dict(POSITIONS)[key]
    return [prefix + name.lower() for name in (display.axes if key == "machine" else display.names)]


def flattened(record: Record) -> dict[str, object]:
    """A record with its positions as columns of their own."""
    flat: dict[str, object] = {key: value for key, value in record.items() if not isinstance(value, dict)}
    for key, prefix in POSITIONS:
        for axis, value in record.get(key, _NOWHERE).items():
            flat[prefix + axis.lower()] = value
    return flat
