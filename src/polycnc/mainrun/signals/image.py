"""The signal image: inputs and outputs by name with the time of their last edge, and the machine's rules on them.

What the control puts out: `M8` while M8 waits to be done, the state and the mode in capitals (`RUNNING`, `JOG`). What
it takes in: `FIN_M8` when M8 is done (only asked for where a rule of the machine gives it), the keys of the panel
(`CYCLE_START`, `FEED_HOLD`, `RESET`, `EMERGENCY_STOP`), `SKIP`. Every other name belongs to the machine.
"""

from __future__ import annotations

from math import inf

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.machine.rules import Rule
    from polycnc.mainrun.execution.clock import Clock

_FUNCTION = regex(r"M\d+|G\d+(?:\.\d+)?")
#: In front of the function that a rule says is done.
DONE = "FIN_"
#: Rounds of the rules at one moment, after which outputs that chase each other wait for the next cycle.
ROUNDS = 50


class SignalImage:
    """Signals between control, machine and panel. A signal that nobody has set is 0.

    Args:
        start: Signals and their values at power-on.
        rules: Rules of the machine, in the order of their scan.
        clock: The time; outputs that chase each other wait for an interpolation cycle.

    Attributes:
        on_edge: Called with name and value when a signal changes.
        states: Signals that follow from the state of the control, and how they are read.
        due: When the next delay of a rule ends; inf where none runs.
    """

    def __init__(self, start: Mapping[str, float], rules: Sequence[Rule], clock: Clock) -> None:
        self._values: dict[str, float] = dict(start)
        self._edges: dict[str, float] = {}
        self._rules = rules
        self._held_since: list[float | None] = [None] * len(rules)
        self._answered = frozenset(rule.output for rule in rules if rule.output.startswith(DONE))
        self.on_edge: Callable[[str, float], None] | None = None
        self._clock = clock
        self.states: dict[str, Callable[[], bool]] = {}
        self._acted = [False] * len(rules)
        self._scanning = False
        self.due = inf

    # ---- values --------------------------------------------------------------------------------------------

    @property
    def values(self) -> Mapping[str, float]:
        """A copy of all signals."""
        return dict(self._values)

    def __getitem__(self, name: str) -> float:
        state = self.states.get(name)
        return self._values.get(name, 0.0) if state is None else float(state())

    def __setitem__(self, name: str, value: float) -> None:
        changed = self._values.get(name, 0.0) != value
        self._values[name] = float(value)
        if changed:
            self._edges[name] = self._clock.time
            if self.on_edge is not None:
                self.on_edge(name, float(value))
            self.scan()

    def since(self, name: str) -> float:
        """When a signal last changed; 0 where it never has."""
        return self._edges.get(name, 0.0)

    # ---- rules ---------------------------------------------------------------------------------------------

    def scan(self) -> None:
        """Let the rules act on the signals as they are now; `due` is when the next delay ends."""
        if self._scanning or not self._rules:
            return
        self._scanning = True
        try:
            for _ in range(ROUNDS):
                before = dict(self._values)
                self.due = self._round()
                if self._values == before:
                    return
            self.due = self._clock.time + self._clock.cycle_s
        finally:
            self._scanning = False

    def _round(self) -> float:
        now, due = self._clock.time, inf
        for number, rule in enumerate(self._rules):
            holds = rule.condition(self.__getitem__)
            since = self._held_since[number]
            if not holds:
                since = None
            elif since is None:
                since = now
            self._held_since[number] = since
            acts = since is not None and now >= since + rule.after_s
            if since is not None and not acts:
                due = min(due, since + rule.after_s)
            began = acts and not self._acted[number]
            self._acted[number] = acts
            if rule.latch:
                if began if rule.latch == "toggle" else acts:
                    self[rule.output] = rule.latched(self[rule.output])
            else:
                self[rule.output] = float(acts)
        return due

    def advance(self, time: float) -> None:
        """Let act what is due."""
        if self.due <= time:
            self.scan()

    # ---- M functions and G codes of the builder --------------------------------------------------------------

    def begin(self, word: str) -> bool:
        """A function goes out, as `M8`; whether a rule of the machine says when it is done."""
        self[word] = 1.0
        return f"{DONE}{word}" in self._answered

    def is_done(self, word: str) -> bool:
        """Whether the machine has said that a function is done."""
        return bool(self[f"{DONE}{word}"])

    def finish(self, word: str) -> None:
        """A function is done."""
        self[word] = 0.0

    def reset(self) -> None:
        """Functions under way are given up."""
        for name in [name for name in self._values if _FUNCTION.fullmatch(name)]:
            self[name] = 0.0
