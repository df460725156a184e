"""What soft keys and keys of the MDI unit do with the key-in buffer: set, add, search, measure, select, delete."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from polycnc.control.fanuc.lathe.tools import screens as lathe
from polycnc.control.fanuc.lathe.tools.screens import Page
from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.mainrun import CommandRefused, Mode
from polycnc.panel.keyed import number_of, whole_number_of
from polycnc.panel.screens import forms
from polycnc.panel.screens.programs import EDITING
from polycnc.panel.screens.sources import SOURCES
from polycnc.panel.screens.state import PARAMETER_WRITE, Operation
from polycnc.panel.screens.tables import Table
from polycnc.panel.screens.transfer import Transfer, begin_transfer

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.mainrun.preparation.items import Places
    from polycnc.panel.screens.pages import Column
    from polycnc.panel.screens.state import ScreenState

Action: TypeAlias = Callable[["ScreenState"], None]

#: An axis with a value behind it, which may be missing; a name with a number wants an equals sign (`Q1=5`).
_AXIS_VALUE = regex(r"(?P<axis>[A-Z]+\d+(?==)|[A-Z])\s*=?\s*(?P<value>[+-]?[0-9]*\.?[0-9]*)")


def _number(screen: ScreenState) -> float:
    """The number that has been keyed in.

    Raises:
        CommandRefused: It is none.
    """
    return number_of(screen.buffer)


def _numbers(screen: ScreenState) -> list[float]:
    """The numbers that have been keyed in, `;` between them; raises `CommandRefused` where one is none."""
    return [number_of(part) for part in screen.buffer.rstrip("; ").split(";")]


def _field(screen: ScreenState) -> tuple[Table, Column, int]:
    spec = screen.table
    if spec is None:
        raise CommandRefused("screen.no-field")
    row, at = screen.cursor
    if at >= len(spec.columns):
        raise CommandRefused("screen.no-field")
    return Table(screen.control, spec, screen.latched), spec.columns[at], row


def set_value(screen: ScreenState) -> None:
    """INPUT: the field at the cursor has the value; a parameter likewise.

    Several values with `;` between them go into consecutive rows; those in front of one that is refused are set
    (0i-TF Plus III.2.1.1).
    """
    if screen.shows("switches"):
        set_switch(screen)
    elif screen.shows("parameters"):
        if screen.needs_parameter_write and not screen.writes_parameters:
            raise CommandRefused("screen.write-protected")
        number, _ = screen.parameters[screen.cursor[0]]
        screen.control.write_parameter(number, _number(screen))
    else:
        table, column, row = _field(screen)
        is_text = isinstance(table.value(column, row), str)
        if is_text:
            table.write(column, row, screen.buffer)
        else:
            for place, value in enumerate(_numbers(screen)):
                table.write(column, row + place, value)
    screen.buffer = ""


def _switch_at(screen: ScreenState) -> str:
    switches = screen.panel_switches
    return switches[min(screen.cursor[0], len(switches) - 1)]


def set_switch(screen: ScreenState) -> None:
    """INPUT on the setting page: PARAMETER WRITE by 1 or 0; the other rows are switches of the machine panel."""
    name = _switch_at(screen)
    value = _number(screen)
    if name != PARAMETER_WRITE:
        raise CommandRefused("screen.no-field")
    if value not in (0.0, 1.0):
        raise CommandRefused("screen.value", value=f"{value:g}")
    screen.writes_parameters = bool(value)


def turn_switch(screen: ScreenState) -> None:
    """SELECT on the page of program control: the switch at the cursor turns over (SINUMERIK)."""
    name = _switch_at(screen)
    if name == PARAMETER_WRITE:
        write_enable(screen)
    else:
        screen.control.set_switches(**{name: not screen.switch(name)})


def add_value(screen: ScreenState) -> None:
    """+INPUT: the value is added to that of the field at the cursor."""
    table, column, row = _field(screen)
    table.write(column, row, table.number(column, row) + _number(screen))
    screen.buffer = ""


def search_number(screen: ScreenState) -> None:
    """NO.SRH: the cursor goes to the number that has been keyed in."""
    wanted = whole_number_of(screen.buffer)
    if screen.shows("parameters"):
        found = [
            i for i, (_, each) in enumerate(screen.parameters) if each.number.split("#")[0] == str(wanted)
        ]
        if not found:
            raise CommandRefused("screen.no-field")
        screen.place(found[0], 0)
    else:
        table, _, _ = _field(screen)
        if wanted not in table.numbers or not table.exists(wanted):
            raise CommandRefused("screen.no-field")
        screen.place(wanted, screen.cursor[1])
    screen.buffer = ""


def _axis_field(screen: ScreenState) -> tuple[Table, Column, int, str]:
    """The field of the axis that has been keyed in, in the row of the cursor; and what was typed behind it."""
    match = _AXIS_VALUE.fullmatch(screen.buffer.strip().upper())
    table, _, row = _field(screen)
    axis = match["axis"] if match else ""
    column = next((each for each in table.spec.columns if each.axis and each.axis == axis), None)
    if match is None or column is None:
        raise CommandRefused("screen.no-axis", typed=screen.buffer)
    return table, column, row, match["value"]


def measure(screen: ScreenState) -> None:
    """MEASURE: the offset with which the axis reads the measured value (0i-TF Plus III.2.1.2)."""
    _, column, row, typed = _axis_field(screen)
    SOURCES[column.source].measure(screen.control, column, row, number_of(typed), screen.latched)
    screen.buffer = ""


def counter_input(screen: ScreenState) -> None:
    """INP.C.: the offset is the relative coordinate, on the page that is shown alone (III.2.1.4)."""
    table, column, row, _ = _axis_field(screen)
    relative = screen.positions(screen.control.snapshot, "relative").get(column.axis)
    if relative is None:
        raise CommandRefused("screen.no-axis", typed=column.axis)
    table.write(column, row, relative)
    screen.buffer = ""


def set_here(screen: ScreenState) -> None:
    """SET: the field at the cursor is where the axis stands."""
    _, column, row = _field(screen)
    SOURCES[column.source].here(screen.control, column, row)


def restore(screen: ScreenState) -> None:
    """The row at the cursor has its delivered values again."""
    table, _, row = _field(screen)
    for column in table.spec.columns:
        SOURCES[column.source].restore(screen.control, column, row)


def restore_all(screen: ScreenState) -> None:
    """All rows have their delivered values again."""
    table, _, _ = _field(screen)
    for row in table.numbers:
        for column in table.spec.columns:
            SOURCES[column.source].restore(screen.control, column, row)


def origin(screen: ScreenState) -> None:
    """ORIGIN: the relative coordinate of the axis that is keyed in becomes 0, or what is keyed in behind it."""
    snapshot = screen.control.snapshot
    typed = screen.buffer.strip().upper()
    match = _AXIS_VALUE.fullmatch(typed)
    axes = [match["axis"]] if match else list(snapshot.positions.work) if not typed else []
    axes = [screen.axis_of_relative(axis) for axis in axes]
    if not axes or any(axis not in snapshot.positions.work for axis in axes):
        raise CommandRefused("screen.no-axis", typed=screen.buffer)
    value = number_of(match["value"]) if match and match["value"] else 0.0
    for axis in axes:
        screen.origins[axis] = snapshot.positions.machine[axis] - value * screen.unit_mm(axis)
    screen.buffer = ""


def clear(screen: ScreenState) -> None:
    """CLEAR: all fields of the page become 0."""
    table, _, _ = _field(screen)
    for row in table.numbers:
        for column in table.spec.columns:
            if table.exists(row) and table.number(column, row):
                table.write(column, row, 0.0)


def search_program(screen: ScreenState) -> None:
    """O SEARCH: the program that has been keyed in, or the one at the cursor, becomes the main program."""
    name = screen.buffer.strip()
    if not name and screen.shows("listing") and screen.control.programs:
        name = screen.control.programs[screen.cursor[0]].name
    if screen.in_background:
        screen.control.program_lines(name)
        screen.background, screen.program_word = name, 0
        screen.look_at(0)
    else:
        screen.control.select_program(name)
        screen.program_row = None
    screen.buffer = ""


def delete_program(screen: ScreenState) -> None:
    """DELETE: the program that has been keyed in, or the one at the cursor, leaves the memory.

    Raises:
        CommandRefused: There is none, or the control does this in another mode (EDIT on FANUC; Hartford 5.2.4.2 h).
    """
    wanted, control = screen.family.data_mode, screen.control
    free = screen.in_background or control.signals["EDIT_PROTECT"]  # protection is told first
    if wanted and control.mode is not Mode(wanted) and not free:
        raise CommandRefused("screen.mode", mode=screen.family.modes[wanted])
    name = screen.buffer.strip()
    if not name and screen.shows("listing") and screen.control.programs:
        name = screen.control.programs[screen.cursor[0]].name
    screen.control.delete_program(name)
    screen.buffer = ""


def search_block(screen: ScreenState) -> None:
    """Block search: cycle start goes on at the block number or line that has been keyed in, or at the cursor."""
    typed = screen.buffer.strip()
    if not typed and screen.at_interruption:
        target: int | str | Places = screen.control.snapshot.interrupted
    elif not typed and screen.program_row is not None:
        target = screen.control.first_line(screen.control.program) + screen.program_row
    else:
        target = int(typed) if typed.isascii() and typed.isdigit() else typed
    screen.control.block_search(target, how=screen.search_mode)
    screen.program_row, screen.buffer = None, ""


def search_interruption(screen: ScreenState) -> None:
    """The cursor goes to the block at which the program was given up; in a subprogram, to the block that called it.

    A search from there goes on in the subprogram.
    """
    control = screen.control
    line = control.snapshot.interruption
    if not line:
        raise CommandRefused("screen.no-interruption")
    screen.look_at(line - control.first_line(control.program))
    screen.at_interruption = True


def preset(screen: ScreenState) -> None:
    """PRESET: the axis that is keyed in shows the value behind it where it stands, in mode JOG."""
    match = _AXIS_VALUE.fullmatch(screen.buffer.strip().upper())
    if match is None or not match["value"]:
        raise CommandRefused("screen.no-axis", typed=screen.buffer)
    screen.control.preset(match["axis"], number_of(match["value"]))
    screen.buffer = ""


def search_text(screen: ScreenState) -> None:
    """The cursor goes to the next block with the text that has been keyed in."""
    screen.find(screen.buffer, 1)


def to_top(screen: ScreenState) -> None:
    """The cursor goes to the first block of the program; what has been searched is given up."""
    screen.look_at(0)


#: A number behind a sign, and the operators between numbers.
_TERM = regex(r"\s*([+-]?[0-9]*\.?[0-9]+|[+-]?[0-9]+\.)\s*")


def calculate(screen: ScreenState) -> None:
    """CALC: what has been keyed in becomes its result; products and quotients first, then sums (MELDAS)."""
    sums, at, operator = [0.0], 0, "+"
    while True:
        term = _TERM.match(screen.buffer, at)
        if term is None or (operator == "/" and not float(term[1])):
            raise CommandRefused("screen.no-number", typed=screen.buffer)
        value, at = float(term[1]), term.end()
        if operator == "*":
            sums[-1] *= value
        elif operator == "/":
            sums[-1] /= value
        else:
            sums.append(-value if operator == "-" else value)
        if at == len(screen.buffer):
            break
        operator, at = screen.buffer[at], at + 1
        if operator not in "+-*/":
            raise CommandRefused("screen.no-number", typed=screen.buffer)
    screen.buffer = f"{sum(sums):.6f}".rstrip("0")


def write_enable(screen: ScreenState) -> None:
    """PARAMETER WRITE: parameters may be written, or no more."""
    screen.writes_parameters = not screen.writes_parameters


@dataclass
class Clearing(Operation):
    """CLEAR with ALL, WEAR or GEOM, which waits for [EXEC] on displays with keys at the side (III.2.1.8)."""

    change: Callable[[Channel], object]
    back: str

    @property
    def keys(self) -> str:
        """[CAN] and [EXEC]."""
        return "exec"

    def execute(self, screen: ScreenState) -> bool:
        """Clear."""
        screen.control.change(self.change)
        return True


def clear_axes(screen: ScreenState, chosen: Sequence[Page]) -> None:
    """CLEAR with ALL, WEAR or GEOM: the offsets of the page's axes become 0 in all numbers (0i-TF Plus III.2.1.8)."""
    table, _, _ = _field(screen)
    axes = [column.axis for column in table.spec.columns]
    clearing = Clearing(partial(lathe.clear_offsets, chosen=chosen, fields=axes), back=screen.page.menu)
    if screen.side_rows:
        screen.pending = clearing
    else:
        clearing.execute(screen)


