"""From the lines of a file to its programs.

Only line starts matter: a program number in a comment or behind other words starts nothing. The first
characters of all lines are looked at once, the rest only of lines that can be a heading; a file of a million
blocks costs little more than its list of lines.
"""

from __future__ import annotations

import re
from itertools import compress, count, pairwise, takewhile
from operator import itemgetter
from typing import TYPE_CHECKING

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.regexes import regex
from polycnc.program.long_text import HEADING_STARTS, LongText
from polycnc.program.names import default_directory, program_name, stored_directory, stored_name
from polycnc.program.program import Form, Program

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

_FIRST_SIGN = itemgetter(slice(1))
#: Digits that the number of a program may have.
_MOST_DIGITS = 9
_NAME = regex(r"\s*(?:%\s*)?<([A-Za-z0-9+\-_.]{1,32})>")
_BLOCK = regex(r"\s*(?:/\d?\s*)?(?:[A-Za-z]\s*[-+.\d#\[]|[#@]|[A-Za-z]+\s*[\[=])")
"""A line with a word, an assignment or a macro statement; the label in front of a tape has none."""

_ARCHIVE_HEADER = regex(r"\s*%\s*(_N_\w+)\s*$", re.IGNORECASE)
_COMMENT_HEADER = regex(r"\s*;\s*%\s*(_N_\w+)\s*$", re.IGNORECASE)
_PATH_HEADER = regex(r"\s*;\s*\$PATH\s*=\s*(/[\w./]+)", re.IGNORECASE)
_CHANNEL = regex(r"\s*\$([1-9])\s*(?:;.*|//.*|\(.*)?$")

_HEADER_LINES = 10
"""A comment header stands among the first lines of its file."""


@dataclass(frozen=True, slots=True)
class Source:
    """What all programs of one file have in common; `name` is that of the file."""

    name: str
    path: str = ""
    encoding: str = "utf-8"
    replaced: int = 0


def split_programs(
    lines: Sequence[str], source: Source, default: Form = Form.WORD_ADDRESS
) -> tuple[Program, ...]:
    """All programs of a file in their order; a file without any heading is one program, even an empty file.

    Args:
        lines: The lines of the file.
        source: Name and origin of the file.
        default: Form of a file whose own headings do not tell.
    """
    headings = list(_possible_headings(lines))
    form = form_of(lines, headings, default)
    if form is Form.MACRO:
        return (_macro_program(lines, headings, source),)
    split = _archive_programs if form is Form.SINUMERIK else _tape_programs
    return tuple(split(lines, headings, source))


def form_of(lines: Sequence[str], headings: Iterable[int], default: Form) -> Form:
    """The form that the headings of a file show, else `default`; `headings` are the lines that can be one."""
    if macro_header(lines) is not None:
        return Form.MACRO
    top = lines[:_HEADER_LINES]
    comments = [line for line in top if line.lstrip().startswith(";")]
    if any(_COMMENT_HEADER.match(line) or _PATH_HEADER.match(line) for line in comments):
        return Form.SINUMERIK
    if any("_" in lines[index] and _ARCHIVE_HEADER.match(lines[index]) for index in headings):
        return Form.SINUMERIK
    return default


def macro_header(lines: Sequence[str]) -> int | None:
    """Index of the SYNTEC header `%@MACRO`; blanks in it and a comment behind it are allowed."""
    first = next((index for index, line in enumerate(lines) if line.strip()), None)
    if first is None:
        return None
    text = "".join(lines[first].split("//")[0].split()).upper()
    return first if text.startswith("%") and "@MACRO" in text else None


def split_channels(program: Program) -> dict[int, Program]:
    """The programs of the axis groups of a SYNTEC file with `$1`, `$2` … sections; empty if it has none.

    Every channel keeps all line numbers: the lines of the others are blank in it. What stands before the
    first section belongs to channel 1.
    """
    lines = program.lines
    possible = lines.holding("$") if isinstance(lines, LongText) else range(len(lines))
    sections = [
        (index, int(m[1]))
        for index in possible
        if "$" in lines[index] and (m := _CHANNEL.match(lines[index]))
    ]
    if not sections:
        return {}
    bounds = [(-1, 1), *sections, (len(lines), 0)]
    lines_of: dict[int, list[str]] = {}
    for (start, channel), (end, _) in pairwise(bounds):
        own = lines_of.setdefault(channel, [""] * len(lines))
        own[start + 1 : end] = lines[start + 1 : end]
    named = sorted({channel for _, channel in sections})
    return {channel: replace(program, lines=lines_of[channel]) for channel in named}


def _possible_headings(lines: Sequence[str]) -> Iterable[int]:
    if isinstance(lines, LongText):
        return lines.headings()
    return list(compress(count(), map(HEADING_STARTS.__contains__, map(_FIRST_SIGN, lines))))


def _program(source: Source, form: Form, lines: Sequence[str], first: int, end: int) -> Program:
    return Program(
        name=source.name,
        lines=lines[first:end],
        path=source.path,
        first_line=first + 1,
        form=form,
        encoding=source.encoding,
        replaced=source.replaced,
    )


def _macro_program(lines: Sequence[str], headings: Iterable[int], source: Source) -> Program:
    start = macro_header(lines)
    first = 0 if start is None else start + 1
    marks = (index for index in headings if index >= first and _is_marked(lines[index]))
    return _program(source, Form.MACRO, lines, first, next(marks, len(lines)))


