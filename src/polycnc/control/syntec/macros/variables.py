"""Variables of the macro language: locals by level, `#` spaces, `@` spaces and R registers behind them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable

from polycnc.channel.states.state import Lifetime, State, lasting, retained
from polycnc.control.signals import AskedSignals
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.syntec.expressions import LAST_LOCAL, NO_SUCH_VARIABLE
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value, number, storable, to_long, whole
from polycnc.memory.retained import REGISTERS, VARIABLES
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from random import Random

    from polycnc.channel.stack import Level
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.deferred.typing import Self

Read = Callable[["SyntecMemory", int], Value]
Write = Callable[["SyntecMemory", int, Value], None]

#: Words of a call and the local variables that they set. G, N and O cannot be arguments.
ARGUMENTS = {
    "A": 1, "B": 2, "C": 3, "I": 4, "J": 5, "K": 6, "D": 7, "E": 8, "F": 9, "H": 11, "L": 12, "M": 13,
    "P": 16, "Q": 17, "R": 18, "S": 19, "T": 20, "U": 21, "V": 22, "W": 23, "X": 24, "Y": 25, "Z": 26,
}  # fmt: skip
LETTERS = {variable: letter for letter, variable in ARGUMENTS.items()}
#: A macro that reads one of these words takes them all.
AXIS_LETTERS = frozenset("XYZABCIJKUVW")
#: Letters whose words may carry an index (`X1=`).
INDEXED_LETTERS = frozenset("ABCFSUVWXYZ")

#: Names of single bits of the PLC interface that setups may give, and the functions that read them.
BIT_FAMILIES = "IOAC"
#: R registers that a macro may write; the others belong to the control and the PLC.
WRITABLE_REGISTERS = (
    (50, 80), (101, 511), (1024, 4095), (5800, 7999), (10000, 10999), (15000, 65535),
)  # fmt: skip
#: What the control alone writes: speeds of G31.11 (2.77), angles of spindles (2.86.5). A setup may say it.
SHOWN_REGISTERS = (range(700, 719), range(761, 777))
#: What a register of the interface holds until somebody sets it: R19 is a feed override in percent.
DELIVERED_REGISTERS = {19: 100}
#: Windows of `@` on R registers: first `@`, last `@`, first R.
REGISTER_WINDOWS = ((401, 655, 1), (10000, 14095, 0), (100000, 165535, 0))
#: `#` variables of the axis group, numbers that outlive the power.
USER = range(401, 1000)
#: What else outlives the power: R registers (tool guide), `@` variables beside the windows (list of variables).
RETENTIVE_REGISTERS, RETENTIVE_GLOBALS = range(103, 256), (range(656, 2000), range(60000, 80000))
#: Other `@` variables that exist.
GLOBAL_RANGES = ((1, 400), (656, 1999), (60000, 79999))
BYTES_PER_VARIABLE = 4


class Locals(dict[int, Value]):
    """Local variables of a macro level, filled with the words of its call.

    Attributes:
        words: The words of the calling block by address (`X`, `X1`), in the order typed.
        trapped: Under G66 the words of the block that the macro follows.
        taken: Addresses that the macro has read.
        returns_words: What it has not read of its block acts when it is over (a macro called by a code).
        other_codes: Further M codes of its block.
    """

    def __init__(self, words: dict[str, Value], *, returns_words: bool = False) -> None:
        super().__init__()
        self.words = words
        self.trapped: dict[str, Value] = {}
        self.taken: set[str] = set()
        self.returns_words = returns_words
        self.other_codes: tuple[str, ...] = ()
        self.fill()

    def fill(self) -> None:
        """Set the arguments, as at the start of each pass; everything else is vacant."""
        self.clear()
        for address, value in self.words.items():
            variable = ARGUMENTS.get(address)
            if variable is not None:
                self[variable] = value

    def get(self, key: int, default: Any = VACANT) -> Any:
        """The value of a local variable; reading an argument takes its word."""
        letter = LETTERS.get(key)
        if letter is not None:
            self.take(letter)
        return super().get(key, default)

    def argument(self, name: str) -> Value:
        """A word of the calling block; VACANT where it is missing."""
        self.take(name)
        return self.words.get(name, VACANT)

    def take(self, address: str) -> None:
        """The macro deals with a word, and with all axis words if it is one."""
        if address[0] in AXIS_LETTERS:
            self.taken |= AXIS_LETTERS
        self.taken.add(address)

    def remaining(self) -> dict[str, Value]:
        """Words that the macro has not read."""
        return {
            address: value
            for address, value in self.words.items()
            if address not in self.taken and address[0] not in self.taken & AXIS_LETTERS
        }


@dataclass(slots=True)
class LocalState(State, lifetime=Lifetime.RESET):
    """#1 to #400 of the main program."""

    main: dict[int, Value] = field(default_factory=dict)


