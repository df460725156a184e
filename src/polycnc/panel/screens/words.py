"""Programs under edit by the keys of the MDI unit: INSERT, ALTER and DELETE of words (FANUC; general knowledge).

The cursor stands on a word; the end of a block is its last word. What is typed goes behind it, and `;` ends a block.
"""

from __future__ import annotations

from bisect import bisect_right

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

#: How the end of a block is keyed in, and shown.
END = ";"
#: A comment, or a slash with its number.
_PART = regex(r"\([^)]*\)?|/\d?")
_LETTERS = regex(r"[A-Za-z]+")


def spans(block: str) -> list[tuple[int, int]]:
    """Where the words of a block stand: from, up to. What stands in brackets is part of its word."""
    found: list[tuple[int, int]] = []
    at, length = 0, len(block.rstrip().removesuffix(END))
    while at < length:
        if block[at].isspace():
            at += 1
            continue
        end = min(_end_of_word(block, at), length)
        found.append((at, end))
        at = end
    return found


def _end_of_word(block: str, at: int) -> int:
    if part := _PART.match(block, at):
        return part.end()
    letters = _LETTERS.match(block, at)
    end, depth = letters.end() if letters is not None else at + 1, int(block[at] == "[")
    while end < len(block) and (
        depth or not (block[end].isalpha() or block[end].isspace() or block[end] in "(/;")
    ):
        depth += (block[end] == "[") - (block[end] == "]")
        end += 1
    return end


@dataclass(frozen=True, slots=True)
class Place:
    """Where the cursor stands: the row, and the word of it from 0; the word behind the last is the end of the block."""

    row: int
    word: int


def on_words(lines: Sequence[str], place: Place) -> Place:
    """The place, or the nearest one that the program has; looks at its own row alone."""
    row = max(0, min(place.row, len(lines) - 1))
    last = len(spans(lines[row])) if lines else 0
    return Place(row, max(0, min(place.word, last)))


def moved(lines: Sequence[str], place: Place, words: int) -> Place:
    """The cursor goes some words on, or back; from block to block."""
    place = on_words(lines, place)
    row, word = place.row, place.word + words
    while word < 0 and row > 0:
        row -= 1
        word += len(spans(lines[row])) + 1
    while row < len(lines) - 1 and word > (last := len(spans(lines[row]))):
        word -= last + 1
        row += 1
    return on_words(lines, Place(row, word))


def word_with(lines: Sequence[str], place: Place, wanted: str, step: int) -> Place | None:
    """The next word that begins with a text, onwards (1) or backwards (-1) from a place; else the next with it inside.

    `X4` is another word than `X40`: where there is a word of just that text, or the text is an address alone, longer
    numbers are passed.
    """
    rows = range(place.row, len(lines)) if step > 0 else range(place.row, -1, -1)
    inside: Place | None = None
    for row in rows:
        block = lines[row].upper()
        if wanted not in block:
            continue
        words = [(Place(row, at), block[start:end]) for at, (start, end) in enumerate(spans(block))]
        if row == place.row:
            words = [each for each in words if step * (each[0].word - place.word) > 0]
        for here, word in words[::step]:
            letters = _LETTERS.match(word)
            if word == wanted or (letters is not None and letters[0] == wanted):
                return here
            inside = inside or (here if wanted in word else None)
        if inside is None and row != place.row:  # over several words
            start = block.index(wanted)
            inside = Place(row, sum(1 for _, end in spans(block) if end <= start))
    return inside


class Edited:
    """The text of a program with a cursor.

    Args:
        lines: Its blocks.
        place: Where the cursor stands.
    """

    def __init__(self, lines: Sequence[str], place: Place) -> None:
        self._lines = [line.rstrip().removesuffix(END).rstrip() for line in lines] or [""]
        self.place = on_words(self._lines, place)

    @property
    def text(self) -> str:
        """The program as it is stored."""
        return "\n".join(self._lines) + "\n"

    def insert(self, typed: str) -> None:
        """INSERT: what was typed goes behind the word at the cursor, which is then on the last word of it."""
        _, end = self._word
        if typed.strip() == END and self.text[end : end + 1] == "\n" and self.place == Place(0, 0):
            self.place = Place(0, 1)  # the number of a new program has its end of block already
            return
        self._put(end, end, typed)

    def alter(self, typed: str) -> None:
        """ALTER: what was typed stands in the place of the word at the cursor."""
        self._put(*self._word, typed)

    def delete(self) -> None:
        """DELETE: the word at the cursor goes; the end of a block joins it with the next one."""
        start, end = self._word
        self._cut(start, end)

    def delete_block(self) -> None:
        """`;` and DELETE: what is left of the block from the cursor on goes, with its end."""
        start, _ = self._word
        self._cut(start, self.text.index("\n", start) + 1)

    @property
    def _word(self) -> tuple[int, int]:
        """Where the word at the cursor stands in the text."""
        row, word = self.place.row, self.place.word
        begin = sum(len(line) + 1 for line in self._lines[:row])
        found = spans(self._lines[row])
        if word < len(found):
            return begin + found[word][0], begin + found[word][1]
        return begin + len(self._lines[row]), begin + len(self._lines[row]) + 1

    def _put(self, start: int, end: int, typed: str) -> None:
        new = typed.strip().replace(END, "\n")
        head, tail = self.text[:start], self.text[end:]
        head += "" if head[-1:] in ("", "\n", " ") or new.startswith("\n") else " "
        tail = tail.lstrip(" ") if new.endswith("\n") else tail
        between = "" if new.endswith("\n") or tail[:1] in ("", "\n", " ") else " "
        self._become(head + new + between + tail, len(head) + len(new) - 1)

    def _cut(self, start: int, end: int) -> None:
        head, tail = self.text[:start], self.text[end:]
        if head[-1:] in (" ", "\n", ""):
            tail = tail.removeprefix(" ")
        elif tail[:1] not in ("", "\n", " "):
            head += " "
        self._become(head + tail, len(head))

    def _become(self, text: str, at: int) -> None:
        """The text is another one; the cursor stands on the word with a character."""
        self._lines = [line.rstrip() for line in text.removesuffix("\n").split("\n")]
        before = text[: max(at, 0)]
        row = min(before.count("\n"), len(self._lines) - 1)
        column = len(before) - before.rfind("\n") - 1
        starts = [start for start, _ in spans(self._lines[row])]
        is_end = column >= len(self._lines[row])
        self.place = Place(row, len(starts) if is_end else max(0, bisect_right(starts, column) - 1))
