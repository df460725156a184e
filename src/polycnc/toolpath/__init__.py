"""The motion of a run as a table: moves and events in order, with the contexts that hold meanwhile.

`table` has the rows, `kinds` what they are, `context` (with `modes`) and `events` the rest of a row; `motion_settings`
is how a control leads the axes where a context does not say. `trace` says what the displays of a control show for it;
`export` and `plot` write it (`columns`: its rows as columns and lines of text, whose numbers the kernel `digits`
writes; `strokes`: its lines and arcs as a drawing wants them, `row_path` the points of a row), `usage` sums up how far,
how fast and under which offsets each tool cuts, by the kernel `survey`. The kernel `fairing` says how far cuts may be
led beside their ends, for a smoother path (all three are `compiled` where they can be).
"""

from polycnc.toolpath.context import Context
from polycnc.toolpath.events import Event
from polycnc.toolpath.kinds import NO_CURVE, Kind
from polycnc.toolpath.table import Row, Toolpath

__all__ = ["NO_CURVE", "Context", "Event", "Kind", "Row", "Toolpath"]
