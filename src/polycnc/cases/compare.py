"""Compares what a run gave with what a case expects: every function gives the differences as texts."""

from __future__ import annotations

import re

from polycnc.control.alarm_text import alarm_key
from polycnc.deferred.typing import TYPE_CHECKING, TypeVar
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from polycnc.cases.format import ExpectedAlarm, ExpectedEvent, ExpectedMove, ExpectedPosition
    from polycnc.control.interface import Control
    from polycnc.messages import Alarm
    from polycnc.toolpath.trace import Record

E = TypeVar("E")
A = TypeVar("A")
ANY_ALARM = "any"
#: The name in the trace of what an expected event writes short.
EVENT_FIELDS = {
    "m": "code",
    "h": "code",
    "b": "code",
    "g": "code",
    "d": "code",
    "s": "speed",
    "t": "tool",
    "stroke": "interface",
    "message": "text",
    "print": "text",
}
_TURN_DEG = 360.0


def values_equal(expected: object, actual: object, tolerance: float) -> bool:
    """Numbers within the tolerance (true is 1, false 0), texts as they stand, null only as null."""
    if isinstance(expected, int | float) and isinstance(actual, int | float):
        return expected == actual or abs(expected - actual) <= tolerance + 1e-9
    if isinstance(expected, list) and isinstance(actual, list | tuple):
        return len(expected) == len(actual) and all(
            map(lambda e, a: values_equal(e, a, tolerance), expected, actual)
        )
    if expected is None or actual is None:
        return expected is actual
    return str(expected) == str(actual)


class Positions:
    """Compares positions; modulo axes are compared around the turn."""

    def __init__(self, tolerance: float, modulo: Iterable[str] = ()) -> None:
        self.tolerance = tolerance
        self._modulo = frozenset(modulo)

    def equal(self, expected: Mapping[str, float], actual: Mapping[str, float]) -> bool:
        """Whether every expected axis stands where it should."""
        return all(
            axis in actual and self.axis_equal(axis, value, actual[axis]) for axis, value in expected.items()
        )

    def axis_equal(self, axis: str, expected: float, actual: float) -> bool:
        """Whether one axis stands where it should."""
        off = abs(expected - actual)
        if axis in self._modulo:
            off = min(off % _TURN_DEG, _TURN_DEG - off % _TURN_DEG)
        return off <= self.tolerance + 1e-9


def compare_moves(
    expected: Sequence[ExpectedMove], actual: Sequence[Record], positions: Positions, *, exact: bool
) -> list[str]:
    """Moves in order: all of them, or a subsequence. Only the first difference is told."""

    def fits(move: ExpectedMove, record: Record) -> bool:
        return _move_fits(move, record, positions)

    if not exact:
        missing = _first_missing(expected, actual, fits)
        if missing is None:
            return []
        after = missing[1]
        return [text("case.move-missing", number=missing[0] + 1, expected=show_move(expected[missing[0]]),
                     after=after, came=_show_some(actual[after:]))]  # fmt: skip
    for number, (move, record) in enumerate(zip(expected, actual, strict=False), 1):
        if not fits(move, record):
            return [
                text("case.move-differs", number=number, expected=show_move(move), came=show_record(record))
            ]
    if len(expected) > len(actual):
        move = expected[len(actual)]
        return [text("case.move-absent", number=len(actual) + 1, expected=show_move(move), count=len(actual))]
    if len(actual) > len(expected):
        record = actual[len(expected)]
        return [
            text("case.move-extra", number=len(expected) + 1, came=show_record(record), count=len(expected))
        ]
    return []


def _move_fits(move: ExpectedMove, record: Record, positions: Positions) -> bool:
    if move.type is not None and move.type != record["type"]:
        return False
    if not positions.equal(move.to, record["to"]) or not positions.equal(move.machine, record["machine"]):
        return False
    if move.center and not positions.equal(move.center, record.get("center", {})):
        return False
    wanted: dict[str, object] = move.model_dump(include=_MOVE_VALUES, exclude_none=True)
    return all(values_equal(value, record.get(key), positions.tolerance) for key, value in wanted.items())