# --- tapes: % O0001 … % -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Heading:
    """A tape mark or the first block of a program; `name` is empty for a tape mark."""

    index: int
    name: str = ""
    number: int | None = None


def _tape_headings(lines: Sequence[str], possible: Iterable[int]) -> Iterator[_Heading]:
    for index in possible:
        line = lines[index]
        if (number := _number(line)) is not None:
            yield _Heading(index, program_name(number), number)
        elif "<" in line and (name := _NAME.match(line)):
            yield _Heading(index, name[1])
        elif _is_marked(line):
            yield _Heading(index)


def _is_marked(line: str) -> bool:
    """Whether a line begins with a tape mark."""
    return line.lstrip().startswith("%")


def _number(line: str) -> int | None:
    """The number of a program that a line begins with, behind a tape mark perhaps: `O100`, `:100`.

    It is read sign by sign: to compile a pattern takes longer than the few lines that it would be asked for.
    """
    heading = line.lstrip().removeprefix("%").lstrip()
    if heading[:1] not in {"O", "o", ":"}:
        return None
    written = heading[1:].lstrip(" \t")
    digits = "".join(takewhile(str.isdecimal, written))
    if not 0 < len(digits) <= _MOST_DIGITS or written[len(digits) :].startswith("."):
        return None
    return int(digits)


def _tape_programs(lines: Sequence[str], possible: Iterable[int], source: Source) -> list[Program]:
    """Programs between tape marks; text without a number is one only if it is the first and holds blocks.

    As on a control, what stands before the first `%` or behind the last one is otherwise not read.
    """
    headings = list(_tape_headings(lines, possible))
    bounds = [_Heading(-1), *headings, _Heading(len(lines))]
    programs: list[Program] = []
    for heading, following in pairwise(bounds):
        if heading.name:
            programs.append(_named_program(lines, source, heading, following.index))
        elif not programs and _holds_block(lines, heading.index + 1, following.index):
            programs.append(_program(source, Form.WORD_ADDRESS, lines, heading.index + 1, following.index))
    return programs or [_longest_section(lines, source, bounds)]


def _named_program(lines: Sequence[str], source: Source, heading: _Heading, end: int) -> Program:
    program = _program(source, Form.WORD_ADDRESS, lines, heading.index, end)
    first = program.lines[0]
    if _is_marked(first):
        # `%O0001`: the mark becomes a blank, so that columns stay.
        program = replace(program, lines=_with_first(program.lines, first.replace("%", " ", 1)))
    return replace(program, name=heading.name, number=heading.number)


def _with_first(lines: Sequence[str], first: str) -> Sequence[str]:
    return lines.with_first(first) if isinstance(lines, LongText) else [first, *lines[1:]]


def _holds_block(lines: Sequence[str], first: int, end: int) -> bool:
    return any(_BLOCK.match(lines[index]) for index in range(first, end))


def _longest_section(lines: Sequence[str], source: Source, bounds: list[_Heading]) -> Program:
    """The one program of a file in which no line looks like a block: the control shall say what is wrong."""
    sections = [(start.index + 1, end.index) for start, end in pairwise(bounds)]
    first, end = max(sections, key=lambda section: section[1] - section[0])
    return _program(source, Form.WORD_ADDRESS, lines, first, end)


# --- SINUMERIK: %_N_NAME_MPF, ;$PATH= -----------------------------------------------------------------------


def _archive_programs(lines: Sequence[str], possible: Iterable[int], source: Source) -> list[Program]:
    marks = [index for index in possible if _is_marked(lines[index])]
    heads = [(index, m[1]) for index in marks if (m := _ARCHIVE_HEADER.match(lines[index]))]
    ends = [index for index in marks if lines[index].strip() == "%"]
    programs: list[Program] = []
    bounds = [(-1, ""), *heads, (len(lines), "")]
    for (index, name), (following, _) in pairwise(bounds):
        first, end = _without_bare_marks(index + 1, following, ends)
        text = _program(source, Form.SINUMERIK, lines, first, end)
        if name:
            programs.append(_archived(text, stored_name(name)))
        elif not heads or any(line.strip() and not line.lstrip().startswith(";") for line in text.lines):
            programs.append(_plain(text))
    return programs


def _without_bare_marks(first: int, end: int, marks: list[int]) -> tuple[int, int]:
    """A lone `%` on the first or last line of a unit is tape, not text."""
    if first in marks:
        first += 1
    if end - 1 in marks and end > first:
        end -= 1
    return first, end


def _archived(program: Program, name: str) -> Program:
    """A unit of an archive; its path stands in the line below its name."""
    path = next((m[1] for line in program.lines[:2] if (m := _PATH_HEADER.match(line))), "")
    return replace(program, name=name, directory=stored_directory(path) or default_directory(name))


def _plain(program: Program) -> Program:
    """A file of one program, which may tell its name and directory in comments."""
    top = program.lines[:_HEADER_LINES]
    name = next((m[1] for line in top if (m := _COMMENT_HEADER.match(line))), "")
    path = next((m[1] for line in top if (m := _PATH_HEADER.match(line))), "")
    return replace(
        program, name=stored_name(name) if name else program.name, directory=stored_directory(path)
    )
