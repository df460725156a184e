"""The scanner: from the bytes of plain blocks to columns of the toolpath. Pure functions on arrays.

A block is read word by word while its *shape* (codes, addresses, how numbers were written; see
`language.word_address.words`) is followed down a tree: `nexts[node * KEY_COUNT + key]` is the next node, 0 for none
yet. The node at which the block ends tells in `leaves` which rule it follows; rules were drawn up from the control's
own plans (see `recipe`), so that a block does here exactly what it would do there. Nothing is changed until it is
certain that the whole block can be worked off: whatever could alarm, and whatever is in doubt, ends the scan in front
of the block, and the interpreter decides.
"""

from __future__ import annotations

from typing import NamedTuple

from polycnc.kernels.layout import Bytes, Floats, Ints32
from polycnc.language.bulk.formulas import begins_formula, calculate, read_formula
from polycnc.language.bulk.layout import (
    CR_FORM,
    DIRECTION_FORM,
    FIRST_CODE,
    FIRST_FORMULA,
    FORMS,
    KEY_COUNT,
    LAST_CODE,
    MOST_KEYS,
    MOST_WORDS,
    Grammar,
    Leaf,
    Outcome,
    Rule,
    State,
)
from polycnc.language.bulk.moves import Columns, act, note
from polycnc.language.bulk.numerals import BLANK, EXACT_DIGITS, NINE, POINT, TAB, ZERO, read_number

NEWLINE, THREE = 10, 51
LETTER_A, LETTER_C, LETTER_G, LETTER_M, LETTER_N, LETTER_O, LETTER_R, LETTER_X, LETTER_Z = (
    65, 67, 71, 77, 78, 79, 82, 88, 90
)  # fmt: skip
EQUALS_SIGN, OPEN, CLOSE, SEMICOLON, SLASH, STAR = 61, 40, 41, 59, 47, 42
#: Longer lines are for the interpreter, which has an alarm for them.
LONGEST_LINE = 4096
#: What `read_word` gives instead of a key: not plain, a block number.
NO_KEY, BLOCK_NUMBER = -1, -2
#: What `read_block` gives instead of a node: a line without a block.
NO_BLOCK = -1


class Tables(NamedTuple):
    """What a scan reads; see `layout`.

    Attributes:
        text: Bytes, whole lines.
        nexts: The shape tree, `(nodes, KEY_COUNT)`.
        leaves: For each node the number of its rule.
        rules: `(rules, Rule.SIZE)`.
        factors: `(rules, Factor.SIZE)`.
        formulas: What rules calculate, pairs of `Operation` and argument.
    """

    text: Bytes
    nexts: Ints32
    leaves: Ints32
    rules: Ints32
    factors: Floats
    formulas: Ints32


def scan(tables: Tables, state: State, columns: Columns) -> int:
    """Work off plain blocks from `scan.place` on; rows go into `columns`. Gives how it ended."""
    leaves, rules, factors = tables.leaves, tables.rules, tables.factors
    while state.scan.place < state.scan.end:
        if (
            state.scan.blocks >= state.scan.most_blocks
            or state.scan.rows + state.scan.notes >= state.scan.most_rows
        ):
            return Outcome.FULL
        place, node = read_block(tables, state)
        if place < 0 or place - state.scan.place > LONGEST_LINE:
            return Outcome.NOT_PLAIN
        if node != NO_BLOCK:
            leaf = leaves[node]
            if leaf < Leaf.FIRST_RULE:
                return Outcome.NOT_PLAIN if leaf == Leaf.NOT_PLAIN else Outcome.UNKNOWN
            notes = rules[leaf * Rule.SIZE + Rule.LEAVES_NOTE]
            if notes and state.scan.notes >= state.scan.most_notes:
                return Outcome.FULL
            formulas = rules[leaf * Rule.SIZE + Rule.FORMULAS]
            if formulas and not calculate(state, tables.formulas, formulas):
                return Outcome.NOT_PLAIN
            if notes and not note(state, rules, factors, leaf, columns):
                return Outcome.NOT_PLAIN
            if not act(state, rules, factors, leaf, columns):
                return Outcome.NOT_PLAIN
            state.scan.notes += notes
            state.scan.root = rules[leaf * Rule.SIZE + Rule.NEXT_STATE]
        if node != NO_BLOCK or not state.scan.grammar & Grammar.BLANK_LINES_ARE_NONE:
            state.scan.blocks += 1
        state.scan.place = place + 1
        state.scan.line += 1
    return Outcome.AT_END


