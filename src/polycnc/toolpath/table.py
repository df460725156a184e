"""The toolpath: columns in chunks, contexts and events beside them.

Columns are plain `array.array` buffers while a chunk is being written, so that a short program needs no array
library; `Chunk.numpy()` gives views of the same memory. Lengths are millimetres (radius, never diameter),
rotary positions degrees, feeds mm/s, mm/rev or 1/s as the context's feed mode says.
"""

from __future__ import annotations

from array import array
from math import isnan, nan

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE, Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from polycnc.toolpath.context import Context
    from polycnc.toolpath.events import Event

CHUNK_ROWS = 16_384
#: So many rows are looked at one by one rather than halved.
FEW_ROWS = 32
NO_FEED = nan
_KINDS = tuple(Kind)


class Row(NamedTuple):
    """One row as Python values, for those who read a toolpath row by row."""

    number: int
    kind: Kind
    program: str
    line: int
    end: tuple[float, ...]
    feed: float
    curve: tuple[float, ...]
    context: Context
    event: Event | None

    @property
    def has_feed(self) -> bool:
        """Whether the row names a feed."""
        return not isnan(self.feed)


class Columns(NamedTuple):
    """The columns of a chunk as NumPy views: `end` is (n, axes), `curves` (m, CURVE_WIDTH), the others (n,)."""

    kind: NDArray[np.uint8]
    program: NDArray[np.uint16]
    line: NDArray[np.uint32]
    context: NDArray[np.uint32]
    feed: NDArray[np.float64]
    end: NDArray[np.float64]
    curve: NDArray[np.int32]
    curves: NDArray[np.float64]


def _add_run(runs: list[tuple[int, int, int]], number: int, first: int, end: int) -> None:
    """Add rows of one number behind those so far."""
    if runs and runs[-1][0] == number:
        first = runs.pop()[1]
    runs.append((number, first, end))


def _is_even(numbers: bytes, first: int, end: int, size: int) -> bool:
    """Whether all numbers of so many bytes from one on to before another are alike."""
    return numbers[first * size : (end - 1) * size] == numbers[(first + 1) * size : end * size]


