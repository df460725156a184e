"""How the rows that lie ahead are laid out: for which overrides, and from what, so that they can be laid out again.

Rows are laid out at the overrides that hold, so that the main run passes them as the plan does. An override that is
turned up lays out again what lies ahead, with the row in execution. One that is turned down needs nothing: what is laid
out for a higher speed holds for a lower one. Where the axes rest, rows are laid out for what holds then.
"""

from __future__ import annotations

from array import array

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.layout import contents_of, put_back
from polycnc.motion.kernels.columns import MAIN_RUN, RAPID, TAP, THREAD
from polycnc.motion.time_constants import Use

if TYPE_CHECKING:
    from collections.abc import MutableSequence

    from polycnc.motion.kernels.columns import Limits, Rows, State
    from polycnc.toolpath import Context


class Layout(NamedTuple):
    """What rows are laid out for.

    Attributes:
        feed: Feed override.
        spindle: Spindle override.
        free: Whether a dry run says how fast rows are: 1, or 2 if threads too (`RunState.free`).
    """

    feed: float = 1.0
    spindle: float = 1.0
    free: float = MAIN_RUN

    def covers(self, other: Layout) -> bool:
        """Whether what is laid out so may be run as the other asks."""
        if self.free > 0.0 or other.free > 0.0:
            return self.free >= other.free
        return self.feed >= other.feed and self.spindle >= other.spindle

    def factor(self, kind: int, context: Context, *, per_revolution: bool) -> float:
        """On the feed of a row."""
        if self.free > 0.0 or kind in (RAPID, TAP):
            return 1.0
        if kind == THREAD:
            return context.spindle_factor(self.spindle)
        spindle = context.spindle_factor(self.spindle) if per_revolution else 1.0
        return spindle * (self.feed if context.feed_override else 1.0)


@unchanging
@dataclass(frozen=True, slots=True)
class Before:
    """What the kernels carry into a row."""

    run: bytes
    kind: int
    vectors: tuple[MutableSequence[float], ...]

    @classmethod
    def of(cls, state: State) -> Before:
        """As it is now."""
        return cls(
            contents_of(state.run),
            state.row.kind,
            (state.position[:], state.tangent[:], state.bent_before[:], state.bow[:]),
        )

    def restore(self, state: State) -> None:
        """As it was then; how rows are laid out stays as it is."""
        free = state.run.free
        put_back(state.run, self.run)
        state.run.free, state.row.kind = free, self.kind
        for vector, then in zip(
            (state.position, state.tangent, state.bent_before, state.bow), self.vectors, strict=True
        ):
            vector[:] = then


@unchanging
@dataclass(frozen=True, slots=True)
class PreparedRow:
    """A row, or a leg of one, from which pieces have been made.

    Attributes:
        rows: Its columns, with the feed that the program asks for; None for a turn at the pole.
        curves: Parameters of curves.
        number: Number of the row.
        called: Number that its pieces have.
        limits: The machine, as a transformation shows it.
        feed: What the program asks for.
        context: What holds in it; `per_revolution`: its feed follows the spindle.
        rests: The axes rest before it, for what is no row.
        before: What the kernels carried into it.
        records: The pieces of a turn at the pole.
        use: What it runs by; where that has changed, `led` are the limits of the row before.
    """

    rows: Rows | None
    curves: array[float]
    number: int
    called: float
    limits: Limits
    feed: float
    context: Context
    per_revolution: bool
    rests: bool
    before: Before
    records: array[float] | None = None
    use: Use = Use.CUT
    led: Limits | None = None

    def factor(self, layout: Layout) -> float:
        """Of overrides on its feed."""
        kind = self.rows.kind[0] if self.rows is not None else RAPID
        return layout.factor(kind, self.context, per_revolution=self.per_revolution)

    def rows_for(self, layout: Layout) -> Rows:
        """Its columns for overrides."""
        assert self.rows is not None
        return self.rows._replace(feed=array("d", (self.feed * self.factor(layout),)))
