"""The rows of a chunk as lines of text, a long chunk by whole columns.

Most rows differ in their numbers only: their text has one form, with places for line, positions, feed and centre. A
kernel (`digits`) fills them in. Events, and whatever else is rare, are written one by one.
"""

from __future__ import annotations

import re
from array import array
from operator import itemgetter

from polycnc.deferred.modules import is_installed
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Protocol, cast
from polycnc.toolpath.compiled import fill
from polycnc.toolpath.digits import ALONE, END, LEFT_OUT, LONGEST_NUMBER, PLACE, WHOLE, Forms
from polycnc.toolpath.kinds import SHOWN_IN_COLUMNS, Kind
from polycnc.toolpath.trace import COLUMN_ROWS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.toolpath.compiled import Fill
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record, Shown

#: Stand for the number of a column in the record that gives a form: no name of a program or an axis holds one.
_FIRST_MARK = 0x10F000
_MARKS = re.compile(f"[{chr(_FIRST_MARK)}-{chr(_FIRST_MARK + 0xFF)}]")
#: A mark that was written as a text of JSON.
MARKED_TEXT = re.compile(f'"({_MARKS.pattern})"')
#: Bytes of text that are made at once.
_TEXT_BYTES = 1 << 20


class Writing(Protocol):
    """How a record becomes a line."""

    def line(self, record: Record) -> str:
        """The line of a record."""

    def form(self, record: Record) -> str:
        """The line of a record whose numbers are marks, which stand in it as numbers would."""


class _Form(NamedTuple):
    """The text of rows that differ in their numbers only.

    Attributes:
        template: For `%`, with the numbers of `columns`.
        columns: What stands in its places.
        bytes: As the kernel takes it.
    """

    template: str
    columns: Callable[[Sequence[float]], tuple[float, ...]]
    bytes: bytes


class Lines:
    """Gives the lines of chunks.

    Args:
        display: Of the toolpath that the chunks belong to.
        writing: How records become lines.
    """

    def __init__(self, display: Display, writing: Writing) -> None:
        self._display, self._writing = display, writing
        self._text, self._used = array("B"), array("q", [0])

    def of(self, chunk: Chunk) -> Iterator[bytes]:
        """The lines of a chunk, some at a time, in UTF-8."""
        if len(chunk) < COLUMN_ROWS or not is_installed("numpy"):
            yield from map(self._alone, self._display.records_of(chunk))
            return
        rows = _Rows(self._display, chunk)
        made = [self._form(rows.marked(first)) for first in rows.firsts]
        write = fill()
        filled = _by_template(made, rows) if write is None else self._by_kernel(write, made, rows)
        for text, alone in filled:
            yield text
            if alone is not None:
                yield self._alone(self._display.record(self._display.toolpath.row_of(chunk, alone)))

    def _alone(self, record: Record) -> bytes:
        return self._writing.line(record).encode()

    def _form(self, record: Record) -> _Form:
        text = self._writing.form(record)
        marks, parts = _MARKS.findall(text), _MARKS.split(text)
        columns = [ord(mark) - _FIRST_MARK for mark in marks]
        places = ["%d" if column == WHOLE else "%r" for column in columns]
        template = "".join(
            part.replace("%", "%%") + place for part, place in zip(parts, [*places, ""], strict=True)
        )
        numbers = [bytes((PLACE, column)) for column in columns]
        return _Form(
            template,
            cast("Callable[[Sequence[float]], tuple[float, ...]]", itemgetter(*columns)),
            b"".join(part.encode() + n for part, n in zip(parts, [*numbers, bytes((END,))], strict=True)),
        )

    def _by_kernel(
        self, write: Fill, made: Sequence[_Form], rows: _Rows
    ) -> Iterator[tuple[bytes, int | None]]:
        """Lines, and the row behind them that is written alone."""
        text, begin = array("B"), array("q")
        for form in made:
            begin.append(len(text))
            text.frombytes(form.bytes)
        forms = Forms(text, begin)
        room = max((len(form.bytes) for form in made), default=0) + LONGEST_NUMBER * rows.width
        if len(self._text) < _TEXT_BYTES + room:
            self._text = array("B", bytes(_TEXT_BYTES + room))
        row, numbers = 0, array("d")
        numbers.frombytes(rows.numbers.tobytes())
        chosen = array("i")
        chosen.frombytes(rows.forms.tobytes())
        while row < len(chosen):
            row = write(forms, chosen, numbers, row, room, self._text, self._used)
            done = bytes(memoryview(self._text)[: self._used[0]])
            if row == len(chosen) or self._used[0]:
                yield done, None
            elif chosen[row] == ALONE:
                yield done, row
                row += 1
            else:  # a number that has more digits than the kernel writes
                yield _filled(made[chosen[row]], rows.numbers[row].tolist()), None
                row += 1


