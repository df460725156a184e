"""The case format: what a file may say, checked when it is read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from polycnc.machine.schema import meant
from polycnc.machine.setup.file import TABLES
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic_core import ErrorDetails

Number = float
Match = Literal["exact", "subsequence"]
#: What an operator can do in a case: commands of the virtual control, and letting time pass.
COMMANDS = frozenset({
    "cycle_start", "feed_hold", "reset", "emergency_stop", "power_off", "power_on", "key", "select_mode", "mdi",
    "teach", "block_search", "jog", "stop_jog", "increment", "handle", "home", "override", "set_switches", "step",
    "run",
})  # fmt: skip
#: Expectations that a case with an operator cannot have: they are of the calculated run.
CALCULATED = frozenset({"moves", "moves_match", "stops", "stops_match", "no_stop"})


def _is_command(step: str | dict[str, object]) -> str | dict[str, object]:
    names = [step] if isinstance(step, str) else list(step)
    if len(names) != 1 or names[0] not in COMMANDS:
        raise ValueError(text("case.unknown-command", known=listed(sorted(COMMANDS))))
    return step


Step = Annotated[str | dict[str, object], AfterValidator(_is_command)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid")


class ExpectedMove(_Strict):
    """A move of the trace; what is not named is not compared."""

    type: str | None = None
    to: dict[str, Number] = Field(default_factory=dict)
    machine: dict[str, Number] = Field(default_factory=dict)
    center: dict[str, Number] = Field(default_factory=dict)
    feed: Number | None = None
    line: int | None = None
    program: str | None = None
    seconds: Number | None = None
    revolutions: Number | None = None
    turns: Number | None = None
    lead: Number | None = None
    start_angle: Number | None = None


class ExpectedAlarm(_Strict):
    """An alarm; `code: any` is whatever comes. `block` is its N word where it lies in a called file."""

    code: str | int
    line: int | None = None
    column: int | None = None
    program: str | None = None
    block: str | int | None = None


class ExpectedPosition(_Strict):
    """Where the axes stand at the end, on the work and on the machine display."""

    work: dict[str, Number] = Field(default_factory=dict)
    machine: dict[str, Number] = Field(default_factory=dict)


class ExpectedEvent(_Strict):
    """An event; exactly one of the keys beside `spindle` and `words` says which."""

    m: int | str | None = None
    s: Number | None = None
    t: int | str | None = None
    h: Number | None = None
    d: int | str | None = None
    b: Number | None = None
    g: str | None = None
    stroke: int | None = None
    signal: dict[str, Number] | None = None
    words: dict[str, Number] | None = None
    spindle: int | None = None
    message: str | Number | None = None
    print: str | Number | None = None
    stop: str | None = None


class ExpectedPanel(_Strict):
    """What an operator's panel shows at the end: state, mode, simulated time (s), spindle speed (rpm), finished parts.

    `refused` names the commands that the control refused on the way; `tolerance` is that of times and speeds.
    """

    state: str | None = None
    mode: str | None = None
    time: Number | None = None
    spindle: Number | None = None
    parts: int | None = None
    refused: list[str] = Field(default_factory=list)
    tolerance: Number = Field(default=0.0, exclude=True)


class Expectation(_Strict):
    """What a run must give. Absent keys are not compared, except `alarms`: without it none may come."""

    moves: list[ExpectedMove] | None = None
    moves_match: Match = "exact"
    final: ExpectedPosition | None = None
    variables: dict[str, object] = Field(default_factory=dict)
    alarms: list[ExpectedAlarm] = Field(default_factory=list)
    events: list[ExpectedEvent] = Field(default_factory=list)
    stops: list[str | int] | None = None
    stops_match: Match = "exact"
    no_stop: list[str | int] = Field(default_factory=list)
    panel: ExpectedPanel = Field(default_factory=ExpectedPanel)
    tolerance: Number = 0.001


class Case(_Strict):
    """One case: a program, what it starts from, and what must come of it."""

    id: str
    feature: str = ""
    control: str
    source: str = ""
    note: str = ""
    setup: dict[str, object] = Field(default_factory=dict)
    files: dict[str, str] = Field(default_factory=dict)
    program: str
    operate: list[Step] = Field(default_factory=list)
    expect: Expectation = Field(default_factory=Expectation)


class CaseError(Exception):
    """A case that does not follow the format; `str()` names the key and what is wrong with it."""


def case_id(data: object, number: int) -> str:
    """The id of a case as it stands in the file, or its place there when it has none."""
    if isinstance(data, dict) and data.get("id") not in (None, ""):
        return str(data["id"])
    return f"#{number}"


def parse_case(data: object) -> Case:
    """Check one case.

    Raises:
        CaseError: A key is unknown, missing, or holds what it cannot hold.
    """
    if not isinstance(data, dict):
        raise CaseError(text("case.no-mapping"))
    try:
        case = Case.model_validate(_without_empty(data))
    except ValidationError as error:
        raise CaseError("; ".join(_explain(e) for e in error.errors())) from None
    expected = case.expect.model_fields_set
    wrong = expected & CALCULATED if case.operate else expected & {"panel"}
    if wrong:
        raise CaseError(text("case.other-run", name=listed(sorted(wrong))))
    return case


def _without_empty(data: dict[object, object]) -> dict[str, object]:
    """A section that is named but left empty (`setup:`) is the same as an absent one; ids may be numbers."""
    cleaned = {str(key): value for key, value in data.items() if value is not None}
    for key in ("id", "feature", "source", "note"):
        if key in cleaned:
            cleaned[key] = str(cleaned[key])
    return cleaned


def _explain(error: ErrorDetails) -> str:
    where = _dotted(error["loc"])
    if error["type"] == "extra_forbidden":
        setup = {f"setup.{place}".rstrip("."): keys for place, keys in TABLES.items()}
        return text("case.unknown-key", where=where, **meant(error["loc"], Case, setup))
    if error["type"] == "missing":
        return text("case.missing-key", name=where)
    if error["type"] == "value_error":
        return f"{where}: {error['ctx']['error']}"
    return text("case.wrong-value", name=where, reason=error["msg"], value=repr(error["input"])[:60])


def _dotted(path: Sequence[str | int]) -> str:
    parts = [f"[{part}]" if isinstance(part, int) else f".{part}" for part in path]
    return "".join(parts).lstrip(".")
