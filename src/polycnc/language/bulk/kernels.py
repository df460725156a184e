"""The scanner: from the bytes of plain blocks to columns of the toolpath. Pure functions on arrays.

A block is read word by word while its *shape* (codes, addresses, how numbers were written; see
`language.word_address.words`) is followed down a tree: `nexts[node * KEY_COUNT + key]` is the next node, 0 for none
yet. The node at which the block ends tells in `leaves` which rule it follows; rules were drawn up from the control's
own plans (see `recipe`), so that a block does here exactly what it would do there. Nothing is changed until it is
certain that the whole block can be worked off: whatever could alarm, and whatever is in doubt, ends the scan in front
of the block, and the interpreter decides.

Numbers have up to 15 digits, so that mantissa and power of ten are exact and one division rounds correctly, as
`float(text)` does.
"""

from __future__ import annotations

from typing import NamedTuple

from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32
from polycnc.language.bulk.layout import (
    AT_END,
    BLANK_LINES_ARE_NONE,
    BLOCKS,
    CR_FORM,
    CR_RADIUS,
    END,
    EQUALS,
    FIRST_CODE,
    FIRST_KEY,
    FIRST_RULE,
    FORMS,
    FORMS_COUNT,
    FULL,
    GRAMMAR,
    HEXADECIMAL,
    KEY_COUNT,
    KEYS,
    LAST_CODE,
    LEAF_NOT_PLAIN,
    LEAVES_NOTE,
    LINE,
    MOST_BLOCKS,
    MOST_DIGITS,
    MOST_KEYS,
    MOST_NOTES,
    MOST_ROWS,
    NEXT_STATE,
    NOT_PLAIN,
    NOTES,
    OPEN_COMMENTS,
    PLACE,
    ROUND_COMMENTS,
    ROWS,
    RULE_WIDTH,
    SEMICOLON_COMMENTS,
    SLASH_COMMENTS,
    STARRED_COMMENTS,
    STATE,
    UNKNOWN,
    VALUES,
)
from polycnc.language.bulk.moves import Columns, act, note

NEWLINE, BLANK, TAB = 10, 32, 9
ZERO, NINE, LETTER_A, LETTER_C, LETTER_G, LETTER_N, LETTER_R, LETTER_X, LETTER_Z = (
    48,
    57,
    65,
    67,
    71,
    78,
    82,
    88,
    90,
)
PLUS, MINUS, POINT, EQUALS_SIGN, OPEN, CLOSE, SEMICOLON, SLASH, STAR = 43, 45, 46, 61, 40, 41, 59, 47, 42
#: Longer lines are for the interpreter, which has an alarm for them.
LONGEST_LINE = 4096
#: So many digits are exact.
EXACT_DIGITS = 15
POWERS = (1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15)
#: What `read_word` gives instead of a key: not plain, a block number.
NO_KEY, BLOCK_NUMBER = -1, -2
#: What `read_block` gives instead of a node: a line without a block.
NO_BLOCK = -1


class Tables(NamedTuple):
    """What a scan reads and carries on; see `layout`.

    Attributes:
        text: Bytes, whole lines.
        ints: Whole numbers of the scan.
        floats: Numbers of the scan.
        nexts: The shape tree, `(nodes, KEY_COUNT)`.
        leaves: For each node the number of its rule.
        rules: `(rules, RULE_WIDTH)`.
        factors: `(rules, FACTOR_WIDTH)`.
    """

    text: Bytes
    ints: Ints
    floats: Floats
    nexts: Ints32
    leaves: Ints32
    rules: Ints32
    factors: Floats


def scan(tables: Tables, columns: Columns) -> int:
    """Work off plain blocks from `PLACE` on; rows go into `columns`. Gives how it ended."""
    ints, floats, leaves = tables.ints, tables.floats, tables.leaves
    rules, factors = tables.rules, tables.factors
    while ints[PLACE] < ints[END]:
        if ints[BLOCKS] >= ints[MOST_BLOCKS] or ints[ROWS] + ints[NOTES] >= ints[MOST_ROWS]:
            return FULL
        place, node = read_block(tables)
        if place < 0 or place - ints[PLACE] > LONGEST_LINE:
            return NOT_PLAIN
        if node != NO_BLOCK:
            leaf = leaves[node]
            if leaf < FIRST_RULE:
                return NOT_PLAIN if leaf == LEAF_NOT_PLAIN else UNKNOWN
            notes = rules[leaf * RULE_WIDTH + LEAVES_NOTE]
            if notes and ints[NOTES] >= ints[MOST_NOTES]:
                return FULL
            if notes and not note(ints, floats, rules, factors, leaf, columns):
                return NOT_PLAIN
            if not act(ints, floats, rules, factors, leaf, columns):
                return NOT_PLAIN
            ints[NOTES] += notes
            ints[STATE] = rules[leaf * RULE_WIDTH + NEXT_STATE]
        if node != NO_BLOCK or not ints[GRAMMAR] & BLANK_LINES_ARE_NONE:
            ints[BLOCKS] += 1
        ints[PLACE] = place + 1
        ints[LINE] += 1
    return AT_END


