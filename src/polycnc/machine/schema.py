"""What may stand in a machine file: names, types and ranges of keys, in the units of the file.

Every key is optional here, because a file may build on a `base`; what must be there in the end, and what must
fit together, is checked on the whole machine in `check`. Only files of the user come here: importing pydantic
takes longer than a short program runs, and the shipped files are held to this schema by a test.
"""

from __future__ import annotations

import re
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, Literal, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints, ValidationError

from polycnc.machine.errors import meant_by
from polycnc.machine.tables import Act, Pockets, SpeedWait, Turns

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from pydantic_core import ErrorDetails

    from polycnc.machine.places import Key


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class TextTable(_Table):
    """A text in one or two languages."""

    en: str
    zh_tw: str | None = Field(default=None, alias="zh-TW")


def _one_language(value: object) -> object:
    return {"en": value} if isinstance(value, str) else value


TextKey = Annotated[TextTable, BeforeValidator(_one_language)]
Number = Annotated[str, StringConstraints(pattern=r"^[0-9]+$")]
Name = Annotated[str, StringConstraints(pattern=r"^[A-Z_][A-Z0-9_]*$")]
GNumber = Annotated[str, StringConstraints(pattern=r"^[0-9]{1,4}(\.[0-9])?$")]
Address = Annotated[str, StringConstraints(pattern=r"^[A-Z]$")]
Program = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_]+$")]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
Vector = Annotated[list[float], Field(min_length=3, max_length=3)]
ReferenceNumber = Annotated[int, Field(ge=1, le=4)]


class Dynamics(_Table):
    """Speeds and accelerations of an axis, or the defaults of a kind."""

    rapid: Positive | None = None
    max_feed: Positive | None = None
    acceleration: Positive | None = None
    jerk: Positive | None = None
    rapid_time_s: NotNegative | None = None
    rapid_bell_s: NotNegative | None = None
    cutting_time_s: NotNegative | None = None
    cutting_bell_s: NotNegative | None = None
    after_interpolation_s: NotNegative | None = None
    in_position_fine: Positive | None = None
    in_position_coarse: Positive | None = None


class Defaults(_Table):
    """`[defaults]`."""

    linear: Dynamics | None = None
    rotary: Dynamics | None = None


class AxisTable(Dynamics):
    """`[axis.NAME]`."""

    kind: Literal["linear", "rotary"] | None = None
    modulo: bool | None = None
    diameter: bool | None = None
    parallel_to: Name | None = None
    aliases: list[Name] | None = None
    machine_name: Name | None = None
    limit_minus: float | None = None
    limit_plus: float | None = None
    reference_points: Annotated[list[float], Field(min_length=1, max_length=4)] | None = None


class ChannelTable(_Table):
    """`[channel.NUMBER]`."""

    axes: Annotated[list[Name], Field(min_length=1)] | None = None
    names: list[Name] | None = None
    geometry: dict[Literal["X", "Y", "Z"], Name] | None = None
    virtual: list[Literal["X", "Y", "Z"]] | None = None
    spindles: list[int] | None = None


class GearTable(_Table):
    """One entry of `gears`."""

    min_rpm: NotNegative
    max_rpm: Positive


class SpindleTable(_Table):
    """`[spindle.NUMBER]`."""

    name: Name | None = None
    min_rpm: NotNegative | None = None
    max_rpm: Positive | None = None
    acceleration: Positive | None = None
    orient_s: NotNegative | None = None
    carries: Literal["tool", "work"] | None = None
    axis: Name | None = None
    gears: list[GearTable] | None = None
    speed_wait: SpeedWait | None = None


def _nowhere(value: object) -> object:
    return {} if value == "anywhere" else value


ChangeAt = Annotated[
    dict[Name, Annotated[list[ReferenceNumber], Field(min_length=1)]], BeforeValidator(_nowhere)
]