class Chunk:
    """Up to `CHUNK_ROWS` rows. `axes` is the number of channel axes; `end` is flat, `axes` numbers a row."""

    __slots__ = (
        "add", "axes", "context", "curve", "curves", "end", "events", "feed", "first", "kind", "line",
        "program",
    )  # fmt: skip

    def __init__(self, axes: int, first: int) -> None:
        self.axes = axes
        self.first = first
        self.kind = array("B")
        self.program = array("H")
        self.line = array("I")
        self.context = array("I")
        self.feed = array("d")
        self.end = array("d")
        self.curve = array("i")
        self.curves = array("d")
        self.events: list[Event] = []
        self.add = self._row_writer()

    def _row_writer(self) -> Callable[[int, int, int, int, float, Sequence[float], int], None]:
        """What adds a row. The columns' own methods are at hand: this runs once for every row."""
        kind, program, line, context = (
            self.kind.append,
            self.program.append,
            self.line.append,
            self.context.append,
        )
        feed, end, curve = self.feed.append, self.end.extend, self.curve.append

        def add(k: int, p: int, n: int, c: int, f: float, e: Sequence[float], v: int = NO_CURVE) -> None:
            kind(k)
            program(p)
            line(n)
            context(c)
            feed(f)
            end(e)
            curve(v)

        return add

    def __len__(self) -> int:
        return len(self.kind)

    def context_runs(self) -> list[tuple[int, int, int]]:
        """Rows of one context after each other: its number, the first of them, and the row behind the last one."""
        numbers = self.context.tobytes()
        runs: list[tuple[int, int, int]] = []
        parts = [(0, len(self))] if self.kind else []
        while parts:
            first, end = parts.pop()
            if _is_even(numbers, first, end, self.context.itemsize):
                _add_run(runs, self.context[first], first, end)
            elif end - first > FEW_ROWS:
                middle = (first + end) // 2
                parts += (middle, end), (first, middle)
            else:
                for row in range(first, end):
                    _add_run(runs, self.context[row], row, row + 1)
        return runs

    def extend(self, first: int, end: int, context: int, columns: Sequence[memoryview]) -> None:
        """Add rows under one context.

        Args:
            first: First row of the columns.
            end: The row behind the last one.
            context: Number of their context.
            columns: Bytes of `kind`, `program`, `line`, `feed`, `end`, `curve`, with items as here.
        """
        own: tuple[array[int] | array[float], ...] = (
            self.kind, self.program, self.line, self.feed, self.end, self.curve
        )  # fmt: skip
        widths = (
            1,
            self.program.itemsize,
            self.line.itemsize,
            self.feed.itemsize,
            self.end.itemsize * self.axes,
            self.curve.itemsize,
        )
        for target, column, width in zip(own, columns, widths, strict=False):
            target.frombytes(column[first * width : end * width])
        self.context.extend(array("I", (context,)) * (end - first))

    def add_along(
        self,
        axis: int,
        places: array[float],
        kinds: array[int],
        program: int,
        line: int,
        context: int,
        feeds: array[float],
        position: Sequence[float],
    ) -> None:
        """Add straight rows of one block along an axis, with its places, from a position."""
        count = len(places)
        self.kind.extend(kinds)
        self.program.extend(array("H", (program,)) * count)
        self.line.extend(array("I", (line,)) * count)
        self.context.extend(array("I", (context,)) * count)
        self.feed.extend(feeds)
        end = array("d", position) * count
        end[axis :: self.axes] = places
        self.end.extend(end)
        self.curve.extend(array("i", (NO_CURVE,)) * count)

    def add_curves(self, count: int, curves: memoryview) -> None:
        """Add the first rows of a column of curve parameters, which comes as bytes."""
        self.curves.frombytes(curves[: count * CURVE_WIDTH * self.curves.itemsize])

    def take_over(self, other: Chunk) -> None:
        """Add the rows of the chunk behind this one."""
        events, curves = len(self.events), len(self.curves) // CURVE_WIDTH
        for kind, place in zip(other.kind, other.curve, strict=True):
            self.curve.append(place + (events if kind == Kind.EVENT else curves) if place >= 0 else place)
        self.kind.extend(other.kind)
        self.program.extend(other.program)
        self.line.extend(other.line)
        self.context.extend(other.context)
        self.feed.extend(other.feed)
        self.end.extend(other.end)
        self.curves.extend(other.curves)
        self.events.extend(other.events)

    def only(self, rows: Sequence[int]) -> Chunk:
        """A chunk of some of the rows, in order, with the same curves and events; this one where they are all."""
        if len(rows) == len(self):
            return self
        made, n = Chunk(self.axes, self.first), self.axes
        for row in rows:
            made.add(
                self.kind[row], self.program[row], self.line[row], self.context[row], self.feed[row],
                self.end[row * n : (row + 1) * n], self.curve[row],
            )  # fmt: skip
        made.curves, made.events = self.curves, self.events
        return made

    def numpy(self) -> Columns:
        """The columns as NumPy views of the same memory."""
        import numpy as np

        return Columns(
            kind=np.frombuffer(self.kind, np.uint8),
            program=np.frombuffer(self.program, np.uint16),
            line=np.frombuffer(self.line, np.uint32),
            context=np.frombuffer(self.context, np.uint32),
            feed=np.frombuffer(self.feed, np.float64),
            end=np.frombuffer(self.end, np.float64).reshape(-1, self.axes),
            curve=np.frombuffer(self.curve, np.int32),
            curves=np.frombuffer(self.curves, np.float64).reshape(-1, CURVE_WIDTH),
        )

    def memento(self) -> Callable[[], None]:
        """What drops the rows that are added from here on; rows that are there now stay for ever."""
        rows, curves, events = len(self.kind), len(self.curves), len(self.events)

        def put_back() -> None:
            columns: tuple[array[int] | array[float], ...] = (
                self.kind, self.program, self.line, self.context, self.feed, self.curve
            )  # fmt: skip
            for column in columns:
                del column[rows:]
            del self.end[rows * self.axes :], self.curves[curves:], self.events[events:]

        return put_back

    def truncate(self, rows: int) -> None:
        """Drop every row from number `rows` (within the chunk) on, with its curve and event."""
        events = sum(1 for kind in self.kind[rows:] if kind == Kind.EVENT)
        curves = sum(
            1 for k, c in zip(self.kind[rows:], self.curve[rows:], strict=True) if c >= 0 and k != Kind.EVENT
        )
        if events:
            del self.events[-events:]
        if curves:
            del self.curves[-curves * CURVE_WIDTH :]
        for column in (self.kind, self.program, self.line, self.context, self.feed, self.curve):
            del column[rows:]
        del self.end[rows * self.axes :]


