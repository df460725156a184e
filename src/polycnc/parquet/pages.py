"""Kernels: what stands in the pages of a column.

Functions on arrays that run as they are and as machine code (`kernels/`). A column of numbers is a stretch of an array;
NaN is null.
"""

from __future__ import annotations

from math import floor

from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Words32

#: Places of a dictionary's values by their hash, and most values in it.
SLOTS, MOST_VALUES = 1 << 15, 1 << 14
#: A column is given no dictionary where, of so many values and more, more than every second one is a new one.
_TRIED = 4_096
#: Steps of whole numbers in a block, and in each of its parts.
BLOCK, PART = 128, 32
#: Spreads the numbers that displays show: the fractions of its multiples lie evenly.
_HASH = 1e7 * 0.6180339887498949
#: The fraction of greater numbers is too coarse to tell them apart.
_MOST_HASHED = 1e8


def drop_nulls(numbers: Floats, first: int, rows: int, levels: Bytes) -> int:
    """Move the values of a column together, over its nulls; gives how many there are.

    Args:
        numbers: With the column.
        first: Where it begins.
        rows: Its length.
        levels: Gets a bit for each row, one where it has a value, the lowest first.
    """
    for place in range((rows + 7) // 8):
        levels[place] = 0
    count = 0
    for row in range(rows):
        value = numbers[first + row]
        if value == value:
            numbers[first + count] = value
            levels[row // 8] |= 1 << row % 8
            count += 1
    return count


def index_values(
    numbers: Floats, first: int, count: int, slots: Ints32, homes: Ints32, values: Floats, places: Ints32
) -> int:
    """Find the different values of a column and the place of each row among them.

    Gives how many there are; -1 where they are too many for a dictionary to save room.

    Args:
        numbers: With the column, without nulls.
        first: Where it begins.
        count: Its length, at least one.
        slots: `SLOTS` places in `values`, by hash; what they hold at first does not matter.
        homes: For each of `values` its slot; one that is said here alone holds something.
        values: The different values in the order in which they come.
        places: For each row the place of its value in `values`.
    """
    found, place, last = 0, 0, 0.0
    for row in range(count):
        value = numbers[first + row]
        if found == 0 or value != last:
            if not abs(value) < _MOST_HASHED:
                return -1
            last, spread = value, value * _HASH
            slot = int((spread - floor(spread)) * SLOTS) % SLOTS
            place = slots[slot]
            while 0 <= place < found and homes[place] == slot and values[place] != value:
                slot = (slot + 1) % SLOTS
                place = slots[slot]
            if not (0 <= place < found and homes[place] == slot):
                if found == MOST_VALUES or (found >= _TRIED and 2 * found > row):
                    return -1
                place = slots[slot] = found
                homes[place], values[place] = slot, value
                found += 1
        places[row] = place
    return found


def pack_places(places: Ints32, count: int, width: int, written: Bytes) -> int:
    """Write numbers of so many bits, the lowest first, in groups of eight; gives the bytes."""
    return put_bits(places, count, (count + 7) // 8 * 8, width, written, 0)


def put_steps(words: Words32, held: Ints, written: Bytes, extremes: Ints) -> int:
    """Write the steps from each whole number to the next, in blocks, each step by what it exceeds the block's least.

    Gives the bytes (the encoding DELTA_BINARY_PACKED without its head).

    Args:
        words: Numbers below 2^31, at least one.
        held: Room for the steps of a part of a block.
        written: What is written.
        extremes: Get the least and the greatest number.
    """
    extremes[0] = extremes[1] = words[0]
    at, first = 0, 1
    while first < len(words):
        end = min(first + BLOCK, len(words))
        least = hold_steps(words, first, end, held, 0, extremes)
        at = put_signed(least, written, at)
        widths = at
        at += BLOCK // PART
        for part in range(BLOCK // PART):
            begin = min(first + part * PART, end)
            count = min(begin + PART, end) - begin
            hold_steps(words, begin, begin + count, held, least, extremes)
            most = 0
            for place in range(count):
                most |= held[place]
            width = 0
            while most >> width > 0:
                width += 1
            written[widths + part] = width
            at = put_bits(held, count, PART, width, written, at)
        first = end
    return at


def hold_steps(words: Words32, first: int, end: int, held: Ints, less: int, extremes: Ints) -> int:
    """Hold the steps that lead to some numbers, each less by so much; gives the least of them, zero for none."""
    least = 0
    for row in range(first, end):
        # The difference of two words would have no sign in machine code.
        place = (row - first) % PART
        held[PART], held[PART + 1] = words[row - 1], words[row]
        step = held[PART + 1] - held[PART]
        held[place] = step - less
        if row == first or step < least:
            least = step
        extremes[0], extremes[1] = min(extremes[0], held[PART + 1]), max(extremes[1], held[PART + 1])
    return least


def put_signed(number: int, written: Bytes, at: int) -> int:
    """Write a number with its sign in the lowest bit, seven bits a byte; the place behind it."""
    rest = 2 * number if number >= 0 else -2 * number - 1
    while rest > 0x7F:
        written[at] = rest & 0x7F | 0x80
        rest >>= 7
        at += 1
    written[at] = rest
    return at + 1


def put_bits(numbers: Ints | Ints32, count: int, filled: int, width: int, written: Bytes, at: int) -> int:
    """Write numbers of so many bits, the lowest first, then zeros until there are `filled`; the place behind them."""
    held, bits = 0, 0
    for row in range(filled):
        if row < count:
            held |= numbers[row] << bits
        bits += width
        while bits >= 8:
            written[at] = held & 0xFF
            held >>= 8
            bits -= 8
            at += 1
    return at