def locals_of(level: Level) -> dict[int, Value]:
    """#1 to #400 of a level; vacant ones where it has none."""
    return level.locals if isinstance(level.locals, dict) else {}


@dataclass(slots=True)
class SpaceState(State, lifetime=Lifetime.POWER):
    """`#` variables that are kept as they are written, by their offset in the space; `words` by number (#1502 …).

    Those of `user` (USER) outlive the power.
    """

    user: dict[int, Value] = retained(VARIABLES)
    words: dict[int, int] = field(default_factory=dict)
    modal_longs: dict[int, Value] = lasting(Lifetime.RESET, factory=dict)
    modal_doubles: dict[int, Value] = lasting(Lifetime.RESET, factory=dict)


def _numbers() -> Random:
    """The numbers of RANDOM: the same ones in every run."""
    from random import Random

    return Random(0)


@dataclass(slots=True)
class FunctionState(State, lifetime=Lifetime.POWER):
    """What functions remember: PUSH and POP, RANDOM, SETDRAW."""

    stack: list[Value] = lasting(Lifetime.RESET, factory=list)
    random: Random = field(default_factory=_numbers)
    colour: int = 0
    filled: bool = False
    radius: float = 0.0


@dataclass(slots=True)
class BitState(State, lifetime=Lifetime.POWER):
    """Bits I, O, A, C of the PLC interface by name."""

    bits: dict[str, int]

    @classmethod
    def first(cls, channel: SyntecChannel) -> Self:
        """The bits that the setup gives."""
        signals = channel.setup.switches.signals.items()
        names = (pair for pair in signals if pair[0][:1] in BIT_FAMILIES and pair[0][1:].isdigit())
        return cls(AskedSignals(dict(names), channel))


@dataclass(frozen=True, slots=True)
class Space:
    """Variables `first` to `last`, read and written by their offset; without `write` read-only."""

    first: int
    last: int
    read: Read
    write: Write | None = None


class Registry:
    """Spaces of `#` variables by number."""

    def __init__(self, spaces: Iterable[Space]) -> None:
        self._spaces: Sequence[Space] = sorted(spaces, key=lambda space: space.first)
        self._firsts = [space.first for space in self._spaces]

    def find(self, index: int) -> Space:
        """The space that holds a number; the alarm where there is none."""
        place = bisect_right(self._firsts, index) - 1
        if place < 0 or index > self._spaces[place].last:
            raise AlarmError(NO_SUCH_VARIABLE, variable=f"#{index}")
        return self._spaces[place]


def stored(values: Callable[[SpaceState], dict[int, Value]]) -> tuple[Read, Write]:
    """Reader and writer of a space that holds values of any type, or none."""

    def read(memory: SyntecMemory, offset: int) -> Value:
        return values(SpaceState.of(memory.channel)).get(offset, VACANT)

    def write(memory: SyntecMemory, offset: int, value: Value) -> None:
        put(values(SpaceState.of(memory.channel)), offset, value)

    return read, write


def put(values: dict[int, Value], index: int, value: Value) -> None:
    """Store a value; VACANT clears."""
    if isinstance(value, Vacant):
        values.pop(index, None)
    else:
        values[index] = value


