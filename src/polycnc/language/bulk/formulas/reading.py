"""Formulas in words (`X[#1+2.5]`, `X=R1*2`): read as tokens of the shape tree. Pure functions on arrays."""

from __future__ import annotations

from polycnc.kernels.layout import Ints32, Text
from polycnc.language.bulk.layout import (
    ASSIGNED,
    FIRST_TOKEN,
    KEY_COUNT,
    MOST_KEYS,
    MOST_LITERALS,
    MOST_WORDS,
    State,
    Token,
)
from polycnc.language.bulk.numerals import BLANK, EXACT_DIGITS, NINE, POINT, TAB, ZERO, read_number

LETTER_A, LETTER_R, LETTER_Z = 65, 82, 90
HASH, STAR, PLUS, MINUS, SLASH, OPEN_BRACKET, CLOSE_BRACKET = 35, 42, 43, 45, 47, 91, 93
OPEN_ROUND, CLOSE_ROUND, COMMA, EQUALS_SIGN, SEMICOLON, NEWLINE = 40, 41, 44, 61, 59, 10
#: What `read_name` gives for other names.
NO_TOKEN = -1
#: Digits of a variable that is at hand, and of a whole number in an expression.
VARIABLE_DIGITS, WHOLE_DIGITS = 4, 9


def begins_formula(text: Text, place: int) -> bool:
    """Whether a formula begins here, with a sign or without."""
    if text[place] == PLUS or text[place] == MINUS:
        place += 1
    return text[place] == OPEN_BRACKET or text[place] == HASH


def read_formula(
    text: Text, nexts: Ints32, state: State, place: int, node: int, keys: int, literals: int
) -> tuple[int, int, int, int]:
    """Follow a formula down the shape tree.

    Args:
        text: Text, whole lines.
        nexts: The shape tree.
        state: Gets keys and numbers.
        place: Where it begins.
        node: Where the tree stands.
        keys: Keys of the block so far.
        literals: Numbers in its formulas so far.

    Returns:
        Place behind it, -1 where it is not plain; node, keys and numbers behind it.
    """
    depth = 0
    while True:
        char = int(text[place])
        if depth and char in (BLANK, TAB):
            place += 1
            continue
        place, token, value = read_token(text, place)
        if place < 0 or keys == MOST_KEYS or literals == MOST_LITERALS:
            return -1, 0, 0, 0
        inside = depth
        if token == Token.OPEN:
            depth += 1
        elif token == Token.CLOSE:
            depth -= 1
        elif token == Token.VARIABLE or token == Token.NUMBER:
            state.values[MOST_WORDS + literals] = value
            literals += 1
        begins = token <= Token.VARIABLE or token in (Token.PLUS, Token.MINUS, Token.NUMBERED)
        if depth < 0 or not (inside or begins):
            return -1, 0, 0, 0
        state.keys[keys] = FIRST_TOKEN + token
        keys += 1
        node = nexts[node * KEY_COUNT + FIRST_TOKEN + token]
        if depth == 0 and (token == Token.CLOSE or token == Token.VARIABLE):
            return place, node, keys, literals


def read_token(text: Text, place: int) -> tuple[int, int, float]:
    """Place behind a token, -1 for what is none; the token, and its number."""
    char = int(text[place])
    if ZERO <= char <= NINE or char == POINT:
        place, value, _ = read_number(text, place, EXACT_DIGITS)
        return place, Token.NUMBER, value
    if char == HASH and text[place + 1] == OPEN_BRACKET:
        return place + 1, Token.NUMBERED, 0.0
    if char == HASH:
        return read_variable(text, place + 1)
    if LETTER_A <= char <= LETTER_Z:
        token, letters = read_name(text, place)
        return (-1 if token == NO_TOKEN else place + letters), token, 0.0
    if char == OPEN_BRACKET:
        return place + 1, Token.OPEN, 0.0
    if char == CLOSE_BRACKET:
        return place + 1, Token.CLOSE, 0.0
    if char == PLUS:
        return place + 1, Token.PLUS, 0.0
    if char == MINUS:
        return place + 1, Token.MINUS, 0.0
    if char == STAR:
        return place + 1, Token.TIMES, 0.0
    if char == SLASH:
        return place + 1, Token.DIVIDED, 0.0
    if char == COMMA:
        return place + 1, Token.COMMA, 0.0
    return -1, 0, 0.0


