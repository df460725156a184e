"""A word-address program made ready to run: each line becomes a step when it is first reached."""

from __future__ import annotations

import re
from bisect import bisect_right

from polycnc.channel.states.unchanging import unchanging
from polycnc.channel.steps import kept_steps, several
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.code import listed
from polycnc.language.expressions.hot_loop import HotLoop
from polycnc.language.expressions.joined import MAX_JOINED, MOST_JOINS, led_by
from polycnc.language.word_address.joining import JOINABLE, join, join_loop
from polycnc.language.word_address.macro_b import Lifting, Reader, macro_shapes
from polycnc.language.word_address.patterns import Patterns, Spot, negative
from polycnc.language.word_address.statements import (
    KEYWORD,
    Assignment,
    LoopEnd,
    leads_back,
    parse_statement,
    target_of,
)
from polycnc.language.word_address.words import ExpressionBlock, WordBlock, code_key, is_fixed_code, word_key
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Code
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.program import Program

#: Longer blocks are refused: no control stores one, and a damaged file must not fill the memory.
MAX_BLOCK_LENGTH = 4096
#: A number can match in one way only, so a line that fails does so at once.
_PLAIN = regex(r"(?:[A-Z][-+]?(?:\d+(?:\.\d*)?|\.\d+)[ \t]*)+;?")
_WORD = regex(r"([A-Z])([-+]?)([\d.]+)")
_BLANK = regex(r"[ \t]*%?[ \t]*")
_COMMENT = regex(r"\([^)]*\)?")
_SEQUENCE = regex(r"[ \t]*(?:/\d?[ \t]*)*N[ \t]*(\d+)", re.IGNORECASE)
_STATEMENT = regex(rf"[ \t]*(?:/\d?[ \t]*)*(?:N[ \t]*\d+)?[ \t]*(?:/\d?[ \t]*)*(?:{KEYWORD.pattern})")
_NUMBERS = regex(
    r"^[ \t]*(?:[O:][ \t]*\d+|<[^>]*>)?[ \t]*(?:/\d?[ \t]*)*(?:N[ \t]*\d+)?[ \t]*(?:/\d?[ \t]*)*"
)
#: A block that begins with a word and its number is neither a statement nor nothing.
_PLAIN_BEGIN = regex(r"(?:N\d+[ \t]*)?[A-MO-Z][-+\d.]")
_SEQUENCE_WORD = regex(r"N[ \t]*\d+\.?\d*")
_LOOP = regex(r"(?<![A-Z])(DO|END)[ \t]*(\d+)")
_SKIP = regex(r"[ \t]*/[ \t]*(\d?)")
_NUMBER_TEXT = regex(r"[ \t]*([-+]?)[ \t]*(\d+\.?\d*|\.\d+)")
_VALUE = regex(r"[ \t]*[-+]?[ \t]*[#\[]")
_NAME = regex(r"[ \t]*P?[ \t]*(<[^<>]+>)")

#: Steps that lines of one pattern share.
REPEATABLE = (WordBlock, ExpressionBlock, Assignment)
#: Runs of a step after which it is joined with those behind it.
JOINED_FROM = 8


#: Programs whose lines are read all at once where they come round again.
SHORT = 256


@dataclass(frozen=True)
class Grammar:
    """What a control's word-address text looks like, and its alarms for mistakes in it.

    Attributes:
        alarms: Names of mistakes to alarm codes.
        max_digits: Digits that a number may have.
        comma_addresses: Letters that may follow a comma (`,R` `,C`); they become addresses `,R`.
        letters: Letters that may be addresses.
        point_in_numbers: Whether a block number may have a decimal point (`N3.`), which means nothing.
        last_loop: The largest number of a loop (DO m); `deepest_loop` is how deep loops nest.
        shapes: The compiled code of the control's expressions.
        patterns: The lines that have been read.
        plain: Blocks of the lines that have numbers only: a program calls, retracts and turns back in the same words
            again and again.
    """

    alarms: Mapping[str, str]
    max_digits: int = 8
    comma_addresses: str = "RCAD"
    letters: str = "ABCDEFGHIJKLMNPQRSTUVWXYZ"
    point_in_numbers: bool = True
    last_loop: int = 3
    deepest_loop: int = 3
    shapes: Shapes = field(default_factory=macro_shapes, compare=False, repr=False)
    patterns: Patterns = field(default_factory=Patterns, compare=False, repr=False)
    plain: dict[str, WordBlock] = field(default_factory=dict, compare=False, repr=False)


