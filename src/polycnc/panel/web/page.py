"""The page of a control: its screen with soft keys and keyboard at the left, the machine panel at the right.

What stands on it comes from the family's data and the panel's description. What changes is sent when it has changed.
"""

from __future__ import annotations

from functools import partial
from html import escape

from nicegui import ui

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.panel import Light
from polycnc.panel.screens.pages import in_language
from polycnc.panel.screens.screen import SIDE_KEYS
from polycnc.panel.web.crt import Crt
from polycnc.panel.web.editor import Editor
from polycnc.panel.web.teacher import Teacher
from polycnc.view.web.picture import Picture

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from nicegui.events import KeyEventArguments

    from polycnc.panel.web.desk import Desk

#: So many displays have a key each.
KEYS_FOR_DISPLAYS = 2
#: How often a page looks for what has changed, s.
REFRESH_S = 0.04
#: Keys of a keyboard, and the key of the MDI unit that each one is.
TYPED = {
    "Enter": "INPUT", "Backspace": "CAN", "Insert": "INSERT", "Delete": "DELETE", "PageUp": "PAGE_UP",
    "PageDown": "PAGE_DOWN", "ArrowUp": "UP", "ArrowDown": "DOWN", "ArrowLeft": "LEFT", "ArrowRight": "RIGHT",
    "Escape": "RESET", "Home": "MENU",
}  # fmt: skip
#: Keys of a keyboard, and the key of the machine panel that each one is. A control that has a key F10 of its own has
#: the other one for it.
OPERATED = {"F9": "START", "F10": "HOLD", "Pause": "HOLD"}
#: Keys that edit, and what stands on each.
EDITING = {
    "RETURN": "◁", "MENU": "▷", "CAN": "CAN", "INPUT": "INPUT", "INSERT": "INSERT", "DELETE": "DELETE",
    "PAGE_UP": "PAGE↑", "PAGE_DOWN": "PAGE↓", "UP": "↑", "DOWN": "↓", "LEFT": "←", "RIGHT": "→",
}  # fmt: skip
_LOOK = {"START": "start", "HOLD": "hold", "RESET": "reset", "EMERGENCY": "emergency"}
_RED = frozenset({"E13", "E14", "E11", "E15"})


