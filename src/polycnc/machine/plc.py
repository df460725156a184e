"""The machine's own controller (PLC) as tables: rules on the signal image, and what it answers with alarms.

A row of the alarm table holds a condition. Some of its signals are *words*: something that is asked for at one moment,
an M code (`M6`), a G code that the machine declares (`G100`), `S_CODE`, `T_CODE`, `B_CODE`, a key (`KEY_B3`),
`CYCLE_START`, a mode (`MODE_MDI`), an axis that is to move (`MOVE_A`) or to return to its reference point (`HOME_X`). A
row with a word refuses that word while the rest of its condition holds. A row without one is there as long as its
condition holds.
"""

from __future__ import annotations

from functools import cached_property
from itertools import product

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.rules import condition_of, signals_in
from polycnc.machine.text import NO_TEXT

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.machine.rules import Condition, Rule, Values
    from polycnc.machine.text import Text

#: What is asked for at one moment, beside M and G codes: by its name, or by how its name begins.
_WORDS = frozenset(("S_CODE", "T_CODE", "B_CODE", "UNKNOWN_M", "CYCLE_START"))
_KINDS = frozenset(("KEY", "MODE", "MOVE", "HOME"))


def is_word(signal: str) -> bool:
    """Whether a signal is something that is asked for at one moment."""
    kind, _, rest = signal.partition("_")
    if kind in _KINDS:
        return rest.replace("_", "0").isalnum()
    whole, point, digits = signal[1:].partition(".")
    if signal[:1] == "M":
        return signal[1:].isdecimal()
    if signal[:1] == "G":
        return whole.isdecimal() and (digits.isdecimal() or not point)
    return signal in _WORDS


@dataclass(frozen=True)
class PlcAlarm:
    """A row of the alarm table.

    Attributes:
        code: Number of the alarm in the control's catalogue.
        when: When it comes.
        stops: It is an alarm, which stops the machine until a reset; else a message, which goes with its cause.
        text: What it says; empty where a catalogue does.
        cause: Why it comes.
        remedy: What to do about it.
        free: Words that it lets pass all the same.
    """

    code: str
    when: str
    stops: bool = True
    text: Text = NO_TEXT
    cause: Text = NO_TEXT
    remedy: Text = NO_TEXT
    free: frozenset[str] = frozenset()

    def __getstate__(self) -> dict[str, object]:
        """Without the condition, a function that is made again where it is asked for: in another process too."""
        return {name: value for name, value in self.__dict__.items() if name != "condition"}

    @cached_property
    def condition(self) -> Condition:
        """When it comes, asked with a function that gives the value of a signal."""
        return condition_of(self.when)

    @cached_property
    def signals(self) -> frozenset[str]:
        """The signals in its condition."""
        return signals_in(self.when)

    def refuses_outright(self, word: str) -> bool:
        """Whether it refuses a word in whatever state: it says that the word has no function."""
        states = sorted(name for name in self.signals if not is_word(name))
        signals = (
            dict.fromkeys(self.signals, 0.0) | {word: 1.0, **dict(zip(states, values, strict=True))}
            for values in product((0.0, 1.0), repeat=len(states))
        )
        return all(self.condition(each.__getitem__) for each in signals)

    @cached_property
    def words(self) -> frozenset[str]:
        """The words that it refuses."""
        return frozenset(filter(is_word, self.signals)) - self.free


class Plc:
    """The tables of a machine's controller.

    Args:
        rules: Rules, in the order of their scan.
        alarms: Alarms and messages; of several that refuse a word the first counts.

    Attributes:
        standing: The rows without a word.
        asked: The signals in conditions of alarms.
        moves: The words of moves that any row answers to.
        refusing: The signals on which it depends whether some word is refused.
    """

    def __init__(self, rules: Iterable[Rule] = (), alarms: Iterable[PlcAlarm] = ()) -> None:
        self.rules = tuple(rules)
        self.alarms = tuple(alarms)
        self.standing = tuple(row for row in self.alarms if not row.words and not row.free)
        self.asked = frozenset(name for row in self.alarms if row.stops for name in row.signals)
        self._refusals: dict[str, list[PlcAlarm]] = {}
        for row in self.alarms:
            for word in row.words:
                self._refusals.setdefault(word, []).append(row)
        self._latches: dict[str, list[Rule]] = {}
        for rule in self.rules:
            for word in filter(is_word, signals_in(rule.when)) if rule.latch else ():
                self._latches.setdefault(word, []).append(rule)

        self.refusing = frozenset(
            name for rows in self._refusals.values() for row in rows for name in row.signals
        )
        self.moves = frozenset(word for word in (*self._refusals, *self._latches) if word.startswith("MOVE_"))

    def signals_of(self, word: str) -> frozenset[str]:
        """The signals on which it depends whether a word is refused."""
        return frozenset().union(*(row.signals for row in self._refusals.get(word, ())))

    def knows(self, word: str) -> bool:
        """Whether any row answers to a word."""
        return word in self._refusals or word in self._latches

    def matters(self, word: str) -> bool:
        """Whether a row refuses a word in some state, or the word sets an output that refuses others."""
        return word in self._refusals or any(
            rule.output in self.refusing for rule in self._latches.get(word, ())
        )

    def sets(self, word: str) -> bool:
        """Whether a latching rule answers to a word."""
        return word in self._latches

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
