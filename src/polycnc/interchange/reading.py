"""Files into a memory: data as the control reads them, programs, setups. All of them, or nothing at all.

A data file of a control is a program (G10, assignments, initialisation programs): it is run at power-on, and the
control's own alarms tell what is wrong with it. A file that moves an axis is none. Programs come first, then data in
the order of the control's kinds, then setups: what one of them needs, as definitions of user data, is there before it.
"""

from __future__ import annotations

from pathlib import Path

from polycnc.control.data_files import DataFileError
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.interchange import programs, setups
from polycnc.interchange.controls.kinds import ARCHIVE, FILES, texts_of
from polycnc.interchange.errors import ReadingError
from polycnc.interchange.power_on import channel_on, run_on
from polycnc.memory.retained import PROGRAMS
from polycnc.messages import text
from polycnc.program import Form, decode
from polycnc.program.folders import read_file
from polycnc.program.names import WORKING_MEMORY, WORKPIECE, stored_name
from polycnc.toolpath.kinds import TYPE_NAMES, Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.interchange.controls.kinds import Texts
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import Alarm
    from polycnc.program import Program
    from polycnc.session import Result

SETUPS = (".yaml", ".yml", ".toml")
_MOVES = frozenset(TYPE_NAMES) - {TYPE_NAMES[Kind.EVENT]}
#: Types of SINUMERIK files that hold data of the working memory.
_DATA_TYPES = ("INI", "TEA", "SEA", "TOA", "UFR", "RPA", "GUD")


class Reading:
    """Takes files into a memory.

    Args:
        memory: The memory. Where something is refused it holds a part of the files: it must not be committed then.
        control: Id of its control.
        machine: Its machine, built-in or a file.
    """

    def __init__(self, memory: RetainedStore, control: str, machine: str | Path | None) -> None:
        self._memory = memory
        self._control = control
        self._machine = machine
        self._texts: Texts = texts_of(control)
        self.notes: list[str] = []
        """What of the files does not belong to a memory."""

    def take(self, files: Sequence[Path]) -> None:
        """Take files over.

        Raises:
            ReadingError: One of them is refused: file, line, column, reason.
            ProgramFileError: One cannot be read.
        """
        contents = {
            path: "" if _is_setup(path) else decode(read_file(str(path)), None).text for path in files
        }
        self.take_texts({path: content for path, content in contents.items() if not _is_setup(path)})
        for path in filter(_is_setup, files):
            self.notes += setups.take(self._memory, self._control, self._machine, path)

    def take_texts(self, contents: dict[Path, str]) -> None:
        """Take texts over, each with the name of its file; raises as `take`."""
        if self._texts.programs == ARCHIVE:
            self._take_archives(contents)
            return
        data: list[tuple[Path, str]] = []
        for path, content in contents.items():
            if not content.strip():
                raise ReadingError(path, 1, 1, text("memory.empty-file"))
            if self._texts.programs == FILES:
                if path.name.upper() in self._data_files:
                    data.append((path, content))
                else:
                    programs.put(
                        self._memory, programs.of_file(path, content, Form.WORD_ADDRESS), Form.WORD_ADDRESS
                    )
            elif programs.is_tape(content):
                programs.put(self._memory, programs.of_tape(path, content), Form.WORD_ADDRESS)
            else:
                data.append((path, content))
        for path, content in sorted(data, key=lambda each: self._place(each[0])):
            self._take_data(path, content)

    @property
    def _data_files(self) -> list[str]:
        return [kind.file for kind in self._texts.kinds.values()]

    def _place(self, path: Path) -> int:
        """The place of a file among the kinds of data; the last one where its name says nothing."""
        files = self._data_files
        return files.index(path.name.upper()) if path.name.upper() in files else len(files)

    # ---- word address ------------------------------------------------------------------------------------------

    def _take_data(self, path: Path, content: str) -> None:
        channel = channel_on(self._memory, self._control, self._machine)
        for read in self._texts.readers:
            try:
                left_out = read(channel, content)
                if left_out is not None:
                    self.notes += left_out
                    return
            except DataFileError as error:
                column = _column(content, error)
                raise ReadingError(path, error.line, column, error.text()) from None
        self._check(path, run_on(self._memory, self._control, self._machine, content.encode()), {})

    # ---- SINUMERIK ---------------------------------------------------------------------------------------------

    def _take_archives(self, contents: dict[Path, str]) -> None:
        data: list[tuple[Path, Program]] = []
        for path, content in contents.items():
            found = programs.of_archive(path, content)
            data += [(path, each) for each in found if _is_data(path, each)]
            programs.put(self._memory, [each for each in found if not _is_data(path, each)], Form.SINUMERIK)
        types = [Path(file).stem.rpartition("_")[2] for file in self._data_files]
        data.sort(key=lambda each: _type_place(types, each[1]))
        for path, program in data:
            self._take_initialisation(path, program)

    def _take_initialisation(self, path: Path, program: Program) -> None:
        """An initialisation program is run as the control does it at power-on: from the working memory."""
        name = stored_name(program.name)
        key = WORKING_MEMORY, name.casefold()
        table = self._memory.table(PROGRAMS)
        kept = table.get(key)
        store_program = programs.in_working_memory(program, name)
        table[key] = store_program
        try:
            result = run_on(self._memory, self._control, self._machine)
        finally:
            if kept is None:
                table.pop(key, None)
            else:
                table[key] = kept
        self._check(path, result, {name: program.first_line - 1})

    # ---- what a run has said -----------------------------------------------------------------------------------

    def _check(self, path: Path, result: Result, first_lines: dict[str, int]) -> None:
        """A run with an alarm, or with a move in it, is no reading of data."""
        for alarm in result.alarms:
            raise ReadingError(path, _line(alarm, first_lines), alarm.column, _told(result, alarm))
        for row in result.rows:
            if row["type"] in _MOVES:
                line = row["line"] + first_lines.get(row["program"], 0)
                raise ReadingError(path, line, 1, text("memory.moves"))


def _line(alarm: Alarm, first_lines: dict[str, int]) -> int:
    return alarm.line + first_lines.get(alarm.program, 0)


def _told(result: Result, alarm: Alarm) -> str:
    return f"{alarm.code} {result.alarm_text(alarm)}"


def _column(content: str, error: DataFileError) -> int:
    """Where in its line stands what is wrong, as far as the reason names it."""
    lines = content.splitlines()
    line = lines[error.line - 1].upper() if 0 < error.line <= len(lines) else ""
    named: Iterable[object] = error.args_by_name.values()
    return max((line.find(str(each).upper()) + 1 for each in named if str(each)), default=1)


def _is_setup(path: Path) -> bool:
    return path.suffix.lower() in SETUPS


def _is_data(path: Path, program: Program) -> bool:
    """Whether a file is data of the working memory; in the directory of a workpiece it is a file of the workpiece."""
    if program.directory.endswith(WORKPIECE):
        return False
    name = program.name if program.name.startswith("_N_") else stored_name(path.name)
    return name.rpartition("_")[2] in _DATA_TYPES


def _type_place(types: list[str], program: Program) -> int:
    """The place of a data file by the type that its name says: `_N_COMPLETE_TOA_INI` has tools."""
    said = [part for part in program.name.split("_") if part in types]
    return types.index(said[0]) if said else len(types)
