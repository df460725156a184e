"""Labels and block numbers of a program, and how jumps search them (job planning 1.10, 1.11, 1.25.2.7)."""

from __future__ import annotations

import re

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.lexer import prefix_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_NUMBER = regex(r"\s*([N:])\s*(\d+)\s*", re.IGNORECASE)
_FIRST = regex(r"[ \t]*([A-Z_$][\w$]*)", re.IGNORECASE | re.ASCII)


class Labels:
    """Where labels and block numbers stand, by steps in order."""

    def __init__(self, blocks: Sequence[str]) -> None:
        self._blocks = blocks
        self._places: dict[str, list[int]] = {}
        for index, text in enumerate(blocks):
            prefix = prefix_of(text)
            for name in (prefix.number, prefix.label):
                if name:
                    self._places.setdefault(name, []).append(index)

    def places(self, target: str) -> list[int]:
        """The steps that carry a label or block number."""
        number = _NUMBER.fullmatch(target)
        name = f"{number[1].upper()}{int(number[2])}" if number else target.strip().upper()
        return self._places.get(name, [])

    def find(self, target: str, here: int, word: str) -> int:
        """Search as GOTOF (towards the end), GOTOB (towards the start), GOTO and GOTOC (end, then start)."""
        places = self.places(target)
        if word != "GOTOB":
            forward = _first(place for place in places if place > here)
            if forward >= 0 or word == "GOTOF":
                return forward
        return _first(place for place in reversed(places) if place <= here)

    def find_back_first(self, label: str, here: int) -> int:
        """Search towards the start, then towards the end, as REPEAT does."""
        places = self.places(label)
        back = _first(place for place in reversed(places) if place <= here)
        return back if back >= 0 else _first(place for place in places if place > here)

    def find_return(self, target: str, here: int) -> int:
        """Search as RET with a target: labels and numbers first, then blocks that begin with the text."""
        found = self.find(target, here, "GOTO")
        if found >= 0:
            return found
        wanted = target.strip().upper()
        count = len(self._blocks)
        order = [*range(here + 1, count), *range(min(here, count - 1), -1, -1)]
        return _first(index for index in order if self._begins_with(index, wanted))

    def _begins_with(self, index: int, wanted: str) -> bool:
        text = self._blocks[index]
        first = _FIRST.match(text, prefix_of(text).end)
        return first is not None and first[1].upper() == wanted

    def section_ends(self, start: int, last: str, here: int) -> set[int]:
        """Ends of a section that begins at a step: its end label, ENDLABEL, or the block before REPEAT.

        ENDLABEL counts only between the start and the REPEAT that stands behind it; a pass that jumps past
        one ends at the next.
        """
        if last:
            end = _first(place for place in self.places(last) if place >= start)
            return {end} if end >= 0 else set()
        ends = {place for place in self.places("ENDLABEL") if place >= start}
        if start > here:
            return ends
        return ends if any(place < here for place in ends) else {here - 1}


def _first(places: Iterable[int]) -> int:
    return next(iter(places), -1)
