"""The JSON interface: commands of a virtual control over the wire, and its snapshot.

A message is an object: `{"do": "jog", "with": {"axis": "X", "direction": 1}}`. The answer is `{"ok": result}` or
`{"refused": text}`, with the text that Python raises. `{"do": "snapshot"}` gives everything that a panel shows.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from inspect import signature
from math import isfinite

from polycnc.deferred.records import fields, is_dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError, UserError, text
from polycnc.messages.catalogue import language

if TYPE_CHECKING:
    from polycnc.panel.web.desk import Desk

#: Commands of `VirtualControl` that may be given over the wire; their arguments are those of Python.
COMMANDS = (
    "load", "mdi", "block_search", "cycle_start", "feed_hold", "reset", "emergency_stop", "power_on", "power_off",
    "key", "select_mode", "jog", "stop_jog", "increment", "handle", "home", "preset", "override", "set_switches",
    "read_variable", "write_variable", "read_parameter", "write_parameter", "program_lines", "store_program",
    "delete_program", "select_program",
)  # fmt: skip
#: What only reads: nothing of it is recorded.
READS = frozenset(
    {"snapshot", "screen", "recording", "lesson", "read_variable", "read_parameter", "program_lines"}
)
_NUMBER, _WHOLE = (int, float), (int,)
#: What arguments may be: one name has one meaning in all commands.
ARGUMENTS: dict[str, tuple[type, ...]] = {
    "source": (str,), "text": (str,), "target": (int, str, list), "channel": _WHOLE, "pressed": (bool,), "name": (str,),
    "mode": (str,), "axis": (str,), "direction": _WHOLE, "rapid": (bool, int, float), "steps": _WHOLE, "pulses": _WHOLE,
    "size": _NUMBER, "feed": _NUMBER, "spindle": _NUMBER, "value": (int, float, str), "number": (str,), "keys": (list,),
    "key": (str,), "index": _WHOLE, "switch": (str,), "position": (str, int), "notches": _WHOLE, "unit": (str,),
    "single_block": (bool, str), "optional_stop": (bool,), "block_skip": (bool,), "dry_run": (bool,),
    "how": (str,), "machine_lock": (bool,), "z_lock": (bool,), "mst_lock": (bool,), "drf": (bool,),
}  # fmt: skip
#: Longest message, characters.
LONGEST = 4_000_000


def answer(desk: Desk, message: str) -> str:
    """Do what a message says, and answer it."""
    try:
        asked = json.loads(message) if len(message) <= LONGEST else None
    except (ValueError, RecursionError):
        asked = None
    if not isinstance(asked, dict) or not isinstance(asked.get("do"), str):
        return _refused(text("panel.message-form"))
    name, given = asked["do"], asked.get("with", {})
    if not isinstance(given, dict):
        return _refused(text("panel.message-form"))
    try:
        _check(given)
        if name not in READS:
            desk.recording.note(name, **given)
        done = perform(desk, name, given)
        desk.follow()
        return json.dumps({"ok": done}, allow_nan=False, default=str)
    except UserError as refusal:
        if desk.lesson is not None:
            desk.lesson.refused += 1
        return _refused(refusal.text())
    except AlarmError as alarm:
        return _refused(
            f"{alarm.code} {desk.control.catalogue.text(alarm.code, None, **dict(alarm.args_by_name))}"
        )
    except (TypeError, ValueError, KeyError, OverflowError) as error:
        return _refused(text("panel.message-value", name=name, reason=str(error)))


def perform(desk: Desk, name: str, given: Mapping[str, Any]) -> object:
    """Do what a message asks for; raises what Python raises."""
    control = desk.control
    if name == "snapshot":
        return plain(control.snapshot)
    if name == "screen":
        return plain(desk.screen.view())
    if name == "recording":
        return plain(desk.recording.acts)
    if name == "lesson":
        return desk.lesson.sheet(language()) if desk.lesson is not None else None
    actions = desk.actions
    if name in actions:
        return plain(_called(actions[name], given))
    if name not in COMMANDS:
        raise KeyError(name)
    return plain(_called(getattr(control, name), _checked(name, given)))


def _check(given: Mapping[str, Any]) -> None:
    """Arguments are of their types; `KeyError` and `TypeError` where they are not."""
    for name, value in given.items():
        wanted = ARGUMENTS[name]
        if not isinstance(value, wanted) or (isinstance(value, bool) and bool not in wanted):
            raise TypeError(name)
        if isinstance(value, float) and not isfinite(
            value
        ):  # Python reads NaN and Infinity, which JSON has not
            raise ValueError(name)


def _called(action: Callable[..., object], given: Mapping[str, Any]) -> object:
    keys = given.get("keys")
    if isinstance(keys, list):
        return action(*map(str, keys))
    signature(action).bind(**given)
    return action(**given)


def _checked(name: str, given: Mapping[str, Any]) -> Mapping[str, Any]:
    """A program comes as its text: no file of the server's is reached."""
    if name == "load":
        return {**given, "source": str(given.get("source", "")).removesuffix("\n").encode() + b"\n"}
    return given


def plain(value: object) -> object:
    """A value as JSON has it; fields of dataclasses by their names."""
    if isinstance(value, float):
        return value if isfinite(value) else str(value)
    if value is None or isinstance(value, bool | int | str):
        return value
    if is_dataclass(value) and not isinstance(value, type):
        return {
            each.name: plain(getattr(value, each.name)) for each in fields(value) if each.name != "catalogue"
        }
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(each) for each in value]
    return str(value)


def _refused(reason: str) -> str:
    return json.dumps({"refused": reason}, ensure_ascii=False)