def _by_template(made: Sequence[_Form], rows: _Rows) -> Iterator[tuple[bytes, int | None]]:
    """The same, row by row."""
    for row, (form, numbers) in enumerate(zip(rows.forms.tolist(), rows.numbers.tolist(), strict=True)):
        if form == ALONE:
            yield b"", row
        elif form != LEFT_OUT:
            yield _filled(made[form], numbers), None


def _filled(form: _Form, numbers: Sequence[float]) -> bytes:
    return (form.template % form.columns(numbers)).encode()


class _Rows:
    """The numbers of a chunk's rows, and which rows have one form.

    Attributes:
        numbers: (n, width): line, work display, machine display, feed, centre and turns.
        forms: For each row the number of its form, ALONE or LEFT_OUT.
        firsts: For each form the first row that has it.
    """

    def __init__(self, display: Display, chunk: Chunk) -> None:
        import numpy as np

        self._display, self._chunk = display, chunk
        shown = display.columns(chunk)
        arcs = display.arcs(shown)
        self._arcs = list(arcs)
        columns = shown.columns.line, *shown.work.T, *shown.machine.T, shown.feed, *arcs.values()
        self.numbers = np.stack(columns, axis=1, dtype=np.float64, casting="unsafe")
        self.width = len(columns)
        self.forms, self.firsts = self._chosen(shown)

    def _chosen(self, shown: Shown) -> tuple[NDArray[np.int32], list[int]]:
        """Rows of one kind, program and context that have the same numbers are of one form."""
        import numpy as np

        kind, curve, context = shown.columns.kind, shown.columns.curve, shown.columns.context
        key = (context.astype(np.int64) << 16 | shown.columns.program) << 8 | kind
        for number in self.numbers[:, self.width - len(self._arcs) - 1 :].T:
            key = key << 1 | ~np.isnan(number)
        knots = np.array([each.is_hidden for each in self._display.toolpath.contexts], bool)
        alone = (kind == Kind.EVENT) | ((curve >= 0) & ~np.isin(kind, tuple(SHOWN_IN_COLUMNS)))
        left_out = knots[context] & (kind != Kind.EVENT) & self._goes_on(shown)
        forms = np.full(len(key), LEFT_OUT, np.int32)
        forms[alone & ~left_out] = ALONE
        common = np.flatnonzero(~alone & ~left_out)
        _, first, own = np.unique(key[common], return_index=True, return_inverse=True)
        forms[common] = own
        return forms, common[first].tolist()

    def _goes_on(self, shown: Shown) -> NDArray[np.bool_]:
        """Whether the next row of each one is of the same block: a motion that is broken off has its last row shown."""
        import numpy as np

        columns = shown.columns
        found = np.zeros(len(columns.kind), bool)
        found[:-1] = columns.kind[1:] != Kind.EVENT
        for column in (columns.line, columns.program):
            found[:-1] &= column[1:] == column[:-1]
        return found

    def marked(self, row: int) -> Record:
        """The record of a row with a mark in place of every number: the character of its column."""
        display = self._display
        place = display.toolpath.row_of(self._chunk, row)
        record: dict[str, object] = {**display.record(place)}
        names, count = place.context.names or display.axes, len(display.axes)

        def marks(shown: object, axes: Sequence[str], first: int) -> dict[str, str]:
            return {name: _mark(first + axes.index(name)) for name in cast("dict[str, float]", shown)}

        record |= {"line": _mark(WHOLE), "to": marks(record["to"], names, 1)}
        record["machine"] = marks(record["machine"], display.axes, 1 + count)
        if "feed" in record:
            record["feed"] = _mark(1 + 2 * count)
        if "center" in record:
            centers = cast("dict[str, float]", record["center"])
            record["center"] = {name: self._mark_of(f"center_{name}") for name in centers}
        if "turns" in record:
            record["turns"] = self._mark_of("turns")
        return cast("Record", record)

    def _mark_of(self, column: str) -> str:
        return _mark(self.width - len(self._arcs) + self._arcs.index(column))


def _mark(column: int) -> str:
    return chr(_FIRST_MARK + column)
