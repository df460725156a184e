"""An exercise as a file: what is to be done, on which control, which faults come, how one sees that it was done.

    - id: home-first
      control: fanuc-m
      title: {en: Home the machine, zh-TW: 原點復歸}
      text: {en: Return all axes to their reference points., zh-TW: 將各軸復歸至原點。}
      setup: {machine: hartford, start: {X: -40, Y: -20, Z: -90}}
      program: |
        O1
        M30
      faults:
        - {fault: air, when: {state: running, block: N50}}
      checks:
        - text: {en: Mode ZERO RETURN, zh-TW: 原點復歸模式}
          when: {mode: reference}
        - text: {en: All axes at zero, zh-TW: 各軸在原點}
          when: {machine: {X: 0, Y: 0, Z: 0}}

`control`, `setup`, `program` and `files` are those of a case. A check is looked at when the one before it is passed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import yaml

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.messages import UserError
from polycnc.messages.catalogue import listed
from polycnc.panel.teaching.faults import faults

if TYPE_CHECKING:
    from pathlib import Path

    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.screen import Screen

Text: TypeAlias = "str | Mapping[str, str]"
#: How near a number must come.
NEAR = 1e-3


class ExerciseError(UserError):
    """A file of exercises cannot be used."""


def _numbers(found: Mapping[str, float], wanted: Mapping[str, float]) -> bool:
    return all(abs(found.get(name, float("inf")) - value) <= NEAR for name, value in wanted.items())


def _variables(control: VirtualControl, wanted: Mapping[str, Any]) -> bool:
    for name, value in wanted.items():
        try:
            found = control.read_variable(name)
        except (KeyError, ValueError):
            return False
        if isinstance(found, int | float) and isinstance(value, int | float):
            if abs(found - value) > NEAR:
                return False
        elif found != value:
            return False
    return True


#: What a condition may ask for, by its word: whether it holds of a control with its screen.
CONDITIONS: dict[str, Callable[[VirtualControl, Screen, Any], bool]] = {
    "state": lambda control, _, wanted: control.state == wanted,
    "mode": lambda control, _, wanted: control.mode == wanted,
    "halt": lambda control, _, wanted: control.halt == wanted,
    "program": lambda control, _, wanted: control.program == wanted,
    "block": lambda control, _, wanted: control.active_block.text.startswith(str(wanted)),
    "parts": lambda control, _, wanted: control.parts >= int(wanted),
    "tool": lambda control, _, wanted: wanted in (control.tool.tool, control.tool.name),
    "alarm": lambda control, _, wanted: str(wanted) in {alarm.code for alarm in control.alarms},
    "alarms": lambda control, _, wanted: len(control.alarms) == int(wanted),
    "work": lambda control, _, wanted: _numbers(control.positions.work, wanted),
    "machine": lambda control, _, wanted: _numbers(control.positions.machine, wanted),
    "signal": lambda control, _, wanted: all(
        control.signals[name] == value for name, value in wanted.items()
    ),
    "variable": lambda control, _, wanted: _variables(control, wanted),
    "page": lambda _, screen, wanted: screen.page.id == wanted,
}
_MAPPED = frozenset({"work", "machine", "signal", "variable"})


@dataclass(frozen=True, slots=True)
class Check:
    """Something that is to be done: what it is, and by what one sees that it was done."""

    text: Text
    when: Mapping[str, Any]

    def holds(self, control: VirtualControl, screen: Screen) -> bool:
        """Whether its condition holds now."""
        return holds(self.when, control, screen)


@dataclass(frozen=True, slots=True)
class Injection:
    """A fault that comes when a condition holds."""

    fault: str
    when: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Exercise:
    """An exercise; the module tells what its fields are."""

    id: str
    control: str
    title: Text
    text: Text
    checks: tuple[Check, ...]
    faults: tuple[Injection, ...] = ()
    setup: Mapping[str, Any] = field(default_factory=dict)
    program: str = ""
    files: Mapping[str, str] = field(default_factory=dict)


def holds(when: Mapping[str, Any], control: VirtualControl, screen: Screen) -> bool:
    """Whether all parts of a condition hold."""
    return all(CONDITIONS[word](control, screen, wanted) for word, wanted in when.items())


def load_exercises(path: Path) -> tuple[Exercise, ...]:
    """The exercises of a file.

    Raises:
        ExerciseError: It cannot be read, or says what no exercise says.
    """
    try:
        rows = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ExerciseError("file.unreadable", file=path, reason=error.strerror) from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}:{mark.line + 1}" if mark is not None else str(path)
        raise ExerciseError(
            "exercise.form", file=place, where="", wrong=getattr(error, "problem", error)
        ) from error
    if not isinstance(rows, list) or not rows:
        raise ExerciseError("exercise.empty", file=path)
    return tuple(_exercise(path, place, row) for place, row in enumerate(rows, 1))


_NEEDED, _MORE = ("id", "control", "title", "text", "checks"), ("faults", "setup", "program", "files")


def _exercise(path: Path, place: int, row: object) -> Exercise:
    def wrong(what: object, where: str = "") -> ExerciseError:
        name = row.get("id", place) if isinstance(row, dict) else place
        return ExerciseError("exercise.form", file=path, where=f"{name}{where}", wrong=what)

    if not isinstance(row, dict):
        raise wrong(row)
    unknown = [key for key in row if key not in (*_NEEDED, *_MORE)] + [
        key for key in _NEEDED if key not in row
    ]
    if unknown:
        raise wrong(listed(map(str, unknown)))
    for name in ("checks", "faults"):
        listed_rows = row.get(name, [])
        if not isinstance(listed_rows, list):
            raise wrong(listed_rows, f", {name}")
        for each in listed_rows:
            other = "text" if name == "checks" else "fault"
            if (
                not isinstance(each, dict)
                or each.keys() != {other, "when"}
                or not isinstance(each["when"], dict)
            ):
                raise wrong(each, f", {name}")
            if name == "faults" and each["fault"] not in faults():
                raise wrong(each["fault"], f", {name}")
            for word, wanted in each["when"].items():
                if word not in CONDITIONS or (word in _MAPPED) is not isinstance(wanted, dict):
                    raise wrong(f"{word}: {wanted}", f", {name}")
    if not row["checks"]:
        raise wrong("checks")
    return Exercise(
        **{**row, "checks": tuple(Check(**each) for each in row["checks"]),
           "faults": tuple(Injection(**each) for each in row.get("faults", ()))}
    )  # fmt: skip
