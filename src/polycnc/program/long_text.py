"""The lines of a file that is not small, made when they are asked for.

Most of them never are: plain blocks are scanned from the bytes of the file. The file is looked through once. What is
kept is where its *pages* begin, each some thousand whole lines, and which lines begin with a character that may begin a
heading. A large file is not kept, for a program of a gigabyte needs none: a page that is asked for is read again, and
the last few are at hand.
"""

from __future__ import annotations

import errno
import os
import re
from array import array
from bisect import bisect_right
from collections.abc import Sequence
from functools import lru_cache
from stat import S_ISREG

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, overload
from polycnc.messages.files import reason_of
from polycnc.program.encoding import codec_of, has_byte_order_mark
from polycnc.program.errors import ProgramFileError
from polycnc.program.pages import CONTROLS, Page, ended
from polycnc.program.text import MAX_LINE, refuse_long_line

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

#: Smaller files are split into their lines, for what is done here takes as long; larger ones are not kept.
LONG_FILE_BYTES, KEPT_FILE_BYTES = 16 * 1024, 1024 * 1024
#: Bytes of a page, and what is left of its last line: so much the processor has at hand while it is looked through.
PAGE_BYTES = 256 * 1024
#: Pages of a file that are kept at hand.
PAGES_AT_HAND = 4
#: Bytes of pages with characters beyond ASCII that decide on the encoding.
SAMPLE_BYTES = 1024 * 1024
HEADING_STARTS = frozenset("%oO:< \t")
#: A line without any of these is no heading, however it begins.
HEADING_SIGNS = b"%oO:<"
#: Where one line in so many is looked for, all are looked at.
_MANY = 4
#: Signs are few where no more than one byte in so many is one.
_FEW_SIGNS = 200
#: What a line with a heading may begin with in the file, control codes of tapes included.
_STARTS = "".join(sorted(HEADING_STARTS)).encode() + CONTROLS
_HEADING = regex(b"\n[" + re.escape(_STARTS) + b"]")


@dataclass(eq=False)
class TextFile:
    """A file of whole lines in pages.

    Attributes:
        path: The file.
        handle: That of the open file, which is closed with this object.
        codec: Python codec by which it is read.
        has_returns: Lines end with CR LF.
        replaced: Characters that the codec could not read.
        places: First byte of each page, and behind the last one the size of the file.
        numbers: Index of the first line of each page, and behind the last one how many lines there are.
        headings: Lines that begin with one of `HEADING_STARTS`, but for some without `HEADING_SIGNS`, and some others.
    """

    path: str
    handle: int
    codec: str = "ascii"
    has_returns: bool = False
    replaced: int = 0
    places: array[int] = field(default_factory=lambda: array("q", [0]))
    numbers: array[int] = field(default_factory=lambda: array("q", [0]))
    headings: array[int] = field(default_factory=lambda: array("I"))

    def __post_init__(self) -> None:
        self.page = lru_cache(PAGES_AT_HAND)(self._page)
        size = os.fstat(self.handle).st_size
        self._kept = self._read(0, size) if size < KEPT_FILE_BYTES else None

    def __del__(self) -> None:
        os.close(self.handle)

    @property
    def is_kept(self) -> bool:
        """Whether all of it is at hand; it is one page then."""
        return self._kept is not None

    def pages(self) -> Iterator[bytes]:
        """All of it, for the first time."""
        if self._kept is not None:
            yield from (self._kept,) if self._kept else ()
            return
        with open(self.path, "rb") as stream:  # noqa: PTH123 - a path is a text here
            while page := stream.read(PAGE_BYTES):
                yield page + stream.readline(MAX_LINE + 1)

    def raw(self, page: int) -> bytes:
        """The bytes of a page as they stand in the file."""
        place, end = self.places[page], self.places[page + 1]
        if self._kept is not None:
            return self._kept[place:end]
        try:
            return self._read(place, end - place)
        except OSError as error:
            raise ProgramFileError("program.unreadable", self.path, reason=reason_of(error)) from error

    def _read(self, place: int, size: int) -> bytes:
        """So many bytes of the file from one on."""
        os.lseek(self.handle, place, os.SEEK_SET)
        data = os.read(self.handle, size)
        if len(data) != size:
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        return data

    def _page(self, page: int) -> Page:
        """A page, read."""
        data = self.raw(page)
        if self.has_returns:
            data = data.replace(b"\r\n", b"\n")
        if not data.isascii():
            data = data.translate(None, CONTROLS).decode(self.codec, "replace").encode("utf-8", "replace")
        return Page(ended(data), self.numbers[page + 1] - self.numbers[page])

    def page_of(self, line: int) -> int:
        """The page in which a line stands."""
        return bisect_right(self.numbers, line) - 1


