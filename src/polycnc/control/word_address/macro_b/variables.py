"""Variables of custom macro B: local, common, system; vacant is None (reference: FANUC macro B §1, §2).

System variables stand in a registry of ranges, each with what reads and what writes it. A family gives its registry;
the store looks a number up and calls.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.channel.states.unchanging import unchanging
from polycnc.control.signals import AskedSignals
from polycnc.control.word_address.memory import Memory
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.units import INCH_MM
from polycnc.language.word_address.functions import round_half_away
from polycnc.memory.retained import VARIABLE_NAMES, VARIABLES
from polycnc.toolpath.events import Print

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.control.word_address.parameters import MacroAxisParameters, MacroParameters
    from polycnc.messages import AlarmError

#: What reads and what writes a variable: they get the memory of their family.
Read = Callable[[Any, int], "float | None"]
Write = Callable[[Any, int, "float | None", str], None]
LOCALS = 34
#: #100 to #199 are cleared with the power, #500 to #999 stay.
COMMONS, KEPT = 200, range(500, 1000)
#: Further variables that stay.
FURTHER = range(98000, 98500)


@dataclass(frozen=True, slots=True)
class SystemRange:
    """System variables `first` to `last`. `read` and `write` get the offset from `first`; None refuses.

    `name` is the system name of the range (`_ABSIO`), by which `[#_ABSIO[1]]` finds it; `index` that of its first one.
    """

    first: int
    last: int
    read: Read | None = None
    write: Write | None = None
    name: str = ""
    index: int = 1


@unchanging
class Registry:
    """The system variables of a control.

    Args:
        ranges: Which numbers there are, and what reads and writes them.
        aliases: Further names: first and last number of what each stands for.
    """

    def __init__(
        self, ranges: Sequence[SystemRange], aliases: Mapping[str, tuple[int, int]] | None = None
    ) -> None:
        self._ranges = sorted(ranges, key=lambda item: item.first)
        self._firsts = [item.first for item in self._ranges]
        self.names = {item.name: item for item in self._ranges if item.name}
        self.names |= {
            name: SystemRange(first, last, name=name) for name, (first, last) in (aliases or {}).items()
        }

    def find(self, number: int) -> SystemRange | None:
        """The range that holds a number."""
        i = bisect_right(self._firsts, number) - 1
        if i < 0 or number > self._ranges[i].last:
            return None
        return self._ranges[i]


@dataclass(slots=True)
class LocalState(State, lifetime=Lifetime.RESET):
    """#1 to #33 of the main program (index 0 is #0, vacant)."""

    main: list[float | None] = field(default_factory=lambda: [None] * LOCALS)


@dataclass(slots=True)
class CommonVariables(State, lifetime=Lifetime.POWER):
    """#100 to #199, by number."""

    values: list[float | None] = field(default_factory=lambda: [None] * COMMONS)


@dataclass(slots=True)
class MacroSignals(State, lifetime=Lifetime.POWER):
    """Interface signals between macro and machine by name (UI000 …, UO000 …)."""

    values: dict[str, int] = field(default_factory=dict)

    @classmethod
    def first(cls, channel: Channel) -> MacroSignals:
        """What the setup says."""
        return cls(AskedSignals(channel.setup.switches.signals, channel))


@dataclass(slots=True)
class ControlSwitches(State, lifetime=Lifetime.POWER):
    """Settings by #3003 to #3005, #3901, #3902, by their names."""

    values: dict[str, int] = field(default_factory=dict)


def locals_of(level: Level) -> list[float | None]:
    """#1 to #33 of a level; vacant ones where it has none."""
    return level.locals if isinstance(level.locals, list) else [None] * LOCALS


@dataclass(slots=True)
class VariableTables(State, lifetime=Lifetime.RETAINED):
    """#500 to #999 and #98000 to #98499, and names given by SETVN."""

    values: dict[int, float | None] = retained(VARIABLES)
    names: dict[str, int] = retained(VARIABLE_NAMES)


