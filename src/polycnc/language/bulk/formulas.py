"""Formulas in words (`X[#1+2.5]`): read as tokens of the shape tree, calculated on a stack. Pure functions on arrays.

What could alarm or is no number (a division by zero, a root of less, a variable that is vacant where that means
something, one that lies elsewhere) ends the scan in front of the block.
"""

from __future__ import annotations

from math import copysign, cos, floor, nan, pi, sin, sqrt

from polycnc.kernels.layout import Bytes, Floats, Ints32
from polycnc.language.bulk.layout import (
    FIRST_TOKEN,
    KEY_COUNT,
    MOST_KEYS,
    MOST_LITERALS,
    MOST_WORDS,
    VARIABLES,
    Operation,
    State,
    Token,
)
from polycnc.language.bulk.numerals import BLANK, EXACT_DIGITS, NINE, POINT, TAB, ZERO, read_number

LETTER_A, LETTER_B, LETTER_C, LETTER_F, LETTER_I, LETTER_N, LETTER_O, LETTER_P, LETTER_Q, LETTER_R = (
    65, 66, 67, 70, 73, 78, 79, 80, 81, 82
)  # fmt: skip
LETTER_S, LETTER_T, LETTER_U, LETTER_X, LETTER_Z = 83, 84, 85, 88, 90
HASH, STAR, PLUS, MINUS, SLASH, OPEN_BRACKET, CLOSE_BRACKET = 35, 42, 43, 45, 47, 91, 93
#: What `read_name` gives for other names.
NO_TOKEN = -1
#: Digits of a variable that is at hand.
VARIABLE_DIGITS = 4
#: Numbers beyond this are the interpreter's; those of words are far smaller.
LARGEST, LARGEST_WORD, LARGEST_WHOLE = 1e300, 1e9, 1e15
RADIANS = pi / 180.0
#: Results this close to the next whole number count as it (`language.word_address.functions.GUARD`).
GUARD = 1e-9


def begins_formula(text: Bytes, place: int) -> bool:
    """Whether a formula begins here, with a sign or without."""
    if text[place] == PLUS or text[place] == MINUS:
        place += 1
    return text[place] == OPEN_BRACKET or text[place] == HASH