def read_block(tables: Tables) -> tuple[int, int]:
    """Place of the line end behind the next block, -1 for one that is not plain, and the node of its shape."""
    text, ints, floats, nexts = tables.text, tables.ints, tables.floats, tables.nexts
    place, node = ints[PLACE], ints[STATE]
    keys = values = 0
    is_block = False
    while True:
        char = int(text[place])
        if LETTER_A <= char <= LETTER_Z:
            place, key, value = read_word(text, place, ints[GRAMMAR], ints[MOST_DIGITS])
            if key == NO_KEY or keys == MOST_KEYS or (key == BLOCK_NUMBER and is_block):
                return -1, 0
            is_block = True
            if key == BLOCK_NUMBER:
                continue
            if key < FIRST_CODE:
                floats[VALUES + values] = value
                values += 1
            ints[FIRST_KEY + keys] = key
            keys += 1
            ints[KEYS] = keys
            node = nexts[node * KEY_COUNT + key]
        elif char in (BLANK, TAB):
            place += 1
        elif char == NEWLINE:
            break
        else:
            ends_block = char == SEMICOLON and not ints[GRAMMAR] & SEMICOLON_COMMENTS
            place = read_rest(text, place, ints[GRAMMAR])
            if place < 0:
                return -1, 0
            is_block = is_block or ends_block
    ints[KEYS] = keys
    return place, node if is_block else NO_BLOCK


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
    if text[place] == EQUALS_SIGN and grammar & EQUALS:
        form = 1
        place += 1
    elif letter == LETTER_C and text[place] == LETTER_R and grammar & CR_RADIUS:
        if text[place + 1] != EQUALS_SIGN:
            return place, NO_KEY, 0.0
        form = CR_FORM
        place += 2
    place, value, decimals = read_number(text, place, most_digits)
    if place < 0:
        return place, NO_KEY, 0.0
    if grammar & HEXADECIMAL and text[place] == LETTER_X and text[place - 1] == ZERO and value == 0.0:
        return place, NO_KEY, 0.0
    if form and decimals < 0 and value == 0.0:
        value = 0.0  # behind `=`, `-0` is a whole number and has no sign
    if decimals >= 0 and grammar & FORMS_COUNT:
        form = 1 if decimals <= 3 else 2 if decimals == 4 else 3
    return place, (letter - LETTER_A) * FORMS + form, value


def read_number(text: Bytes, place: int, most_digits: int) -> tuple[int, float, int]:
    """Place behind the number that begins here, -1 for none; its value, and its decimals, -1 without a point."""
    negative = text[place] == MINUS
    if negative or text[place] == PLUS:
        place += 1
    mantissa, digits, significant, decimals = 0, 0, 0, -1
    while True:
        char = int(text[place])
        if ZERO <= char <= NINE:
            mantissa = mantissa * 10 + char - ZERO
            digits += 1
            significant += mantissa > 0
            decimals += decimals >= 0
            if digits > EXACT_DIGITS:
                return -1, 0.0, 0
        elif char == POINT and decimals < 0:
            decimals = 0
        else:
            break
        place += 1
    if digits == 0 or significant > most_digits:
        return -1, 0.0, 0
    value = mantissa / POWERS[min(max(decimals, 0), EXACT_DIGITS)]
    return place, -value if negative else value, decimals


def read_rest(text: Bytes, place: int, grammar: int) -> int:
    """What is no word: a comment, or `;` with nothing but comments behind it. Place behind it, -1 for others."""
    if text[place] != SEMICOLON or grammar & SEMICOLON_COMMENTS:
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
    if char == OPEN and grammar & ROUND_COMMENTS:
        starred = text[place + 1] == STAR and grammar & STARRED_COMMENTS
        while text[place] not in (CLOSE, NEWLINE):
            place += 1
        if text[place] == CLOSE:
            return -1 if starred and text[place - 1] != STAR else place + 1
        return place if grammar & OPEN_COMMENTS else -1
    slashes = char == SLASH and text[place + 1] == SLASH and grammar & SLASH_COMMENTS
    if slashes or (char == SEMICOLON and grammar & SEMICOLON_COMMENTS):
        while text[place] != NEWLINE:
            place += 1
        return place
    return -1