class LongText(Sequence[str]):
    """Lines of a file, or some of them.

    Args:
        file: The file.
        lines: Which lines of it.
        first_line: Stands for the first one, if given.
    """

    def __init__(self, file: TextFile, lines: range, first_line: str | None = None) -> None:
        self.file = file
        self._lines = lines
        self._first_line = first_line

    def __len__(self) -> int:
        return len(self._lines)

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        if isinstance(index, slice):
            chosen = self._lines[index]
            if chosen.step != 1:
                return [self[i] for i in range(*index.indices(len(self)))]
            starts_here = bool(chosen) and chosen[0] == self._lines[0]
            return LongText(self.file, chosen, self._first_line if starts_here else None)
        line = self._lines[index]
        if self._first_line is not None and line == self._lines[0]:
            return self._first_line
        file = self.file
        page = file.page_of(line)
        found: str = file.page(page).line(line - file.numbers[page])
        return found

    def __iter__(self) -> Iterator[str]:
        if self._lines and self._first_line is not None:
            yield self._first_line
        file, at = self.file, self._lines.start + (self._first_line is not None)
        while at < self._lines.stop:
            page = file.page_of(at)
            first, end = file.numbers[page], min(file.numbers[page + 1], self._lines.stop)
            yield from file.page(page).lines(at - first, end - first)
            at = end

    def with_first(self, text: str) -> LongText:
        """The same lines with another first one."""
        return LongText(self.file, self._lines, text)

    def headings(self) -> Iterator[int]:
        """Every line that can be a heading, and some others."""
        first, found = self._lines.start, self.file.headings
        for i in range(bisect_right(found, first - 1), len(found)):
            if found[i] >= self._lines.stop:
                return
            yield found[i] - first

    def holding(self, sign: str) -> Iterator[int]:
        """The lines that hold a sign of ASCII; a page without it is not taken apart."""
        for lines, text in self._pages():
            if sign.encode() in text:
                yield from (
                    i for i, line in zip(lines, self[lines.start : lines.stop], strict=True) if sign in line
                )

    def not_beginning(self, signs: str, is_meant: Callable[[str], bool]) -> Iterator[range]:
        """Runs of lines that are not empty and begin with none of some signs of ASCII, or that are meant."""
        ends = re.compile(b"\n(?=[" + re.escape(signs.encode() + CONTROLS) + b"\n])")
        for lines, text in self._pages():
            start = lines.start
            candidates = _lines_behind(ends, text, lines)
            if candidates:
                read = list(self[start : lines.stop])
                for i in candidates:
                    if read[i][:1] in signs and not is_meant(read[i]):
                        line = lines[i]
                        if line > start:
                            yield range(start, line)
                        start = line + 1
            if start < lines.stop:
                yield range(start, lines.stop)

    def _pages(self) -> Iterator[tuple[range, bytes]]:
        """The lines of each page, and its text, which may hold more than them."""
        at = 0
        while at < len(self._lines):
            page = self.file.page_of(self._lines[at])
            end = min(self.file.numbers[page + 1] - self._lines.start, len(self._lines))
            own = self._first_line if at == 0 else None
            text: bytes = self.file.page(page).text
            yield range(at, end), text if own is None else f"{own}\n".encode() + text
            at = end

    def text_from(self, line: int) -> tuple[bytes, int, int]:
        """The lines from one on to the end of its page, in UTF-8, each with its line feed.

        Returns:
            A text, where in it they begin, and where they end.
        """
        if line == 0 and self._first_line is not None:
            own = f"{self._first_line}\n".encode("utf-8", "replace")
            return own, 0, len(own)
        file, number = self.file, self._lines[line]
        page = file.page_of(number)
        first = file.numbers[page]
        found: Page = file.page(page)
        return found.text, *found.places_of(number - first, self._lines.stop - first)