def read_formula(
    text: Bytes, nexts: Ints32, state: State, place: int, node: int, keys: int, literals: int
) -> tuple[int, int, int, int]:
    """Follow a formula down the shape tree.

    Args:
        text: Bytes, whole lines.
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
        if depth < 0 or (
            not inside and token > Token.VARIABLE and token != Token.PLUS and token != Token.MINUS
        ):
            return -1, 0, 0, 0
        state.keys[keys] = FIRST_TOKEN + token
        keys += 1
        node = nexts[node * KEY_COUNT + FIRST_TOKEN + token]
        if depth == 0 and (token == Token.CLOSE or token == Token.VARIABLE):
            return place, node, keys, literals


def read_token(text: Bytes, place: int) -> tuple[int, int, float]:
    """Place behind a token, -1 for what is none; the token, and its number."""
    char = int(text[place])
    if ZERO <= char <= NINE or char == POINT:
        place, value, _ = read_number(text, place, EXACT_DIGITS)
        return place, Token.NUMBER, value
    if char == HASH:
        return read_variable(text, place + 1)
    if LETTER_A <= char <= LETTER_Z:
        token = read_name(text, place)
        if token == NO_TOKEN:
            return -1, 0, 0.0
        return place + (4 if token == Token.SQRT else 3), token, 0.0
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
    return -1, 0, 0.0


def read_variable(text: Bytes, place: int) -> tuple[int, int, float]:
    """The number of a variable, behind its sign."""
    number = digits = 0
    while ZERO <= text[place] <= NINE and digits < VARIABLE_DIGITS:
        number = number * 10 + int(text[place]) - ZERO
        digits += 1
        place += 1
    if digits == 0 or ZERO <= text[place] <= NINE or text[place] == POINT:
        return -1, 0, 0.0
    return place, Token.VARIABLE, float(number)


def read_name(text: Bytes, place: int) -> int:
    """The function whose name stands here in full; its bracket must follow."""
    one = int(text[place])
    two = int(text[place + 1]) if one >= LETTER_A else 0
    three = int(text[place + 2]) if two >= LETTER_A else 0
    four = int(text[place + 3]) if three >= LETTER_A else 0
    token = NO_TOKEN
    if one == LETTER_S and two == LETTER_I and three == LETTER_N:
        token = Token.SIN
    elif one == LETTER_C and two == LETTER_O and three == LETTER_S:
        token = Token.COS
    elif one == LETTER_A and two == LETTER_B and three == LETTER_S:
        token = Token.ABS
    elif one == LETTER_F and two == LETTER_I and three == LETTER_X:
        token = Token.FIX
    elif one == LETTER_F and two == LETTER_U and three == LETTER_P:
        token = Token.FUP
    elif one == LETTER_S and two == LETTER_Q and three == LETTER_R and four == LETTER_T:
        return Token.SQRT if text[place + 4] == OPEN_BRACKET else NO_TOKEN
    return token if four == OPEN_BRACKET else NO_TOKEN


def calculate(state: State, formulas: Ints32, first: int) -> bool:
    """Work out the formulas of a block; false where the interpreter must."""
    stack, values = state.stack, state.values
    at, top = first, 0
    while formulas[at] != Operation.END:
        operation, argument = formulas[at], formulas[at + 1]
        at += 2
        if operation >= Operation.NUMBER and operation <= Operation.VACANT:
            possible, stack[top] = operand(state, operation, argument)
            if not possible:
                return False
            top += 1
        elif operation == Operation.STORE:
            top -= 1
            if not abs(stack[top]) <= LARGEST_WORD:
                return False
            values[argument] = stack[top]
        elif operation == Operation.ASSIGN:
            top -= 1
            found, _ = variable(state.variables, values[MOST_WORDS + argument])
            if not found:
                return False
            state.variables[int(values[MOST_WORDS + argument])] = stack[top]
        elif operation == Operation.UNLESS:
            top -= 1
            if stack[top] == 0.0:
                return True
        elif operation < Operation.ADD:
            possible, stack[top - 1] = applied_to_one(operation, stack[top - 1])
            if not possible:
                return False
        else:
            top -= 1
            possible, stack[top - 1] = applied(operation, stack[top - 1], stack[top])
            if not possible:
                return False
    return True


def operand(state: State, operation: int, argument: int) -> tuple[bool, float]:
    """What comes onto the stack, and whether it may."""
    if operation == Operation.VACANT:
        return True, nan
    value = state.values[MOST_WORDS + argument]
    if operation == Operation.NUMBER:
        return True, value
    found, value = variable(state.variables, value)
    vacant = value != value
    if operation == Operation.VARIABLE_OR_ZERO and (vacant or value == 0.0):
        value = 0.0
    return found and not (vacant and operation == Operation.VARIABLE), value


def variable(variables: Floats, number: float) -> tuple[bool, float]:
    """Whether a variable lies here, and its value."""
    place = int(number)
    if place >= VARIABLES:
        return False, 0.0
    value = variables[place]
    return not abs(value) > LARGEST, value


def applied_to_one(operation: int, x: float) -> tuple[bool, float]:
    """A sign or a function of a number, and whether it has a value."""
    if operation == Operation.NEGATIVE:
        return True, -x
    if operation == Operation.ABS:
        return True, abs(x)
    if operation == Operation.SQRT:
        return x >= 0.0, sqrt(x) if x >= 0.0 else 0.0
    if not abs(x) <= LARGEST_WHOLE:
        return False, 0.0
    if operation == Operation.SIN:
        return True, sine(x)
    if operation == Operation.COS:
        return True, cosine(x)
    if x == 0.0:
        return True, 0.0
    if operation == Operation.FIX:
        return True, copysign(float(floor(abs(x) + GUARD)), x)
    return True, copysign(float(-floor(GUARD - abs(x))), x)


def sine(x: float) -> float:
    """Sine of degrees, exact at multiples of 90."""
    quarters = float(floor(x / 90.0 + 0.5))
    if x != quarters * 90.0:
        return sin(x * RADIANS)
    quarter = quarters - 4.0 * float(floor(quarters / 4.0))
    return 0.0 if quarter == 0.0 or quarter == 2.0 else 2.0 - quarter


def cosine(x: float) -> float:
    """Cosine of degrees, exact at multiples of 90."""
    quarters = float(floor(x / 90.0 + 0.5))
    if x != quarters * 90.0:
        return cos(x * RADIANS)
    quarter = quarters - 4.0 * float(floor(quarters / 4.0))
    return 0.0 if quarter == 1.0 or quarter == 3.0 else 1.0 - quarter


def applied(operation: int, a: float, b: float) -> tuple[bool, float]:
    """An operator between two numbers, and whether it has a value that is a number (1 or 0 of a comparison)."""
    if operation == Operation.ADD:
        value = a + b
    elif operation == Operation.SUBTRACT:
        value = a - b
    elif operation == Operation.MULTIPLY:
        value = a * b
    elif operation == Operation.DIVIDE:
        if b == 0.0:
            return False, 0.0
        value = a / b
    else:
        return True, 1.0 if compared(operation, a, b) else 0.0
    return abs(value) <= LARGEST, value


def compared(operation: int, a: float, b: float) -> bool:
    """Whether a comparison between two numbers holds; what is vacant is no number, and equal to its like only."""
    if operation == Operation.EQUAL or operation == Operation.NOT_EQUAL:
        equal = a == b or (a != a and b != b)
        return equal == (operation == Operation.EQUAL)
    if operation == Operation.GREATER:
        return a > b
    if operation == Operation.GREATER_OR_EQUAL:
        return a >= b
    if operation == Operation.LESS:
        return a < b
    return a <= b
