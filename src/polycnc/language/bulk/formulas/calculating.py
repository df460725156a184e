"""Formulas, calculated on a stack. Pure functions on arrays.

What could alarm or is no number (a division by zero, a root of less, a variable that is vacant where that means
something, one that lies elsewhere) ends the scan in front of the block.
"""

from __future__ import annotations

from math import acos, asin, atan, atan2, copysign, cos, floor, nan, pi, sin, sqrt, tan

from polycnc.kernels.layout import Ints32
from polycnc.language.bulk.layout import CHANGES, MOST_WORDS, STACK, Operation, State

#: Numbers beyond this are the interpreter's; those of words are far smaller.
LARGEST, LARGEST_WORD, LARGEST_WHOLE = 1e300, 1e9, 1e15
RADIANS, DEGREES = pi / 180.0, 180.0 / pi
#: The range of INT; numbers below this have whole quotients of INT.
LEAST_INTEGER, GREATEST_INTEGER, WHOLE_QUOTIENTS = -(2.0**31), 2.0**31 - 1.0, 2.0**31
#: Numbers this close to each other, as a part of the greater one, count as equal where that is asked.
NEAR = 1e-12
#: Results this close to the next whole number count as it (`language.word_address.functions.GUARD`).
GUARD = 1e-9


def calculate(state: State, formulas: Ints32, first: int) -> bool:
    """Work out the formulas of a block; false, and no variable changed, where the interpreter must."""
    at, top = first, 0
    state.scan.changes = 0
    while formulas[at] != Operation.END:
        operation, argument = formulas[at], formulas[at + 1]
        at += 2
        if operation == Operation.UNLESS:
            top -= 1
            if state.stack[top] == 0.0:
                return True
            continue
        top = carried_out(state, operation, argument, top)
        if top < 0:
            take_back(state)
            return False
    return True


def carried_out(state: State, operation: int, argument: int, top: int) -> int:
    """Carry out one operation; gives how many values are on the stack then, -1 where the interpreter must."""
    stack = state.stack
    if operation <= Operation.HELD:
        possible, stack[top] = operand(state, operation, argument)
        top += 1
    elif operation == Operation.HOLD:
        possible = True
        stack[STACK + argument] = stack[top - 1]
    elif operation == Operation.STORE:
        top -= 1
        possible = abs(stack[top]) <= LARGEST_WORD
        state.values[argument] = stack[top]
    elif operation == Operation.ASSIGN:
        top -= 1
        number = state.values[MOST_WORDS + argument]
        possible, _ = variable(state, number)
        possible = possible and change(state, int(number), stack[top])
    elif operation == Operation.ASSIGN_NUMBERED:
        top -= 2
        number = half_away(stack[top])
        possible = abs(stack[top]) <= LARGEST_WORD
        if possible:
            possible, _ = variable(state, number)
        possible = possible and change(state, int(number), stack[top + 1])
    elif operation == Operation.PUT:
        top -= 1
        possible = abs(state.variables[argument]) <= LARGEST and change(state, argument, stack[top])
    elif operation == Operation.PUT_ELEMENT:
        top -= 2
        place = argument + int(stack[top + 1])
        possible = abs(state.variables[place]) <= LARGEST and change(state, place, stack[top])
    elif operation <= Operation.INTEGER:
        possible, stack[top - 1] = indexed(state, operation, argument, stack[top - 1])
    elif operation < Operation.ADD:
        possible, stack[top - 1] = applied_to_one(operation, stack[top - 1])
    else:
        top -= 1
        possible, stack[top - 1] = applied(operation, stack[top - 1], stack[top])
    return top if possible else -1


def change(state: State, place: int, value: float) -> bool:
    """Give the variable at a place a value; false where the line has changed too many."""
    changes, changed = state.scan.changes, state.changed
    if changes >= CHANGES:
        return False
    changed[2 * changes], changed[2 * changes + 1] = float(place), state.variables[place]
    state.scan.changes = changes + 1
    state.variables[place] = value
    return True


def take_back(state: State) -> None:
    """Variables are as they were before the line."""
    for i in range(state.scan.changes - 1, -1, -1):
        state.variables[int(state.changed[2 * i])] = state.changed[2 * i + 1]
    state.scan.changes = 0


def operand(state: State, operation: int, argument: int) -> tuple[bool, float]:
    """What comes onto the stack, and whether it may."""
    if operation == Operation.ARGUMENT:
        return True, float(argument)
    if operation == Operation.HELD:
        return True, state.stack[STACK + argument]
    if operation == Operation.PLACE:
        value = state.variables[argument]
        return abs(value) <= LARGEST, value
    if operation == Operation.VACANT:
        return True, nan
    value = state.values[MOST_WORDS + argument]
    if operation == Operation.NUMBER:
        return True, value
    found, value = variable(state, value)
    vacant = value != value
    if operation == Operation.VARIABLE_OR_ZERO and (vacant or value == 0.0):
        value = 0.0
    return found and not (vacant and operation == Operation.VARIABLE), value


def variable(state: State, number: float) -> tuple[bool, float]:
    """Whether a variable lies here, and its value."""
    place = int(number)
    if place < 0 or place >= state.scan.numbered:
        return False, 0.0
    value = state.variables[place]
    return not abs(value) > LARGEST, value