class MagazineTable(_Table):
    """`[magazine]`."""

    kind: Literal["magazine", "turret"] | None = None
    places: Annotated[int, Field(ge=1)] | None = None
    change_time_s: NotNegative | None = None
    place_time_s: NotNegative | None = None
    pockets: Pockets | None = None
    turns: Turns | None = None
    change_at: ChangeAt | None = None
    retracts: bool | None = None


class MFunctionTable(_Table):
    """`[m_function.CODE]`."""

    name: TextKey | None = None
    seconds: NotNegative | None = None
    timing: Literal["before", "with", "after"] | None = None
    takes: list[Address] | None = None
    calls: Program | None = None
    does: Act | None = None


class GFunctionTable(_Table):
    """`[g_function.CODE]`."""

    name: TextKey | None = None
    seconds: NotNegative | None = None
    takes: list[Address] | None = None
    calls: Program | None = None


class JointTable(_Table):
    """`[[joint]]`."""

    axis: Name
    carries: Literal["tool", "work"]
    direction: Vector
    offset: Vector | None = None


class SolidTable(_Table):
    """`[[solid]]`."""

    name: TextKey
    role: Literal["table", "chuck", "tailstock", "fixture", "head", "guard"]
    shape: Literal["box", "cylinder"]
    position: Vector
    size: Annotated[list[NotNegative], Field(min_length=2, max_length=3)]
    direction: Vector | None = None
    moves_with: str


class RuleTable(_Table):
    """`[[rule]]`."""

    when: str
    output: Annotated[str, StringConstraints(pattern=r"^[A-Za-z_$][A-Za-z0-9_$.\[\]]*$")]
    after_s: NotNegative | None = None
    latch: Literal["on", "off", "toggle"] | None = None


class AlarmTable(_Table):
    """`[[alarm]]` and `[[message]]`."""

    code: Annotated[str, StringConstraints(pattern=r"^[A-Z0-9-]+( [0-9]+)?$")]
    when: str
    text: TextKey | None = None
    cause: TextKey | None = None
    remedy: TextKey | None = None


class BuilderTable(_Table):
    """A file that `rules` names: what a builder has made of the control."""

    magazine: MagazineTable | None = None
    m_function: dict[Number, MFunctionTable] | None = None
    g_function: dict[GNumber, GFunctionTable] | None = None
    rule: list[RuleTable] | None = None
    alarm: list[AlarmTable] | None = None
    message: list[AlarmTable] | None = None


class MachineTable(BuilderTable):
    """A whole file."""

    base: str | None = None
    rules: str | None = None
    name: TextKey | None = None
    description: TextKey | None = None
    interpolation_cycle_s: Positive | None = None
    settle_fine_s: NotNegative | None = None
    settle_coarse_s: NotNegative | None = None
    block_time_s: NotNegative | None = None
    tool_direction: Vector | None = None
    nose: Vector | None = None
    control_variant: (
        Literal["828D PPU260 turning", "828D PPU260 milling", "828D PPU280 turning", "828D PPU280 milling"]
        | None
    ) = None
    control_options: (
        list[
            Literal[
                "splines", "compressors", "synchronous spindles", "force control", "inclined axis", "transmit"
            ]
        ]
        | None
    ) = None
    defaults: Defaults | None = None
    channel: dict[Number, ChannelTable] | None = None
    axis: dict[Name, AxisTable] | None = None
    spindle: dict[Number, SpindleTable] | None = None
    joint: list[JointTable] | None = None
    solid: list[SolidTable] | None = None


#: Message of each kind of mistake, by the start of the name that pydantic gives it; the first fit counts.
_MESSAGES = (
    ("extra_forbidden", "unknown-key"),
    ("missing", "missing-key"),
    ("literal_error", "not-one-of"),
    ("float", "needs-number"),
    ("finite", "needs-number"),
    ("int", "needs-whole-number"),
    ("bool", "needs-true-or-false"),
    ("string_pattern", "bad-name"),
    ("string", "needs-text"),
    ("list", "needs-list"),
    ("too_", "wrong-length"),
    ("dict", "needs-table"),
    ("model", "needs-table"),
    ("greater", "out-of-range"),
    ("less", "out-of-range"),
)
_LIMITS = {"gt": ">", "ge": "≥", "lt": "<", "le": "≤", "min_length": "≥", "max_length": "≤"}
#: Longest piece of a wrong value that a message repeats.
_SHOWN = 40
#: What stands in a place for any name, and for any number.
NAME, NUMBER = "NAME", "NUMBER"
Mistake = tuple[tuple["Key", ...], str, dict[str, object]]


