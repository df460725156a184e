"""The motion of a run as a table: moves and events in order, with the contexts that hold meanwhile."""

from polycnc.toolpath.context import Context
from polycnc.toolpath.events import Event
from polycnc.toolpath.kinds import Kind
from polycnc.toolpath.table import NO_CURVE, Row, Toolpath

__all__ = ["NO_CURVE", "Context", "Event", "Kind", "Row", "Toolpath"]