_MOVE_VALUES = {"feed", "line", "program", "seconds", "revolutions", "turns", "lead", "start_angle"}


def compare_final(expected: ExpectedPosition, work: Mapping[str, float], machine: Mapping[str, float],
                  positions: Positions) -> list[str]:  # fmt: skip
    """Where the axes stand at the end."""
    differences = []
    for display, wanted, actual in (("work", expected.work, work), ("machine", expected.machine, machine)):
        for axis, value in wanted.items():
            came = actual.get(axis)
            if came is None or not positions.axis_equal(axis, value, came):
                where = f"{display}.{axis}"
                differences.append(text("case.final-differs", axis=where, expected=value, came=show(came)))
    return differences


def compare_variables(
    expected: Mapping[str, object], read: Callable[[str], object], tolerance: float
) -> list[str]:
    """Variables at the program end, read by name."""
    differences = []
    for name, value in expected.items():
        try:
            came = read(name)
        except KeyError:
            differences.append(text("case.variable-unknown", name=name))
            continue
        if not values_equal(value, came, tolerance):
            differences.append(
                text("case.variable-differs", name=name, expected=show(value), came=show(came))
            )
    return differences


def compare_alarms(
    control: Control,
    expected: Sequence[ExpectedAlarm],
    actual: Sequence[Alarm],
    block: Callable[[Alarm], str],
    message: Callable[[Alarm], str],
) -> list[str]:
    """Alarms in order, none missing and none more; `block` gives the N word of an alarm's block."""
    if any(str(alarm.code) == ANY_ALARM for alarm in expected) and len(actual) > len(expected):
        expected = [*expected, *[expected[-1]] * (len(actual) - len(expected))]
    differences = []
    for wanted, came in zip(expected, actual, strict=False):
        if not _alarm_fits(control, wanted, came, block):
            shown = show(wanted.model_dump(exclude_none=True))
            differences.append(text("case.alarm-differs", expected=shown, came=message(came)))
    differences += [
        text("case.alarm-absent", expected=show(wanted.model_dump(exclude_none=True)))
        for wanted in expected[len(actual) :]
    ]
    differences += [text("case.alarm-extra", came=message(came)) for came in actual[len(expected) :]]
    return differences


def _alarm_fits(control: Control, wanted: ExpectedAlarm, came: Alarm, block: Callable[[Alarm], str]) -> bool:
    if str(wanted.code) != ANY_ALARM and alarm_key(control, wanted.code) != alarm_key(control, came.code):
        return False
    if wanted.block is not None and _label(wanted.block) != _label(block(came)):
        return False
    places = (wanted.line, came.line), (wanted.column, came.column), (wanted.program, came.program)
    return all(value is None or value == actual for value, actual in places)


def compare_events(
    expected: Sequence[ExpectedEvent], actual: Sequence[Record], tolerance: float
) -> list[str]:
    """Events as an ordered subsequence."""

    def fits(event: ExpectedEvent, record: Record) -> bool:
        return _event_fits(event, record, tolerance)

    missing = _first_missing(expected, actual, fits)
    if missing is None:
        return []
    number, after = missing
    came = " ".join(show_event(record) for record in actual[after : after + 8]) or text("case.nothing")
    wanted = show(expected[number].model_dump(exclude_none=True))
    return [text("case.event-missing", expected=wanted, number=number + 1, came=came)]


