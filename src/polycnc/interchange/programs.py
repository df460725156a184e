"""Programs of a memory as files: a tape between `%`, an archive, or each as a file of its own; and back."""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.interchange.controls.kinds import ARCHIVE, TAPE
from polycnc.interchange.errors import InterchangeError, ReadingError
from polycnc.memory.retained import PROGRAMS
from polycnc.messages import text
from polycnc.program import Form, Program, ProgramStore, names, split_programs
from polycnc.program.archive import archive_of
from polycnc.program.split import Source
from polycnc.program.text import split_lines

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from polycnc.interchange.controls.kinds import Texts
    from polycnc.memory.retained import RetainedStore

_MACRO_HEADER = "%@MACRO"


def kept_programs(memory: RetainedStore) -> list[Program]:
    """The programs of a memory, in the order in which they came into it."""
    return [each for each in memory.table(PROGRAMS).values() if each is not None]


def is_tape(content: str) -> bool:
    """Whether a text holds programs with numbers or names, as `O0001` or `<NAME>`."""
    heading = (line.strip().removeprefix("%").lstrip().upper() for line in content.splitlines())
    return any((line[:1] in "O:" and line[1:2].isdigit()) or line[:1] == "<" for line in heading if line)


# ---- writing ---------------------------------------------------------------------------------------------------


def written(programs: Sequence[Program], texts: Texts) -> dict[str, str]:
    """The files of programs by name; none where there is no program.

    Raises:
        InterchangeError: A program cannot be written so that it is read again as it is.
    """
    if not programs:
        return {}
    if texts.programs == TAPE:
        found = {texts.program_file: _tape(programs)}
    elif texts.programs == ARCHIVE:
        found = {texts.program_file: archive_of(programs)}
    else:
        return {_file_name(each): _file_of(each) for each in programs}
    form = Form.SINUMERIK if texts.programs == ARCHIVE else Form.WORD_ADDRESS
    _check(programs, split_programs(split_lines(found[texts.program_file]), Source(""), form))
    return found


def _tape(programs: Sequence[Program]) -> str:
    lines = ["%"]
    for program in programs:
        if not (program.lines and is_tape(program.lines[0])):
            lines.append(program.name if program.number is not None else f"<{program.name.upper()}>")
        lines += program.lines
    return "".join(f"{line}\n" for line in (*lines, "%"))


def _file_of(program: Program) -> str:
    header = (_MACRO_HEADER,) if program.form is Form.MACRO else ()
    return "".join(f"{line}\n" for line in (*header, *program.lines))


def _file_name(program: Program) -> str:
    if program.directory or set(program.name) & set("/\\:") or program.name in (".", ".."):
        raise InterchangeError("memory.program-name", name=program.name)
    return program.name


def _check(programs: Sequence[Program], read: Sequence[Program]) -> None:
    """What cannot be read again as it is, is not written: a block that looks like the heading of another program."""
    for program, again in zip(programs, read, strict=False):
        lines = list(again.lines)
        lines = lines[len(lines) - len(program.lines) :] if len(lines) > len(program.lines) else lines
        if lines != list(program.lines):
            raise InterchangeError("memory.program-text", name=program.name)
    if len(programs) != len(read):
        raise InterchangeError("memory.program-text", name=programs[min(len(read), len(programs)) - 1].name)


# ---- reading ---------------------------------------------------------------------------------------------------


def of_tape(path: Path, content: str) -> list[Program]:
    """The programs of a tape.

    Raises:
        ReadingError: It is cut off, holds something without a name, or a name twice.
    """
    lines = split_lines(content)
    filled = [index for index, line in enumerate(lines) if line.strip()]
    if not lines[filled[0]].lstrip().startswith("%"):
        raise ReadingError(path, filled[0] + 1, 1, text("data.no-start"))
    if len(filled) < 2 or lines[filled[-1]].strip() != "%":
        raise ReadingError(path, filled[-1] + 1, 1, text("data.no-end"))
    programs = list(split_programs(lines, Source(path.name)))
    for program in programs:
        if program.number is None and not is_tape(program.lines[0]):
            raise ReadingError(path, program.first_line, 1, text("memory.no-name"))
    _check_names(path, programs)
    return programs


def of_file(path: Path, content: str, form: Form) -> list[Program]:
    """The programs of a file that has the name of the first one."""
    store = ProgramStore(form=form)
    store.add_text(path.name, content)
    return list(store)


def of_archive(path: Path, content: str) -> list[Program]:
    """The files of an archive; of a text without any heading the one that is named as its file is.

    Raises:
        ReadingError: A name comes twice.
    """
    programs = list(split_programs(split_lines(content), Source(path.name), Form.SINUMERIK))
    first = programs[0]
    if len(programs) == 1 and not first.name.startswith("_N_"):
        programs = of_file(path, content, Form.SINUMERIK)
    _check_names(path, programs)
    return [_without_path(each) for each in programs]


def _without_path(program: Program) -> Program:
    """A program without the line of the archive that says its directory: an archive of it says that again."""
    said = bool(program.lines) and "".join(program.lines[0].split()) == f";$PATH={program.directory}"
    return replace(program, lines=program.lines[1:], first_line=program.first_line + 1) if said else program


def _check_names(path: Path, programs: Sequence[Program]) -> None:
    known: set[tuple[str, str]] = set()
    for program in programs:
        key = program.directory, program.name.casefold()
        if key in known:
            raise ReadingError(path, program.first_line, 1, text("memory.name-twice", name=program.name))
        known.add(key)


def put(memory: RetainedStore, programs: Sequence[Program], form: Form) -> None:
    """Put programs into a memory, in the place of those with their names."""
    store = ProgramStore(form=form, edited=memory.table(PROGRAMS))
    for program in programs:
        placed = program
        if program.form is Form.SINUMERIK and not program.directory:
            placed = Program(
                program.name,
                program.lines,
                directory=names.default_directory(program.name),
                form=program.form,
            )
        store.replace(placed)


def lines_of(program: Program) -> str:
    """The text of a program."""
    return "".join(f"{line}\n" for line in program.lines)


def in_working_memory(program: Program, name: str) -> Program:
    """A program as an initialisation program of the working memory."""
    named = name if name.endswith("_INI") else f"{name}_INI"
    return Program(named, program.lines, directory=names.WORKING_MEMORY, form=Form.SINUMERIK)
