"""Words of orientation: what a block says of the tool's direction (job planning 6.2.4 to 6.5).

They are taken while the block is worked out; `orientation` says where they lead when it runs.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.positions import number
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.block.draft import Draft, Values
    from polycnc.geometry.frames import Vector

#: Vectors and angles with three letters each: 2 angles, 3 direction, 4 and 5 normals at start and end, 6 axis of a
#: cone, 7 direction between, 8 retraction.
ANGLES, DIRECTION, FIRST_NORMAL, LAST_NORMAL, AXIS, BETWEEN, RETRACTION = range(2, 9)
LETTERS = "ABC"
TRIPLES = {f"{letter}{digit}": (digit, i) for digit in range(2, 9) for i, letter in enumerate(LETTERS)}
SINGLE = ("LEAD", "TILT", "NUT", "THETA")
SECOND = ("XH", "YH", "ZH")
OF_ANGLES = ("PHI", "PSI", "THT")
#: Numbers of a polynomial of degree 5: with its end in front of them, or without (6.3).
MOST_COEFFICIENTS = {"PHI": 4, "PSI": 4, "THT": 5, "XH": 5, "YH": 5, "ZH": 5}
#: Codes of group 51 that lead the direction along a cone, and those that keep it to the path.
CONES = ("ORICONCW", "ORICONCCW", "ORICONTO", "ORICONIO")
BY_PATH = ("ORIPATH", "ORIPATHS")
#: With which of them words go that no other way of the direction has (6.2.8, 6.5.4).
GOES_WITH = {
    AXIS: ("ORICONCW", "ORICONCCW", "ORICONTO"),
    "NUT": ("ORICONCW", "ORICONCCW"),
    BETWEEN: ("ORICONIO",),
    RETRACTION: ("ORIPATHS",),
}


class Words(NamedTuple):
    """Where the words of orientation stand in a block.

    Attributes:
        triples: Places of the components of each triple, by its digit.
        single: Places of LEAD, TILT, NUT and THETA.
        second: Places of XH, YH and ZH.
        polynomials: Places of PO[PHI] and its like.
        theta: What stands round the value of THETA: AC, IC, or nothing.
        columns: Columns of the orientation axes that the block names themselves.
        bends: Polynomials act; else only their ends count (POLYPATH).
    """

    triples: Mapping[int, Mapping[int, int]]
    single: Mapping[str, int]
    second: Mapping[str, int]
    polynomials: Mapping[str, int]
    theta: str
    columns: frozenset[int]
    bends: bool = True

    def vector(self, values: Values, digit: int) -> Vector | None:
        """A triple, zero for components that are not programmed; None where none of them is."""
        places = self.triples.get(digit)
        if places is None:
            return None
        x, y, z = (number(values, places[i]) if i in places else 0.0 for i in range(3))
        return (x, y, z)

    @property
    def tells_cone(self) -> bool:
        """Whether the block tells the axis, the opening or the middle of a cone."""
        return AXIS in self.triples or BETWEEN in self.triples or "NUT" in self.single

    def value(self, values: Values, address: str) -> float | None:
        """The value of LEAD, TILT, NUT or THETA; None where it is not programmed."""
        place = self.single.get(address)
        return None if place is None else number(values, place)

    def coefficients(self, values: Values, name: str) -> tuple[float, ...]:
        """The numbers of a polynomial; none where it is not programmed. 14102 for too many."""
        place = self.polynomials.get(name)
        if place is None:
            return ()
        value = values[place]
        numbers = value if isinstance(value, tuple) else (value,)
        if len(numbers) > MOST_COEFFICIENTS[name]:
            raise WordAlarm("14102", place, text=name)
        found = tuple(_real(each, place) for each in numbers)
        if self.bends:
            return found
        has_end = name in SECOND or (name == "THT" and "THETA" not in self.single and len(found) > 1)
        return (found[0], *[0.0] * (len(found) - 1)) if has_end else ()


def _real(value: Any, place: int) -> float:
    if not isinstance(value, (int, float)):
        raise WordAlarm("12150", place, text="PO")
    return float(value)


def take(
    draft: Draft, orientation_axes: frozenset[int], *, acts: bool = True, virtual: bool = False
) -> Words | None:
    """Take the words of orientation out of a block; None where it has none.

    Words of a cone stay where the direction goes along none, and so does a retraction: PC0001.

    `acts`: a transformation turns the tool; without one no word has to go with the way of the direction. `virtual`: A,
    B and C mean what A2, B2 and C2 mean (MD21102 = 1).

    Raises:
        AlarmError: 14110, 14111, 14129, 14131 for the end of the direction told in two ways, 14122 for opening and
            axis of a cone.
    """
    triples: dict[int, dict[int, int]] = {}
    single: dict[str, int] = {}
    second: dict[str, int] = {}
    polynomials: dict[str, int] = {}
    theta, code = "", draft.mode["orientation_motion"]
    for position, word in draft.open_words():
        address = word.address
        kind = TRIPLES[address][0] if address in TRIPLES else address
        counts = code in GOES_WITH.get(kind, (code,)) or not (acts or address in draft.memory.columns)
        if not counts:
            continue
        if virtual and address in LETTERS and word.index is None:
            triples.setdefault(ANGLES, {})[LETTERS.index(address)] = position
        elif address in TRIPLES:
            digit, component = TRIPLES[address]
            triples.setdefault(digit, {})[component] = position
        elif address in SINGLE:
            single[address] = position
            theta = word.modifier if address == "THETA" else theta
        elif address in SECOND:
            second[address] = position
        elif address == "PO" and word.index in (*OF_ANGLES, *SECOND):
            polynomials[str(word.index)] = position
        else:
            continue
        if word.modifier and (address != "THETA" or word.modifier not in ("AC", "IC")):
            raise WordAlarm("12020", position, text=word.modifier)
        draft.close(position)
    columns = draft.memory.columns
    named = frozenset(columns[w.address] for _, w in draft.open_words() if w.address in columns)
    moves = bool(named) or any(w.address == "PO" for _, w in draft.open_words())
    words = Words(triples, single, second, polynomials, theta, named & orientation_axes)
    _check(words)
    by_path = draft.mode["orientation_motion"] in BY_PATH or draft.mode["rotation_vector"] == "ORIROTC"
    says = triples or single or second or polynomials or words.columns
    return words if says or (by_path and moves) else None


def _check(words: Words) -> None:
    """The end of the direction may be told in one way only (6.2.3)."""
    by_axes, by_angles = bool(words.columns), ANGLES in words.triples
    by_vector = DIRECTION in words.triples
    by_path = "LEAD" in words.single or "TILT" in words.single
    if by_axes and by_vector:
        raise AlarmError("14129")
    if by_axes and by_angles:
        raise AlarmError("14111")
    if by_axes and by_path:
        raise AlarmError("14131")
    if by_angles + by_vector + by_path > 1:
        raise AlarmError("14110")
    if AXIS in words.triples and "NUT" in words.single:
        raise AlarmError("14122")
