"""A toolpath row as the control's displays would show it: the records of the trace.

Inside the table lengths are millimetres and radii. Here, and only here, they become what an operator
reads: inches where the program is in inches, diameters on diameter axes, feeds per minute, modulo rotary axes
within one turn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from polycnc.toolpath.kinds import TYPE_NAMES, Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from polycnc.toolpath.context import Context
    from polycnc.toolpath.events import Event
    from polycnc.toolpath.table import Chunk, Row, Toolpath

MM_PER_INCH = 25.4
_FULL_TURN = 360.0
#: Seconds in the time unit of each feed mode: per minute, per revolution (no time in it), inverse minutes.
_TIME_FACTOR = {"G93": 60.0, "G94": 60.0, "G95": 1.0}


@dataclass(frozen=True, slots=True)
class AxisLayout:
    """What the displays must know of a channel's axes.

    Attributes:
        geometry: For X, Y, Z of the geometry the index of the channel axis, or -1.
        rotary: Indices of rotary axes, in degrees whatever the unit of length.
        modulo: Indices of the rotary axes whose work display stays within one turn.
    """

    geometry: tuple[int, int, int] = (-1, -1, -1)
    rotary: frozenset[int] = frozenset()
    modulo: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class _Scale:
    """Factors from the table's units to the displays' under one context."""

    work: tuple[float, ...]
    machine: tuple[float, ...]
    length: float
    feed: float


class Display:
    """Shows the rows of one toolpath.

    Args:
        toolpath: The toolpath that the rows belong to.
        layout: Geometry and rotary axes of the channel.
        alarm_text: Gives the text of an alarm event from its data.
    """

    def __init__(
        self,
        toolpath: Toolpath,
        layout: AxisLayout,
        alarm_text: Callable[[Mapping[str, Any]], str] | None = None,
    ) -> None:
        self.axes = toolpath.axes
        self._toolpath = toolpath
        self._layout = layout
        self._alarm_text = alarm_text
        self.modulo_axes = frozenset(self.axes[i] for i in layout.modulo)
        self._scales: dict[int, _Scale] = {}

    def records(self) -> Iterator[dict[str, Any]]:
        """The records of all rows that the toolpath still holds, in order."""
        for row in self._toolpath.rows():
            yield self.record(row)

    def records_of(self, chunk: Chunk) -> Iterator[dict[str, Any]]:
        """The records of one chunk."""
        for row in self._toolpath.rows_of(chunk):
            yield self.record(row)

    def record(self, row: Row) -> dict[str, Any]:
        """One row as a record of the trace (see the documentation of `run --trace`)."""
        if row.event is not None:
            return self._event(row, row.event)
        scale = self._scale(row.context)
        record: dict[str, Any] = {
            "type": TYPE_NAMES[row.kind],
            "program": row.program,
            "line": row.line,
            "unit": "inch" if row.context.inch else "mm",
            "to": self.work(row.end, row.context),
            "machine": self.machine(row.end, row.context),
        }
        if row.has_feed:
            # The F of a thread is its lead, whatever the feed mode.
            record["feed"] = row.feed * (scale.length if row.kind == Kind.THREAD else scale.feed)
        if row.curve:
            record.update(self._curve(row, scale))
        return record

    def _event(self, row: Row, event: Event) -> dict[str, Any]:
        record = {"type": event.type, "program": row.program, "line": row.line, **event.data}
        if event.type == "alarm" and self._alarm_text is not None:
            record["text"] = self._alarm_text(event.data)
        return record

    def work(self, end: Sequence[float], context: Context) -> dict[str, float]:
        """A position (absolute, internal units) as the work display shows it."""
        values = [value * factor for value, factor in zip(end, self._scale(context).work, strict=True)]
        for i in self._layout.modulo:
            values[i] = round(values[i] % _FULL_TURN, 9) % _FULL_TURN
        return dict(zip(self.axes, values, strict=True))

    def machine(self, end: Sequence[float], context: Context) -> dict[str, float]:
        """A position (absolute, internal units) as the machine display shows it, never in inches."""
        position = self._toolpath.to_machine(tuple(end), context, self._layout.geometry)
        factors = self._scale(context).machine
        return {axis: v * f for axis, v, f in zip(self.axes, position, factors, strict=True)}

    def _scale(self, context: Context) -> _Scale:
        scale = self._scales.get(id(context))
        if scale is None:
            length = 1.0 / MM_PER_INCH if context.inch else 1.0
            diameter = [2.0 if context.diameter_axes >> i & 1 else 1.0 for i in range(len(self.axes))]
            work = [d if i in self._layout.rotary else d * length for i, d in enumerate(diameter)]
            per_length = 1.0 if context.feed_mode == "G93" else length
            feed = _TIME_FACTOR[context.feed_mode] * per_length
            scale = self._scales[id(context)] = _Scale(tuple(work), tuple(diameter), length, feed)
        return scale

    def _curve(self, row: Row, scale: _Scale) -> dict[str, Any]:
        """What the curve parameters of a row add to its record."""
        if row.kind == Kind.DWELL:
            seconds, revolutions = row.curve[0], row.curve[1]
            return {"revolutions": revolutions} if revolutions else {"seconds": seconds}
        if row.kind in (Kind.THREAD, Kind.TAP):
            return {"lead": row.curve[0] * scale.length, "start_angle": row.curve[1]}
        if row.kind in (Kind.CW, Kind.CCW, Kind.HELIX_CW, Kind.HELIX_CCW):
            return self._arc(row.curve, scale)
        return {}

    def _arc(self, curve: tuple[float, ...], scale: _Scale) -> dict[str, Any]:
        """Centre on the axes of the arc's plane (all three where it is tilted), and further turns."""
        center, normal, turns = curve[0:3], curve[3:6], curve[6]
        tilted = sum(1 for component in normal if abs(component) > 1e-9) > 1
        shown: dict[str, float] = {}
        for i, value, component in zip(self._layout.geometry, center, normal, strict=True):
            if i >= 0 and (tilted or abs(component) <= 1e-9):
                shown[self.axes[i]] = value * scale.work[i]
        record: dict[str, Any] = {"center": shown}
        if turns:
            record["turns"] = turns + 1
        return record
