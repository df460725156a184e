"""Numbers as blocks hold them, read from bytes.

Numbers have up to 15 digits, so that mantissa and power of ten are exact and one division rounds correctly, as
`float(text)` does.
"""

from __future__ import annotations

from polycnc.kernels.layout import Text

TAB, BLANK, PLUS, MINUS, POINT, ZERO, NINE = 9, 32, 43, 45, 46, 48, 57
#: So many digits are exact.
EXACT_DIGITS = 15
POWERS = (1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15)


def read_number(text: Text, place: int, most_digits: int) -> tuple[int, float, int]:
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
