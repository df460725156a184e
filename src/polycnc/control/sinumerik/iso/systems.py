"""Words of the ISO dialect on a lathe (code T) by its code system, told in the names of system B.

MD10881 chooses the system: 0 is B, 1 is A, 2 is C. System A has no G90 and G91: U, V, W and H are increments of X, Y, Z
and C in it. Source: general knowledge of the control's ISO turning.
"""

from __future__ import annotations

from polycnc.control.sinumerik.iso.subprograms import MACROS
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.errors import not_supported

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from polycnc.language.sinumerik.iso_dialect import IsoBlock, IsoWord


def _same(codes: Iterable[int]) -> dict[str, str]:
    return {f"G{code}": f"G{code}" for code in codes}


#: Codes that every system writes alike.
_ALIKE = _same(
    (0, 1, 2, 3, 4, 17, 18, 19, 28, 30, 31, 40, 41, 42, *range(54, 60), 61, 64, 65, 66, 67, 96, 97)
) | {"G54.1": "G54.1"}
_B = _ALIKE | _same((20, 21, 33, 77, 79, 90, 91, 92, 94, 95))
_A = (
    _ALIKE
    | _same((20, 21))
    | {
        "G32": "G33",
        "G50": "G92",
        "G90": "G77",
        "G94": "G79",
        "G98": "G94",
        "G99": "G95",
    }
)
_C = _ALIKE | _same((33, 90, 91, 92, 94, 95)) | {"G70": "G20", "G71": "G21", "G20": "G77", "G24": "G79"}
#: The names in system B of what the systems write, by MD10881.
SYSTEMS: tuple[Mapping[str, str], ...] = (_B, _A, _C)
SYSTEM_A = 1
#: Increments of system A, and their axes.
INCREMENTS = {"U": "X", "V": "Y", "W": "Z", "H": "C"}


def of_system(block: IsoBlock, system: int) -> IsoBlock:
    """A block in the names of system B, with the increments of system A as such.

    Raises:
        AlarmError: PC0001 for a code that the system does not have, or that is not executed.
    """
    is_macro = not MACROS.isdisjoint(block.codes)
    return block._replace(words=tuple(_word(word, system, is_macro=is_macro) for word in block.words))


def _word(word: IsoWord, system: int, *, is_macro: bool) -> IsoWord:
    if word.code:
        told = SYSTEMS[system].get(word.code) if 0 <= system < len(SYSTEMS) else None
        if told is None:
            raise not_supported(word.column, f"G291 {word.code}")
        return word._replace(value=float(told[1:]), number=told[1:])
    if system == SYSTEM_A and word.letter in INCREMENTS and not is_macro:
        return word._replace(letter=INCREMENTS[word.letter], incremental=True)
    return word
