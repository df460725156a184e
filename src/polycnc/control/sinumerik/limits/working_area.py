"""Software limit switches and working areas: targets beyond them raise an alarm before anything moves.

Source: Fundamentals (G25, G26, WALIMON, WALIMOF; WALCS0 to WALCS10), machine data 36100 and 36110, setting data 43400
to 43430, `$P_WORKAREA_CS_…`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.frames.memory import chain
from polycnc.control.sinumerik.variables.row import Indices, Row
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

SWITCH, WORKING_AREA, WORK_SYSTEM_AREA = "10720", "10730", "10735"
_SLACK = 1e-6
#: Data that limits are made of.
DATA = frozenset(
    (
        "$SA_WORKAREA_PLUS_ENABLE",
        "$SA_WORKAREA_MINUS_ENABLE",
        "$SA_WORKAREA_LIMIT_PLUS",
        "$SA_WORKAREA_LIMIT_MINUS",
    )
)


#: Coordinate systems: the machine's, and those of $P_WORKAREA_CS_COORD_SYSTEM, workpiece and settable zero.
MACHINE, WORK, SETTABLE = 0, 1, 3
GROUPS = range(1, 11)
AREA = "$P_WORKAREA_CS_"


class Limit(NamedTuple):
    """The range of an axis in one of the coordinate systems, and the alarm for a target outside it."""

    column: int
    low: float
    high: float
    alarm: str
    system: int = MACHINE


@dataclass(slots=True)
class Ranges(State, lifetime=Lifetime.POWER):
    """The ranges that targets must stay in."""

    limits: tuple[Limit, ...] = ()


def refresh(channel: SinumerikChannel) -> None:
    """Work out the limits that hold now; only those that setup or program gave a value."""
    data = channel.memory.data
    limits = []
    for column, name in enumerate(channel.axes):
        minus, plus = (f"$MA_POS_LIMIT_{side}{_pair(channel, column, side)}" for side in ("MINUS", "PLUS"))
        low = data.number(minus, name) if data.is_set(minus, name) else -inf
        high = data.number(plus, name) if data.is_set(plus, name) else inf
        limits.append(Limit(column, low, high, SWITCH))
        if channel.mode["working_area"] == "WALIMON":
            below, above = (
                bool(data.number(f"$SA_WORKAREA_{side}_ENABLE", name)) for side in ("MINUS", "PLUS")
            )
            low = data.number("$SA_WORKAREA_LIMIT_MINUS", name) if below else -inf
            high = data.number("$SA_WORKAREA_LIMIT_PLUS", name) if above else inf
            limits.append(Limit(column, low, high, WORKING_AREA))
    limits += _of_work_system(channel)
    Ranges.of(channel).limits = tuple(limit for limit in limits if limit.low > -inf or limit.high < inf)


def _of_work_system(channel: SinumerikChannel) -> list[Limit]:
    """WALCS1 to WALCS10: the ranges of a group, in the system that the group names."""
    values = Stored.of(channel).values
    group = gcodes.number_of(channel.mode["working_area_wcs"]) - 1
    if group == 0:
        return []
    limits = []
    for column in range(len(channel.axes)):
        low, high = (
            float(values.get((f"{AREA}LIMIT_{side}", (group, column)), 0.0))
            if values.get((f"{AREA}{side}_ENABLE", (group, column)), False)
            else beyond
            for side, beyond in (("MINUS", -inf), ("PLUS", inf))
        )
        system = int(values.get((f"{AREA}COORD_SYSTEM", (group,)), WORK))
        limits.append(Limit(column, low, high, WORK_SYSTEM_AREA, system))
    return limits


def _area(name: str, type_: Type, *, of_axis: bool) -> Row:
    """A variable of the working areas in the workpiece system: by group, and by axis."""

    def place(channel: SinumerikChannel, indices: Indices) -> tuple[int, ...]:
        if len(indices) != 1 + of_axis:
            raise AlarmError("12400", text=name)
        group = arguments.whole(indices[0])
        if group not in GROUPS:
            raise AlarmError("17020", text=name, index=group)
        return (group, arguments.column(channel, indices[1])) if of_axis else (group,)

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        empty = {Type.BOOL: False, Type.INT: WORK}.get(type_, 0.0)
        return Stored.of(channel).values.get((name, place(channel, indices)), empty)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        if name.endswith("COORD_SYSTEM") and value not in (WORK, SETTABLE):
            raise AlarmError("12560", text=name)
        Stored.of(channel).values[name, place(channel, indices)] = value
        refresh(channel)

    return type_, read, write


AREA_VARIABLES: dict[str, Row] = {
    f"{AREA}COORD_SYSTEM": _area(f"{AREA}COORD_SYSTEM", Type.INT, of_axis=False),
    **{
        f"{AREA}{name}": _area(f"{AREA}{name}", type_, of_axis=True)
        for side in ("PLUS", "MINUS")
        for name, type_ in ((f"{side}_ENABLE", Type.BOOL), (f"LIMIT_{side}", Type.REAL))
    },
}


def _pair(channel: SinumerikChannel, column: int, side: str) -> str:
    """Which of the two limit switches the PLC has chosen: nothing for the first, `2` for the second."""
    bit = {"MINUS": 2, "PLUS": 3}[side]
    return "2" if channel.setup.switches.plc.get(f"DB{31 + column}.DBX12.{bit}") else ""


def check(channel: SinumerikChannel, end: list[float]) -> None:
    """Refuse a target beyond a limit: 10720 for a software limit switch, 10730 and 10735 for working areas."""
    limits = Ranges.of(channel).limits
    systems = {MACHINE: channel.coordinates.to_machine(end), WORK: end}
    if any(limit.system == SETTABLE for limit in limits):
        systems[SETTABLE] = channel.coordinates.image(chain(channel.memory.frames.inner()).frame, end)
    for limit in limits:
        value = systems[limit.system][limit.column]
        if value < limit.low - _SLACK or value > limit.high + _SLACK:
            side = "-" if value < limit.low else "+"
            raise AlarmError(limit.alarm, axis=channel.axes[limit.column], side=side)
