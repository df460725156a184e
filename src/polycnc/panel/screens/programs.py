"""What keys do with programs: words and blocks are changed, in the background too; MDI, teach-in."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused, Mode
from polycnc.messages import UserError
from polycnc.panel.screens.words import END

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.panel.screens.state import ScreenState

#: The number of a program.
_PROGRAM = regex(r"(?i)O\d{1,8}")
#: Numbers at which programs of a text begin.
_NUMBERS = regex(r"(?im)^\s*[O:](\d{1,8})")


def edit_words(screen: ScreenState, key: str) -> None:
    """INSERT, ALTER and DELETE of words in mode EDIT; the number of a program and INSERT begin a new one.

    ALTER of its number gives the program another one, which the memory must not have.

    Raises:
        CommandRefused: The mode is another one, nothing is keyed in, or the number is 0.
        UserError: The memory has that program.
    """
    typed = screen.buffer.strip()
    if not screen.page.edits or not (typed or key == "DELETE"):
        raise CommandRefused("screen.no-field")
    if not screen.edits:
        raise CommandRefused("screen.mode", mode=screen.family.modes[Mode.EDIT])
    if key != "DELETE" and _PROGRAM.fullmatch(typed) and not int(typed[1:]):
        raise CommandRefused("screen.value", value=typed)
    if key == "INSERT" and _PROGRAM.fullmatch(typed) and screen.in_background:
        edit_in_background(screen)
    elif key == "INSERT" and _PROGRAM.fullmatch(typed):
        _begin_program(screen, typed.upper(), f"{typed.upper()}\n")
    else:
        _change_program(screen, key, typed)
    screen.buffer = ""


def _begin_program(screen: ScreenState, name: str, text: str) -> None:
    """A program that the memory has not got yet becomes the main program; nothing is left of one that cannot."""
    control = screen.control
    with suppress(CommandRefused):
        control.program_lines(name)
        raise UserError("screen.program-exists", name=name)
    control.store_program(name, text)
    try:
        control.select_program(name)
    except CommandRefused:
        control.delete_program(name)
        raise
    screen.program_row, screen.program_word = 0, 0


def _change_program(screen: ScreenState, key: str, typed: str) -> None:
    control, edited = screen.control, screen.edited
    before = _NUMBERS.findall(edited.text)
    if key == "INSERT":
        edited.insert(typed)
    elif key == "ALTER":
        edited.alter(typed)
    elif typed == END:
        edited.delete_block()
    elif not typed:
        edited.delete()
    else:
        raise CommandRefused("screen.no-field")
    after = _NUMBERS.findall(edited.text)
    if [int(each) for each in after] == [int(each) for each in before]:
        control.store_program(screen.edited_program or "MAIN", edited.text)
        screen.program_row, screen.program_word = edited.place.row, edited.place.word
    elif (
        key == "ALTER"
        and _PROGRAM.fullmatch(typed)
        and len(before) == len(after) == 1
        and not screen.background
    ):
        former = control.program
        _begin_program(screen, typed.upper(), edited.text)
        control.delete_program(former)
    else:  # the number of a program is not lost, and no other program is overwritten
        raise CommandRefused("screen.no-field")


def insert_block(screen: ScreenState) -> None:
    """INPUT on a page that edits blocks: what has been keyed in is a new block behind the one at the cursor.

    Raises:
        CommandRefused: Nothing is keyed in, the program is under way, or edit protection is on.
    """
    typed = screen.buffer.replace(";", "").strip() if screen.family.layout == "crt" else screen.buffer.strip()
    if not typed:
        raise CommandRefused("screen.no-field")
    lines, row = list(screen.lines), screen.row
    lines.insert(row + 1, typed)
    _store_blocks(screen, lines, row + 1)


def delete_block(screen: ScreenState) -> None:
    """DELETE there, with nothing keyed in: the block at the cursor goes."""
    lines, row = list(screen.lines), screen.row
    if not lines:
        raise CommandRefused("screen.no-field")
    del lines[row]
    _store_blocks(screen, lines, row)


def _store_blocks(screen: ScreenState, lines: Sequence[str], row: int) -> None:
    """The main program has other blocks; its number stays, and no further one comes."""
    name, text = screen.control.program, "".join(f"{line}\n" for line in lines)
    numbers = (list(map(int, _NUMBERS.findall("\n".join(each)))) for each in (screen.lines, lines))
    if _PROGRAM.fullmatch(name) and next(numbers) != next(numbers):
        raise CommandRefused("screen.no-field")
    screen.control.store_program(name, text)
    screen.look_at(row)
    screen.buffer = ""


def teach(screen: ScreenState) -> None:
    """INSERT in teach-in: a block with what has been keyed in and the present position, behind the last one taught."""
    screen.control.teach(screen.buffer.strip())
    screen.buffer = ""


def insert(screen: ScreenState, _key: str = "INSERT") -> None:
    """INSERT on the MDI page: what has been keyed in is the next block."""
    if not screen.shows("mdi"):
        raise CommandRefused("screen.no-field")
    screen.mdi_text += screen.buffer.replace(";", "").strip() + "\n"
    screen.buffer = ""


def edit_in_background(screen: ScreenState) -> None:
    """BG-EDT: the program that is keyed in is edited while another one may run; a new one where the memory has none.

    Raises:
        CommandRefused: No number is keyed in, edit protection is on, or the program is under way.
    """
    name = screen.buffer.strip().upper()
    if not _PROGRAM.fullmatch(name):
        raise CommandRefused("screen.no-field")
    if not int(name[1:]):
        raise CommandRefused("screen.value", value=name)
    try:
        text = "\n".join(screen.control.program_lines(name)) + "\n"
    except CommandRefused:
        text = f"{name}\n"
    screen.control.store_program(name, text)  # refused where it may not be changed
    screen.show("program")
    screen.background, screen.program_word, screen.buffer = name, 0, ""
    screen.look_at(0)


def end_background(screen: ScreenState) -> None:
    """BG-END: the program in the background is in the memory; the page shows the main program again."""
    screen.background, screen.program_row, screen.buffer = "", None, ""


def erase_mdi(screen: ScreenState) -> None:
    """What has been typed in at MDI is erased."""
    screen.mdi_text = ""


EDITING: dict[str, Callable[[ScreenState], None]] = {
    "insert-block": insert_block,
    "delete-block": delete_block,
    "background-edit": edit_in_background,
    "background-end": end_background,
    "insert": insert,
    "teach": teach,
    "erase-mdi": erase_mdi,
}