class Page:
    """One browser's page of a desk.

    Args:
        desk: What it shows.
        lang: Its language at first.
        name: Name of the desk in addresses.
    """

    def __init__(self, desk: Desk, lang: str, name: str) -> None:
        self._desk, self._name = desk, name
        self._lang = desk.language or lang
        self._shown: dict[str, str] = {}
        self._refreshers: list[Callable[[], None]] = []
        self._held: set[str] = set()
        self._editor = Editor(desk, self._lang)
        with ui.element("div").classes("desk"):
            self._left = ui.element("div").classes("half")
            with ui.element("div").classes("half"):
                self._bar()
                self._right = ui.element("div").classes("rest")
        self._build()
        ui.keyboard(on_key=self._typed, ignore=["input", "select", "textarea"])
        ui.timer(REFRESH_S, self._refresh)

    def _build(self) -> None:
        self._refreshers.clear()
        self._shown.clear()
        for part in (self._left, self._displays, self._tools, self._right):
            part.clear()
        with self._left:
            self._screen()
            self._keyboard()
        with self._displays:
            self._choose_display()
        with self._tools:
            self._key("☀", self._day, hint=text("panel.theme", self._lang))
            self._key("?", self._help, hint=text("panel.help", self._lang))
            self._key("✎", self._edit, hint=text("editor.title", self._lang))
            self._key("☑", self._teach, hint=text("lesson.title", self._lang))
        with self._right:
            self._machine_panel()
        self._left.client.run_javascript(f"document.documentElement.lang = '{self._lang}'")
        self._refresh()

    def _refresh(self) -> None:
        for refresh in self._refreshers:
            refresh()

    def _changed(self, name: str, value: str) -> bool:
        """Whether something looks otherwise than when it was last sent."""
        if self._shown.get(name) == value:
            return False
        self._shown[name] = value
        return True

    # ---- parts ---------------------------------------------------------------------------------------------

    def _key(self, label: str, act: Callable[[], object], look: str = "", hint: str = "") -> ui.element:
        """A key that acts when it is pressed."""
        key = (
            ui.element("button")
            .classes(f"k {look}")
            .props(f'type="button" aria-label="{_quoted(hint or label)}"')
        )
        with key:
            ui.label(label)

        def clicked() -> None:
            act()
            self._refresh()

        key.on("click", clicked)
        if hint:
            key.props(f'title="{_quoted(hint)}"')
        return key

    # ---- the screen ----------------------------------------------------------------------------------------

    def _screen(self) -> None:
        desk = self._desk
        with ui.element("div").classes("crt"):
            content = Crt().classes("crt-body").props('role="region" aria-label="screen"')
            side: list[ui.element] = []
            if desk.screen.has_side:
                with ui.element("div").classes("sidekeys"):
                    side = [self._key("", partial(desk.do, "side_key", index=i)) for i in range(SIDE_KEYS)]
        self._picture_over(".window.graph")
        with ui.element("div").classes("softkeys"):
            below = [self._key("", partial(desk.do, "soft_key", index=i)) for i in range(desk.screen.rows)]

        def refresh() -> None:
            view = desk.look(self._lang).view
            content.show(view)
            for name, keys, shown in (("soft", below, view.soft_keys), ("side", side, view.side_keys)):
                for i, (key, soft) in enumerate(zip(keys, shown, strict=False)):
                    if self._changed(f"{name}{i}", f"{soft.text}{soft.active}"):
                        key.clear()
                        with key:
                            ui.label(soft.text)
                        key.classes(
                            add="chosen" if soft.active else "", remove="" if soft.active else "chosen"
                        )
                        key.props(f'aria-label="{_quoted(soft.text or "soft key " + str(i + 1))}"')

        self._refreshers.append(refresh)

    def _picture_over(self, place: str) -> None:
        """The picture, on the pages of the screen that have a window for it."""
        course = self._desk.course
        addresses = {name: f"/lines/{self._name}/{name}" for name in course.lines}
        picture = Picture(addresses, course.bodies, self._lang, over=place)

        def refresh() -> None:
            if self._desk.screen.shows("graph"):
                picture.show(course.pose, course.lines)

        self._refreshers.append(refresh)

    def _keyboard(self) -> None:
        """Function keys and keys that type."""
        desk, screen = self._desk, self._desk.screen
        with ui.element("div").classes("keys"):
            with ui.element("div").classes("row"):
                for name in screen.family.keys:
                    self._key(name, partial(desk.do, "screen_key", key=name))
            with ui.element("div").classes("row edit"):
                for name in self._editing():
                    # Two legends stand one above the other.
                    label = EDITING.get(name, name).replace("/", "/ ")
                    if name == "MENU":
                        label = screen.family.next_key or label
                    self._key(label, partial(desk.do, "screen_key", key=name), hint=name)
            for letters in screen.family.letters:
                with ui.element("div").classes("row"):
                    for letter in letters.split():
                        self._key(letter, partial(desk.do, "screen_key", key=letter))

    def _editing(self) -> list[str]:
        """Keys that edit: those of the MDI unit, where its manual names them."""
        units = self._desk.panel.description.mdi_units
        if not units:
            return [*EDITING, *self._desk.screen.family.more_keys]
        return ["RETURN", "MENU", *(key for key in units[0].keys if key not in self._desk.screen.family.keys)]

    # ---- the machine panel ---------------------------------------------------------------------------------

    def _bar(self) -> None:
        """What stands above the machine panel.

        The keys of the languages stay when all else is built anew: no click on them is lost.
        """
        control = self._desk.control
        with ui.element("div").classes("bar"):
            ui.html(f"<h1>polycnc · {control.control.id} · {escape(control.machine.id)}</h1>", sanitize=False)
            self._tool_display = ui.label("").classes("tools").props('role="status"')
            with ui.element("div").classes("flow"):
                self._displays = ui.element("div").classes("parts")
                for lang in LANGUAGES:
                    self._key({"en": "EN", "zh-TW": "中"}.get(lang, lang), partial(self._speak, lang))
                self._tools = ui.element("div").classes("parts")

    def _machine_panel(self) -> None:
        desk, description = self._desk, self._desk.panel.description
        with self._group("panel.mode-switch"), ui.element("div").classes("flow"):
            modes = {
                name: self._key(in_language(mode.name, self._lang), partial(desk.turn, "mode", name))
                for name, mode in description.modes.items()
            }
        with self._group("panel.overrides"), ui.element("div").classes("dials"):
            for name, switch in description.switches.items():
                self._dial(name, in_language(switch.name, self._lang), switch.positions)
            self._dial("handle_axis", text("panel.handle-axis", self._lang), desk.control.channel.axes)
        with self._group("panel.axes"):
            self._axis_keys()
        commands = [name for name, key in description.keys.items() if key.command]
        with self._group("panel.keys"), ui.element("div").classes("grid"):
            keys = {
                name: self._machine_key(name, in_language(key.name, self._lang))
                for name, key in description.keys.items()
                if not key.command
            }
        with ui.element("div").classes("row commands"):
            for name in commands:
                keys[name] = self._machine_key(name, in_language(description.keys[name].name, self._lang))
        with ui.element("div").classes("lamps"):
            lamps = {
                name: ui.label(in_language(lamp.name, self._lang)).classes(
                    "lamp red" if name in _RED else "lamp"
                )
                for name, lamp in description.lamps.items()
            }
        self._refreshers.append(lambda: self._light(modes, {**keys, **lamps}))
        self._refreshers.append(lambda: self._dim(keys))
        self._refreshers.append(lambda: self._show_tools(self._tool_display))

    def _choose_display(self) -> None:
        """The displays that the control may have: keys for two, a list for more."""
        units = self._desk.panel.description.mdi_units
        names = {unit.id: in_language(unit.name, self._lang) for unit in units}
        if len(units) == KEYS_FOR_DISPLAYS:
            for unit in units:
                self._key(unit.short, partial(self._display, unit.id), hint=names[unit.id])
        elif units[1:]:
            label = text("panel.display", self._lang)
            chosen = ui.element("select").classes("dial").props(f'aria-label="{_quoted(label)}"')
            with chosen:
                for unit in units:
                    now = " selected" if unit.id == self._desk.unit else ""
                    option = ui.element("option").props(
                        f'value="{unit.id}" title="{_quoted(names[unit.id])}"{now}'
                    )
                    option.add_slot("default", unit.short)
            chosen.on(
                "change",
                lambda event: self._display(str(event.args)),
                js_handler="(e) => emit(e.target.value)",
            )

    def _group(self, title: str) -> ui.element:
        group = ui.element("section").classes("group")
        with group:
            ui.html(f"<h2>{text(title, self._lang)}</h2>", sanitize=False)
        return group

    def _machine_key(self, name: str, label: str) -> ui.element:
        desk, key = self._desk, self._desk.panel.description.keys[name]
        if key.hold and (key.command == "emergency" or name == "C8"):
            # The emergency stop latches; the safety key is held with a finger that a mouse does not have.
            return self._key(label, partial(self._latch, name), _LOOK.get(name, ""), f"{name} {label}")
        if not key.hold:
            return self._key(label, partial(desk.press, name), _LOOK.get(name, ""), f"{name} {label}")
        made = self._key(label, lambda: None, _LOOK.get(name, ""), f"{name} {label}")
        made.on("pointerdown", lambda: desk.press(name))
        made.on("pointerup", lambda: desk.release(name))
        made.on("pointerleave", lambda: desk.release(name))
        return made

    def _latch(self, name: str) -> None:
        if name in self._held:
            self._held.discard(name)
            self._desk.release(name)
        else:
            self._held.add(name)
            self._desk.press(name)

    def _axis_keys(self) -> None:
        desk = self._desk
        with ui.element("div").classes("flow"):
            for axis in desk.control.channel.axes:
                for sign in "+-":
                    name = f"{axis}{sign}"
                    key = self._key(name, lambda: None, hint=f"{text('panel.jog', self._lang)} {name}")
                    key.on("pointerdown", partial(desk.press, name))
                    key.on("pointerup", partial(desk.release, name))
                    key.on("pointerleave", partial(desk.release, name))
            wheel = self._key("◎", lambda: None, hint=text("panel.wheel", self._lang))
            wheel.on(
                "wheel.prevent",
                lambda event: desk.wheel(-1 if event.args.get("deltaY", 0) > 0 else 1),
                ["deltaY"],
            )

    def _dial(self, name: str, label: str, positions: tuple[str, ...]) -> None:
        desk = self._desk
        with ui.element("label"):
            ui.label(label)
            dial = ui.element("select").classes("dial").props(f'aria-label="{_quoted(label)}"')
            with dial:
                for position in positions:
                    chosen = " selected" if desk.panel.positions[name] == position else ""
                    ui.element("option").props(f'value="{position}"{chosen}').add_slot("default", position)
        dial.on(
            "change", lambda event: desk.turn(name, str(event.args)), js_handler="(e) => emit(e.target.value)"
        )

    def _light(self, modes: Mapping[str, ui.element], lights: Mapping[str, ui.element]) -> None:
        """Lamps, and the position of the mode switch."""
        panel = self._desk.panel
        for name, key in modes.items():
            chosen = panel.positions["mode"] == name
            if self._changed(f"mode-{name}", str(chosen)):
                key.classes(add="chosen" if chosen else "", remove="" if chosen else "chosen")
        for name, light in self._desk.look(self._lang).lamps.items():
            element = lights.get(name)
            if element is not None and self._changed(f"lamp-{name}", light):
                element.classes(remove="lit blinking")
                element.classes(add={Light.ON: "lit", Light.BLINKING: "blinking"}.get(light, ""))

    def _dim(self, keys: Mapping[str, ui.element]) -> None:
        """Keys that would do nothing now are dim; pressed, they say why."""
        dim = self._desk.look(self._lang).dim
        for name, key in keys.items():
            is_dim = name in dim
            if self._changed(f"dim-{name}", str(is_dim)):
                key.classes(add="dim" if is_dim else "", remove="" if is_dim else "dim")

    # ---- the page itself -----------------------------------------------------------------------------------

    def _typed(self, event: KeyEventArguments) -> None:
        if self._editor.is_open:
            return
        if not event.action.keydown or event.modifiers.ctrl or event.modifiers.alt or event.modifiers.meta:
            return
        name = str(event.key.name)
        if name == "?":
            self._help()
        elif name == self._desk.screen.family.next_key:
            self._desk.do("screen_key", key="MENU")
        elif name in OPERATED:
            self._desk.press(OPERATED[name])
        elif name in TYPED:
            self._desk.do("screen_key", key=TYPED[name])
        elif name[:1] == "F" and name[1:].isdigit():
            self._desk.do("soft_key", index=int(name[1:]) - 1)
        elif len(name) == 1:
            self._desk.do("type", text=name.upper())
        self._refresh()

    def _speak(self, lang: str) -> None:
        self._lang = self._desk.language = lang
        self._build()

    def _display(self, unit: str) -> None:
        self._desk.do("display", unit=unit)
        self._build()

    def _show_tools(self, display: ui.label) -> None:
        """The tool display."""
        shown = self._desk.look(self._lang).tools
        if self._changed("tools", shown):
            display.set_text(shown)

    def _day(self) -> None:
        ui.run_javascript("document.body.classList.toggle('day')")

    def _edit(self) -> None:
        self._editor = Editor(self._desk, self._lang)
        self._editor.open()

    def _teach(self) -> None:
        Teacher(self._desk, self._lang).open()

    def _help(self) -> None:
        """The sheet of keys."""
        title = text("panel.help", self._lang)
        with ui.dialog().props(f'aria-label="{_quoted(title)}"') as dialog, ui.card().classes("teacher"):
            ui.label(title)
            for key, meaning in self._keys_of_keyboard():
                ui.label(f"{key}: {meaning}")
        dialog.open()

    def _keys_of_keyboard(self) -> list[tuple[str, str]]:
        """Keys of a keyboard, and what each of them is on this control."""
        family, keys = self._desk.screen.family, self._desk.panel.description.keys
        operated = {
            key: in_language(keys[name].name, self._lang)
            for key, name in OPERATED.items()
            if key != family.next_key
        }
        further = [(family.next_key, text("panel.next-keys", self._lang))] if family.next_key else []
        soft = f"F1 … F{min(self._desk.screen.rows, 8)}"
        return [*TYPED.items(), *operated.items(), (soft, text("panel.soft-keys", self._lang)), *further]


def _quoted(value: str) -> str:
    return value.replace("&", "&amp;").replace('"', "&quot;")
