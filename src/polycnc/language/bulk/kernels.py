"""The scanner: from the bytes of plain blocks to columns of the toolpath. Pure functions on arrays.

A block is read word by word while its *shape* (codes, addresses, how numbers were written; see
`language.word_address.words`) is followed down a tree: `nexts[node * KEY_COUNT + key]` is the next node, 0 for none
yet. The node at which the block ends tells in `leaves` which rule it follows; rules were drawn up from the control's
own plans (see `recipe`), so that a block does here exactly what it would do there. Nothing is changed until it is
certain that the whole block can be worked off: whatever could alarm, and whatever is in doubt, ends the scan in front
of the block, and the interpreter decides.
"""

from __future__ import annotations

from polycnc.kernels.layout import Ints32, Text
from polycnc.language.bulk.formulas.calculating import calculate
from polycnc.language.bulk.formulas.reading import (
    begins_expression,
    begins_formula,
    read_assignment,
    read_expression,
    read_formula,
    read_variable,
)
from polycnc.language.bulk.layout import (
    ASSIGNED,
    CR_FORM,
    CR_FORMULA,
    DIRECTION_FORM,
    FIRST_CODE,
    FIRST_FORMULA,
    FIRST_M_CODE,
    FORMS,
    KEY_COUNT,
    LAST_CODE,
    LAST_M_CODE,
    MOST_KEYS,
    MOST_LITERALS,
    MOST_WORDS,
    PLAIN_MARK,
    Columns,
    Factor,
    Grammar,
    Leaf,
    Outcome,
    Rule,
    State,
    Strokes,
    Tables,
)
from polycnc.language.bulk.moves import act, note
from polycnc.language.bulk.numerals import BLANK, EXACT_DIGITS, NINE, POINT, TAB, ZERO, read_number
from polycnc.language.bulk.routines.flow import (
    CALLS,
    ENDS,
    REFUSED,
    RETURNS,
    call,
    flow,
    leave,
    may_flow,
    take_line,
)
from polycnc.language.bulk.routines.layout import NO_ROUTINE

NEWLINE, THREE = 10, 51
LETTER_A, LETTER_C, LETTER_G, LETTER_M, LETTER_N, LETTER_O, LETTER_R, LETTER_X, LETTER_Z = (
    65, 67, 71, 77, 78, 79, 82, 88, 90
)  # fmt: skip
EQUALS_SIGN, OPEN, CLOSE, SEMICOLON, SLASH, STAR, HASH = 61, 40, 41, 59, 47, 42, 35
#: Longer lines are for the interpreter, which has an alarm for them.
LONGEST_LINE = 4096
#: What `read_word` gives instead of a key: not plain.
NO_KEY = -1
#: What `read_block` gives instead of a node: a line without a block.
NO_BLOCK = -1


def scan(tables: Tables, state: State, columns: Columns) -> int:
    """Work off plain blocks from `scan.place` on, or in a routine; rows go into `columns`. Gives how it ended."""
    while state.scan.routine != NO_ROUTINE or state.scan.place < state.scan.end:
        if is_full(state):
            return Outcome.FULL
        in_text, place, step = state.scan.routine == NO_ROUTINE, 0, 0
        if in_text:
            place, node = read_block(tables, state)
            if place < 0 or place - state.scan.place > LONGEST_LINE:
                return Outcome.NOT_PLAIN
            state.scan.block_line = state.scan.line
        else:
            step = state.scan.index
            node = take_line(tables, state)
            if node <= REFUSED:
                return Outcome.NOT_PLAIN if node == REFUSED else Outcome.UNREAD
        if node >= 0:
            outcome = work_off(tables, state, columns, node)
            if outcome != Outcome.GOES_ON:
                return outcome
        if in_text:
            state.scan.place = place + 1
            state.scan.line += 1
        else:
            state.scan.current = step
            state.scan.index += 1
        is_counted = node >= 0 or not in_text or not state.scan.grammar & Grammar.BLANK_LINES_ARE_NONE
        state.scan.blocks += is_counted and node != ENDS
        if node == CALLS:
            call(tables, state)
        elif node <= RETURNS:
            leave(tables, state)
        elif node >= 0:
            leaf = tables.leaves[node]
            if tables.rules[leaf * Rule.SIZE + Rule.FLOW]:
                flow(tables, state, leaf * Rule.SIZE, leaf * Factor.SIZE)
    return Outcome.AT_END


