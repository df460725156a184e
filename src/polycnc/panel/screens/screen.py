"""One screen of a control: the page, the cursor, the key-in buffer. Keys go in, a `View` comes out.

    screen = Screen(VirtualControl("fanuc-m"))
    screen.press("OFS/SET")
    screen.type("12.5")
    screen.press("INPUT")
    screen.view().text

Whoever looks at the control looks at the same screen: all browsers share one.
"""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused, Mode
from polycnc.messages import UserError
from polycnc.messages.catalogue import language
from polycnc.panel.screens.actions import ACTIONS, calculate
from polycnc.panel.screens.forms import follow_dialog
from polycnc.panel.screens.operate import state_of
from polycnc.panel.screens.pages import SoftKey, in_language
from polycnc.panel.screens.programs import edit_words, insert
from polycnc.panel.screens.state import ScreenState
from polycnc.panel.screens.view import Cell, SoftKeyView, View
from polycnc.panel.screens.windows import window

if TYPE_CHECKING:
    from polycnc.mainrun.reading.snapshot import Snapshot

#: Blocks that are looked through for a number.
LONGEST_LOOK = 500
#: A block with its number.
_NUMBERED = regex(r"\s*/?\d?\s*[Nn](\d+)")
#: The number of a program.
_NUMBER = regex(r"(?i)O\d+")
#: Characters that the key-in buffer takes.
LONGEST_BUFFER = 127
#: Soft keys at the side of a screen that always has them.
SIDE_KEYS = 8
#: Keys whose name is not what they type.
_SIGNS = {"EOB": ";", "SPACE": " "}
_EDITING = frozenset(
    ("CAN", "RUBOUT", "CANCEL_BLOCK", "CALC", "INPUT", "INSERT", "ALTER", "DELETE", "SELECT")
)
_MOVES = {"UP": (-1, 0), "DOWN": (1, 0), "LEFT": (0, -1), "RIGHT": (0, 1)}


