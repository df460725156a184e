"""The program editor of a page: text in colours, findings while it is typed, and back into the control's memory."""

from __future__ import annotations

from time import monotonic

from nicegui import ui

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused
from polycnc.messages import UserError, text
from polycnc.panel.editing import Check, check_elsewhere, parts, told

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.panel.checking import FarCheck
    from polycnc.panel.editing import Finding
    from polycnc.panel.web.desk import Desk

#: A check begins when nothing has been typed for so long, s; it goes on for so long at a time, as often as that.
PAUSE_S, SPELL_S, TURN_S = 0.4, 0.005, 0.03
#: Programs up to this length are shown in colours, and what the server finds at once is told, characters.
LONGEST = 200_000
#: Longer ones are not opened: a browser would not edit them fluently, and the way there holds the server.
LONGEST_OPEN = 4_000_000


class Editor:
    """A sheet over the page with the text of a program.

    Args:
        desk: The desk whose control has the program.
        lang: Language of findings and refusals.

    Attributes:
        is_open: It is on the page: what is typed goes into it.
    """

    def __init__(self, desk: Desk, lang: str) -> None:
        self._desk, self._lang = desk, lang
        self.is_open = False
        self._due = 0.0
        self._check: Check | None = None
        self._far: FarCheck | None = None

    def open(self) -> None:
        """Show the program that is loaded, or an empty text where there is none."""
        name = self._desk.control.program
        try:
            source = "\n".join(self._desk.control.program_lines(name)) + "\n" if name else ""
        except CommandRefused:
            source = ""
        if len(source) > LONGEST_OPEN:
            self._desk.screen.refusal = CommandRefused("editor.too-long", name=name, most=LONGEST_OPEN)
            return
        self.is_open = True
        # No dialog of Quasar: it grows while it opens, and the editor would measure its lines in the midst of that.
        with ui.element("div").classes("editor").props('role="dialog" aria-modal="true"') as self._dialog:
            with ui.element("div").classes("editor-head"):
                self._name = ui.input(text("editor.name", self._lang), value=name).props("outlined dense")
                self._button("editor.save", self._save)
                self._button("editor.close", self._close)
                self._said = ui.label("").classes("editor-said").props('role="status"')
            self._text = ui.codemirror(source, on_change=self._changed).classes("editor-text")
            self._found = ui.element("ul").classes("editor-found").props('role="log"')
            ui.timer(TURN_S, self._go_on)
        self._begin()

    def _button(self, name: str, act: Callable[[], None]) -> None:
        with ui.element("button").classes("k").props('type="button"') as key:
            ui.label(text(name, self._lang))
        key.on("click", act)

    def _changed(self) -> None:
        self._due, self._check = monotonic() + PAUSE_S, None
        self._leave()

    def _leave(self) -> None:
        """What goes on elsewhere is of no use any more."""
        if self._far is not None:
            self._far.give_up()
            self._far = None

    def _go_on(self) -> None:
        """Look at the text a little further: nobody waits for a check."""
        if self._due and monotonic() >= self._due:
            self._begin()
        if self._far is not None and self._far.is_over:
            self._end(self._far)
        if self._check is None:
            return
        until = monotonic() + SPELL_S
        while self._check.go_on():
            if monotonic() > until:
                return
        check, self._check = self._check, None
        self._mark(check.findings)
        if check.ends_early:
            self._look_elsewhere()

    def _begin(self) -> None:
        """A check of the text as it is now begins."""
        self._due, self._check = 0.0, None
        self._leave()
        source = self._text.value
        if len(source) > LONGEST:
            self._text.decorations = []
            self._look_elsewhere()
        elif source.strip():
            self._check = Check(self._desk.control, self._name.value or "MAIN", source, self._lang)
        else:
            self._mark(())

    def _look_elsewhere(self) -> None:
        """The whole text is gone through in another process."""
        self._far = check_elsewhere(self._desk.control, self._name.value or "MAIN", self._text.value)
        self._say("editor.checking")

    def _end(self, far: FarCheck) -> None:
        """What was found elsewhere is told."""
        self._far = None
        if far.found is None:
            self._say("editor.unchecked")
            return
        found = far.found
        self._mark(told(self._desk.control, found.program, found.alarms, self._lang))
        if not found.to_the_end:
            self._say("editor.partly")

    def _say(self, name: str) -> None:
        """A word below what has been found."""
        with self._found, ui.element("li"):
            ui.label(text(name, self._lang))

    def _mark(self, found: tuple[Finding, ...]) -> None:
        """Colours of the text, and what has been found in it."""
        source = self._text.value if len(self._text.value) <= LONGEST else ""
        marks: list[dict[str, object]] = [
            {"kind": "mark", "from": part.start, "to": part.end, "class": f"nc-{part.kind}"}
            for part in parts(self._desk.control.control.id, source)
        ]
        lines = {each.line for each in found if each.line}
        marks += [{"kind": "line", "line": line, "class": "nc-wrong"} for line in sorted(lines)]
        self._text.decorations = marks
        self._text.line_tooltips = {each.line: f"{each.code} {each.text}" for each in found if each.line}
        self._tell(found)

    def _tell(self, found: tuple[Finding, ...]) -> None:
        self._found.clear()
        with self._found:
            for each in found:
                place = ":".join(str(number) for number in (each.line, each.column) if number)
                with ui.element("li"):
                    ui.label(f"{place} {each.code} {each.text}")
            if not found:
                with ui.element("li"):
                    ui.label(text("editor.clean", self._lang))

    def _save(self) -> None:
        """Into the memory; what the control refuses is said here."""
        self._desk.recording.note("store_program", name=self._name.value or "MAIN", text=self._text.value)
        try:
            self._desk.control.store_program(self._name.value or "MAIN", self._text.value)
        except UserError as refusal:
            self._said.set_text(refusal.text(self._lang))
            return
        self._said.set_text(text("editor.saved", self._lang, name=self._name.value or "MAIN"))

    def _close(self) -> None:
        self.is_open = False
        self._leave()
        self._dialog.delete()