def is_full(state: State) -> bool:
    """Whether there may be no room for what the next block gives. A hole that does not fit at all is no matter."""
    rows = state.scan.rows + state.scan.notes
    if rows and state.strokes[Strokes.COUNT] > 0.0:
        rows += int(state.strokes[Strokes.COUNT])
    return (
        state.scan.blocks >= state.scan.most_blocks
        or rows >= state.scan.most_rows
        or state.scan.curves >= state.scan.most_curves
    )


def work_off(tables: Tables, state: State, columns: Columns, node: int) -> int:
    """Do what a block of a shape does, but for calls and returns; gives `GOES_ON`, or how the scan ends."""
    leaf, rules, factors = tables.leaves[node], tables.rules, tables.factors
    if leaf < Leaf.FIRST_RULE:
        return Outcome.NOT_PLAIN if leaf == Leaf.NOT_PLAIN else Outcome.UNKNOWN
    rule = leaf * Rule.SIZE
    notes = rules[rule + Rule.LEAVES_NOTE]
    if notes and state.scan.frames:
        return Outcome.NOT_PLAIN  # its step would ask for the level of the program
    if notes and state.scan.notes >= state.scan.most_notes:
        return Outcome.FULL
    formulas = rules[rule + Rule.FORMULAS]
    if formulas and not calculate(state, tables.formulas, formulas):
        return Outcome.NOT_PLAIN
    if rules[rule + Rule.FLOW]:
        outcome = may_flow(tables, state, rule, leaf * Factor.SIZE)
        if outcome != Outcome.GOES_ON:
            return outcome
    if notes and not note(state, rules, factors, leaf, columns):
        return Outcome.NOT_PLAIN
    if not act(state, rules, factors, leaf, columns):
        return Outcome.NOT_PLAIN
    state.scan.notes += notes
    state.scan.root = rules[rule + Rule.NEXT_STATE]
    return Outcome.GOES_ON


def read_block(tables: Tables, state: State) -> tuple[int, int]:
    """Place of the line end behind the next block, -1 for one that is not plain, and the node of its shape."""
    text, grammar = tables.text, state.scan.grammar
    place, levels, is_numbered = read_head(text, state.scan.place, grammar)
    if place < 0 or (levels and state.scan.skipped < 0):
        return -1, 0
    if text[place] == HASH and grammar & Grammar.FORMULAS:
        place, node, keys, literals = read_assignment(text, tables.nexts, state, place, state.scan.root)
        if place < 0:
            return -1, 0
        place, node, is_block = read_words(text, tables.nexts, state, place, node, keys, literals)
        is_block = True
    else:
        place, node, is_block = read_words(text, tables.nexts, state, place, state.scan.root, 0, 0)
    if place >= 0 and levels & state.scan.skipped:
        if grammar & Grammar.BLANK_LINES_ARE_NONE:
            return -1, 0
        # What is wrong in a block that is left out is an alarm all the same: it is passed by once its shape is known.
        return place, NO_BLOCK if tables.leaves[node] >= Leaf.FIRST_RULE else node
    return place, node if is_block or levels or is_numbered else NO_BLOCK


def read_words(
    text: Text, nexts: Ints32, state: State, place: int, node: int, keys: int, literals: int
) -> tuple[int, int, bool]:
    """Follow the words of a block down the shape tree.

    Returns:
        Place of the line end, -1 where it is not plain; the node, and whether there is a word or an end of a block.
    """
    values = 0
    is_block = False
    while True:
        char = int(text[place])
        if has_formula(text, place, state.scan.grammar):
            if keys == MOST_KEYS or values == MOST_WORDS:
                return -1, 0, False
            is_block = True
            place, node, keys, literals = read_calculated(text, nexts, state, place, node, keys, literals)
            if place < 0:
                return -1, 0, False
            values += state.keys[state.scan.keys] != ASSIGNED
            state.scan.keys = keys
        elif LETTER_A <= char <= LETTER_Z:
            place, key, value = read_word(text, place, state.scan.grammar, state.scan.most_digits)
            if key == NO_KEY or keys == MOST_KEYS:
                return -1, 0, False
            is_block = True
            if key < FIRST_CODE:
                if values == MOST_WORDS:
                    return -1, 0, False
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
                return -1, 0, False
            is_block = is_block or ends_block
    state.scan.keys = keys
    return place, node, is_block