def _behind_head(text: str) -> int:
    """Where a block begins behind the number or the name of a program that may stand at the begin of its line."""
    rest = text.lstrip(" \t")
    start = len(text) - len(rest)
    if rest.startswith("<"):
        return text.find(">", start) + 1 or start
    if not rest.startswith(("O", ":")):
        return start
    digits = rest[1:].lstrip(" \t")
    end = next((at for at, sign in enumerate(digits) if not sign.isdecimal()), len(digits))
    return len(text) - len(digits) + end if end else start


def empty_block(_channel: Channel) -> None:
    """The step of a line without a block."""


@unchanging
class WordAddressProgram:
    """The steps of one program. A line is a step; a line with several `;` keeps its blocks in one step.

    Args:
        program: The text.
        grammar: The control's way of writing.
    """

    def __init__(self, program: Program, grammar: Grammar) -> None:
        self.program = program
        self.grammar = grammar
        self.lines = program.lines
        #: Whether jumps and loops may stand in it: not in what MDI or DNC runs as the main program.
        self.may_jump = True
        self.steps = kept_steps(len(self.lines))
        self._reached = bytearray(len(self.lines))
        self._joined_into = bytearray(len(self.lines))
        self._singles: dict[int, Step] = {}
        self._sequences: dict[int, list[int]] | None = None
        self._loops: dict[tuple[int, int], int] = {}
        #: The line in the file of a step. Asked for every row, so it is the range's own method.
        self.line = range(program.first_line, program.first_line + len(self.lines) + 1).__getitem__

    # ---- what the channel asks ----------------------------------------------------------------------------------

    def step(self, index: int, *, alone: bool = False) -> Step | None:
        """The step of a line; kept from its second run on, so that a long program does not fill the memory.

        It is joined with those behind it when it has run so often that the time for it comes back, unless it has to
        run alone.
        """
        if index >= len(self.lines):
            return None
        step = self._single(index)
        reached, joinable = self._reached[index], isinstance(step, JOINABLE) and not alone
        if reached >= JOINED_FROM or (reached and not joinable):
            step = self.steps[index] = self._joined(step, index) if joinable else self._hot(step, index)
        elif reached:
            self._singles[index] = step
        self._reached[index] = min(reached + 1, JOINED_FROM)
        return step

    def _single(self, index: int) -> Step:
        return self._singles.get(index) or self.compile(self.lines[index], index)

    def _joined(self, first: Step, index: int) -> Step:
        """A step together with those behind it that have been reached too; a jump still finds each one.

        It ends in front of one that is kept: what a program enters at many places is joined once, not from each anew.
        """
        stretch = [(index, first)]
        for i in range(index + 1, min(index + MAX_JOINED, len(self.lines))):
            following = self._single(i) if self._reached[i] else None
            if isinstance(following, LoopEnd):
                return HotLoop(join_loop(self.grammar.shapes, stretch, i, following), first)
            if not isinstance(following, JOINABLE) or self.steps[i] is not None:
                break
            if self._joined_into[i] >= MOST_JOINS:
                break
            self._joined_into[i] += 1
            stretch.append((i, following))
        if any(leads_back(step, i) for i, step in stretch):
            return HotLoop(join(self.grammar.shapes, stretch) if len(stretch) > 1 else first, first)
        return led_by(first, join(self.grammar.shapes, stretch)) if len(stretch) > 1 else first

    @staticmethod
    def _hot(step: Step, index: int) -> Step:
        """A step that is not joined; one at which a loop comes round again."""
        return HotLoop(step, step) if isinstance(step, LoopEnd) or leads_back(step, index) else step

    def jumps_around(self, index: int) -> list[tuple[int, int]]:
        """First and last step of each part of the program within which a jump behind a step leads back in front of it.

        Of a program that is not long that is all of it: what comes round again may lie anywhere.
        """
        steps = [
            (last, self._single(last) if self._reached[last] else None)
            for last in range(index, min(index + MAX_JOINED, len(self.lines)))
        ]
        around = [(target_of(step), last) for last, step in steps if leads_back(step, index)]
        return [(0, len(self.lines) - 1)] if around and len(self.lines) <= SHORT else around

    def line_of_step(self, index: int) -> int:
        """Index of a step's line in the program's text."""
        return index

    def step_of_line(self, line: int) -> int:
        """The step of a line of the text."""
        return line

    def scannable_to(self, _line: int) -> int:
        """The line behind those that the scanner may read, from a line of the text on: every line is a block."""
        return len(self.program.lines)

    def column(self, index: int, address: str) -> int:
        """Column, from 1, of an address (`X`, `,R`) or a code (`G41`) in a line; 0 when it is not there."""
        if index >= len(self.lines):
            return 0  # what the end of the program finds missing stands in no line
        text = self.blank_comments(self.lines[index])
        if is_fixed_code(address):
            for match in _WORD.finditer(text):
                if match[1] == address[0] and code_key(match[1], match[3]) == address:
                    return match.start() + 1
        return text.find(address) + 1 if address else 0

    def sequence(self, index: int) -> int:
        """The sequence number of a line, or of the last line above that has one; 0 for none."""
        for i in range(index, -1, -1):
            match = _SEQUENCE.match(self.lines[i])
            if match:
                return int(match[1])
        return 0

    def counts(self, index: int) -> bool:
        """Whether a line is a block for stages that look ahead.

        Macro statements are none (FANUC macro B §7), and blank lines only set a text out; a comment, or `;` alone,
        is an empty block.
        """
        if index >= len(self.lines):
            return True
        line = self.lines[index]
        return bool(_PLAIN_BEGIN.match(line)) or not (_BLANK.fullmatch(line) or self.is_statement(index))

    def is_statement(self, index: int) -> bool:
        """Whether a line is a macro statement."""
        return index < len(self.lines) and bool(_STATEMENT.match(self.blank_comments(self.lines[index])))

    def has_words(self, index: int) -> bool:
        """Whether a line holds a block of words."""
        if index >= len(self.lines) or self.is_statement(index):
            return False
        return bool(_NUMBERS.sub("", self.blank_comments(self.lines[index])).strip(" \t;%"))

    # ---- jumps --------------------------------------------------------------------------------------------------

    @property
    def last_loop(self) -> int:
        """The largest number of a loop (DO m)."""
        return self.grammar.last_loop

    def find_sequence(self, number: int, index: int, mistake: str = "no_sequence") -> int:
        """The step of `N number`: the first behind `index`, else the first from the top."""
        places = self.sequence_places(number)
        if not places:
            raise AlarmError(self.grammar.alarms[mistake], number=number)
        after = bisect_right(places, index)
        return places[after] if after < len(places) else places[0]

    def sequence_places(self, number: int) -> list[int]:
        """All steps of `N number`."""
        if self._sequences is None:
            self._sequences = {}
            for i, line in enumerate(self.lines):
                match = _SEQUENCE.match(line)
                if match:
                    self._sequences.setdefault(int(match[1]), []).append(i)
        return self._sequences.get(number, [])

    def loop_end(self, index: int, number: int) -> int:
        """The step of the END that belongs to the DO in step `index`; loops must not cross."""
        end = self._loops.get((index, number))
        if end is None:
            end = self._loops[index, number] = self._search_loop_end(index, number)
        return end

    def _search_loop_end(self, index: int, number: int) -> int:
        open_loops = [number]
        for i in range(index + 1, len(self.lines)):
            match = _LOOP.search(self.blank_comments(self.lines[i]))
            if match is None:
                continue
            word, n = match[1], int(match[2])
            if word == "DO":
                if n in open_loops:
                    break
                open_loops.append(n)
                if len(open_loops) > self.grammar.deepest_loop:
                    raise AlarmError(self.grammar.alarms["loop_number"], number=n)
            elif open_loops[-1] != n:
                break
            else:
                open_loops.pop()
                if not open_loops:
                    return i
        raise AlarmError(self.grammar.alarms["missing_end"], number=number)

    # ---- compiling ----------------------------------------------------------------------------------------------

    def compile(self, line: str, index: int) -> Step:
        """The step of one line."""
        plain = self.grammar.plain
        known = plain.get(line)
        if known is not None:
            return known
        text = line.strip()
        if _PLAIN.fullmatch(text) and text[0] != "O":
            if len(plain) >= self.grammar.patterns.most:
                plain.clear()
            plain[line] = block = self._plain(text)
            return block
        if not text or text == "%":
            return empty_block
        if len(text) > MAX_BLOCK_LENGTH:
            raise AlarmError(self.grammar.alarms["block_too_long"], column=MAX_BLOCK_LENGTH)
        return self._general(line, index)

    def _plain(self, text: str) -> WordBlock:
        """A block of words with numbers only."""
        signature: list[str] = []
        values: list[float] = []
        max_digits = self.grammar.max_digits
        for letter, sign, number in _WORD.findall(text):
            if letter == "N" and (sign or "." in number):
                self._check_number(sign, number)
            if letter in "GM" and not sign:
                signature.append(code_key(letter, number))
                continue
            if letter == "N" and not signature:
                continue
            if len(number) > max_digits and len(number.replace(".", "").lstrip("0")) > max_digits:
                raise AlarmError(self.grammar.alarms["too_many_digits"], address=letter)
            if letter in "GM":
                raise AlarmError(self.grammar.alarms["minus"], address=letter)
            signature.append(word_key(letter, number))
            values.append(float(sign + number))
        return WordBlock(tuple(signature), values)

    def _check_number(self, sign: str, number: str) -> None:
        """The alarm for a sequence number with a sign, or with a point where that is refused."""
        if sign:
            raise AlarmError(self.grammar.alarms["minus"], address="N")
        if "." in number and not self.grammar.point_in_numbers:
            raise AlarmError(self.grammar.alarms["point"], address="N")

    def blank_comments(self, line: str) -> str:
        """The line in upper case with its comments turned into blanks of the same length."""
        if "(" in line:
            nested = any("(" in match.group()[1:] for match in _COMMENT.finditer(line))
            line = _COMMENT.sub(lambda match: " " * len(match.group()), line)
            if nested:
                # A comment ends at its first bracket; what was to close the outer one is read over.
                line = line.replace(")", " ")
        return line.upper()

    def _general(self, line: str, index: int) -> Step:
        text = self.blank_comments(line)
        known = self.grammar.patterns.step(text)
        if known is not None:
            return known
        blocks: list[Step] = []
        start = 0
        while True:
            end = text.find(";", start)
            stop = len(text) if end < 0 else end
            piece = " " * start + text[start:stop]
            if piece.strip() or end >= 0:
                blocks.append(self._block(piece, line, index))
            if end < 0 or not text[end + 1 :].strip():
                break
            start = end + 1
        if len(blocks) <= 1:
            return blocks[0] if blocks else empty_block
        return several(blocks)

    def _block(self, text: str, line: str, index: int) -> Step:
        """One block: program number, skip marks, sequence number, then a statement or words."""
        reader = BlockReader(text, self.grammar, line)
        begin = reader.pos = _behind_head(text)
        levels = reader.skip_levels()
        number = reader.match(_SEQUENCE_WORD) if reader.peek() == "N" else ""
        digits_at = reader.pos - len(number.lstrip("N \t"))
        if "." in number:
            self._check_number("", number)
        levels |= reader.skip_levels()
        keyword = reader.match(KEYWORD) if reader.peek() else ""
        if keyword:
            step = parse_statement(reader, keyword, self, index)
        elif not reader.peek():
            # A line that only names the program is none of its blocks.
            is_head = text.strip() and not text[begin:].strip()
            step = empty_block if is_head else WordBlock((), [])
        else:
            step = self._words(reader)
        if isinstance(step, REPEATABLE) and not levels:
            self.grammar.patterns.learn(text, step, reader.spots, (digits_at,) if number else ())
        return SkippedBlock(levels, step, empty_block) if levels else step

    def words_of(self, line: str) -> tuple[BlockWords, Sequence[Spot | None]] | None:
        """The words of a line with one block of words, and where its numbers stand; None for any other line.

        Raises:
            AlarmError: What is wrong with the line.
        """
        reader = BlockReader(self.blank_comments(line).rstrip(" \t;"), self.grammar, line)
        reader.match(_SEQUENCE_WORD)
        words = BlockWords()
        while reader.peek():
            if reader.peek() == "/" or KEYWORD.match(reader.text, reader.pos):
                return None
            self._word(reader, words)
        return words, reader.spots

    def _words(self, reader: BlockReader) -> Step:
        """The words of a block; a `/` between them skips the rest."""
        words = BlockWords()
        while reader.peek():
            if reader.text[reader.pos] == "/":
                levels = reader.skip_levels()
                before = words.block(reader)
                while reader.peek():
                    self._word(reader, words)
                return SkippedBlock(levels, words.block(reader), before)
            self._word(reader, words)
        return words.block(reader)

    def _word(self, reader: BlockReader, words: BlockWords) -> None:
        """Read one word."""
        start = reader.pos
        if KEYWORD.match(reader.text, start):
            raise reader.fail("nc_and_macro")
        name = _NAME.match(reader.text, reader.pos)
        if name:
            words.keys.append(name[1])
            reader.pos = name.end()
            return
        address = reader.address()
        number = _NUMBER_TEXT.match(reader.text, reader.pos)
        if number:
            sign, digits = number[1], number[2]
            reader.pos = number.end()
            if address in ("G", "M") and not sign:
                words.keys.append(code_key(address, digits))
                return
            zeros_count = len(digits.replace(".", "")) > self.grammar.max_digits
            if zeros_count and len(digits.replace(".", "").lstrip("0")) > self.grammar.max_digits:
                raise reader.fail("too_many_digits", start)
            if address in ("G", "M", "N", "O"):
                raise reader.fail("minus" if sign else "address", start)
            spot = Spot(number.start(2), negative if sign == "-" else float)
            words.number(
                word_key(address, digits), float(sign + digits), reader, None if zeros_count else spot
            )
            if reader.pos < len(reader.text) and reader.text[reader.pos] == ".":
                raise reader.fail("point", reader.pos)
            return
        if not _VALUE.match(reader.text, reader.pos):
            raise reader.fail("minus" if reader.peek() in ("-", "+") else "no_data", start)
        reader.in_word = True
        value = reader.factor()
        reader.in_word = False
        words.expression(address if address in ("G", "M") else address + "#", value)