def read_assignment(
    text: Text, nexts: Ints32, state: State, place: int, node: int
) -> tuple[int, int, int, int]:
    """Follow `#1=…` down the shape tree, to the end of its block; as `read_formula`."""
    place, _, value = read_variable(text, place + 1)
    state.values[MOST_WORDS] = value
    while place >= 0 and text[place] in (BLANK, TAB):
        place += 1
    if place < 0 or text[place] != EQUALS_SIGN:
        return -1, 0, 0, 0
    place += 1
    state.keys[0] = ASSIGNED
    node = nexts[node * KEY_COUNT + ASSIGNED]
    keys = literals = 1
    while True:
        char = int(text[place])
        if char in (BLANK, TAB):
            place += 1
            continue
        if char in (NEWLINE, SEMICOLON, OPEN_ROUND):
            return place, node, keys, literals
        place, token, value = read_token(text, place)
        if place < 0 or keys == MOST_KEYS or literals == MOST_LITERALS:
            return -1, 0, 0, 0
        if token == Token.VARIABLE or token == Token.NUMBER:
            state.values[MOST_WORDS + literals] = value
            literals += 1
        state.keys[keys] = FIRST_TOKEN + token
        keys += 1
        node = nexts[node * KEY_COUNT + FIRST_TOKEN + token]


def read_variable(text: Text, place: int) -> tuple[int, int, float]:
    """The number of a variable, behind its sign."""
    number = digits = 0
    while ZERO <= text[place] <= NINE and digits < VARIABLE_DIGITS:
        number = number * 10 + int(text[place]) - ZERO
        digits += 1
        place += 1
    if digits == 0 or ZERO <= text[place] <= NINE or text[place] == POINT:
        return -1, 0, 0.0
    return place, Token.VARIABLE, float(number)


def _spelt(name: str) -> int:
    """A name as one number, letter by letter."""
    number = 0
    for letter in name:
        number = number * 32 + ord(letter) - LETTER_A + 1
    return number


#: Names in custom macro B: how each is spelt, and its token; functions, behind which a bracket stands, and operators.
MACRO_FUNCTIONS: tuple[tuple[int, int], ...] = tuple(
    (_spelt(name), getattr(Token, name))
    for name in ("SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ABS", "SQRT", "ROUND", "FIX", "FUP")
)
MACRO_OPERATORS: tuple[tuple[int, int], ...] = tuple(
    (_spelt(name), getattr(Token, name)) for name in ("MOD", "AND", "OR", "XOR")
)
#: Letters of the longest of them.
MOST_LETTERS = 5


def read_name(text: Text, place: int) -> tuple[int, int]:
    """The function or operator whose name stands here in full, and how many letters it has."""
    letters, spelt = read_letters(text, place)
    token = NO_TOKEN
    if text[place + letters] == OPEN_BRACKET:
        for name, function in MACRO_FUNCTIONS:
            if spelt == name:
                token = function
    for name, operator in MACRO_OPERATORS:
        if spelt == name:
            token = operator
    return token, letters


def read_letters(text: Text, place: int) -> tuple[int, int]:
    """How many letters stand here, one more than the longest name at the most, and how they are spelt."""
    letters, spelt = 0, 0
    while LETTER_A <= text[place + letters] <= LETTER_Z and letters <= MOST_LETTERS:
        spelt = spelt * 32 + int(text[place + letters]) - LETTER_A + 1
        letters += 1
    return letters, spelt


# ---- expressions -----------------------------------------------------------------------------------------------------


