"""Lines of routines as the kernels read them: what is read once, however often it runs."""

from __future__ import annotations

from array import array

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import layout
from polycnc.language.bulk.kernels import NO_BLOCK, read_block
from polycnc.language.bulk.routines.flow import NOT_SCANNED
from polycnc.language.bulk.routines.layout import Line, LineKind, Routine
from polycnc.language.bulk.routines.statements import BLOCK, REFUSED

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.bulk.recipe import Spelling
    from polycnc.language.bulk.routines.statements import Statement
    from polycnc.language.bulk.scannable import Scannable
    from polycnc.language.bulk.shapes import Shapes

    Tell = Callable[[Channel, Scannable, int, bool], Statement]

#: Longer programs are no routines.
MOST_LINES = 1_000
#: So many lines are read at a time.
READ_AHEAD = 256
#: No state has this root: the shape of a block has not been looked for.
_NO_ROOT = -1


class Kept(NamedTuple):
    """A routine: its program, its first step, and how many steps it has."""

    code: Scannable
    first: int
    steps: int


class Routines:
    """Routines that are known, in the kernels' tables.

    Args:
        shapes: Keeps what statements calculate.
        spelling: How the control's text looks.
        tell: What a step of a program does; `BLOCK` where the scanner must read it, `UNREAD` where it cannot be
            told yet.

    Attributes:
        kept: The routines by their numbers.
        routines, lines, line_keys, line_values, callees: See `kernels.Tables`.
    """

    def __init__(self, shapes: Shapes, spelling: Spelling, tell: Tell) -> None:
        self.kept: list[Kept] = []
        self.routines = array("i")
        self.lines = array("i")
        self.line_keys = array("i")
        self.line_values = array("d")
        self.callees = array("i")
        self._shapes = shapes
        self._tell = tell
        self._numbers: dict[tuple[int, int, int], int] = {}
        self._state = layout.new_state(0)
        self._state.scan.grammar, self._state.scan.most_digits = spelling.flags, spelling.max_digits

    def number(self, channel: Channel, code: Scannable, first: int, count: int, program: int) -> int:
        """The routine of some steps of a program; `program` is its number in the toolpath."""
        key = id(code), first, count
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.kept)
            self.kept.append(Kept(code, first, count))
            self.routines.extend((len(self.lines) // Line.SIZE, first, count, program))
            self.lines.frombytes(bytes(4 * Line.SIZE * count))
            self.read_lines(channel, number, first, is_met=False)
        return number

    def read_lines(self, channel: Channel, routine: int, step: int, *, is_met: bool = True) -> bool:
        """Read lines from a step on that have not been read; false where that one cannot be told yet.

        Args:
            channel: The channel.
            routine: Number of the routine.
            step: The first one.
            is_met: The channel has come to that one.
        """
        code, first, steps = self.kept[routine]
        begin = self.routines[routine * Routine.SIZE + Routine.FIRST_LINE]
        for each in range(step, min(step + READ_AHEAD, first + steps)):
            line = (begin + each - first) * Line.SIZE
            if self.lines[line + Line.KIND] == LineKind.UNREAD:
                self.lines[line : line + Line.SIZE] = self._read_line(
                    channel, code, each, line // Line.SIZE, is_met=is_met and each == step
                )
        line = (begin + step - first) * Line.SIZE
        return self.lines[line + Line.KIND] != LineKind.UNREAD

    def learn_callee(self, channel: Channel, number: int, code: Scannable | None, program: int) -> None:
        """Keep which routine the number of a program calls; none for what the interpreter calls."""
        routine = NOT_SCANNED
        if code is not None and len(code.program.lines) <= MOST_LINES:
            routine = self.number(channel, code, 0, len(code.program.lines), program)
        self.callees.extend((number, routine))

    @property
    def tables(self) -> tuple[array[int], array[int], array[int], array[float], array[int]]:
        """As `kernels.Tables` ends."""
        return self.routines, self.lines, self.line_keys, self.line_values, self.callees

    def _read_line(
        self, channel: Channel, code: Scannable, step: int, number: int, *, is_met: bool
    ) -> array[int]:
        """The record of a line; `number` is its place among all lines."""
        told = self._tell(channel, code, step, is_met)
        if len(told.numbers) > layout.MOST_LITERALS or told.loop >= layout.LOOPS:
            told = REFUSED
        line = array("i", bytes(4 * Line.SIZE))
        line[Line.KIND], line[Line.NUMBER], line[Line.ROOT] = told.kind, code.line(step), _NO_ROOT
        line[Line.FIRST_KEY], line[Line.FIRST_VALUE] = len(self.line_keys), len(self.line_values)
        line[Line.LITERALS], line[Line.TARGET], line[Line.LOOP] = len(told.numbers), told.target, told.loop
        self.line_values.extend(told.numbers)
        if told.callee is not None:
            callee, program, steps = told.callee
            line[Line.TARGET] = self.number(channel, callee, 0, steps, program)
        if told.formulas:
            line[Line.FORMULAS] = self._shapes.add_formulas(told.formulas)
        if told.is_known:
            self.line_keys.extend(_keys_of_line(number))
            line[Line.KEYS] = len(self.line_keys) - line[Line.FIRST_KEY]
        elif told is BLOCK:
            self._read(code.program.lines[code.line_of_step(step)], line)
        return line

    def _read(self, text: str, line: array[int]) -> None:
        """Keep keys and values of a block as the kernel reads them."""
        state, empty, no_numbers = self._state, array("i"), array("d")
        state.scan.place = state.scan.root = 0
        content = array("B", f"{text}\n".encode("utf-8", "replace"))
        tables = layout.Tables(
            content,
            self._shapes.nexts,
            empty,
            empty,
            no_numbers,
            empty,
            empty,
            empty,
            empty,
            no_numbers,
            empty,
        )
        place, node = read_block(tables, state)
        if place < 0:
            line[Line.KIND] = LineKind.REFUSED
            return
        if node == NO_BLOCK:
            line[Line.KIND] = LineKind.NOTHING
            return
        keys = list(state.keys[: state.scan.keys])
        tokens = [key - layout.FIRST_TOKEN for key in keys]
        words = sum(key < layout.FIRST_CODE or layout.FIRST_FORMULA <= key < layout.ASSIGNED for key in keys)
        literals = sum(
            token in (layout.Token.VARIABLE, layout.Token.NUMBER, layout.Token.DECIMAL) for token in tokens
        )
        line[Line.KEYS], line[Line.WORDS], line[Line.LITERALS] = len(keys), words, literals
        self.line_keys.extend(keys)
        self.line_values.extend(state.values[:words])
        self.line_values.extend(state.values[layout.MOST_WORDS : layout.MOST_WORDS + literals])


def _keys_of_line(number: int) -> list[int]:
    """Keys that no other line has."""
    figures = [layout.LINE_KEY]
    while number:
        number, figure = divmod(number, layout.Token.SIZE)
        figures.append(layout.FIRST_TOKEN + figure)
    return figures
