"""Data between a control and its memory card: READ, PUNCH, ALL IO (0i-TF Plus III.1.1, III.1.2).

An operation is chosen first ([READ], [PUNCH]) and begun by [EXEC]. A transfer takes its time; INPUT or OUTPUT blinks so
long, and [CAN] gives it up before anything has been changed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

from polycnc.control.data_files import data_files
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.mainrun import CommandRefused, Mode
from polycnc.panel.screens.state import Operation

if TYPE_CHECKING:
    from polycnc.control.data_files import DataFiles
    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.state import ScreenState

#: What a transfer takes, in simulated time. The manual says nothing; a card is about as quick.
CHARACTERS_PER_S = 2000.0


class Data(ABC):
    """Data that can be transferred."""

    @abstractmethod
    def file(self, screen: ScreenState) -> str:
        """The name of the file where none is keyed in."""

    @abstractmethod
    def text(self, screen: ScreenState) -> str:
        """What is written."""

    @abstractmethod
    def take(self, screen: ScreenState, content: str, file: str) -> None:
        """Take over what was read, all of it or nothing."""


class DataFile(Data):
    """A data file of the control (`control.data_files`)."""

    def __init__(self, kind: str) -> None:
        self._kind = kind

    def file(self, screen: ScreenState) -> str:
        """The control's own name for it."""
        return _files(screen.control).KINDS[self._kind]

    def text(self, screen: ScreenState) -> str:
        """As the control punches it."""
        return _files(screen.control).write(screen.control.channel, self._kind)

    def take(self, screen: ScreenState, content: str, file: str) -> None:
        """What the file names is overwritten, everything else stays."""
        files = _files(screen.control)
        screen.control.change(lambda channel: cast("object", files.read(channel, content)))


class ProgramText(Data):
    """Programs: the one at the cursor of a listing, or the main program, is written; all of a file are read."""

    def file(self, screen: ScreenState) -> str:
        """The name of the program."""
        return self._name(screen) or "ALL-PROG.TXT"

    def text(self, screen: ScreenState) -> str:
        """The program between two `%`."""
        name = self._name(screen)
        if not name:
            raise CommandRefused("mainrun.no-program")
        return "%\n" + "".join(f"{line}\n" for line in screen.control.program_lines(name)) + "%\n"

    def take(self, screen: ScreenState, content: str, file: str) -> None:
        """The programs come into the memory."""
        screen.control.store_program(file.partition(".")[0], content)

    def _name(self, screen: ScreenState) -> str:
        programs = screen.control.programs
        if screen.shows("listing") and programs:
            return programs[min(screen.cursor[0], len(programs) - 1)].name
        return screen.control.program


def _files(control: VirtualControl) -> DataFiles:
    found = data_files(control.control)
    if found is None:
        raise CommandRefused("screen.no-field")
    return found


def data_of(kind: str) -> Data:
    """The data of a page by their name; raises `CommandRefused` for a page that has none."""
    if not kind:
        raise CommandRefused("screen.no-field")
    return ProgramText() if kind == "program" else DataFile(kind)


# ---- the transfer --------------------------------------------------------------------------------------------------


@dataclass
class Transfer(Operation):
    """Reading or writing a file of the card."""

    data: Data
    writes: bool
    back: str
    file: str = ""
    content: str = ""
    done_at: float | None = None

    @property
    def status(self) -> str:
        """INPUT or OUTPUT, from [EXEC] on."""
        return "" if self.done_at is None else "OUTPUT" if self.writes else "INPUT"

    def execute(self, screen: ScreenState) -> bool:
        """Open the file; the time that the transfer takes begins."""
        if self.done_at is not None:
            return False
        self.file = screen.buffer.strip() or self.file or self.data.file(screen)
        screen.card.path(self.file)
        self.content = self.data.text(screen) if self.writes else screen.card.read(self.file)
        screen.buffer = ""
        self.done_at = screen.control.time + len(self.content) / CHARACTERS_PER_S
        return False

    def goes_on(self, screen: ScreenState) -> bool:
        """What has been read is taken over at the end, all of it or nothing."""
        if self.done_at is None or screen.control.time < self.done_at:
            return True
        if self.writes:
            screen.card.write(self.file, self.content)
        else:
            self.data.take(screen, self.content, self.file)
        return False


def begin_transfer(screen: ScreenState, *, writes: bool) -> None:
    """[READ] or [PUNCH]: the file name may be keyed in now; [EXEC] begins.

    Raises:
        CommandRefused: The page has no such data, or the control is not in the mode for it (EDIT on FANUC).
    """
    data = data_of(screen.page.data)
    wanted = screen.family.data_mode
    if wanted and screen.control.mode is not Mode(wanted):
        raise CommandRefused("screen.mode", mode=screen.family.modes.get(wanted, wanted))
    screen.pending = Transfer(data, writes, back=screen.menu)
