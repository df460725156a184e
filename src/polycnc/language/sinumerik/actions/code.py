"""What a synchronised action is when the language has read it, and what its functions ask of the control."""

from __future__ import annotations

from collections.abc import Callable

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import SystemVariable

#: Values that were worked out where the block was prepared.
Frozen: TypeAlias = tuple[Any, ...]
#: Values of the parameters of a technology cycle.
Own: TypeAlias = list[Any]
#: Whether a condition holds now.
Condition: TypeAlias = Callable[["Channel", Frozen, Own, "Acting"], Any]
#: What an action does now.
Effect: TypeAlias = Callable[["Channel", Frozen, Own, "Acting"], None]
KEYWORDS = ("WHEN", "WHENEVER", "FROM", "EVERY")
#: Codes that may stand in front of a condition and behind DO.
UNITS = frozenset({"G70", "G71", "G700", "G710"})


class Acting(Protocol):
    """The control while actions run; compiled effects call it."""

    def store(self, variable: SystemVariable, indices: tuple[Any, ...], value: Any) -> None:
        """Write a system variable."""

    def store_item(self, values: list[Any], index: int, value: Any) -> None:
        """Write an R parameter, or an element of a variable."""

    def store_all(self, variable: SystemVariable, indices: tuple[Any, ...], values: tuple[Any, ...]) -> None:
        """Fill an array from an element on."""

    def repeat(self, variable: SystemVariable, indices: tuple[Any, ...], values: tuple[Any]) -> None:
        """Fill an array with one value, from an element to its end."""

    def store_items(self, items: list[Any], start: int, values: tuple[Any, ...]) -> None:
        """Fill an array of the user from an element on."""

    def repeat_items(self, items: list[Any], start: int, values: tuple[Any]) -> None:
        """Fill an array of the user with one value, from an element to its end."""

    def use_unit(self, code: str) -> None:
        """`G70` … hold for what follows in this action; empty for those of the program."""

    def word(self, address: str, index: Any, modifier: str, value: Any) -> None:
        """`POS[X]=IC(10)`, `M3`, `S2=500`, `SPOS=90`: address, index or None, what stands round the value."""

    def procedure(self, name: str, args: tuple[Any, ...]) -> None:
        """`DELDTG(X)`, `LOCK(1)`, `RDISABLE`."""

    def function(self, name: str, args: tuple[Any, ...]) -> Any:
        """A function that the main run answers: `POSRANGE(X,10,1)`."""

    def reference(self, variable: SystemVariable, indices: tuple[Any, ...]) -> Any:
        """A system variable that a function may change; it has a `value`."""

    def polynomial(self, number: int, value: float) -> float:
        """The value of a function of FCTDEF."""

    def call(self, cycle: Cycle, args: tuple[Any, ...]) -> None:
        """Run a technology cycle, behind those that were called before in this action."""


@dataclass(frozen=True, slots=True)
class Needs:
    """What an action reads and asks for, as far as its text says.

    Attributes:
        words: Addresses and procedures of its effects.
        axes: Axes that it commands; None in it stands for one that only the main run knows.
        shifts: Axes that it shifts beside everything else (`$AA_OFF`); None likewise.
        reads: System variables that it reads in every cycle.
    """

    words: frozenset[str] = frozenset()
    axes: frozenset[str | None] = frozenset()
    reads: frozenset[str] = frozenset()
    shifts: frozenset[str | None] = frozenset()

    def __or__(self, other: Needs) -> Needs:
        return Needs(
            self.words | other.words,
            self.axes | other.axes,
            self.reads | other.reads,
            self.shifts | other.shifts,
        )


@unchanging
@dataclass(frozen=True, slots=True, eq=False)
class ActionCode:
    """A block that is an action.

    Attributes:
        word: ID, IDS, or empty for one that belongs to the next block.
        keyword: WHEN, WHENEVER, FROM, EVERY, or empty.
        condition: What it waits for; None without one.
        unit: Measuring system of the condition (G70 …), and of effects without one of their own; empty for none.
        effect: What it does.
        needs: What it reads and asks for.
        program: Name of its program.
        line: Its line.
    """

    word: str
    keyword: str
    condition: Condition | None
    unit: str
    effect: Effect
    needs: Needs
    program: str
    line: int


@dataclass(frozen=True, slots=True)
class CycleLine:
    """A line of a technology cycle.

    Attributes:
        kind: `do`, `if` (goes to the target where the condition does not hold), `jump` (where it does), `end`.
        line: In its file.
        condition: Of a jump.
        effect: What it does.
        frozen: Values that were worked out where the action was prepared.
        target: Index of a line.
    """

    kind: str
    line: int
    condition: Condition | None = None
    effect: Effect | None = None
    frozen: Frozen = ()
    target: int = -1


@unchanging
@dataclass(frozen=True, slots=True, eq=False)
class Cycle:
    """A technology cycle: a subprogram that an action runs, a line in each interpolation cycle.

    Attributes:
        name: Of its program.
        lines: In order.
        needs: What they read and ask for.
    """

    name: str
    lines: tuple[CycleLine, ...]
    needs: Needs
