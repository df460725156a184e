"""SINUMERIK's forms: user cycles and their calls, dialogs of the program, the step view of the editor."""

from __future__ import annotations

from contextlib import suppress

from polycnc.control.sinumerik.variables import dialogs
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.mainrun import CommandRefused, State
from polycnc.messages import text
from polycnc.panel.screens.masks import Mask, filled, masks_of, overview_of
from polycnc.panel.screens.view import Cell

if TYPE_CHECKING:
    from polycnc.panel.screens.masks import MaskField, MaskInput
    from polycnc.panel.screens.state import ScreenState

Rows: TypeAlias = tuple[tuple[Cell, ...], ...]

#: The cycle overview and the call descriptions, by the directory that counts first (job planning 1.25.4).
OVERVIEW, CALLS = "COV.COM", "UC.COM"
_PAGE, _CALL = "dialog", "cycle-call"
#: A structuring instruction with its name and level.
_STEP = regex(r"(?i)^\s*(?:/\d?\s*)?(?:N\d+\s*)?SEFORM\s*\(\s*(.+?)\s*,\s*(\d+)\s*,")


# ---- user cycles -------------------------------------------------------------------------------------------------


def _lines(screen: ScreenState, name: str) -> tuple[str, ...]:
    """The lines of a file; none where the memory has no such file."""
    try:
        return tuple(screen.control.program_lines(name))
    except CommandRefused:
        return ()


def _cycles(screen: ScreenState) -> tuple[Mask, ...]:
    """The cycles of the overview, each with the fields of its call; those too that only the descriptions have."""
    if screen.listed is None:
        screen.listed = tuple(_read_cycles(screen))
    return screen.listed


def _read_cycles(screen: ScreenState) -> list[Mask]:
    described = masks_of(_lines(screen, CALLS))
    by_number = {each.number: each for each in described}
    listed = overview_of(_lines(screen, OVERVIEW))
    numbers = {each.number for each in listed}
    full = [
        Mask(
            each.number,
            each.name,
            each.comment,
            by_number[each.number].fields if each.number in by_number else (),
        )
        for each in listed
    ]
    return full + [each for each in described if each.number not in numbers]


def cycles(screen: ScreenState, shown: int) -> Rows:
    """The overview of the user's cycles; the cursor chooses one."""
    found = _cycles(screen)
    row = screen.place(max(0, min(screen.cursor[0], len(found) - 1)), 0)
    first = row // shown * shown
    return tuple(
        (
            Cell(f"C{each.number}", "label"),
            Cell(each.name, "value", cursor=place == row),
            Cell(each.comment, "label"),
        )
        for place, each in enumerate(found[first : first + shown], first)
    )


def open_cycle(screen: ScreenState) -> None:
    """The mask of the cycle at the cursor."""
    found = _cycles(screen)
    if not found:
        raise CommandRefused("screen.no-file", name=OVERVIEW)
    screen.mask = filled(found[min(screen.cursor[0], len(found) - 1)])
    screen.show(_CALL)
    screen.place(0, 0)


def insert_call(screen: ScreenState) -> None:
    """OK: the call comes into the program, behind the block at the cursor."""
    if screen.mask is None:
        raise CommandRefused("screen.no-field")
    name, lines, _ = screen.shown_program
    if not name:
        raise CommandRefused("mainrun.no-program")
    at = (screen.program_row if screen.program_row is not None else screen.running_row) + 1
    changed = [*lines[:at], screen.mask.call, *lines[at:]]
    screen.control.store_program(name, "\n".join(changed) + "\n")
    screen.mask = None
    screen.show("program")
    screen.look_at(at)


# ---- masks -------------------------------------------------------------------------------------------------------


def mask(screen: ScreenState, shown: int) -> Rows:
    """The fields of the mask that is filled in."""
    form = screen.mask
    if form is None:
        return ()
    row = screen.place(max(0, min(screen.cursor[0], len(form.mask.fields) - 1)), 0)
    first = row // shown * shown
    head = (Cell(form.mask.name, "label"), Cell(form.mask.comment, "label"))
    fields = tuple(
        (Cell(each.label, "label"), Cell(_shown(screen, form, place, each), "value", cursor=place == row))
        for place, each in enumerate(form.mask.fields[first : first + shown], first)
    )
    return (head, *fields)


def _shown(screen: ScreenState, form: MaskInput, place: int, each: MaskField) -> str:
    if each.variable:
        with suppress(KeyError, ValueError):
            value = screen.control.read_variable(each.variable)
            if value is not None:
                return f"{value:.10g}" if isinstance(value, float) else str(value)
    return form.values[place]


def enter(screen: ScreenState) -> None:
    """INPUT: the field of the mask at the cursor has what was keyed in."""
    if screen.mask is None:
        raise CommandRefused("screen.no-field")
    row = screen.cursor[0]
    _write(screen, screen.mask.enter(row, screen.buffer), row)
    screen.buffer = ""