def lies_in_table(number: int) -> bool:
    """Whether a variable outlives the power."""
    return number in KEPT or number in FURTHER


class MacroMemory(Memory):
    """A control's memory with the variables of custom macro B.

    Attributes:
        locals: #1 to #33 of the running macro level (index 0 is #0, vacant).
        common: #100 to #199, by number.
        kept: #500 to #999, all of them, and of #98000 to #98499 those that were written.
        names: Names given by SETVN.
    """

    parameters: MacroParameters[MacroAxisParameters]

    def __init__(self, channel: MacroChannel, registry: Callable[[], Registry]) -> None:
        super().__init__(channel)
        self.channel: MacroChannel = channel
        self._registry = registry
        self.locals = LocalState.of(channel).main
        self.common = CommonVariables.of(channel).values
        tables = VariableTables.of(channel)
        self.kept, self.names = tables.values, tables.names
        self._was_kept = bool(self.kept)
        if not self.kept:
            self.kept.update(dict.fromkeys(KEPT))

    @property
    def registry(self) -> Registry:
        """The system variables: a program that names none does not load them."""
        return self._registry()

    @property
    def signals(self) -> dict[str, int]:
        """Interface signals between macro and machine."""
        return MacroSignals.of(self.channel).values

    # ---- what generated expressions call ------------------------------------------------------------------------

    @property
    def angle_range_signed(self) -> bool:
        """Angles of ATAN are -180 to 180 degrees, else 0 to 360."""
        return self.parameters.NAT

    @property
    def joined_conditions(self) -> bool:
        """AND, OR and XOR may join conditions."""
        return self.parameters.MLG

    @property
    def joining_hint(self) -> str:
        """What to do where conditions are joined that may not be."""
        return str(self.channel.control.JOINING_HINT)

    def fail(self, mistake: str, hint: str = "") -> AlarmError:
        """The control's alarm for a mistake in an expression."""
        control = self.channel.control
        error: AlarmError = control.fail(mistake, hint=hint)
        return error

    @property
    def increment(self) -> float:
        """Least increment of lengths in the program's unit."""
        return 0.0001 if self.is_inch else 0.001

    @property
    def is_inch(self) -> bool:
        """Whether the program's unit is the inch."""
        control = self.channel.control
        return bool(control.is_inch(self.channel.mode))

    def read(self, number: int) -> float | None:
        """A variable by number."""
        if 1 <= number < LOCALS:
            return self.locals[number]
        if number == 0:
            return None
        if 100 <= number <= 199:
            return self.common[number]
        if lies_in_table(number):
            return self.kept.get(number)
        found = self.registry.find(number)
        if found is None:
            raise self.fail("variable_number")
        if found.read is None:
            raise self.fail("read_protected")
        return found.read(self, number - found.first)

    def write(self, number: int, value: float | None, text: str = "") -> None:
        """Set a variable; `text` is the comment behind the statement (#3000, #3006)."""
        if 1 <= number < LOCALS:
            self.locals[number] = value
        elif 100 <= number <= 199:
            self.common[number] = value
        elif lies_in_table(number):
            self.kept[number] = value
        else:
            found = self.registry.find(number)
            if found is None and number != 0:
                raise self.fail("variable_number")
            if found is None or found.write is None:
                raise self.fail("write_protected")
            found.write(self, number - found.first, value, text)

    def read_indirect(self, number: float) -> float | None:
        """`#[expression]`: the index is rounded to a whole number."""
        return self.read(self._index(number))

    def write_indirect(self, number: float | None, value: float | None, text: str) -> None:
        """Set `#[expression]`."""
        self.write(self._index(number or 0.0), value, text)

    def _index(self, number: float) -> int:
        index = int(round_half_away(number))
        if index < 0:
            raise self.fail("variable_number")
        return index

    def parameter(self, number: float, bit: float | None, axis: float | None) -> float:
        """`PRM[…]`: a machine parameter; 0 for one that polycnc does not have."""
        names = self.channel.axes
        if axis is not None and not 1 <= axis <= len(names):
            raise self.fail("argument_range")
        name = names[int(axis) - 1] if axis is not None else None
        return self.parameters.at(int(number), None if bit is None else int(bit), name) or 0.0

    def read_named(self, name: str, index: float | None) -> float | None:
        """`[#NAME]`, `[#_ABSIO[n]]`: a variable by its name."""
        return self.read(self.number_of(name, index))

    def number_of(self, name: str, index: float | None) -> int:
        """The number of the variable with a name: names of SETVN, then system names."""
        offset = 0 if index is None else self._index(index)
        if name in self.names:
            return self.names[name] + offset
        found = self.registry.names.get(name)
        if found is None:
            raise self.fail("variable_name")
        number = found.first + (0 if index is None else offset - found.index)
        if not found.first <= number <= found.last:
            raise self.fail("variable_number")
        return number

    @property
    def kept_at_reset(self) -> tuple[type[State], ...]:
        """#1 to #33 by 6001#7 CLV."""
        return (LocalState,) if self.parameters.CLV else ()

    def forget_commons(self) -> None:
        """#100 to #199 are vacant, by 6001#6 CCV; behind a program's end they can still be read."""
        if not self.parameters.CCV:
            self.common[:] = [None] * COMMONS

    def forget_locals(self) -> None:
        """The local variables are those of the main program, as they begin."""
        self.locals = LocalState.of(self.channel).main

    # ---- printing -----------------------------------------------------------------------------------------------

    def print_line(self, parts: list[str | tuple[float | None, int, int]]) -> None:
        """DPRNT: one line of text; vacant variables print nothing (6001#1 PRT: without leading blanks)."""
        pads = not self.parameters.PRT
        text = "".join(part if isinstance(part, str) else format_number(*part, pads=pads) for part in parts)
        self.channel.event(Print(text))

    # ---- by name, for reports and test cases --------------------------------------------------------------------

    def read_text(self, name: str) -> float | None:
        """`#100` or `#DEPTH` as a user names it."""
        body = name.lstrip("#")
        return self.read(int(body)) if body.isdigit() else self.read_named(body, None)

    def is_kept(self, name: str) -> bool:
        """Whether a variable has its value from an earlier power-on: #500 on."""
        body = name.lstrip("#")
        return self._was_kept and body.isdigit() and lies_in_table(int(body))

    def variable_names(self) -> list[str]:
        """Local and common variables that are not vacant."""
        numbers = [
            n for values in (self.locals, self.common) for n, value in enumerate(values) if value is not None
        ]
        return [f"#{n}" for n in numbers + [n for n, value in self.kept.items() if value is not None]]

    def write_text(self, name: str, value: object) -> None:
        """Set a variable as a user names it."""
        number = None if value is None else float(str(value))
        self.write(int(name.lstrip("#")), number)

    def to_program_unit(self, millimetres: float) -> float:
        """A length as the program sees it."""
        return millimetres / INCH_MM if self.is_inch else millimetres

    def from_program_unit(self, value: float | None) -> float:
        """A length of the program in millimetres."""
        return (value or 0.0) * (INCH_MM if self.is_inch else 1.0)


def format_number(value: float | None, whole: int, decimals: int, *, pads: bool) -> str:
    """A number as DPRNT sends it: rounded, a sign place and leading blanks where `pads`."""
    if value is None:
        return ""
    rounded = round_half_away(abs(value) * 10**decimals) / 10**decimals
    digits = f"{rounded:.{decimals}f}"
    sign = "-" if value < 0 and rounded else ""
    if not pads:
        return sign + digits
    return (sign or " ") + digits.rjust(whole + decimals + (1 if decimals else 0))
