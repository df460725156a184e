"""Statements of the macro language, laid out as a flat list of steps with jumps between them.

    IF c THEN a; ELSE b; END_IF;        0  unless c: to 3
                                        1  a
                                        2  to 4
                                        3  b
                                        4

A mistake in the text becomes a step that raises its alarm: like the control, a program runs up to the
statement that cannot be read. `check` lists the mistakes of a file without running it.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.operators import TIGHTEST
from polycnc.language.syntec.blocks import BlockReader
from polycnc.language.syntec.expressions import LAST_LOCAL, number_value
from polycnc.language.syntec.functions import FUNCTIONS
from polycnc.language.syntec.layout import (
    KINDS,
    Group,
    Label,
    Layout,
    assign_local,
    assign_nowhere,
    choose,
    for_next,
    for_test,
    goto,
    jump,
    nothing,
    one,
    running,
    unless,
)
from polycnc.language.syntec.tokens import OPENERS, PARTS, Token, fault
from polycnc.language.syntec.values import LONG_MAX, storable
from polycnc.language.word_address.executable import SkippedBlock
from polycnc.language.word_address.words import WordBlock
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.steps import Step
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.language.syntec.expressions import Evaluate

TOO_COMPLEX, TOO_DEEP = "COM-005", "COM-007"
CASE_COLON = "COM-025"
MAX_NESTING = 10
MAX_GROUPS = 512
MAX_ELSEIF = 512


class StatementReader(BlockReader):
    """Reads a whole text into a layout.

    Args:
        tokens: The text.
        shapes: Compiled code of the control.
        macro: A file with `%@MACRO`, with block statements; an ISO file has words and assignments only.
    """

    def __init__(self, tokens: Sequence[Token], shapes: Shapes, *, macro: bool = True) -> None:
        super().__init__(tokens, shapes)
        self.macro = macro
        self.layout = Layout()
        self._groups: list[Group] = []
        self._counts: dict[str, int] = {}

    def read(self) -> Layout:
        """The layout of the whole text."""
        while self.token.kind != "end":
            start, steps = self.place, len(self.layout.steps)
            try:
                self._statement()
                if len(self.layout.steps) == steps + 1 and self._filled_line(start):
                    self.layout.fills_line(self.tokens[start].line)
            except AlarmError as error:
                self.forget_literals()
                self.layout.fail(error)
                self._recover(start)
        while self._groups:
            self._missing_closer(self._groups.pop())
        return self.layout

    def _recover(self, start: int) -> None:
        """Go on behind a mistake: at the next semicolon or line."""
        if self.place == start:
            self.take()
        while not self.at_end() and not self.token.first:
            self.take()
        self.accept(";")

    def _filled_line(self, start: int) -> bool:
        """Whether the statement from a token on is a block of numbers that has its line for itself."""
        first, last = self.tokens[start], self.tokens[self.place - 1]
        closed = last.kind == "plain" or (last.text == ";" and last.line == first.line)
        return first.first and closed and self.token.first and isinstance(self.layout.steps[-1], WordBlock)

    # ---- one statement -----------------------------------------------------------------------------------

    def _statement(self) -> None:
        token = self.token
        if token.kind == "plain":
            self.take()
            self._plain(token)
            return
        if self.accept(";"):
            if not self.macro:
                self.layout.emit(WordBlock((), []), token.line)
            return
        levels = self._skip_marks()
        labelled = self._sequence_number()
        levels |= self._skip_marks()
        if levels:
            self._skipped_statement(levels, token.line)
        elif labelled and self._at_line_end():
            self.layout.emit(WordBlock((), []), token.line)
            self._close(token)
        else:
            self._unlabelled(self.token)

    def _plain(self, token: Token) -> None:
        sequence, block = self.plain_block(token)
        if sequence is not None:
            self.layout.sequences.setdefault(sequence, len(self.layout.steps))
        self.layout.emit(block, token.line)

    def _skipped_statement(self, levels: int, line: int) -> None:
        """A statement behind `/`; block statements cannot be skipped."""
        if self.token.text in KINDS or self.token.text in PARTS:
            raise fault(self.token)
        outer, self.layout = self.layout, Layout()
        try:
            if self._at_line_end():
                self.layout.emit(WordBlock((), []), line)
                self._close(self.token)
            else:
                self._unlabelled(self.token)
            outer.emit(SkippedBlock(levels, self.layout.steps[0], nothing), line)
        finally:
            self.layout = outer

    def _skip_marks(self) -> int:
        """Bit mask of the block skip levels marked here: `/` and `/1` are level 1."""
        levels = 0
        while self.accept("/"):
            digit = self.token.kind == "number" and self.token.text in "123456789"
            levels |= 1 << (int(self.take().text) if digit else 1)
        return levels

    def _sequence_number(self) -> bool:
        """Read `Nn` if it stands here."""
        number = (
            self.tokens[self.place + 1] if self.token.kind == "letter" and self.token.text == "N" else None
        )
        if number is None or not number.text.isdigit():
            return False
        self.take()
        self.take()
        self.layout.sequences.setdefault(int(number_value(number)), len(self.layout.steps))
        return True

    def _at_line_end(self) -> bool:
        return self.at_end() or self.token.first

    def _unlabelled(self, token: Token) -> None:
        """A statement by its first token."""
        if token.kind == "name" and (token.text in OPENERS or token.text in PARTS):
            if not self.macro:
                raise fault(token, hint="hint.syntec.no-macro-header")
            self.take()
            _READERS[token.text](self, token)
        elif token.kind == "number" and self._groups and self._groups[-1].kind is KINDS["CASE"]:
            self._case_label(self._groups[-1])
        elif token.kind == "name" and token.text in FUNCTIONS and FUNCTIONS[token.text].statement:
            self._function(token)
        elif token.text in ("#", "@") or (token.kind == "name" and token.text in ("AR", "MAR")):
            self.layout.emit(self._assignment(), token.line)
            self._close(token)
        else:
            self._block_words(token)

    def _block_words(self, token: Token) -> None:
        if token.kind not in ("letter", "symbol") or (token.kind == "symbol" and token.text != ","):
            raise fault(token)
        self.layout.emit(self.block(), token.line)
        self._close(token)

    def _close(self, start: Token) -> None:
        """The end of a statement: `;`, or a line end where a new statement begins."""
        if self.accept(";"):
            return
        if not self.token.first:
            raise fault(self.token)
        if self.macro:
            self.layout.unclosed.append(start.line)

    def _function(self, token: Token) -> None:
        if not self.macro:
            raise fault(token, hint="hint.syntec.no-macro-header")
        self.layout.emit(running(self.evaluator(self.expression(TIGHTEST))), token.line)
        self._close(token)

    # ---- assignments -------------------------------------------------------------------------------------

    def _assignment(self) -> Step:
        """`#n := e`, `@[e] := e`, `#n = e`."""
        family = self.take()
        if family.text in ("AR", "MAR"):
            index = self.evaluator(self.index())
            self._becomes()
            return assign_nowhere(index, self.evaluator(self.expression()))
        number = self.token
        if family.text == "#" and number.kind == "number" and number.text.isdigit():
            local = int(number_value(number))
            if 1 <= local <= LAST_LOCAL:
                self.take()
                self._becomes()
                return assign_local(local, self.evaluator(self.expression()))
        index = self.evaluator(self.index())
        self._becomes()
        value = self.evaluator(self.expression())
        if family.text == "#":
            return lambda channel: channel.memory.set_variable(index(channel), storable(value(channel)))
        return lambda channel: channel.memory.set_register(index(channel), storable(value(channel)))

    def _becomes(self) -> None:
        if not self.accept(":="):
            self.expect("=")

    # ---- groups ------------------------------------------------------------------------------------------

    def _open(self, token: Token) -> Group:
        """A block statement begins."""
        kind = KINDS[token.text]
        group = Group(kind, token, len(self.layout.steps))
        self._groups.append(group)
        if len(self._groups) > MAX_NESTING:
            raise fault(token, TOO_DEEP)
        count = self._counts[token.text] = self._counts.get(token.text, 0) + 1
        if count > MAX_GROUPS:
            raise fault(token, kind.too_many)
        return group

    def _innermost(self, token: Token, name: str) -> Group:
        """The open group to which a part belongs; groups inside it have lost their closing word."""
        kind = KINDS[name]
        if not any(group.kind is kind for group in self._groups):
            raise fault(token, kind.head_missing)
        while self._groups[-1].kind is not kind:
            self._missing_closer(self._groups.pop())
        return self._groups[-1]

    def _missing_closer(self, group: Group) -> None:
        kind = group.kind
        code = kind.closer_missing_late if group.late else kind.closer_missing
        self.layout.place(group.end)
        self.layout.fail(fault(group.head, code), group.start)

    def _end_group(self, group: Group) -> None:
        self._groups.pop()
        self.layout.place(group.end)

    def read_if(self, token: Token) -> None:
        """`IF c THEN`."""
        group = self._open(token)
        condition = self.evaluator(self.expression())
        self.expect("THEN", group.kind.head_missing)
        self.layout.emit(unless(condition, group.branch), token.line)

    def read_elseif(self, token: Token) -> None:
        """`ELSEIF c THEN`."""
        group = self._innermost(token, "IF")
        if group.late:
            raise fault(token, group.kind.head_missing)
        group.branches += 1
        if group.branches > MAX_ELSEIF:
            raise fault(token, TOO_COMPLEX)
        self._end_branch(group, token)
        condition = self.evaluator(self.expression())
        self.expect("THEN", group.kind.head_missing)
        self.layout.emit(unless(condition, group.branch), token.line)

    def _end_branch(self, group: Group, token: Token) -> None:
        """The branch before an ELSEIF or ELSE leaves the group; a false condition comes here."""
        self.layout.emit(jump(group.end), token.line)
        self.layout.place(group.branch)
        group.branch = Label()

    def read_else(self, token: Token) -> None:
        """`ELSE` of IF or CASE."""
        inner = next((g for g in reversed(self._groups) if not g.kind.loop), None)
        name = "CASE" if inner is not None and inner.kind is KINDS["CASE"] else "IF"
        group = self._innermost(token, name)
        if group.late:
            raise fault(token, group.kind.head_missing)
        self._end_branch(group, token)
        group.late = True
        if name == "CASE":
            group.other = Label()
            self.layout.place(group.other)

    def read_end_if(self, token: Token) -> None:
        """`END_IF`."""
        group = self._innermost(token, "IF")
        self.layout.place(group.branch)
        self._end_group(group)
        self._close(token)

    def read_case(self, token: Token) -> None:
        """`CASE e OF`."""
        group = self._open(token)
        selector = self.evaluator(self.expression())
        self.expect("OF", group.kind.head_missing)
        self.layout.emit(choose(selector, group), token.line)

    def _case_label(self, group: Group) -> None:
        """`1:`, `2, 3:`; what stands before leaves the group."""
        if group.late:
            raise fault(self.token)
        label = Label()
        self.layout.emit(jump(group.end), self.token.line)
        self.layout.place(label)
        while True:
            token = self.take()
            if token.kind != "number" or not token.text.isdigit() or int(token.text) > LONG_MAX:
                raise fault(token, CASE_COLON)
            group.cases.setdefault(int(token.text), label)
            if self.accept(":"):
                return
            self.expect(",", CASE_COLON)

    def read_end_case(self, token: Token) -> None:
        """`END_CASE`."""
        self._end_group(self._innermost(token, "CASE"))
        self._close(token)

    def read_for(self, token: Token) -> None:
        """`FOR v := a TO b BY s DO`; the limits are worked out at every pass."""
        group = self._open(token)
        missing = group.kind.head_missing
        at = self.place
        self.layout.emit(self._assignment(), token.line)
        after = self.place
        self.place = at
        variable = self._loop_variable()
        self.place = after
        self.expect("TO", missing)
        limit = self.evaluator(self.expression())
        step = self.evaluator(self.expression()) if self.accept("BY") else one
        self.expect("DO", missing)
        self.layout.place(group.again)
        self.layout.emit(for_test(variable[0], limit, step, group.end), token.line)
        group.next_pass = for_next(*variable, step, group.again)

    def _loop_variable(self) -> tuple[Evaluate, Callable[[Evaluate], Step]]:
        """How to read the variable of a FOR, and how to write it."""
        at = self.place
        read = self.evaluator(self.operand())
        self.place = at
        family = self.take()
        index = self.evaluator(self.index())
        if family.text == "#":
            return read, lambda value: lambda c: c.memory.set_variable(index(c), storable(value(c)))
        return read, lambda value: lambda c: c.memory.set_register(index(c), storable(value(c)))

    def read_end_for(self, token: Token) -> None:
        """`END_FOR`."""
        group = self._innermost(token, "FOR")
        self.layout.emit(group.next_pass or nothing, token.line)
        self._end_group(group)
        self._close(token)

    def read_while(self, token: Token) -> None:
        """`WHILE c DO`."""
        group = self._open(token)
        condition = self.evaluator(self.expression())
        self.expect("DO", group.kind.head_missing)
        self.layout.place(group.again)
        self.layout.emit(unless(condition, group.end), token.line)

    def read_end_while(self, token: Token) -> None:
        """`END_WHILE`."""
        group = self._innermost(token, "WHILE")
        self.layout.emit(jump(group.again), token.line)
        self._end_group(group)
        self._close(token)

    def read_repeat(self, token: Token) -> None:
        """`REPEAT`."""
        group = self._open(token)
        self.layout.emit(nothing, token.line)
        self.layout.place(group.again)

    def read_until(self, token: Token) -> None:
        """`UNTIL c END_REPEAT`."""
        group = self._innermost(token, "REPEAT")
        group.late = True
        condition = self.evaluator(self.expression())
        if not self.accept("END_REPEAT"):
            self._missing_closer(self._groups.pop())
            return
        self.layout.emit(unless(condition, group.again), token.line)
        self._end_group(group)
        self._close(token)

    def read_end_repeat(self, token: Token) -> None:
        """An `END_REPEAT` that no UNTIL precedes."""
        self._innermost(token, "REPEAT")
        self._missing_closer(self._groups.pop())
        self._close(token)

    # ---- jumps -------------------------------------------------------------------------------------------

    def read_exit(self, token: Token) -> None:
        """`EXIT`: behind the innermost loop."""
        loop = next((group for group in reversed(self._groups) if group.kind.loop), None)
        if loop is None:
            raise fault(token, hint="hint.syntec.exit-outside")
        self.layout.emit(jump(loop.end), token.line)
        self._close(token)

    def read_goto(self, token: Token) -> None:
        """`GOTO e`."""
        self.layout.emit(goto(self.evaluator(self.expression())), token.line)
        self._close(token)

    def read_pause(self, token: Token) -> None:
        """`PAUSE` belongs to the robot controls."""
        raise fault(token)


_READERS: dict[str, Callable[[StatementReader, Token], None]] = {
    "IF": StatementReader.read_if,
    "ELSEIF": StatementReader.read_elseif,
    "ELSE": StatementReader.read_else,
    "END_IF": StatementReader.read_end_if,
    "CASE": StatementReader.read_case,
    "END_CASE": StatementReader.read_end_case,
    "FOR": StatementReader.read_for,
    "END_FOR": StatementReader.read_end_for,
    "WHILE": StatementReader.read_while,
    "END_WHILE": StatementReader.read_end_while,
    "REPEAT": StatementReader.read_repeat,
    "UNTIL": StatementReader.read_until,
    "END_REPEAT": StatementReader.read_end_repeat,
    "EXIT": StatementReader.read_exit,
    "GOTO": StatementReader.read_goto,
    "PAUSE": StatementReader.read_pause,
}
