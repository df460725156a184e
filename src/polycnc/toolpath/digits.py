"""Kernel: the numbers of rows as text, in the places that a form of the row leaves for them.

A function on arrays that runs as it is and as machine code (`kernels/`). Numbers are written as `repr` writes them,
with the fewest digits that tell them from others. For a whole number of steps below 10^15 these are its own digits
without zeros at the end: any two numbers of so many digits are different doubles.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32

#: Steps of a unit that the displays resolve: finer than any control, far above rounding noise.
STEPS, DECIMALS = 1e7, 7
#: Bytes in a form, none of which is part of UTF-8: the next byte is the column of a number; the form ends.
PLACE, END = 0xFF, 0xFE
#: In place of a form: the row is written by itself; it is not written.
ALONE, LEFT_OUT = -1, -2
#: No number is longer.
LONGEST_NUMBER = 24
#: Column of numbers that are written without decimals.
WHOLE = 0
MINUS, POINT, ZERO, LETTER_E = 45, 46, 48, 101
#: From here on a number has too many steps, and below this `repr` writes an exponent.
TOO_LARGE, SMALLEST = 1e8, 1_000


class Forms(NamedTuple):
    """Forms of rows.

    Attributes:
        text: All of them, one behind the other: bytes, PLACE with the column behind it, END.
        begin: Where each begins in `text`.
    """

    text: Bytes
    begin: Ints


def fill(
    forms: Forms, chosen: Ints32, numbers: Floats, first: int, room: int, text: Bytes, used: Ints
) -> int:
    """Write rows from `first` on; gives the next one: one that is written alone, or for which there is no room.

    Args:
        forms: All that rows have.
        chosen: The number of each row's form, or ALONE or LEFT_OUT.
        numbers: Those of the rows, as many for each.
        first: Row to begin with.
        room: Bytes that no row needs more of.
        text: What is written.
        used: Bytes that were written, as its only number.
    """
    width, row, at = len(numbers) // len(chosen), first, 0
    while row < len(chosen) and chosen[row] != ALONE and at + room <= len(text):
        if chosen[row] != LEFT_OUT:
            end = fill_row(forms.text, forms.begin[chosen[row]], numbers, row * width, text, at)
            if end < 0:
                break
            at = end
        row += 1
    used[0] = at
    return row


def fill_row(form: Bytes, begin: int, numbers: Floats, row: int, text: Bytes, at: int) -> int:
    """Write a row whose numbers begin at `row`; the place behind it, -1 where a number cannot be written here."""
    place = begin
    while form[place] != END:
        if form[place] == PLACE:
            column = form[place + 1]
            value = numbers[row + column]
            at = put_whole(int(value), text, at) if column == WHOLE else put_number(value, text, at)
            if at < 0:
                return -1
            place += 2
        else:
            text[at] = form[place]
            at += 1
            place += 1
    return at


def put_whole(value: int, text: Bytes, at: int) -> int:
    """Write a whole number that is not negative; the place behind it."""
    digits, limit = 1, 10
    while value >= limit:
        digits += 1
        limit *= 10
    return put_digits(value, digits, text, at)


def put_digits(value: int, digits: int, text: Bytes, at: int) -> int:
    """Write so many digits of a whole number; the place behind them."""
    for place in range(at + digits - 1, at - 1, -1):
        text[place] = ZERO + value % 10
        value //= 10
    return at + digits


def put_number(value: float, text: Bytes, at: int) -> int:
    """Write a number; the place behind it, -1 where it is no number of steps or too large."""
    if value < 0.0:
        value = -value
        text[at] = MINUS
        at += 1
    if not value < TOO_LARGE:
        return -1
    steps = int(value * STEPS + 0.5)
    if steps / STEPS != value:
        return -1
    if 0 < steps < SMALLEST:
        return put_small(steps, text, at)
    at = put_whole(steps // 10**DECIMALS, text, at)
    text[at] = POINT
    rest, digits = steps % 10**DECIMALS, DECIMALS
    while digits > 1 and rest % 10 == 0:
        rest //= 10
        digits -= 1
    return put_digits(rest, digits, text, at + 1)


def put_small(steps: int, text: Bytes, at: int) -> int:
    """Write a number of few steps, with its exponent; the place behind it."""
    digits = 1 if steps < 10 else 2 if steps < 100 else 3
    exponent = DECIMALS + 1 - digits
    while digits > 1 and steps % 10 == 0:
        steps //= 10
        digits -= 1
    first = 10 ** (digits - 1)
    text[at] = ZERO + steps // first
    at += 1
    if digits > 1:
        text[at] = POINT
        at = put_digits(steps % first, digits - 1, text, at + 1)
    text[at], text[at + 1], text[at + 2], text[at + 3] = LETTER_E, MINUS, ZERO, ZERO + exponent
    return at + 4
