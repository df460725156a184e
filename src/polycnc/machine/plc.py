"""The machine's own controller (PLC) as tables: rules on the signal image, and what it answers with alarms.

A row of the alarm table holds a condition. Some of its signals are *words*: something that is asked for at one moment,
an M code (`M6`), `S_CODE`, `T_CODE`, `B_CODE`, a key (`KEY_B3`), `CYCLE_START`, a mode (`MODE_MDI`), an axis that is to
move (`MOVE_A`) or to return to its reference point (`HOME_X`). A row with a word refuses that word while the rest of
its condition holds. A row without one is there as long as its condition holds.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypedDict, cast

from polycnc.machine.load import rule_of
from polycnc.machine.rules import condition_of, signals_in

if TYPE_CHECKING:
    from collections.abc import Iterable
    from importlib.resources.abc import Traversable

    from polycnc.machine.rules import Condition, Rule, Values
    from polycnc.machine.tables import RuleData

_WORD = re.compile(r"M\d+|[STB]_CODE|UNKNOWN_M|KEY_\w+|CYCLE_START|MODE_\w+|MOVE_\w+|HOME_\w+")


def is_word(signal: str) -> bool:
    """Whether a signal is something that is asked for at one moment."""
    return _WORD.fullmatch(signal) is not None


@dataclass(frozen=True)
class PlcAlarm:
    """A row of the alarm table.

    Attributes:
        code: Number of the alarm in the control's catalogue.
        when: When it comes.
        stops: It is an alarm, which stops the machine until a reset; else a message, which goes with its cause.
    """

    code: str
    when: str
    stops: bool = True

    @cached_property
    def condition(self) -> Condition:
        """When it comes, asked with a function that gives the value of a signal."""
        return condition_of(self.when)

    @cached_property
    def signals(self) -> frozenset[str]:
        """The signals in its condition."""
        return signals_in(self.when)

    @cached_property
    def words(self) -> frozenset[str]:
        """The words that it refuses."""
        return frozenset(filter(is_word, self.signals))


class Plc:
    """The tables of a machine's controller.

    Args:
        rules: Rules, in the order of their scan.
        alarms: Alarms and messages; of several that refuse a word the first counts.
    """

    def __init__(self, rules: Iterable[Rule] = (), alarms: Iterable[PlcAlarm] = ()) -> None:
        self.rules = tuple(rules)
        self.alarms = tuple(alarms)
        self.standing = tuple(row for row in self.alarms if not row.words)
        self._refusals: dict[str, list[PlcAlarm]] = {}
        for row in self.alarms:
            for word in row.words:
                self._refusals.setdefault(word, []).append(row)
        self._latches: dict[str, list[Rule]] = {}
        for rule in self.rules:
            for word in filter(is_word, signals_in(rule.when)) if rule.latch else ():
                self._latches.setdefault(word, []).append(rule)

    def knows(self, word: str) -> bool:
        """Whether any row answers to a word."""
        return word in self._refusals or word in self._latches

    def refusal(self, word: str, value: Values) -> PlcAlarm | None:
        """The row that refuses a word in the state that `value` tells; None where it is carried out."""

        def asked(name: str) -> float:
            return 1.0 if name == word else value(name)

        return next((row for row in self._refusals.get(word, ()) if row.condition(asked)), None)

    def latch(self, word: str, signals: dict[str, float]) -> None:
        """Let the latching rules answer to a word that is carried out, where no signal image runs."""

        def asked(name: str) -> float:
            return 1.0 if name == word else signals.get(name, 0.0)

        for rule in self._latches.get(word, ()):
            if rule.condition(asked):
                signals[rule.output] = rule.latched(signals.get(rule.output, 0.0))


class _AlarmData(TypedDict):
    code: str
    when: str


class _PlcData(TypedDict, total=False):
    rule: list[RuleData]
    alarm: list[_AlarmData]
    message: list[_AlarmData]


def read_plc(*sources: Traversable) -> Plc:
    """Read tables: `[[rule]]` as in machine files, `[[alarm]]` and `[[message]]` with `code` and `when`."""
    rules: list[Rule] = []
    alarms: list[PlcAlarm] = []
    for source in sources:
        data = cast("_PlcData", tomllib.loads(source.read_text(encoding="utf-8")))
        rules += [rule_of(table) for table in data.get("rule", ())]
        alarms += [PlcAlarm(table["code"], table["when"]) for table in data.get("alarm", ())]
        alarms += [PlcAlarm(table["code"], table["when"], stops=False) for table in data.get("message", ())]
    return Plc(rules, alarms)
