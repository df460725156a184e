"""How many parts a cycle makes of a way: no more than a program can mean."""

from __future__ import annotations

from math import ceil

from polycnc.messages import AlarmError

#: A cycle with more parts is taken for a mistake (an infeed of a thousandth of a micrometre, say).
MOST_PARTS = 100_000


def parts(total: float, most: float, spare: float = 0.0) -> int:
    """In how few parts of at most `most` a way is made, as a number; less than 1 where there is none.

    Args:
        total: The way.
        most: Largest part.
        spare: This share of a part may be left over.

    Raises:
        AlarmError: PC0002, there are more than a program can mean.
        ArithmeticError: The number has no value.
    """
    return checked(ceil(total / most - spare))


def checked(count: int) -> int:
    """A number of parts; PC0002 where it is more than a program can mean."""
    if count > MOST_PARTS:
        raise AlarmError("PC0002", hint="hint.parts")
    return count