def toggle(screen: ScreenState) -> None:
    """SELECT: the next value that the field of the mask at the cursor offers."""
    if screen.mask is None:
        raise CommandRefused("screen.no-field")
    row = screen.cursor[0]
    _write(screen, screen.mask.toggle(row), row)


def _write(screen: ScreenState, which: MaskField, row: int) -> None:
    """A field that names a variable writes it."""
    if which.variable and screen.mask is not None:
        typed = screen.mask.values[row]
        is_number = which.kind in ("R", "I")
        screen.control.write_variable(which.variable, float(typed or 0.0) if is_number else typed)


# ---- dialogs of the program --------------------------------------------------------------------------------------


def dialog(screen: ScreenState, lang: str) -> Rows:
    """What stands above the fields of a dialog: file and name, its texts, how it is acknowledged."""
    said = dialogs.shown(screen.control.channel)
    if said is None:
        return ()
    rows = [(Cell(said.file, "label"), Cell(said.picture, "value"))]
    if said.graphic:
        rows.append((Cell("", "label"), Cell(said.graphic, "label")))
    for name in said.texts:
        value: object = None
        with suppress(KeyError, ValueError):
            value = screen.control.read_variable(name)
        rows.append((Cell(name, "label"), Cell("" if value is None else str(value), "value")))
    if screen.mask is None:
        rows.append((Cell("", "note"), Cell(text("screen.no-dialog-file", lang, name=said.file), "note")))
    if said.acknowledged != dialogs.NONE:
        rows.append((Cell("", "note"), Cell(text("screen.acknowledge", lang), "note")))
    return tuple(rows)


def follow_dialog(screen: ScreenState) -> None:
    """A dialog that a program shows comes upon the screen; where it goes, what was there before comes back."""
    control = screen.control
    said = dialogs.shown(control.channel) if _PAGE in screen.family.pages else None
    if said is screen.dialog:
        seconds = said.seconds if said is not None and said.acknowledged != dialogs.SYNCHRONOUS else None
        if seconds is not None and control.snapshot.time - screen.dialog_since >= seconds:
            control.change(lambda channel: dialogs.show(channel, None), protected=False)
        return
    if screen.dialog is None:
        screen.behind_dialog = screen.page.id
    screen.dialog, screen.dialog_since = said, control.snapshot.time
    if said is None:
        screen.mask = None
        if screen.page.id == _PAGE:
            screen.show(screen.behind_dialog)
        return
    masks = masks_of(_lines(screen, said.file))
    found = next((each for each in masks if each.name.casefold() == said.picture.casefold()), None)
    screen.mask = filled(found) if found is not None else None
    screen.show(_PAGE)
    screen.place(0, 0)


def acknowledge(screen: ScreenState) -> None:
    """OK: a program that waits for it goes on; the variable of the dialog is set; the dialog goes."""
    control, said = screen.control, screen.dialog
    if said is None or said.acknowledged == dialogs.NONE:
        raise CommandRefused("screen.no-acknowledge")
    if said.time and said.seconds is None:
        control.write_variable(said.time, 1)
    control.change(lambda channel: dialogs.show(channel, None), protected=False)
    if control.state is State.STOPPED and control.halt == dialogs.STOP:
        control.cycle_start()
    follow_dialog(screen)


# ---- the step view -----------------------------------------------------------------------------------------------


def _steps(screen: ScreenState) -> tuple[tuple[int, int, str], ...]:
    """Sections of the program: row, level, name as the program writes it, without quotes; looked for once."""
    _, lines, _ = screen.shown_program
    if screen.sections[0] is not lines:
        found = ((row, _STEP.match(line)) for row, line in enumerate(lines) if "(" in line)
        there = tuple((row, int(step[2]), step[1].strip('"')) for row, step in found if step is not None)
        screen.sections = lines, there
    return screen.sections[1]


def steps(screen: ScreenState, shown: int) -> Rows:
    """Sections of the main program by level (SEFORM, job planning 2.3); the one that runs is marked."""
    found = _steps(screen)
    now = dialogs.section(screen.control.channel)
    row = screen.place(max(0, min(screen.cursor[0], len(found) - 1)), 0)
    first = row // shown * shown
    head = ((Cell("▶", "label"), Cell(now, "active")),) if now else ()
    return head + tuple(
        (
            Cell(str(line + 1), "label"),
            Cell("    " * level + name, "active" if name == now else "code", cursor=place == row),
        )
        for place, (line, level, name) in enumerate(found[first : first + shown], first)
    )


def go_to_step(screen: ScreenState) -> None:
    """The cursor of the program goes to the section."""
    found = _steps(screen)
    if not found:
        raise CommandRefused("screen.not-found", text="SEFORM")
    line = found[min(screen.cursor[0], len(found) - 1)][0]
    screen.show("program")
    screen.look_at(line)
