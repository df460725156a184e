"""What a screen is at one moment: the page, the cursor, the key-in buffer; and what windows and actions ask of it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from datetime import UTC, datetime
from functools import cached_property

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.mainrun import CommandRefused, Mode, State
from polycnc.messages import UserError
from polycnc.panel.screens.card import Card
from polycnc.panel.screens.measuring import SIGNALS, Measuring
from polycnc.panel.screens.pages import family_of
from polycnc.panel.screens.words import Edited, Place, moved, on_words, word_with

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from polycnc.control.parameters import KnownParameter
    from polycnc.control.sinumerik.variables.dialogs import Dialog
    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.reading.snapshot import Record, Snapshot
    from polycnc.panel.screens.masks import Mask, MaskInput
    from polycnc.panel.screens.pages import Column, Page, SoftKey, WindowSpec

#: The signal of the button that keeps the position.
LATCH = "PRC"
#: The panel's own setting: when maintenance was done.
_MAINTAINED = "maintained"
#: Letters of relative coordinates on screens of the CRT kind.
RELATIVE = {"X": "U", "Y": "V", "Z": "W", "A": "A", "B": "B", "C": "H"}


#: Parameters that anybody may write (SINUMERIK's setting data).
SETTING = "setting-data"
#: The row of the setting page that is no switch of the machine panel: whether parameters may be written.
PARAMETER_WRITE = "parameter_write"


class Operation(ABC):
    """What has been chosen and waits for [EXEC]. `back` is the row of soft keys that is shown behind it."""

    back: str

    @property
    def status(self) -> str:
        """What blinks in the status line while it goes on; empty for nothing."""
        return ""

    @property
    def keys(self) -> str:
        """The row of soft keys while it waits; empty for the one that its soft key opens."""
        return ""

    @abstractmethod
    def execute(self, screen: ScreenState) -> bool:
        """Do it, or begin with it; gives whether it is done."""

    def goes_on(self, screen: ScreenState) -> bool:
        """Called while time passes; gives whether it is not done yet."""
        return True


class ScreenState:
    """The state of a control's screen.

    Args:
        control: The control; its id says which screens it has.

    Attributes:
        control: The control.
        family: Its pages and keys.
        page: The page that is shown.
        rows: Soft keys that stand in a row: as many as the display has.
        side_rows: Soft keys at the side of a display that has a chapter's pages there; 0 for none.
        menu: Name of the row of soft keys; `turned` says how far it has been turned on by ▷, `side_turned` how far
            those at the side by [NEXT PAGE].
        buffer: What has been keyed in.
        shifted: SHIFT was pressed: the next key with two legends is the second one.
        refusal: Why the control has not done what the last key asked for; None where it has.
        mdi_text: Blocks that were typed in at MDI; cycle start runs them.
        card: The memory card.
        pending: What waits for [EXEC], or goes on; None for nothing.
        origins: Machine position at which the relative coordinate of an axis is 0.
        latched: Work coordinates when the signal PRC came last; empty before.
        measuring: Measured input B; None on controls without it.
        writes_parameters: Parameters may be written.
        clock: The time of day.
        mask: The mask that is filled in; None for none.
        listed: The user's cycles as they were when the page came upon the screen.
        sections: Lines of a program, and its sections: row, level, name.
        dialog: The dialog of the program that is shown, since `dialog_since` (simulated time, s); the page that it lies
            upon is `behind_dialog`.
        program_row: Row of the cursor in the program; None where the window follows the block in execution.
        background: The program that is edited while another one may run; empty for none.
        at_interruption: The cursor stands where the program was given up, which may be in a subprogram of that block.
        program_word: The word of that row on which the cursor stands, where the page edits words.
        search_mode: The kind of block search that is chosen.

    Raises:
        CommandRefused: polycnc knows no screens of this control.
    """

    def __init__(self, control: VirtualControl) -> None:
        self.control = control
        try:
            self.family = family_of(control.control.id)
        except KeyError:
            raise CommandRefused("panel.none", control=control.control.id) from None
        axes = tuple(control.positions.work)
        self._pages = {name: page.of(axes) for name, page in self.family.pages.items()}
        self.page: Page = self._pages[self.family.start]
        self.menu, self.turned = self.page.menu, 0
        self.rows, self.side_rows, self.side_turned = self.family.rows, 0, 0
        self.buffer = ""
        self.shifted = False
        self.refusal: UserError | None = None
        self.mdi_text = ""
        self.card = Card()
        self.pending: Operation | None = None
        self.origins: dict[str, float] = {}
        self.writes_parameters = False
        self.latched: dict[str, float] = {}
        self.measuring = Measuring(control) if self.family.measures else None
        control.listeners.append(self._hear)
        self.clock: Callable[[], datetime] = lambda: datetime.now(UTC).astimezone()
        self._came: dict[str, datetime] = {}
        self.mask: MaskInput | None = None
        self.listed: tuple[Mask, ...] | None = None
        self.sections: tuple[object, tuple[tuple[int, int, str], ...]] = (None, ())
        self.dialog: Dialog | None = None
        self.dialog_since, self.behind_dialog = 0.0, self.page.id
        self._cursors: dict[str, tuple[int, int]] = {}
        self.program_row: int | None = None
        self.program_word = 0
        self.background = ""
        self.at_interruption = False
        self.search_mode = "contour"

    @property
    def message(self) -> str:
        """What the control says of the last key, in the active language; empty for nothing."""
        return self.refusal.text() if self.refusal is not None else ""

    def show(self, page: str) -> None:
        """Turn to a page."""
        if self.pending is not None and not self.pending.status:
            self.pending = None
        self.listed = None
        shown, chapter = self._pages[page], self.page.menu
        self.page = self._present(shown if self.holds(shown.when) else self._pages[shown.instead])
        self.menu, self.turned = self.page.menu, 0
        self.side_turned = self.side_turned if self.page.menu == chapter else 0

    def use_display(self, rows: int, side_rows: int) -> None:
        """Another display, with so many soft keys below and at its side."""
        self.rows, self.side_rows = rows, side_rows
        self.menu, self.turned, self.side_turned = self.page.menu, 0, 0

    def holds(self, condition: str) -> bool:
        """Whether parameters are as a condition says: `8136#6`, `!8136#6`, several with `&`; true for an empty one."""
        parts = (part.strip() for part in condition.split("&") if part.strip())
        return all(
            bool(self.control.read_parameter(part.removeprefix("!"))) is not part.startswith("!")
            for part in parts
        )

    def _present(self, page: Page) -> Page:
        """A page with the columns that are there as parameters are now."""
        windows = (
            replace(each, columns=tuple(self._columns(each.columns)), count=self._count(each))
            if each.columns
            else each
            for each in page.windows
        )
        return replace(page, windows=tuple(windows))

    def _count(self, spec: WindowSpec) -> int:
        number = self.control.read_parameter(spec.count_of) if spec.count_of else None
        return int(number) if isinstance(number, int | float) and number > 0 else spec.count

    def _columns(self, columns: Iterable[Column]) -> Iterator[Column]:
        axes = tuple(self.control.positions.work)
        for column in columns:
            if not self.holds(column.when):
                continue
            if not column.axis_of:
                yield column
                continue
            number = self.control.read_parameter(column.axis_of)
            if isinstance(number, int | float) and 1 <= number <= len(axes):
                axis = axes[int(number) - 1]
                yield replace(column, head={"en": axis, "zh-TW": f"{axis}軸"}, axis=axis, variable=axis)

    def finish(self) -> None:
        """What was pending is done or given up; the soft keys in front of it come back."""
        if self.pending is not None:
            self.menu, self.turned, self.pending = self.pending.back, 0, None

    # ---- soft keys that are switches -----------------------------------------------------------------------

    def is_on(self, key: SoftKey) -> bool:
        """Whether the switch, or the signal, of a soft key is on."""
        control = self.control
        chosen = bool(key.search) and key.search == self.search_mode
        return (
            chosen
            or bool(key.switch and getattr(control.switches, key.switch))
            or bool(key.signal and control.signals[key.signal])
        )

    def turn_over(self, key: SoftKey) -> None:
        """Turn over the switch, or the signal, of a soft key."""
        wanted = not self.is_on(key)
        if key.switch:
            self.control.set_switches(**{key.switch: wanted})
        else:
            self.control.signals[key.signal] = float(wanted)

    @property
    def panel_switches(self) -> Sequence[str]:
        """The rows of the page of switches, by the names of panel switches; none on other pages."""
        return next((list(each.words) for each in self.page.windows if each.kind == "switches"), ())

    def switch(self, name: str) -> bool:
        """A panel switch by its name, or whether parameters may be written."""
        return (
            self.writes_parameters if name == PARAMETER_WRITE else bool(getattr(self.control.switches, name))
        )

    @property
    def maintained(self) -> dict[str, float]:
        """Running time at which each task of the maintenance schedule was done last, s, by its number; it lasts."""
        done: dict[str, float] = self.control.panel_settings.get(_MAINTAINED, {})
        return done

    def maintain(self, number: int) -> None:
        """A task of the maintenance schedule has been done now."""
        now = self.control.counters.running_s
        self.control.panel_settings[_MAINTAINED] = {**self.maintained, str(number): now}

    @property
    def parameters(self) -> tuple[tuple[str, KnownParameter], ...]:
        """The rows of the parameter page: the number, with an axis where each has its own (`1240 X`); what it is."""
        return self._parameters.get(self._parameters_of, self._parameters[""])

    @property
    def needs_parameter_write(self) -> bool:
        """Whether parameters of the page want to be enabled before they are written: setting data do not."""
        return self._parameters_of != SETTING

    @property
    def _parameters_of(self) -> str:
        return next((each.of for each in self.page.windows if each.kind == "parameters"), "")

    @cached_property
    def _parameters(self) -> Mapping[str, tuple[tuple[str, KnownParameter], ...]]:
        """The rows by what a page wants: all; SINUMERIK's setting data and its machine data apart."""
        rows: list[tuple[str, KnownParameter]] = []
        for each in self.control.parameters:
            if each.by_axis and self.family.axis_parameters:
                rows += [(f"{each.number} {axis}", each) for axis in self.control.channel.axes]
            else:
                rows.append((each.number, each))
        is_setting = [each.name.startswith("$S") for _, each in rows]
        return {
            "": tuple(rows),
            SETTING: tuple(row for row, yes in zip(rows, is_setting, strict=True) if yes),
            "machine-data": tuple(row for row, yes in zip(rows, is_setting, strict=True) if not yes),
        }

    # ---- the cursor ----------------------------------------------------------------------------------------

    @property
    def table(self) -> WindowSpec | None:
        """The table of the page; None where it has none."""
        return next((each for each in self.page.windows if each.kind == "table"), None)

    def shows(self, kind: str) -> bool:
        """Whether the page has a window of a kind."""
        return any(each.kind == kind for each in self.page.windows)

    @property
    def cursor(self) -> tuple[int, int]:
        """Row and column of the cursor: the number of a table's row, else the row from 0."""
        start = self.table.first if self.table is not None else 0
        return self._cursors.get(self.page.id, (start, 0))

    def place(self, row: int, column: int) -> int:
        """Put the cursor somewhere; gives the row."""
        self._cursors[self.page.id] = row, column
        return row

    def move(self, rows: int, columns: int) -> None:
        """Move the cursor; it stays on the table."""
        (row, column), table = self.cursor, self.table
        if self.measuring is not None and self.measuring.leads_cursor:
            return
        if self.edits and columns and not rows:
            place = moved(self.lines, self.edit_place, columns)
            self.program_row, self.program_word = place.row, place.word
            return
        if self.shows("program") and table is None and not (self.shows("mask") or self.shows("switches")):
            self.look_at(self.row + rows)
            return
        row, column = row + rows, column + columns
        if table is not None:
            row = max(table.first, min(row, table.first + table.count - 1))
            column = max(0, min(column, len(table.columns) - 1))
        self.place(max(row, 0), max(column, 0))

    # ---- the program -----------------------------------------------------------------------------------------

    @property
    def shown_program(self) -> tuple[str, Sequence[str], int]:
        """The program that a program window shows: its name, its lines, the line of its file where it begins."""
        snapshot = self.control.snapshot
        name = (
            snapshot.program if self.program_row is not None else snapshot.block.program or snapshot.program
        )
        name = self.background if self.background and self.page.edits else name
        try:
            return name, self.control.program_lines(name) if name else (), self.control.first_line(name)
        except CommandRefused:
            return name, (), 1

    @property
    def running_row(self) -> int:
        """The row of the block in execution in the main program; 0 where none is."""
        snapshot = self.control.snapshot
        if not snapshot.program or snapshot.block.program != snapshot.program:
            return 0
        return max(0, snapshot.block.line - self.control.first_line(snapshot.program))

    def look_at(self, row: int) -> None:
        """Put the cursor into the program; while it runs, the window follows the block in execution."""
        self.at_interruption = False
        if not self.in_background and (self.control.state is State.RUNNING or not self.control.program):
            self.program_row = None
            return
        lines = self.lines
        self.program_row, self.program_word = max(0, min(row, len(lines) - 1)), 0

    def find(self, text: str, step: int) -> None:
        """Put the cursor on the next row of the program that has a text, onwards (1) or backwards (-1).

        Where words are edited it goes to the next word, in the same block too.

        Raises:
            CommandRefused: There is none.
        """
        lines, wanted = self.lines, text.strip().upper()
        if self.edits:
            place = word_with(lines, self.edit_place, wanted, step)
            if place is None:
                raise CommandRefused("screen.not-found", text=text)
            self.look_at(place.row)
            self.program_word = place.word
            return
        here = self.row
        rows = range(here + 1, len(lines)) if step > 0 else range(here - 1, -1, -1)
        found = next((row for row in rows if wanted in lines[row].upper()), None)
        if found is None:
            raise CommandRefused("screen.not-found", text=text)
        self.look_at(found)

    @property
    def edits(self) -> bool:
        """Whether keys change words of the program: on the page for it, in the mode for it or in the background."""
        return self.page.edits and (self.control.mode is Mode.EDIT or bool(self.background))

    @property
    def in_background(self) -> bool:
        """Whether the page shows a program that is edited in the background."""
        return self.page.edits and bool(self.background)

    @property
    def edited_program(self) -> str:
        """Name of the program that keys change: that in the background, or the main program."""
        return self.background if self.in_background else self.control.program

    @property
    def edited(self) -> Edited:
        """The main program with the cursor in it; an empty one where none is loaded."""
        return Edited(self.lines, self.edit_place)

    @property
    def edit_place(self) -> Place:
        """The word on which the cursor stands."""
        place = Place(self.program_row if self.program_row is not None else 0, self.program_word)
        return on_words(self.lines, place)

    @property
    def row(self) -> int:
        """The row of the cursor in the program, or of the block in execution."""
        return self.program_row if self.program_row is not None else self.running_row

    @property
    def lines(self) -> Sequence[str]:
        """The lines of the program that keys change."""
        try:
            return self.control.program_lines(self.edited_program) if self.edited_program else ()
        except CommandRefused:  # it has been deleted meanwhile
            return ()

    def _hear(self, record: Record) -> None:
        """The record button of the machine keeps where the axes are (III.2.1.2, PRC); a sensor measures (III.2.1.3)."""
        if record.what != "signal":
            return
        name, is_on = str(record.data.get("name")), bool(record.data.get("value"))
        if name == LATCH and is_on:
            self.latched = dict(self.control.positions.work)
        elif self.measuring is not None and name in SIGNALS:
            self.measuring.hear(self, name, on=is_on)

    # ---- what it shows -------------------------------------------------------------------------------------

    @property
    def digits(self) -> int:
        """Decimals of lengths: four in inches."""
        return 4 if self.in_inches else 3

    @property
    def in_inches(self) -> bool:
        """Whether work positions and offsets are inches: as the program says; SINUMERIK's stay as the machine is."""
        return self.family.layout != "operate" and bool({"G20", "G70"} & set(self.control.modal.values()))

    def is_length(self, axis: str) -> bool:
        """Whether an axis counts lengths, not degrees."""
        channel = self.control.channel
        at = channel.axis_index.get(axis)
        return at is None or not channel.axis_data[at].rotary

    def unit_mm(self, axis: str) -> float:
        """Millimetres in the unit in which an axis is shown; 1 for degrees."""
        return INCH_MM if self.in_inches and self.is_length(axis) else 1.0

    def position_text(self, axis: str, kind: str, value: float) -> str:
        """A position of a kind as it is shown: the machine's own stay millimetres and degrees."""
        digits = self.digits if kind != "machine" and self.is_length(axis) else 3
        return f"{value:.{digits}f}"

    def positions(self, snapshot: Snapshot, kind: str) -> Mapping[str, float]:
        """Positions of a kind by axis: `work`, `machine`, `to_go`, `relative`, or `by_hand` while a program waits."""
        shown = snapshot.positions
        if kind == "relative":
            ways = {axis: at - self.origins.get(axis, 0.0) for axis, at in shown.machine.items()}
            return {axis: way / self.unit_mm(axis) for axis, way in ways.items()}
        if kind == "by_hand":
            left = self.control.restart
            return {axis: 0.0 - left[axis][1] if axis in left else 0.0 for axis in shown.machine}
        by_kind = {"work": shown.work, "machine": shown.machine, "to_go": shown.to_go}
        return by_kind[kind]

    def axis_label(self, axis: str, kind: str) -> str:
        """How an axis is called in a list of positions."""
        return axis if kind != "relative" or self.family.layout != "crt" else RELATIVE.get(axis, axis)

    def axis_of_relative(self, letter: str) -> str:
        """The axis that a letter of relative coordinates means."""
        named = {label: axis for axis, label in RELATIVE.items() if axis in self.control.positions.work}
        return letter if letter in self.control.positions.work else named.get(letter, letter)

    def seen(self, what: object) -> datetime:
        """When an alarm or a message came: the moment at which the screen has first had it."""
        return self._came.setdefault(str(what), self.clock())

    def _note_alarms(self) -> None:
        """Alarms and messages have the moment at which they came; those that have gone may come again."""
        shown = self.control.snapshot
        said = [(number, text) for number, each in shown.channels.items() for text in each.messages[-1:]]
        now = [str(each) for each in (*shown.alarms, *shown.notices, *said)]
        self._came = {each: self._came.get(each) or self.clock() for each in now}

    def follow(self) -> None:
        """Note alarms, and go on with what takes time; called while time passes."""
        if self.pending is not None:
            try:
                if not self.pending.goes_on(self):
                    self.finish()
            except UserError as refusal:
                self.refusal = refusal
                self.finish()
        self._note_alarms()
        if self.control.state is State.RUNNING and not self.in_background:
            self.program_row = None
