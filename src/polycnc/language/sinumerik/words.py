"""What a compiled NC block hands to the control: G functions and words.

A block without calculation is a `Block` (what was programmed, without the numbers) and a tuple of values, one
for each word. Blocks are interned: two blocks with the same functions and addresses are one object, so a
control works out once how such a block acts in some modal state and keeps that in
`channel.mode.plans[block]`.
"""

from __future__ import annotations

from weakref import WeakValueDictionary

from polycnc.deferred.records import dataclass
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError


@dataclass(frozen=True, slots=True)
class WordShape:
    """A word of a block without its value.

    Attributes:
        address: Upper case: `X`, `X1`, `F`, `S`, `M`, `T`, `CR`, `AR`, `TURN`, `POS`, `SPOS`, … index:
        Extension of the address: `S2=` and `S[2]` give 2, `POS[X]` gives `Axis("X")`, else None. A word
            `AX[A]=` has the address of its axis, not `AX`; `PO[]=` has the index "".
        modifier: What stands round the value: `AC`, `IC`, `DC`, `ACP`, `DIC`, `PM`, `QU`, `FPO`, … or empty.
    """

    address: str
    index: object = None
    modifier: str = ""


class Block:
    """G functions and words of a block without the values. Interned by `block_of`; compare with `is`.

    Attributes:
        codes: G functions and keywords in canonical names, in order: `G1`, `G54`, `CIP`, `TRANS`, `KONT`, …
        words: The words in the order programmed.
        positions: Addresses without index, with the place of their (first) value.
    """

    __slots__ = ("__weakref__", "codes", "positions", "words")

    def __init__(self, codes: tuple[str, ...], words: tuple[WordShape, ...]) -> None:
        self.codes = codes
        self.words = words
        self.positions: dict[str, int] = {}
        for i, word in enumerate(words):
            if word.index is None:
                self.positions.setdefault(word.address, i)

    def __repr__(self) -> str:
        return f"Block({' '.join((*self.codes, *(w.address for w in self.words)))})"


#: Blocks as long as a step or a plan has them.
_blocks: WeakValueDictionary[tuple[tuple[str, ...], tuple[WordShape, ...]], Block] = WeakValueDictionary()


class WordAlarm(AlarmError):  # noqa: N818 - an alarm is what it is called on the machine
    """An alarm about one word of the running block; the language adds the column.

    Args:
        code: The control's alarm code.
        position: Which word of the block, from 0.
        hint: Message id of what the user can do about this very case.
        args: Values for the placeholders of the text.
    """

    def __init__(self, code: str, position: int, *, hint: str = "", **args: object) -> None:
        super().__init__(code, hint=hint)
        self.args_by_name = args
        self.position = position


#: How often an address may stand in a block; all others once for each index (Fundamentals 2.2).
_MOST = {"M": 5, "H": 3}
#: Addresses that lead the axis of their index somewhere: it stands once in a block, by one of them or its own name.
_POSITIONING = frozenset(("POS", "POSA", "POSP", "PO"))


def block_of(codes: tuple[str, ...], words: tuple[WordShape, ...]) -> Block:
    """The one block with these functions and words; alarm 12010 for an address that stands too often."""
    key = (codes, words)
    block = _blocks.get(key)
    if block is None:
        _check_repetitions(words)
        block = _blocks[key] = Block(codes, words)
    return block


def _check_repetitions(words: tuple[WordShape, ...]) -> None:
    seen: dict[object, int] = {}
    for position, word in enumerate(words):
        most = _MOST.get(word.address, 1)
        key: object = word.address if most > 1 else (word.address, word.index)
        if word.address in _POSITIONING and isinstance(word.index, Axis):
            key = (word.index.name, None)
        seen[key] = seen.get(key, 0) + 1
        if seen[key] > most:
            raise WordAlarm("12010", position, text=word.address)