def mistakes(data: dict[str, Any], table: type[BaseModel] = MachineTable) -> Iterator[Mistake]:
    """What is wrong with the keys of one file: key path, message id and arguments."""
    try:
        table.model_validate(data)
    except ValidationError as error:
        for found in error.errors(include_url=False):
            yield _mistake(found, table)


def _mistake(found: ErrorDetails, table: type[BaseModel]) -> Mistake:
    path = tuple(part for part in found["loc"] if part != "[key]")
    kind = found["type"]
    message = next((text for start, text in _MESSAGES if kind.startswith(start)), "bad-value")
    about: dict[str, object] = {"where": ".".join(map(str, path)), "value": _short(found["input"])}
    limits = found.get("ctx", {})
    if message == "unknown-key":
        about |= meant(path, table)
    elif message == "not-one-of":
        about["expected"] = ", ".join(re.findall(r"'([^']*)'", limits["expected"]))
    else:
        signs = [f"{sign} {limits[name]}" for name, sign in _LIMITS.items() if name in limits]
        about["detail"] = ", ".join(signs) or found["msg"]
    return path, message, about


def meant(
    path: Sequence[Key], table: type[BaseModel], beside: Mapping[str, Collection[str]] = MappingProxyType({})
) -> dict[str, str]:
    """What the unknown key at the end of a path was probably meant to be (`errors.meant_by`).

    Args:
        path: Of the key.
        table: What the file holds.
        beside: Keys that it holds in places of which the schema does not say them.
    """
    levels = dict(_levels(table))
    above = [str(part) for part in path[:-1] if not isinstance(part, int)]
    here = next((keys for place, keys in levels.items() if _is_at(place, above)), ())
    known = {".".join(place): keys for place, keys in levels.items()}
    return meant_by(str(path[-1]), here, {**known, **beside})


def _levels(
    table: type[BaseModel], above: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], set[str]]]:
    """The places of a table and of all tables within it, and their keys."""
    fields = {field.alias or name: field for name, field in table.model_fields.items()}
    yield above, set(fields)
    for name, field in fields.items():
        for own, inner in _tables_in(field.annotation):
            yield from _levels(inner, (*above, name, *own))


def _tables_in(kind: Any) -> Iterator[tuple[tuple[str, ...], type[BaseModel]]]:
    """The tables that a value of a type holds, behind the key that each has there."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        yield (), kind
    elif get_origin(kind) is dict:
        key, value = get_args(kind)
        label = NAME if key == Name else NUMBER
        yield from (((label, *own), table) for own, table in _tables_in(value))
    else:
        for part in get_args(kind):
            yield from _tables_in(part)


def _is_at(place: tuple[str, ...], path: Sequence[str]) -> bool:
    """Whether a path leads to a place, where names and numbers stand for any."""
    return len(place) == len(path) and all(
        own in (name, NAME, NUMBER) for own, name in zip(place, path, strict=True)
    )


def field_names() -> dict[str, set[str]]:
    """All keys by the table that they stand in (`axis`, `spindle` …; empty for the top level)."""
    tables: dict[str, type[BaseModel]] = {
        "": MachineTable,
        "axis": AxisTable,
        "channel": ChannelTable,
        "spindle": SpindleTable,
        "magazine": MagazineTable,
        "m_function": MFunctionTable,
        "g_function": GFunctionTable,
        "joint": JointTable,
        "solid": SolidTable,
        "rule": RuleTable,
        "alarm": AlarmTable,
        "message": AlarmTable,
    }
    return {name: set(table.model_fields) for name, table in tables.items()}


def _short(value: object) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"