def begins_expression(text: Text, place: int) -> bool:
    """Whether what stands behind `=` is more than a number with a sign."""
    while text[place] in (BLANK, TAB):
        place += 1
    if text[place] in (PLUS, MINUS):
        place += 1
    char = int(text[place])
    if not (ZERO <= char <= NINE or char == POINT):
        return True
    while ZERO <= text[place] <= NINE or text[place] == POINT:
        place += 1
    while text[place] in (BLANK, TAB):
        place += 1
    return text[place] in (PLUS, MINUS, STAR, SLASH)


def read_expression(
    text: Text, nexts: Ints32, state: State, place: int, node: int, keys: int, literals: int
) -> tuple[int, int, int, int]:
    """Follow an expression down the shape tree: operands and operators in turn; as `read_formula`."""
    depth = 0
    wants_operand = True
    while True:
        while text[place] in (BLANK, TAB):
            place += 1
        behind, token, value = read_expression_token(text, place)
        begins = token in (Token.OPEN, Token.VARIABLE, Token.NUMBER, Token.DECIMAL) or token >= Token.SIN
        if not wants_operand and depth == 0 and (behind < 0 or begins or token == Token.CLOSE):
            return place, node, keys, literals
        if behind < 0 or keys == MOST_KEYS or literals == MOST_LITERALS:
            return -1, 0, 0, 0
        is_sign = token in (Token.PLUS, Token.MINUS)
        if wants_operand != begins and not (wants_operand and is_sign):
            return -1, 0, 0, 0
        if token == Token.OPEN:
            depth += 1
        elif token == Token.CLOSE:
            depth -= 1
        elif token in (Token.VARIABLE, Token.NUMBER, Token.DECIMAL):
            state.values[MOST_WORDS + literals] = value
            literals += 1
        if token >= Token.SIN:
            depth += 1  # its bracket belongs to it
        wants_operand = token not in (Token.CLOSE, Token.VARIABLE, Token.NUMBER, Token.DECIMAL)
        state.keys[keys] = FIRST_TOKEN + token
        keys += 1
        node = nexts[node * KEY_COUNT + FIRST_TOKEN + token]
        place = behind


def read_expression_token(text: Text, place: int) -> tuple[int, int, float]:
    """As `read_token`; a function takes its bracket along."""
    char = int(text[place])
    if ZERO <= char <= NINE or char == POINT:
        behind, value, decimals = read_number(text, place, EXACT_DIGITS)
        if decimals < 0 and behind - place > WHOLE_DIGITS:
            return -1, 0, 0.0
        return behind, Token.NUMBER if decimals < 0 else Token.DECIMAL, value
    if char == LETTER_R and ZERO <= text[place + 1] <= NINE:
        return read_variable(text, place + 1)
    if LETTER_A <= char <= LETTER_Z:
        token, letters = read_function(text, place)
        return (-1 if token == NO_TOKEN else place + letters + 1), token, 0.0
    if char == OPEN_ROUND:
        return place + 1, Token.OPEN, 0.0
    if char == CLOSE_ROUND:
        return place + 1, Token.CLOSE, 0.0
    if char == PLUS:
        return place + 1, Token.PLUS, 0.0
    if char == MINUS:
        return place + 1, Token.MINUS, 0.0
    if char == STAR:
        return place + 1, Token.TIMES, 0.0
    if char == SLASH:
        return place + 1, Token.DIVIDED, 0.0
    return -1, 0, 0.0


#: The functions of one argument in brackets: how each is spelt, and its token.
FUNCTIONS: tuple[tuple[int, int], ...] = tuple(
    (_spelt(name), getattr(Token, name))
    for name in ("SIN", "COS", "TAN", "ABS", "SQRT", "POT", "ROUND", "TRUNC")
)


def read_function(text: Text, place: int) -> tuple[int, int]:
    """The function whose name stands here in full, with its bracket behind it, and how many letters it has."""
    letters, spelt = read_letters(text, place)
    token = NO_TOKEN
    for name, function in FUNCTIONS:
        if spelt == name:
            token = function
    return (token if text[place + letters] == OPEN_ROUND else NO_TOKEN), letters