class BlockWords:
    """The words of one block as they are read.

    Attributes:
        keys: As in a signature.
        codes: Code of the values, one for each key that is not a fixed code.
        values: Those that are numbers.
        computed: Whether a word holds a variable or an expression.
    """

    def __init__(self) -> None:
        self.keys: list[str] = []
        self.codes: list[Code] = []
        self.values: list[float] = []
        self.computed = False

    def number(self, key: str, value: float, reader: Reader, spot: Spot | None) -> None:
        """A word with a number."""
        self.keys.append(key)
        self.values.append(value)
        self.codes.append(reader.lift(value, spot))

    def expression(self, key: str, value: Code) -> None:
        """A word with a variable or an expression."""
        self.keys.append(key)
        self.codes.append(value)
        self.computed = True

    def block(self, reader: Reader) -> Step:
        """The block of the words read so far."""
        keys = tuple(self.keys)
        if not self.computed:
            return WordBlock(keys, list(self.values))
        return ExpressionBlock(keys, reader.compiled_list(Lifting(listed(self.codes), tuple(reader.numbers))))


class BlockReader(Reader):
    """A reader that knows words and the comment behind a statement."""

    def __init__(self, text: str, grammar: Grammar, line: str) -> None:
        super().__init__(text, grammar.alarms, grammar.shapes)
        self._grammar = grammar
        self._line = line

    def address(self) -> str:
        """The address of the next word; `,R` counts as one."""
        char = self.peek()
        if char == ",":
            self.pos += 1
            letter = self.peek()
            if not letter or letter not in self._grammar.comma_addresses:
                raise self.fail("address")
            self.pos += 1
            return "," + letter
        if char not in self._grammar.letters:
            raise self.fail("address")
        self.pos += 1
        return char

    def skip_levels(self) -> int:
        """Bit mask of the block skip levels marked here: `/` and `/1` are level 1."""
        levels = 0
        while self.peek() == "/" and (match := _SKIP.match(self.text, self.pos)):
            levels |= 1 << int(match[1] or 1)
            self.pos = match.end()
        return levels

    def comment_behind(self, begin: int) -> str:
        """The text in brackets behind a statement (`#3000=1(TEXT)`), as the program's author wrote it."""
        match = _COMMENT.search(self._line, begin)
        return match.group().strip("() ") if match else ""


class SkippedBlock:
    """A block under block skip: which of two steps runs depends on the operator's switches at that moment."""

    __slots__ = ("_levels", "_off", "_on")

    def __init__(self, levels: int, off: Step, on: Step) -> None:
        self._levels = levels
        self._off = off
        self._on = on

    def chosen(self, channel: Channel) -> Step:
        """The step that runs under the operator's switches."""
        return self._on if channel.skip_levels & self._levels else self._off

    def is_left_out(self, channel: Channel) -> bool:
        """Whether nothing of the block is left under the operator's switches."""
        return bool(channel.skip_levels & self._levels) and self._on is empty_block

    def __call__(self, channel: Channel) -> None:
        """Run the step that the switches choose; a block that is left out is none of the path."""
        channel.off_path = self.is_left_out(channel)
        self.chosen(channel)(channel)