class Screen(ScreenState):
    """The screen of a virtual control: what its keys do, and what it shows.

    Raises:
        CommandRefused: polycnc knows no screens of this control.
    """

    # ---- keys ----------------------------------------------------------------------------------------------

    def press(self, key: str) -> None:
        """Press a key of the MDI unit: a function key, a key that edits, or one that types.

        What the control refuses is its message then.
        """
        self.refusal = None
        try:
            self._press(key)
        except UserError as refusal:
            self.refusal = refusal

    def follow(self) -> None:
        """Note alarms and dialogs of the program, and go on with what takes time; called while time passes."""
        super().follow()
        follow_dialog(self)

    def _press(self, key: str) -> None:
        if key == "SHIFT" and self.family.dual:
            self.shifted = not self.shifted
            return
        if key in self.family.dual:
            key = self.family.dual[key][self.shifted]
        self.shifted = False
        if key in self.family.keys:
            self.show(self.family.keys[key])
        elif key in _MOVES:
            self._go(key)
        elif key in ("PAGE_UP", "PAGE_DOWN") and self.page.turns:
            self.show(self.page.turns)
        elif key in ("PAGE_UP", "PAGE_DOWN"):
            shown = self.table.shown if self.table is not None else self.page.windows[0].shown
            self.move(shown if key == "PAGE_DOWN" else -shown, 0)
        elif key in _EDITING:
            self._edit(key)
        elif key in _SIGNS:
            self.type(_SIGNS[key])
        elif key == "RESET":
            self.control.reset()
            self.buffer = ""
            if self.edits:
                self.look_at(0)
        elif key in ("MENU", self.family.next_key):
            self._turn_menu()
        elif key == "RETURN":
            self.menu, self.turned = self.page.menu, 0
        elif len(key) == 1:
            self.type(key)
        else:
            raise CommandRefused("panel.unknown", name=key, known=", ".join(self.family.keys))

    def _go(self, key: str) -> None:
        """A cursor key: it moves the cursor, or looks for what has been keyed in."""
        if key == "DOWN" and self.page.edits and _NUMBER.fullmatch(self.buffer):
            ACTIONS["search-program"](self)
        elif key in ("UP", "DOWN") and self.buffer and self._reads_program:
            self.find(self.buffer, _MOVES[key][0])
        elif key == "RIGHT" and self._numbered and self.buffer.isdecimal():
            ACTIONS["search-number"](self)
        else:
            self.move(*_MOVES[key])

    @property
    def _numbered(self) -> str:
        """The number of the field at the cursor, where the key-in line tells it; there → leads to one that is typed."""
        if not self.family.entry:
            return ""
        if self.shows("parameters"):
            return self.parameters[self.cursor[0]][1].number if self.parameters else ""
        return str(self.cursor[0]) if self.table is not None else ""

    @property
    def _entry(self) -> str:
        numbered = self._numbered
        return self.family.entry.format(n=numbered, typed=self.buffer) if numbered else f"A>{self.buffer}_"

    @property
    def _reads_program(self) -> bool:
        """Whether the cursor stands in a program, where a text that has been keyed in is looked for."""
        return self.shows("program") and self.table is None and not self.shows("mask")

    def _edit(self, key: str) -> None:
        """A key that changes the key-in buffer, or enters it."""
        if key == "CAN" or (key == "RUBOUT" and self.buffer):
            self.buffer = self.buffer[:-1]
        elif key == "CANCEL_BLOCK":
            self.buffer = ""
        elif key == "CALC":
            calculate(self)
        elif key == "INSERT" and self.control.mode is Mode.TEACH and self._reads_program:
            ACTIONS["teach"](self)
        elif key in ("INPUT", "INSERT") and self.page.edits_blocks:
            ACTIONS["insert-block"](self)
        elif key == "INPUT":
            ACTIONS["insert" if self.shows("mdi") else "enter" if self.shows("mask") else "set"](self)
        elif key == "SELECT":
            ACTIONS["turn-switch" if self.shows("switches") else "toggle"](self)
        elif key in ("INSERT", "ALTER"):
            (insert if self.shows("mdi") else edit_words)(self, key)
        elif self.shows("mdi"):
            ACTIONS["erase-mdi"](self)
        elif self.edits and not _NUMBER.fullmatch(self.buffer):
            edit_words(self, key)
        elif key in ("DELETE", "RUBOUT") and self.page.edits_blocks and not self.buffer:
            ACTIONS["delete-block"](self)
        elif key == "DELETE":
            ACTIONS["delete-program"](self)

    def type(self, text: str) -> None:
        """Key a text in."""
        self.buffer = (self.buffer + text)[:LONGEST_BUFFER]

    def soft(self, index: int) -> None:
        """Press a soft key below the screen, from 0 at the left."""
        self._press_soft(self._visible, index)

    def side(self, index: int) -> None:
        """Press a soft key at the side of the screen, from 0 at the top."""
        self._press_soft(self._at_side, index)

    def _press_soft(self, keys: tuple[SoftKey, ...], index: int) -> None:
        self.refusal = None
        if not 0 <= index < len(keys):
            return
        key = keys[index]
        try:
            waiting = self.pending
            if key.action == "next-keys":
                self._turn_menu()
            elif key.action == "next-side":
                self._turn_side()
            elif key.action:
                ACTIONS[key.action](self)
            if key.search:
                self.search_mode = key.search
            if key.switch or key.signal:
                self.turn_over(key)
            before = self.menu, self.turned
            if key.page:
                self.show(key.page)
            if key.menu:
                menu = (key.by_page and self.page.operations) or key.menu
                self.menu, self.turned = before if menu == before[0] else (menu, 0)
            if self.pending is not None and self.pending is not waiting and self.pending.keys:
                self.menu, self.turned = self.pending.keys, 0
        except UserError as refusal:
            self.refusal = refusal

    def _turn_menu(self) -> None:
        """▷: the next soft keys of the row."""
        keys, root = self._row, self.family.root
        if root and self.menu != root and len(keys) <= self.rows:
            self.menu, self.turned = root, 0
            keys = self._row
        self.turned = self.turned + self.rows if self.turned + self.rows < len(keys) else 0

    @property
    def _visible(self) -> tuple[SoftKey, ...]:
        return self._row[self.turned : self.turned + self.rows]

    @property
    def _row(self) -> tuple[SoftKey, ...]:
        """The soft keys of the row that are there as parameters are."""
        return self._present_keys(self._below)

    def _present_keys(self, menu: str) -> tuple[SoftKey, ...]:
        menus = self.family.menus
        keys = menus.get(f"{menu}-{self.rows}") or menus.get(menu, ())
        return tuple(key for key in keys if self.holds(key.when))

    @property
    def _below(self) -> str:
        """The row below the screen: operations, without their own key, where the chapter stands at the side."""
        if not self.side_rows or self.menu != self.page.menu:
            return self.menu
        opened = (key.menu for key in self.family.menus.get(self.menu, ()) if key.menu)
        return self.page.operations or next(opened, "")

    @property
    def _chapter(self) -> tuple[SoftKey, ...]:
        """The pages of the chapter, as they stand at the side."""
        return tuple(key for key in self._present_keys(self.page.menu) if key.text and not key.menu)

    @property
    def _at_side(self) -> tuple[SoftKey, ...]:
        """The soft keys at the side; the last one leads on where there are too many."""
        if not self.side_rows:
            return self.family.side.get(self.menu, ())
        chapter = self._chapter
        if len(chapter) <= self.side_rows:
            return chapter
        shown = chapter[self.side_turned : self.side_turned + self.side_rows - 1]
        dark = (SoftKey(),) * (self.side_rows - 1 - len(shown))
        return (*shown, *dark, SoftKey(self.family.next_page, action="next-side"))

    def _turn_side(self) -> None:
        """[NEXT PAGE]: further pages of the chapter."""
        further = self.side_turned + self.side_rows - 1
        self.side_turned = further if further < len(self._chapter) else 0

    @property
    def has_side(self) -> bool:
        """Whether there are soft keys at the side."""
        return bool(self.family.side or self.side_rows)

    # ---- what it shows -------------------------------------------------------------------------------------

    def view(self, lang: str | None = None) -> View:
        """The screen now, in a language; the active one where none is named."""
        lang = lang or language()
        snapshot = self.control.snapshot
        return View(
            page=self.page.id,
            title=in_language(self.page.title, lang) + (" (BG-EDIT)" if self.in_background else ""),
            program=snapshot.program,
            sequence=self._sequence(snapshot),
            windows=tuple(window(self, spec, snapshot, lang) for spec in self.page.windows),
            soft_keys=self._soft_keys(self._visible, self.rows, lang),
            side_keys=self._soft_keys(self._at_side, self.side_rows or SIDE_KEYS, lang)
            if self.has_side
            else (),
            buffer=self.buffer,
            entry=self._entry,
            message=self.refusal.text(lang) if self.refusal is not None else "",
            status=self._status(snapshot, lang),
            alarm=self._alarm(snapshot, lang),
            note=self._note(snapshot),
        )

    def _sequence(self, snapshot: Snapshot) -> str:
        """The number of the block in execution, or of the last one in front of it that has one; 0 for none."""
        if not self.family.sequence or not snapshot.program:
            return ""
        block, number = snapshot.block, 0
        try:
            first = self.control.first_line(block.program)
            lines, at = self.control.program_lines(block.program), block.line - first
        except CommandRefused:
            lines, at = [block.text], 0
        for index in range(min(at, len(lines) - 1), max(at - LONGEST_LOOK, -1), -1):
            if found := _NUMBERED.match(lines[index]):
                number = int(found[1])
                break
        return self.family.sequence.format(n=number)

    def _note(self, snapshot: Snapshot) -> str:
        """The message line: what the program tells, beside the line of alarms, until it takes it back."""
        return snapshot.messages[-1] if snapshot.messages and self.family.message_line else ""

    def _soft_keys(self, keys: tuple[SoftKey, ...], count: int, lang: str) -> tuple[SoftKeyView, ...]:
        shown = [
            SoftKeyView(
                in_language((self.side_rows and key.large) or key.text, lang),
                (bool(key.page) and key.page == self.page.id) or self.is_on(key),
            )
            for key in keys
        ]
        return tuple(shown + [SoftKeyView()] * (count - len(shown)))

    def _status(self, snapshot: Snapshot, lang: str) -> tuple[Cell, ...]:
        mode = self.family.modes.get(snapshot.mode, snapshot.mode.upper())
        state = self.family.states.get(state_of(snapshot), snapshot.state.upper())
        alarm = Cell("EMG" if snapshot.state == "emergency" else "ALM" if snapshot.alarms else "***",
                     "alarm" if snapshot.alarms else "")  # fmt: skip
        motion = "MTN" if snapshot.feed > 0.0 else "DWL" if snapshot.waiting == "dwell" else "***"
        cells = [Cell(mode), Cell(state), Cell(motion), alarm]
        if (
            self.family.clock
        ):  # the line of FANUC: the fourth place tells that an auxiliary function is waited for
            cells.insert(3, Cell("FIN" if snapshot.waiting == "function" else "***"))
            cells += [Cell(f"{self.clock():%H:%M:%S}"), Cell("PATH1")]
        going_on = self.pending.status if self.pending is not None else ""
        if self.measuring is not None and not going_on:
            going_on = self.measuring.status(lang)
        return (*cells, Cell(going_on, "blink")) if going_on else tuple(cells)

    def _alarm(self, snapshot: Snapshot, lang: str) -> str:
        if snapshot.alarms:
            alarm = snapshot.alarms[-1]
            return f"{alarm.code} {self.control.alarm_text(alarm, lang)}"
        return snapshot.messages[-1] if snapshot.messages and not self.family.message_line else ""

    # ---- cycle start ---------------------------------------------------------------------------------------

    def takes_start(self) -> bool:
        """Cycle start in MDI runs what has been typed in; false where it is the control's own affair."""
        if self.control.mode is not Mode.MDI or not self.mdi_text.strip():
            return False
        self.control.mdi(self.mdi_text)
        return True