class Toolpath:
    """Moves and events of one channel, in order.

    Args:
        axes: Names of the channel's axes, in column order.
        on_full: Called with each full chunk; a consumer that returns true has taken it, and it is dropped.

    Attributes:
        kind_before_chunk: Kind of the last row in front of the chunk that is written.
        rests: Rows before which the axes rest because nothing may be prepared beyond, in order; events say the others.
        counts: Machine positions by column of axes that are counted otherwise from a row on, by its number; they stand.
        block_starts: Rows with which another block begins, in order, though perhaps of the same line: those of blocks
            that must be told apart, and of what follows on them.
    """

    def __init__(
        self,
        axes: tuple[str, ...],
        *,
        chunk_rows: int = CHUNK_ROWS,
        on_full: Callable[[Chunk], bool] | None = None,
    ) -> None:
        self.axes = axes
        self.chunks: list[Chunk] = []
        self.contexts: list[Context] = []
        self.programs: list[str] = []
        self.rests: list[int] = []
        self.counts: dict[int, dict[int, float]] = {}
        self.block_starts: list[int] = []
        self._is_apart = False
        self._context_numbers: dict[Context, int] = {}
        self._program_numbers: dict[str, int] = {}
        self._chunk_rows = chunk_rows
        self._on_full = on_full
        self._rows_before = self._ways_before = 0
        self._last_end: list[float] = []
        self._last_context = 0
        self.kind_before_chunk = int(Kind.EVENT)
        self.chunk = Chunk(len(axes), 0)
        self.chunks.append(self.chunk)

    def __len__(self) -> int:
        return self._rows_before + len(self.chunk.kind)

    @property
    def ways(self) -> int:
        """How many rows move an axis."""
        return self._ways_before + _ways(self.chunk)

    def rest(self, row: int | None = None) -> None:
        """The axes rest before a row of the chunk that is written; None for the next one."""
        self._note(self.rests, len(self.chunk) if row is None else row)

    def recount(self, places: Mapping[int, float]) -> None:
        """Axes, which rest before the next row, are at other machine positions from there on; nothing moves."""
        self.rest()
        self.counts.setdefault(len(self), {}).update(places)

    def _note(self, rows: list[int], row: int) -> None:
        """Note a row of the chunk that is written among rows that are in order."""
        number = self._rows_before + row
        while rows and rows[-1] > number:  # of a block that was taken back
            rows.pop()
        if not rows or rows[-1] < number:
            rows.append(number)

    def set_block_apart(self, row: int) -> None:
        """The block that runs, which begins with a row of the chunk, is told apart from those of the same line."""
        self._note(self.block_starts, row)
        self._is_apart = True

    def end_block(self) -> int:
        """The block that runs is over; gives the number of rows of the chunk that is written."""
        rows = len(self.chunk.kind)
        if self._is_apart:
            self._note(self.block_starts, rows)
            self._is_apart = False
        return rows

    def context_number(self, context: Context) -> int:
        """The number of a context; a new one is added."""
        number = self._context_numbers.get(context)
        if number is None:
            number = self._context_numbers[context] = len(self.contexts)
            self.contexts.append(context)
        return number

    def program_number(self, name: str) -> int:
        """The number of a program name; a new one is added."""
        number = self._program_numbers.get(name)
        if number is None:
            number = self._program_numbers[name] = len(self.programs)
            self.programs.append(name)
        return number

    def append(
        self,
        kind: int,
        program: int,
        line: int,
        context: int,
        feed: float,
        end: list[float],
        curve: int = NO_CURVE,
    ) -> None:
        """Add a row. `curve` is what `add_curve` gave for it, or `NO_CURVE`."""
        self.chunk.add(kind, program, line, context, feed, end, curve)

    def add_curve(self, *parameters: float) -> int:
        """Store curve parameters in the current chunk (padded with zeros) and give their row."""
        curves = self.chunk.curves
        number = len(curves) // CURVE_WIDTH
        curves.extend(parameters)
        curves.extend([0.0] * (CURVE_WIDTH - len(parameters)))
        return number

    def append_event(self, event: Event, program: int, line: int, context: int, end: list[float]) -> None:
        """Add an event in order with the moves."""
        self.chunk.events.append(event)
        self.append(Kind.EVENT, program, line, context, NO_FEED, end, len(self.chunk.events) - 1)

    def hand_on_blocks(self, take: Callable[[Chunk], bool], *, keep: bool) -> None:
        """From here on somebody gets the rows of every block; they are kept as before, or go to him alone."""
        kept = self._on_full
        if len(self.chunk):
            self._next_chunk()

        def on_full(chunk: Chunk) -> bool:
            take(chunk)
            return kept is not None and kept(chunk)

        self._chunk_rows, self._on_full = 1, on_full if keep else take

    def join_chunks(self, first: int) -> list[Chunk]:
        """Put chunks of single blocks (`hand_on_blocks`) together, as many as fill one; gives those that come of it.

        Args:
            first: Index of the first of them. The chunk that is written stays as it is.
        """
        joined: list[Chunk] = []
        for chunk in self.chunks[first:-1]:
            if not joined or len(joined[-1]) >= CHUNK_ROWS:
                joined.append(Chunk(chunk.axes, chunk.first))
            joined[-1].take_over(chunk)
        self.chunks[first:-1] = joined
        return joined

    def block_boundary(self) -> None:
        """Called between blocks: hands on a full chunk and starts the next one."""
        if len(self.chunk.kind) >= self._chunk_rows:
            self._next_chunk()

    def _next_chunk(self) -> None:
        full = self.chunk
        self._rows_before += len(full.kind)
        self._ways_before += _ways(full)
        self._last_end = list(full.end[-len(self.axes) :])
        self._last_context, self.kind_before_chunk = full.context[-1], full.kind[-1]
        if self._on_full is not None and self._on_full(full):
            self.chunks.remove(full)
        self.chunk = Chunk(len(self.axes), self._rows_before)
        self.chunks.append(self.chunk)

    def set_end(self, number: int, end: Sequence[float]) -> None:
        """A row that is still held ends elsewhere: the main run has dropped the rest of its way."""
        for chunk in self.chunks:
            place = (number - chunk.first) * chunk.axes
            if 0 <= place < len(chunk.end):
                chunk.end[place : place + chunk.axes] = array("d", end)

    def last_end(self) -> list[float]:
        """The position in the last row; empty where there is none."""
        chunk = self.chunk
        return list(chunk.end[-len(self.axes) :]) if len(chunk) else list(self._last_end)

    def last_context(self) -> Context | None:
        """The context of the last row; None where there is no row."""
        chunk = self.chunk
        if not len(chunk) and not self._last_end:
            return None
        return self.contexts[chunk.context[-1] if len(chunk) else self._last_context]

    def mark(self) -> int:
        """The number of rows now; `truncate` goes back to it as long as no block boundary lies between."""
        return len(self.chunk.kind)

    def truncate(self, mark: int) -> None:
        """Forget the rows of a block that alarmed."""
        self.chunk.truncate(mark)

    def forget_from(self, number: int) -> None:
        """Drop the rows from a number on that are still held: the main run has not executed them."""
        while len(self.chunks) > 1 and self.chunks[-1].first >= number:
            self.chunks.pop()
            self._ways_before -= _ways(self.chunks[-1])
        self.chunk = self.chunks[-1]
        self._rows_before = self.chunk.first
        self.chunk.truncate(max(number - self.chunk.first, 0))

    def memento(self) -> Callable[[], None]:
        """What forgets all that comes from here on (for a snapshot). Chunks that were dropped meanwhile are back."""
        chunk, chunks, cut = self.chunk, self.chunks.copy(), self.chunk.memento()
        contexts, programs = len(self.contexts), len(self.programs)
        starts, counts = len(self.block_starts), {row: {**places} for row, places in self.counts.items()}
        before = (
            self._rows_before, self._ways_before, self._last_end, self._last_context, self.kind_before_chunk
        )  # fmt: skip

        def put_back() -> None:
            cut()
            self.chunk = chunk
            self.chunks[:] = chunks
            del self.contexts[contexts:], self.programs[programs:], self.block_starts[starts:]
            self.counts = counts
            while len(self._context_numbers) > contexts:
                self._context_numbers.popitem()
            while len(self._program_numbers) > programs:
                self._program_numbers.popitem()
            self._rows_before, self._ways_before, self._last_end, self._last_context = before[:-1]
            self.kind_before_chunk = before[-1]

        return put_back

    def rows(self) -> Iterator[Row]:
        """All rows that are still held, as Python values."""
        for chunk in self.chunks:
            yield from self.rows_of(chunk)

    def rows_of(self, chunk: Chunk) -> Iterator[Row]:
        """The rows of one chunk as Python values."""
        for i in range(len(chunk)):
            yield self.row_of(chunk, i)

    def row_of(self, chunk: Chunk, i: int) -> Row:
        """One row of a chunk as Python values."""
        n, c = chunk.axes, chunk.curve[i]
        kind = _KINDS[chunk.kind[i]]
        is_event = kind is Kind.EVENT
        return Row(
            chunk.first + i,
            kind,
            self.programs[chunk.program[i]],
            chunk.line[i],
            tuple(chunk.end[i * n : (i + 1) * n]),
            chunk.feed[i],
            tuple(chunk.curves[c * CURVE_WIDTH : (c + 1) * CURVE_WIDTH]) if c >= 0 and not is_event else (),
            self.contexts[chunk.context[i]],
            chunk.events[c] if is_event else None,
        )

    def to_machine(
        self, end: tuple[float, ...] | list[float], context: Context, geometry: tuple[int, ...]
    ) -> list[float]:
        """Machine position of a row's end point: the frame acts on `geometry` axes, the offsets on all."""
        machine = list(end)
        if context.transformation is not None:
            machine = context.transformation.to_machine(machine)
        if not context.frame.is_identity:
            image = context.frame.apply(*(machine[i] if i >= 0 else 0.0 for i in geometry))
            for i, value in zip(geometry, image, strict=True):
                if i >= 0:
                    machine[i] = value
        if context.offsets:
            machine = [value + offset for value, offset in zip(machine, context.offsets, strict=True)]
        return machine

    def seen_from(
        self, end: list[float], old: Context, new: Context, geometry: tuple[int, ...]
    ) -> list[float]:
        """Where the end of a row of one context stands in the coordinates of another one."""
        if old.offsets == new.offsets and old.frame == new.frame and old.transformation is new.transformation:
            return end
        found = self.to_machine(end, old, geometry)
        if new.offsets:
            found = [value - offset for value, offset in zip(found, new.offsets, strict=True)]
        if not new.frame.is_identity:
            image = new.frame.inverse().apply(*(found[i] if i >= 0 else 0.0 for i in geometry))
            for i, value in zip(geometry, image, strict=True):
                if i >= 0:
                    found[i] = value
        return found if new.transformation is None else new.transformation.to_work(found)


def _ways(chunk: Chunk) -> int:
    """How many rows of a chunk move an axis."""
    kinds = chunk.kind.tobytes()  # `array.count` compares object by object
    return len(kinds) - kinds.count(Kind.EVENT) - kinds.count(Kind.DWELL)


def is_way(start: list[float], end: list[float]) -> bool:
    """Whether two positions differ by more than rounding."""
    for a, b in zip(start, end, strict=True):  # noqa: SIM110 - a generator costs more than the comparison
        if not abs(a - b) <= NO_WAY:  # also where one is no number
            return True
    return False