def indexed(state: State, operation: int, argument: int, x: float) -> tuple[bool, float]:
    """A variable by its number, an element by its index, an index or a whole number, and whether it is one."""
    if operation <= Operation.NUMBERED_OR_VACANT:
        if not abs(x) <= LARGEST_WORD:
            return False, 0.0
        found, value = variable(state, half_away(x))
        vacant = value != value
        if operation == Operation.NUMBERED_OR_ZERO and (vacant or value == 0.0):
            value = 0.0
        return found and not (vacant and operation == Operation.NUMBERED), value
    if operation == Operation.ELEMENT:
        value = state.variables[argument + int(x)]
        return abs(value) <= LARGEST, value
    if operation == Operation.WITHIN:
        return x >= 0.0 and x < argument, x
    if operation == Operation.EXACT:
        return abs(x) <= LARGEST_WHOLE, x + 0.0  # a whole number zero has no sign
    return x >= LEAST_INTEGER and x <= GREATEST_INTEGER, x


def applied_to_one(operation: int, x: float) -> tuple[bool, float]:
    """A sign or a function of a number, and whether it has a value."""
    if operation == Operation.NEGATIVE:
        return True, -x
    if operation == Operation.NOT:
        return True, 1.0 if x == 0.0 else 0.0
    if operation == Operation.ABS:
        return True, abs(x)
    if operation == Operation.SQRT:
        return x >= 0.0, sqrt(x) if x >= 0.0 else 0.0
    if operation == Operation.SQUARE:
        return x * x <= LARGEST, x * x
    if operation == Operation.ASIN or operation == Operation.ACOS:
        if not abs(x) <= 1.0:
            return False, 0.0
        return True, (asin(x) if operation == Operation.ASIN else acos(x)) * DEGREES
    if operation == Operation.ATAN:
        return True, atan(x) * DEGREES
    if operation == Operation.TURN:
        return True, x if x >= 0.0 else x + 360.0
    if not abs(x) <= LARGEST_WHOLE:
        return False, 0.0
    if operation == Operation.SIN:
        return True, sine(x)
    if operation == Operation.COS:
        return True, cosine(x)
    if operation == Operation.TANGENT:
        return tangent(x)
    if operation == Operation.TAN:
        return x != 90.0 * float(floor(x / 90.0 + 0.5)), tan(x * RADIANS)
    return True, made_whole(operation, x)


def made_whole(operation: int, x: float) -> float:
    """A number without its fraction; by the functions without a guard zero has no sign."""
    if operation == Operation.TRUNC:
        return copysign(float(floor(abs(x))), x) + 0.0
    if operation == Operation.ROUND:
        return float(floor(x + 0.5)) + 0.0
    if operation == Operation.CEIL:
        return 0.0 - float(floor(-x))
    if operation == Operation.HALF_AWAY:
        return half_away(x)
    if x == 0.0:
        return 0.0
    if operation == Operation.FIX:
        return copysign(float(floor(abs(x) + GUARD)), x)
    return copysign(float(-floor(GUARD - abs(x))), x)


def half_away(x: float) -> float:
    """As `language.word_address.functions.round_half_away`."""
    return copysign(float(floor(abs(x) * (1.0 + 1e-12) + 0.5 + GUARD)), x) if x != 0.0 else 0.0


def tangent(x: float) -> tuple[bool, float]:
    """Tangent of degrees, exact at multiples of 90, and whether there is one."""
    if x % 90.0 == 0.0:
        c, s = cosine(x), sine(x)
    else:
        angle = (x % 360.0) * RADIANS
        c, s = cos(angle), sin(angle)
    return c != 0.0, s / c if c != 0.0 else 0.0


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
    if operation >= Operation.AND:
        return True, 1.0 if compared(operation, a, b) else 0.0
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
    elif operation == Operation.ATAN2:
        value = atan2(a, b) * DEGREES
    elif operation <= Operation.BITS_XOR and operation >= Operation.MODULO:
        return combined(operation, a, b)
    elif operation == Operation.LESSER:
        value = min(a, b)
    elif operation == Operation.GREATER_ONE:
        value = max(a, b)
    else:
        return divided(operation, a, b)
    return abs(value) <= LARGEST, value


def combined(operation: int, a: float, b: float) -> tuple[bool, float]:
    """Remainder and bits of rounded numbers, as custom macro B has them, and whether there is a result."""
    if not (abs(a) <= LARGEST_WHOLE and abs(b) <= LARGEST_WHOLE):
        return False, 0.0
    x, y = int(half_away(a)), int(half_away(b))
    if operation == Operation.BITS_AND:
        return True, float(x & y)
    if operation == Operation.BITS_OR:
        return True, float(x | y)
    if operation == Operation.BITS_XOR:
        return True, float(x ^ y)
    if y == 0:
        return False, 0.0
    if x == 0:
        return True, 0.0 if y > 0 else -0.0
    return True, copysign(float(abs(x) % abs(y)), float(x))


def divided(operation: int, a: float, b: float) -> tuple[bool, float]:
    """The whole part of a quotient, or the remainder, and whether there is one."""
    if b == 0.0:
        return False, 0.0
    if operation == Operation.REMAINDER:
        rest = copysign(abs(a) % abs(b), a)
        return True, rest + 0.0 if a >= 0.0 and b > 0.0 else rest
    if not (abs(a) < WHOLE_QUOTIENTS and abs(b) < WHOLE_QUOTIENTS):
        return False, 0.0
    quotient = a / b
    return abs(quotient) <= LARGEST_WHOLE, copysign(float(floor(abs(quotient))), quotient) + 0.0


def compared(operation: int, a: float, b: float) -> bool:
    """Whether a comparison between two numbers holds; what is vacant is no number, and equal to its like only."""
    if operation == Operation.AND:
        return a != 0.0 and b != 0.0
    if operation == Operation.OR:
        return a != 0.0 or b != 0.0
    if operation == Operation.NEAR:
        apart = abs(b - a)
        return a == b or apart <= abs(NEAR * b) or apart <= abs(NEAR * a)
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