def switch_page(screen: ScreenState) -> None:
    """SWITCH: the other page of a pair, with the same soft keys; the cursor stays at its number."""
    menu, (row, _) = (screen.menu, screen.turned), screen.cursor
    screen.show(screen.page.other)
    screen.menu, screen.turned = menu
    screen.place(row, screen.cursor[1])


def note_maintenance(screen: ScreenState) -> None:
    """DONE: the maintenance task at the cursor has been done."""
    tasks = screen.family.tasks
    screen.maintain(tasks[min(screen.cursor[0], len(tasks) - 1)].number)


def read_file(screen: ScreenState) -> None:
    """READ: a file of the card is to be taken over."""
    begin_transfer(screen, writes=False)


def punch_file(screen: ScreenState) -> None:
    """PUNCH: the data of the page are to be written on the card."""
    begin_transfer(screen, writes=True)


def name_file(screen: ScreenState) -> None:
    """F NAME: what has been keyed in is the name of the file."""
    if isinstance(screen.pending, Transfer):
        screen.pending.file = screen.buffer.strip()
        screen.buffer = ""


def execute(screen: ScreenState) -> None:
    """EXEC: what has been chosen is done, or begins."""
    if screen.pending is not None and screen.pending.execute(screen):
        screen.finish()


def cancel(screen: ScreenState) -> None:
    """CAN: what has been chosen, or goes on, is given up."""
    screen.finish()