def read_head(text: Text, place: int, grammar: int) -> tuple[int, int, bool]:
    """Place behind a mark of block skip and a block number, -1 where these are not plain; the level, by its bit.

    Then whether there is a number.
    """
    levels, is_numbered = 0, False
    while True:
        char = int(text[place])
        if char in (BLANK, TAB):
            place += 1
        elif char == LETTER_N and not is_numbered and ZERO <= text[place + 1] <= NINE:
            is_numbered = True
            place += 1
            while ZERO <= text[place] <= NINE:
                place += 1
        elif char == SLASH and levels == 0 and text[place + 1] != SLASH:
            if is_numbered and grammar & Grammar.BLANK_LINES_ARE_NONE:
                return -1, 0, False
            place, levels = read_mark(text, place + 1)
        else:
            return place, levels, is_numbered


def read_mark(text: Text, place: int) -> tuple[int, int]:
    """Place behind a mark of block skip, whose slash is read, and its level by its bit."""
    if ZERO <= text[place] <= NINE:
        return place + 1, 1 << (int(text[place]) - ZERO)
    return place, 1 << PLAIN_MARK


def has_formula(text: Text, place: int, grammar: int) -> bool:
    """Whether a word with a formula begins here; one that names a code is the interpreter's."""
    letter = int(text[place])
    if letter < LETTER_A or letter > LETTER_Z:
        return False
    if grammar & Grammar.EXPRESSIONS:
        return begins_word(text, place)
    if not grammar & Grammar.FORMULAS or letter in (LETTER_G, LETTER_M, LETTER_N, LETTER_O):
        return False
    return begins_formula(text, place + 1)


def read_calculated(
    text: Text, nexts: Ints32, state: State, place: int, node: int, keys: int, literals: int
) -> tuple[int, int, int, int]:
    """Follow a word with a formula down the shape tree; as `read_formula`. Its key is that at `scan.keys`."""
    expressions = state.scan.grammar & Grammar.EXPRESSIONS
    key = FIRST_FORMULA + int(text[place]) - LETTER_A
    place += 1
    if expressions:
        place, key, literals = read_address(text, state, place - 1, literals)
        if place < 0:
            return -1, 0, 0, 0
    state.keys[keys] = key
    state.scan.keys = keys
    node = nexts[node * KEY_COUNT + key]
    if expressions:
        return read_expression(text, nexts, state, place, node, keys + 1, literals)
    return read_formula(text, nexts, state, place, node, keys + 1, literals)


def begins_word(text: Text, place: int) -> bool:
    """Whether a word with an expression begins here: `X=R1`, `CR=R1`, or an assignment `R1=…`."""
    letter, behind = int(text[place]), int(text[place + 1])
    if letter == LETTER_R and ZERO <= behind <= NINE:
        return True
    if letter == LETTER_C and behind == LETTER_R and text[place + 2] == EQUALS_SIGN:
        return begins_expression(text, place + 3)
    return behind == EQUALS_SIGN and begins_expression(text, place + 2)


def read_address(text: Text, state: State, place: int, literals: int) -> tuple[int, int, int]:
    """Place behind the `=` of a word with an expression, -1 for none; its key, and how many numbers there are then."""
    letter = int(text[place])
    if letter == LETTER_R and text[place + 1] != EQUALS_SIGN:
        place, _, value = read_variable(text, place + 1)
        while place >= 0 and text[place] in (BLANK, TAB):
            place += 1
        if place < 0 or text[place] != EQUALS_SIGN or literals == MOST_LITERALS:
            return -1, 0, 0
        state.values[MOST_WORDS + literals] = value
        return place + 1, ASSIGNED, literals + 1
    is_radius = letter == LETTER_C and text[place + 1] == LETTER_R
    return (
        place + 2 + is_radius,
        CR_FORMULA if is_radius else FIRST_FORMULA + letter - LETTER_A,
        literals,
    )


def read_word(text: Text, place: int, grammar: int, most_digits: int) -> tuple[int, int, float]:
    """Place behind the word that begins here, its key, and its value; `NO_KEY` where it is not plain."""
    letter = int(text[place])
    place += 1
    if letter == LETTER_N:
        return place, NO_KEY, 0.0  # it stands at the head
    if letter == LETTER_G or (letter == LETTER_M and grammar & Grammar.M_CODES):
        number, digits = 0, 0
        while ZERO <= text[place] <= NINE:
            number = number * 10 + int(text[place]) - ZERO if digits < EXACT_DIGITS else LAST_CODE
            digits += 1
            place += 1
        last = LAST_CODE if letter == LETTER_G else LAST_M_CODE
        if digits == 0 or number >= last or text[place] == POINT:
            return place, NO_KEY, 0.0
        return place, (FIRST_CODE if letter == LETTER_G else FIRST_M_CODE) + number, 0.0
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


def read_rest(text: Text, place: int, grammar: int) -> int:
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


def read_comment(text: Text, place: int, grammar: int) -> int:
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
