"""The teacher's sheet of a page: the exercise with its checks, faults for the machine, and what is taken away."""

from __future__ import annotations

from functools import partial

from nicegui import ui

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text
from polycnc.panel.screens.pages import in_language
from polycnc.panel.teaching.faults import faults

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.panel.web.desk import Desk

#: How often the sheet looks at the control, s.
LOOK_S = 0.25


class Teacher:
    """A sheet over the page.

    Args:
        desk: The desk.
        lang: Language of the sheet.
    """

    def __init__(self, desk: Desk, lang: str) -> None:
        self._desk, self._lang = desk, lang
        self._shown: object = None

    def open(self) -> None:
        """Show it."""
        with (
            ui.dialog().props(f'aria-label="{self._says("title")}"') as dialog,
            ui.card().classes("teacher"),
        ):
            self._task = ui.element("div").classes("task")
            ui.label(self._says("faults")).classes("head")
            with ui.element("div").classes("flow"):
                self._keys = {
                    name: self._key(in_language(fault.name, self._lang), partial(self._turn_over, name))
                    for name, fault in faults().items()
                }
            with ui.element("div").classes("flow"):
                self._name = ui.input(self._says("signal")).props("outlined dense")
                self._key("1", partial(self._set, 1.0))
                self._key("0", partial(self._set, 0.0))
            with ui.element("div").classes("flow"):
                if self._desk.lesson is not None:
                    self._key(self._says("sheet"), self._take_sheet)
                self._key(self._says("recording"), self._take_recording)
                self._key(text("editor.close", self._lang), dialog.close)
            ui.timer(LOOK_S, self._look)
        self._look()
        dialog.open()

    def _says(self, word: str) -> str:
        return text(f"lesson.{word}", self._lang)

    def _key(self, label: str, act: Callable[[], object]) -> ui.element:
        with ui.element("button").classes("k").props('type="button"') as key:
            ui.label(label)
        key.on("click", act)
        return key

    def _turn_over(self, name: str) -> None:
        is_on = faults()[name].is_in(self._desk.control)
        self._desk.do("fault", name=name, pressed=not is_on)
        self._look()

    def _set(self, value: float) -> None:
        name = str(self._name.value or "").strip().upper()
        if name:
            self._desk.do("signal", name=name, value=value)

    def _look(self) -> None:
        """Faults that are in the machine, and checks that are passed."""
        control, lesson = self._desk.control, self._desk.lesson
        for name, key in self._keys.items():
            is_on = faults()[name].is_in(control)
            key.classes(add="chosen" if is_on else "", remove="" if is_on else "chosen")
            key.props(f'aria-pressed="{str(is_on).lower()}"')
        results = lesson.results(self._lang) if lesson is not None else ()
        if results == self._shown:
            return
        self._shown = results
        self._task.clear()
        if lesson is None:
            return
        with self._task:
            ui.label(in_language(lesson.exercise.title, self._lang)).classes("head")
            ui.label(in_language(lesson.exercise.text, self._lang))
            for each in results:
                ui.label(f"{'☑' if each.at_s is not None else '☐'} {each.text}")

    def _take_sheet(self) -> None:
        if self._desk.lesson is not None:
            name = f"{self._desk.lesson.exercise.id}.md"
            ui.download.content(self._desk.lesson.sheet(self._lang), name)

    def _take_recording(self) -> None:
        ui.download.content(self._desk.recording.text(), "session.jsonl")
