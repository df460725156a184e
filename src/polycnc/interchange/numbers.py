"""Numbers as a control's text, to the last bit: what is read back is the number that was written."""

from __future__ import annotations

from decimal import Decimal
from math import frexp, ldexp

from polycnc.deferred.records import dataclass

#: FANUC variables are written with so many digits; what needs more is written as an expression.
DIGITS = 9
#: FANUC writes a variable as a whole number through this divisor, 2 to the 27th, so that nothing of it is lost.
DIVISOR = 134217728
_HALF_WORD = 65536
_MANTISSA_BITS = 53


def plain(value: float, decimals: int = 0) -> str:
    """A number without an exponent, with a decimal point and so many decimals at least: `7.500`."""
    written = format(Decimal(repr(float(value) + 0.0)), "f")
    whole, _, fraction = written.partition(".")
    fraction = fraction.rstrip("0")
    return f"{whole}.{fraction.ljust(decimals, '0')}"


@dataclass(frozen=True, slots=True)
class Unit:
    """The unit of lengths in which a control reads and shows.

    Attributes:
        factor: Millimetres of one.
        decimals: Decimals of the control's displays.
    """

    factor: float
    decimals: int

    def text(self, millimetres: float) -> str:
        """A length: the shortest text from which the control keeps the same, with the display's decimals at least."""
        exact = millimetres / self.factor
        for places in range(self.decimals, 18):
            written = f"{exact + 0.0:.{places}f}"
            if float(written) * self.factor == millimetres:
                return plain(float(written), self.decimals)
        return plain(exact, self.decimals)


def expression(value: float) -> str:
    """A number as FANUC controls write variables: `[m*65536+n]/134217728` where digits would be lost."""
    written = format(Decimal(repr(value)).normalize(), "f")
    if len(written.strip("-0").replace(".", "")) <= DIGITS and len(written) <= DIGITS + 1:
        return written
    fraction, exponent = frexp(abs(value))
    mantissa = int(ldexp(fraction, _MANTISSA_BITS))
    exponent -= _MANTISSA_BITS
    while mantissa % 2 == 0:
        mantissa, exponent = mantissa // 2, exponent + 1
    parts: list[int] = []
    while mantissa:
        mantissa, part = divmod(mantissa, _HALF_WORD)
        parts.insert(0, part)
    whole = str(parts[0])
    for part in parts[1:]:
        whole = f"[{whole}*{_HALF_WORD}+{part}]"
    return ("-" if value < 0 else "") + whole + _scaled(exponent)


def _scaled(exponent: int) -> str:
    """Times 2 to a power, by factors of nine digits at most; each step is exact."""
    sign, rest = ("*", exponent) if exponent > 0 else ("/", -exponent)
    steps, last = divmod(rest, 27)
    return f"{sign}{DIVISOR}" * steps + (f"{sign}{1 << last}" if last else "")