def _lines_behind(ends: re.Pattern[bytes], text: bytes, lines: range) -> Sequence[int]:
    """Which lines of a page stand behind line ends that are found; all where many do, or its text holds more lines."""
    places = [found.start() for found in ends.finditer(b"\n" + text)]
    if len(places) * _MANY > len(lines) or (places and text.count(b"\n") != len(lines)):
        return range(len(lines))
    found, line, last = [], 0, 0
    for place in places:
        line += text.count(b"\n", last, place)
        last = place
        found.append(line)
    return found


def read_long(path: str) -> LongText | None:
    """The lines of a file that is long enough; None for one that is better read as a whole.

    Raises:
        ProgramFileError: A line is too long for a block.
    """
    try:
        state = os.stat(path)  # noqa: PTH116 - Path(path) hides what the user typed
        if not S_ISREG(state.st_mode) or state.st_size < LONG_FILE_BYTES:
            return None
        return _look_through(TextFile(path, os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))))
    except (OSError, ValueError):
        return None  # reading it as a whole says what is wrong


def _look_through(file: TextFile) -> LongText | None:
    """Find the pages of a file; None where its line ends or its encoding ask for the whole of it."""
    sample = bytearray()
    beyond_ascii: list[int] = []
    for page in file.pages():
        if len(file.places) == 1 and has_byte_order_mark(page):
            return None
        if b"\r" in page:
            file.has_returns = True
            if page.count(b"\r") != page.count(b"\r\n"):
                return None
        if not page.isascii():
            beyond_ascii.append(len(file.places) - 1)
            sample += page[: max(SAMPLE_BYTES - len(sample), 0)]
        _refuse_long_lines(file, page)
        number = _lines_to_end(file, page)
        file.places.append(file.places[-1] + len(page))
        file.numbers.append(number)
    if beyond_ascii:
        _find_codec(file, beyond_ascii, bytes(sample))
    return LongText(file, range(file.numbers[-1]))


def _lines_to_end(file: TextFile, page: bytes) -> int:
    """Note the lines that may be headings; gives how many there are to the end of a page.

    It begins behind those found so far, and is not noted yet.
    """
    line, last = file.numbers[-1], 0
    for start in _headings(page):
        line += page.count(b"\n", last, start)
        last = start
        file.headings.append(line)
    behind_last = page[page.rfind(b"\n") + 1 :].translate(None, CONTROLS)
    return line + page.count(b"\n", last) + bool(behind_last)


def _headings(page: bytes) -> Sequence[int]:
    """Where lines begin that may be headings: from signs to their lines, or by line ends where signs are many."""
    starts, left = set(), len(page) // _FEW_SIGNS
    for sign in HEADING_SIGNS:
        place = page.find(sign)
        while place >= 0:
            if not left:
                first = (0,) if page[0] in _STARTS else ()
                return [*first, *(found.start() + 1 for found in _HEADING.finditer(page))]
            left -= 1
            start = page.rfind(b"\n", 0, place) + 1
            if page[start] in _STARTS:
                starts.add(start)
            place = page.find(sign, place + 1)
    return sorted(starts)


def _refuse_long_lines(file: TextFile, page: bytes) -> None:
    """From line end to line end, as far apart as they may be."""
    place = 0
    while place + MAX_LINE < len(page):
        found = page.rfind(b"\n", place, place + MAX_LINE + 1)
        if found < 0:
            if file.is_kept:
                raise ValueError("characters count, not bytes")
            line = file.numbers[-1] + page.count(b"\n", 0, place) + 1
            refuse_long_line(file.path, line)
        place = found + 1


def _find_codec(file: TextFile, pages: Sequence[int], sample: bytes) -> None:
    """How pages beyond ASCII are read: UTF-8 if all of them are, else what the sample looks like."""

    def cleaned(page: int) -> bytes:
        return file.raw(page).translate(None, CONTROLS)

    try:
        for page in pages:
            cleaned(page).decode("utf-8")
        file.codec = "utf-8"
    except UnicodeDecodeError:
        file.codec = codec_of(sample.translate(None, CONTROLS))
        file.replaced = sum(cleaned(page).decode(file.codec, "replace").count("\ufffd") for page in pages)