def run_from_card(screen: ScreenState) -> None:
    """DNC-ST: the file that is keyed in, or the one at the cursor, is what mode DNC (TAPE) runs."""
    files = screen.card.files
    name = screen.buffer.strip() or (files[min(screen.cursor[0], len(files) - 1)][0] if files else "")
    path = screen.card.path(name)
    if not path.is_file():
        raise CommandRefused("screen.no-file", name=name)
    screen.control.load_tape(path)
    screen.buffer = ""


def clear_history(screen: ScreenState) -> None:
    """The alarm history begins anew."""
    screen.control.clear_alarm_history()


ACTIONS: dict[str, Action] = {
    **EDITING,
    "set": set_value,
    "add": add_value,
    "search-number": search_number,
    "measure": measure,
    "set-here": set_here,
    "counter-input": counter_input,
    "restore": restore,
    "restore-all": restore_all,
    "origin": origin,
    "clear": clear,
    "search-program": search_program,
    "delete-program": delete_program,
    "search-block": search_block,
    "search-interruption": search_interruption,
    "search-text": search_text,
    "preset": preset,
    "to-top": to_top,
    "write-enable": write_enable,
    "clear-history": clear_history,
    "clear-all": partial(clear_axes, chosen=(Page.WEAR, Page.GEOMETRY)),
    "clear-wear": partial(clear_axes, chosen=(Page.WEAR,)),
    "clear-geometry": partial(clear_axes, chosen=(Page.GEOMETRY,)),
    "switch-page": switch_page,
    "note-maintenance": note_maintenance,
    "read": read_file,
    "punch": punch_file,
    "file-name": name_file,
    "execute": execute,
    "cancel": cancel,
    "run-from-card": run_from_card,
    "open-cycle": forms.open_cycle,
    "insert-call": forms.insert_call,
    "enter": forms.enter,
    "toggle": forms.toggle,
    "turn-switch": turn_switch,
    "acknowledge": forms.acknowledge,
    "go-to-step": forms.go_to_step,
}
