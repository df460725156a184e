"""Which blocks of a program belong together as a control structure (job planning 1.12)."""

from __future__ import annotations

import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.lexer import JUMPS, prefix_of, tokenize
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

MAX_NESTING = 16
_WORD = regex(r"IF|ELSE|LOOP|FOR|WHILE|REPEAT|UNTIL", re.IGNORECASE)
_ENDS = {"ENDIF": "IF", "ENDLOOP": "LOOP", "ENDFOR": "FOR", "ENDWHILE": "WHILE", "UNTIL": "REPEAT"}
_STARTS = frozenset(_ENDS.values())


@dataclass(slots=True)
class Structure:
    """A control structure: the steps of its first and last block.

    Attributes:
        kind: Word that begins it.
        start: Step of that word.
        end: Step of the word that ends it, -1 while it is open.
        otherwise: Step at which IF goes on when its condition is false.
        error: Alarm for a structure that does not fit, or empty.
    """

    kind: str
    start: int
    end: int = -1
    otherwise: int = -1
    error: str = ""


def structures_of(blocks: Sequence[str]) -> dict[int, Structure]:
    """The structure of every block that begins, divides or ends one."""
    found: dict[int, Structure] = {}
    stack: list[Structure] = []
    for index, text in enumerate(blocks):
        if not _WORD.search(text):
            continue
        word = _structure_word(text)
        if word in _STARTS:
            structure = Structure(word, index, error="12641" if len(stack) >= MAX_NESTING else "")
            stack.append(structure)
            found[index] = structure
        elif word == "ELSE":
            if stack and stack[-1].kind == "IF" and stack[-1].otherwise < 0:
                stack[-1].otherwise = index + 1
                found[index] = stack[-1]
        elif word:
            _close(stack, found, _ENDS[word], index)
    for structure in stack:
        structure.error = "12640"
    return found


def _close(stack: list[Structure], found: dict[int, Structure], kind: str, index: int) -> None:
    """End the innermost structure of a kind; those inside it that are still open do not fit."""
    if all(structure.kind != kind for structure in stack):
        return
    while (structure := stack.pop()).kind != kind:
        structure.error = "12640"
    structure.end = index
    if structure.otherwise < 0:
        structure.otherwise = index + 1
    found[index] = structure


def _structure_word(text: str) -> str:
    """The word of a structure in a block; none for IF with a jump and REPEAT with a label."""
    try:
        tokens = tokenize(text, prefix_of(text).end)
    except AlarmError:
        return ""  # The block raises its alarm when it is reached.
    first = tokens[0]
    word = first.text if first.kind == "name" else ""
    if word == "IF" and any(token.text in JUMPS for token in tokens if token.kind == "name"):
        return ""
    if word == "REPEAT" and len(tokens) > 2:
        return ""
    return word if word in _STARTS or word in _ENDS or word == "ELSE" else ""