def read_block(tables: Tables, state: State) -> tuple[int, int]:
    """Place of the line end behind the next block, -1 for one that is not plain, and the node of its shape."""
    text, nexts = tables.text, tables.nexts
    place, node = state.scan.place, state.scan.root
    keys = values = literals = 0
    is_block = False
    while True:
        char = int(text[place])
        if has_formula(text, place, state.scan.grammar):
            if keys == MOST_KEYS or values == MOST_WORDS:
                return -1, 0
            key = FIRST_FORMULA + char - LETTER_A
            is_block = True
            values += 1
            state.keys[keys] = key
            node = nexts[node * KEY_COUNT + key]
            place, node, keys, literals = read_formula(
                text, nexts, state, place + 1, node, keys + 1, literals
            )
            if place < 0:
                return -1, 0
            state.scan.keys = keys
        elif LETTER_A <= char <= LETTER_Z:
            place, key, value = read_word(text, place, state.scan.grammar, state.scan.most_digits)
            if key == NO_KEY or keys == MOST_KEYS or (key == BLOCK_NUMBER and is_block):
                return -1, 0
            is_block = True
            if key == BLOCK_NUMBER:
                continue
            if key < FIRST_CODE:
                if values == MOST_WORDS:
                    return -1, 0
                state.values[values] = value
                values += 1
            state.keys[keys] = key
            keys += 1
            state.scan.keys = keys
            node = nexts[node * KEY_COUNT + key]
        elif char in (BLANK, TAB):
            place += 1
        elif char == NEWLINE:
            break
        else:
            ends_block = char == SEMICOLON and not state.scan.grammar & Grammar.SEMICOLON_COMMENTS
            place = read_rest(text, place, state.scan.grammar)
            if place < 0:
                return -1, 0
            is_block = is_block or ends_block
    state.scan.keys = keys
    return place, node if is_block else NO_BLOCK


def has_formula(text: Bytes, place: int, grammar: int) -> bool:
    """Whether a word with a formula begins here; one that names a code is the interpreter's."""
    letter = int(text[place])
    if not grammar & Grammar.FORMULAS or letter < LETTER_A or letter > LETTER_Z:
        return False
    if letter in (LETTER_G, LETTER_M, LETTER_N, LETTER_O):
        return False
    return begins_formula(text, place + 1)


def read_word(text: Bytes, place: int, grammar: int, most_digits: int) -> tuple[int, int, float]:
    """Place behind the word that begins here, its key, and its value; `NO_KEY` where it is not plain."""
    letter = int(text[place])
    place += 1
    if letter in (LETTER_G, LETTER_N):
        number, digits = 0, 0
        while ZERO <= text[place] <= NINE:
            number = number * 10 + int(text[place]) - ZERO if digits < EXACT_DIGITS else LAST_CODE
            digits += 1
            place += 1
        if digits == 0 or (letter == LETTER_G and (number >= LAST_CODE or text[place] == POINT)):
            return place, NO_KEY, 0.0
        return place, BLOCK_NUMBER if letter == LETTER_N else FIRST_CODE + number, 0.0
    form = 0
    if (
        letter <= LETTER_C
        and grammar & Grammar.DIRECTIONS
        and text[place] == THREE
        and text[place + 1] == EQUALS_SIGN
    ):
        form = DIRECTION_FORM
        place += 2
    elif text[place] == EQUALS_SIGN and grammar & Grammar.EQUALS:
        form = 1
        place += 1
    elif letter == LETTER_C and text[place] == LETTER_R and grammar & Grammar.CR_RADIUS:
        if text[place + 1] != EQUALS_SIGN:
            return place, NO_KEY, 0.0
        form = CR_FORM
        place += 2
    place, value, decimals = read_number(text, place, most_digits)
    if place < 0:
        return place, NO_KEY, 0.0
    if grammar & Grammar.HEXADECIMAL and text[place] == LETTER_X and text[place - 1] == ZERO and value == 0.0:
        return place, NO_KEY, 0.0
    if form and decimals < 0 and value == 0.0:
        value = 0.0  # behind `=`, `-0` is a whole number and has no sign
    if decimals >= 0 and grammar & Grammar.FORMS_COUNT:
        form = 1 if decimals <= 3 else 2 if decimals == 4 else 3
    return place, (letter - LETTER_A) * FORMS + form, value


def read_rest(text: Bytes, place: int, grammar: int) -> int:
    """What is no word: a comment, or `;` with nothing but comments behind it. Place behind it, -1 for others."""
    if text[place] != SEMICOLON or grammar & Grammar.SEMICOLON_COMMENTS:
        return read_comment(text, place, grammar)
    place += 1
    while text[place] in (BLANK, TAB):
        place += 1
    if text[place] in (OPEN, SLASH):
        place = read_comment(text, place, grammar)
        while place >= 0 and text[place] in (BLANK, TAB):
            place += 1
    return place if place >= 0 and text[place] == NEWLINE else -1


def read_comment(text: Bytes, place: int, grammar: int) -> int:
    """Place behind the comment that begins here, -1 for none."""
    char = int(text[place])
    if char == OPEN and grammar & Grammar.ROUND_COMMENTS:
        starred = text[place + 1] == STAR and grammar & Grammar.STARRED_COMMENTS
        while text[place] not in (CLOSE, NEWLINE):
            place += 1
        if text[place] == CLOSE:
            return -1 if starred and text[place - 1] != STAR else place + 1
        return place if grammar & Grammar.OPEN_COMMENTS else -1
    slashes = char == SLASH and text[place + 1] == SLASH and grammar & Grammar.SLASH_COMMENTS
    if slashes or (char == SEMICOLON and grammar & Grammar.SEMICOLON_COMMENTS):
        while text[place] != NEWLINE:
            place += 1
        return place
    return -1