def _event_fits(event: ExpectedEvent, record: Record, tolerance: float) -> bool:
    wanted: dict[str, object] = event.model_dump(exclude_none=True)
    if record["type"] == "stop" and "m" in wanted:
        wanted["stop"] = f"M{wanted.pop('m')}"  # a programmed stop is an M function too
    for key, value in wanted.items():
        if key == "spindle":
            fits = values_equal(value, record.get("spindle", 1), 0)
        elif key == "words":
            fits = value == record.get("words")
        elif key == "signal":
            signals = value if isinstance(value, dict) else {}
            fits = (
                record["type"] == key
                and record.get("name") in signals
                and record["value"] == signals[record["name"]]
            )
        elif key == "stop":
            fits = record["type"] == "stop" and _label(value) == _label(record["code"])
        else:
            fits = record["type"] == key and _same_word(value, record.get(EVENT_FIELDS[key]), tolerance)
        if not fits:
            return False
    return True


def _same_word(expected: object, actual: object, tolerance: float) -> bool:
    if isinstance(expected, str) != isinstance(actual, str):
        expected, actual = str(expected), str(actual)
    return values_equal(expected, actual, tolerance)


def compare_stops(
    expected: Sequence[str | int] | None, actual: Sequence[str], never: Sequence[str | int], *, exact: bool
) -> list[str]:
    """Where a run in single block mode halted; blocks are named by their N words."""
    stops = [_label(stop) for stop in actual]
    differences = []
    if expected is not None:
        wanted = [_label(stop) for stop in expected]
        equal = wanted == stops if exact else _first_missing(wanted, stops, str.__eq__) is None
        if not equal:
            differences.append(
                text("case.stops-differ", expected=" ".join(wanted), came=" ".join(stops) or "-")
            )
    unwanted = [_label(stop) for stop in never if _label(stop) in stops]
    differences += [text("case.stop-unwanted", stop=stop, came=" ".join(stops)) for stop in unwanted]
    return differences


def _label(word: object) -> str:
    """A block or stop code without leading zeros: `M0` is `M00`, `10` is `N10`."""
    match = re.fullmatch(r"([A-Z]?)0*(\d+)", str(word).strip().upper())
    return f"{match[1] or 'N'}{match[2]}" if match else str(word).strip().upper()


def _first_missing(
    expected: Sequence[E], actual: Sequence[A], fits: Callable[[E, A], bool]
) -> tuple[int, int] | None:
    """The first expected item that does not come in order, and how far the actual ones were used."""
    used = 0
    for number, wanted in enumerate(expected):
        found = next((i for i in range(used, len(actual)) if fits(wanted, actual[i])), None)
        if found is None:
            return number, used
        used = found + 1
    return None


# ---- how differences are written ---------------------------------------------------------------------------


def show(value: object) -> str:
    """A value as it would stand in a case."""
    if value is None:
        return "null"
    if isinstance(value, float):
        return f"{round(value, 6) + 0.0:.10g}"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {show(item)}" for key, item in value.items()) + "}"
    return str(value)


def _words(position: Mapping[str, float]) -> str:
    return " ".join(f"{axis}{show(float(value))}" for axis, value in position.items())


def show_move(move: ExpectedMove) -> str:
    """An expected move in one line."""
    rest: dict[str, object] = move.model_dump(exclude_defaults=True, exclude={"type", "to"})
    return " ".join(filter(None, [move.type or "*", _words(move.to), show(rest) if rest else ""]))


def show_record(record: Record) -> str:
    """A move of the trace in one line."""
    rest = {
        key: record.get(key) for key in ("center", "feed", "seconds", "revolutions", "turns") if key in record
    }
    place = f"(line {record['line']})"
    return " ".join(filter(None, [record["type"], _words(record["to"]), show(rest) if rest else "", place]))


def _show_some(records: Sequence[Record], most: int = 4) -> str:
    shown = "; ".join(show_record(record) for record in records[:most])
    return (shown + ("; …" if len(records) > most else "")) or text("case.nothing")


def show_event(record: Record) -> str:
    """An event of the trace in one line."""
    return show({key: value for key, value in record.items() if key not in ("program", "line")})
