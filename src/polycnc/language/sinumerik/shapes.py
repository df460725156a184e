"""Steps for blocks that differ from an earlier one in numbers only, without reading them anew.

`N10 G1 X=R1*2.5 Y-3` and `N20 G1 X=R1*7.25 Y12` have one shape: their text without block number and without
the numbers that compiled code has as parameters. The numbers of a known shape go straight into its compiled
code. A shape is learnt only if the compiler itself lifted exactly the numbers that the pattern here finds.
"""

from __future__ import annotations

import re

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.shapes import Template
    from polycnc.language.sinumerik.emitter import Emitter

#: An axis or path address with its number, or a number by itself; never a part of a name, R, G, M or `X1=`.
_NUMBER = regex(
    r"(?<![\w$.])(?:([A-CFI-KSU-Z])[ \t]*([+-]?(?:\d+\.?\d*|\.\d+))|(\d+\.?\d*|\.\d+))(?![\w.]|[ \t]*=[^=])",
    re.IGNORECASE | re.ASCII,
)
_PREFIX = regex(r"[ \t]*(?:N\d+[ \t]*)?", re.IGNORECASE)
_KEEP = 4096


class _Shape(NamedTuple):
    template: Template
    objects: tuple[object, ...]
    #: Types of the numbers in order, None if all are REAL.
    kinds: tuple[type[int | float], ...] | None


class Shapes:
    """The shapes of one program."""

    def __init__(self) -> None:
        self._known: dict[tuple[str | None, ...], _Shape | None] = {}

    def step(self, line: str) -> Step | None:
        """The step of a block of a known shape; None if the block has to be compiled."""
        parts = _parts(line)
        if parts is None:
            return None
        bare = parts[3::4]
        shape = self._known.get(_key(parts, bare))
        if shape is None:
            return None
        numbers = [a or b for a, b in zip(parts[2::4], bare, strict=True)] if any(bare) else parts[2::4]
        if shape.kinds is None:
            return shape.template.function((*map(float, numbers), *shape.objects))
        values = [kind(number) for kind, number in zip(shape.kinds, numbers, strict=True)]
        return shape.template.function((*values, *shape.objects))

    def learn(self, line: str, emitter: Emitter) -> None:
        """Remember the shape of a block that was compiled, if its numbers are those of the pattern."""
        parts = _parts(line)
        if parts is None or emitter.knows_place or len(self._known) >= _KEEP:
            return
        key = _key(parts, parts[3::4])
        end = line.find(";")
        found = _NUMBER.finditer(line, _start(line), len(line) if end < 0 else end)
        spans = [match.span(2) if match[1] else match.span(3) for match in found]
        if spans != [(number.start, number.end) for number in emitter.numbers]:
            self._known[key] = None
            return
        kinds = tuple(type(number.value) for number in emitter.numbers)
        all_real = all(kind is float for kind in kinds)
        template = emitter.template()
        self._known[key] = _Shape(template, tuple(emitter.objects), None if all_real else kinds)


def _start(line: str) -> int:
    match = _PREFIX.match(line)
    return match.end() if match else 0


def _parts(line: str) -> list[str] | None:
    """Text, address, its number and number by itself in turn; None for lines that have no shape."""
    if '"' in line or "'" in line or "/" in line:
        return None
    end = line.find(";")
    return _NUMBER.split(line[_start(line) :] if end < 0 else line[_start(line) : end])


def _key(parts: list[str], bare: list[str]) -> tuple[str | None, ...]:
    """Text and addresses, and whether a number by itself is whole: that decides types."""
    if any(bare):
        kinds = ["." if number and "." in number else None for number in bare]
        return (*parts[0::4], *parts[1::4], *kinds)
    return tuple(parts[0::4] + parts[1::4])