@dataclass(slots=True)
class GlobalState(State, lifetime=Lifetime.RETAINED):
    """The `@` variables and the R registers, which all axis groups share: also those that go with the power."""

    values: dict[int, Value] = retained(VARIABLES, of_control=True)
    registers: dict[int, int] = retained(REGISTERS, of_control=True)

    def forget(self) -> None:
        """Power-on: what does not outlive the power is as delivered."""
        for kept, table in ((is_retentive_register, self.registers), (is_retentive_global, self.values)):
            for index in [index for index in table if not kept(index)]:
                del table[index]

    def read(self, index: Value) -> Value:
        """The value of `@index`."""
        at = whole(index, NO_SUCH_VARIABLE)
        if at == 0:
            return VACANT
        register = register_of(at)
        if register is not None:
            return self.read_register(register)
        _check_global(at)
        return self.values.get(at, VACANT)

    def write(self, index: Value, value: Value) -> None:
        """`@index := value`; a text fills four bytes a variable, its first character lowest."""
        at = whole(index, NO_SUCH_VARIABLE)
        if isinstance(value, Text):
            self._write_text(at, value)
            return
        register = register_of(at)
        if register is not None:
            self.write_register(register, value)
            return
        _check_global(at)
        put(self.values, at, storable(value))

    def read_register(self, register: int) -> int:
        """The value of an R register.

        Raises:
            AlarmError: It is one that the control shows something in, which polycnc does not know.
        """
        value = self.registers.get(register)
        if value is not None:
            return value
        if any(register in shown for shown in SHOWN_REGISTERS):
            raise AlarmError("PC0001", hint="hint.not-supported", code=f"R{register}")
        return DELIVERED_REGISTERS.get(register, 0)

    def write_register(self, register: int, value: Value) -> None:
        """Set an R register, where a macro may."""
        if not any(first <= register <= last for first, last in WRITABLE_REGISTERS):
            raise AlarmError(NO_SUCH_VARIABLE, variable=f"R{register}", hint="hint.syntec.register")
        self.registers[register] = to_long(value)

    def _write_text(self, at: int, text: Text) -> None:
        data = text.encode("utf-8") or b"\0"
        data += b"\0" * (-len(data) % BYTES_PER_VARIABLE)
        for offset in range(0, len(data), BYTES_PER_VARIABLE):
            piece = int.from_bytes(data[offset : offset + BYTES_PER_VARIABLE], "little", signed=True)
            self.write(at + offset // BYTES_PER_VARIABLE, piece)
        if text and not len(text.encode("utf-8")) % BYTES_PER_VARIABLE:
            self.write(at + len(data) // BYTES_PER_VARIABLE, 0)

    def read_text(self, index: Value) -> Text:
        """The text stored from `@index` on."""
        at = whole(index, NO_SUCH_VARIABLE)
        data = b""
        while not data.endswith(b"\0"):
            value = number(self.read(at))
            data += to_long(value).to_bytes(BYTES_PER_VARIABLE, "little", signed=True)
            at += 1
            end = data.find(b"\0")
            if end >= 0:
                data = data[: end + 1]
        return Text(data[:-1].decode("utf-8", "replace"))


def register_of(index: int) -> int | None:
    """The R register behind a `@` number, or None."""
    for first, last, register in REGISTER_WINDOWS:
        if first <= index <= last:
            return index - first + register
    return None


def _check_global(index: int) -> None:
    if not any(first <= index <= last for first, last in GLOBAL_RANGES):
        raise AlarmError(NO_SUCH_VARIABLE, variable=f"@{index}")


def is_retentive_register(register: int) -> bool:
    """Whether an R register outlives the power."""
    return register in RETENTIVE_REGISTERS


def is_retentive_global(index: int) -> bool:
    """Whether `@index` outlives the power; in a window its register says so."""
    register = register_of(index)
    if register is not None:
        return is_retentive_register(register)
    return any(index in kept for kept in RETENTIVE_GLOBALS)


def is_local(index: int) -> bool:
    """Whether `#index` is a local variable."""
    return 1 <= index <= LAST_LOCAL
