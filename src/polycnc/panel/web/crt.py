"""The content of a screen as an element of a page: what changes in its cells is sent alone."""

from __future__ import annotations

from nicegui.element import Element

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.panel.web.markup import cells_of, of_view

if TYPE_CHECKING:
    from polycnc.panel.screens.view import View


class Crt(Element, component="crt.js"):
    """The content of a screen."""

    def __init__(self) -> None:
        super().__init__()
        self._view: View | None = None
        self._frame = ""
        self._cells: tuple[tuple[str, str], ...] = ()

    def show(self, view: View) -> None:
        """Show a view; nothing is sent where nothing has changed."""
        if view == self._view:
            return
        self._view = view
        frame, cells = of_view(view, empty=True), cells_of(view)
        before, self._cells = self._cells, cells
        if frame != self._frame:
            self._frame = frame
            self.run_method("whole", of_view(view))
            return
        pairs = enumerate(zip(before, cells, strict=True))
        changed = [(at, *new) for at, (old, new) in pairs if old != new]
        if changed:
            self.run_method("change", changed)
