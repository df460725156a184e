"""Variables of the NC language for the scanner: R parameters and single variables or arrays of numbers, by places."""

from __future__ import annotations

from array import array
from math import nan

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.formulas.typed_postfix import Located, Sort
from polycnc.language.bulk.layout import NUMBERED, VARIABLES
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted
from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import Array, element_count

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.kernels.layout import Floats
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.names.variables import Variable

#: Types that the scanner calculates with, and how a number becomes a value of theirs.
_SORTS = {Type.INT: Sort.WHOLE, Type.REAL: Sort.REAL, Type.BOOL: Sort.TRUTH}
_VALUES: dict[Sort, Callable[[float], Any]] = {Sort.WHOLE: int, Sort.REAL: float, Sort.TRUTH: bool}


class _Kept(NamedTuple):
    """A variable that has a place.

    Attributes:
        owner: The program whose running level holds it, or the list in which it lies.
        slot: Where in that level or list.
        sort: What its values are.
        place: Its place, of an array that of its first element.
        length: How many elements; 0 for a single value.
    """

    owner: SinumerikProgram | list[Any]
    slot: int
    sort: Sort
    place: int
    length: int

    def values(self, channel: SinumerikChannel) -> Sequence[Any]:
        """Its values now; none where it has not been defined, or belongs to a program that is not running."""
        items = self.items(channel)
        if items is None or self.slot >= len(items):
            return ()
        if not self.length:
            value = items[self.slot]
            return () if value is None else (value,)
        found = items[self.slot]
        return found.items if isinstance(found, Array) and len(found.items) == self.length else ()

    def items(self, channel: SinumerikChannel) -> list[Any] | None:
        """The list in which it lies."""
        if isinstance(self.owner, list):
            return self.owner
        found = channel.level.locals if channel.level.code is self.owner else None
        return found if isinstance(found, list) else None


class VariablesAtHand:
    """The variables of a channel that lines have named so far, each with a place that it keeps."""

    def __init__(self) -> None:
        self._kept: dict[tuple[int, int], _Kept] = {}
        self._end = NUMBERED

    # ---- where they lie ------------------------------------------------------------------------------------

    def locate(
        self,
        channel: SinumerikChannel,
        program: SinumerikProgram,
        emitter: Emitter,
        literal: Callable[[int], int] | None,
    ) -> Callable[[Code], Located]:
        """What finds the place of a variable in the code of a block.

        Args:
            channel: The channel.
            program: The program of the block.
            emitter: Its code.
            literal: Where the number of an R parameter stands among the numbers of the block, by its place among the
                objects; None where the block is known with its numbers.

        Returns:
            A function of the code of a variable; it raises `OtherError` for one that the scanner does not have.
        """

        def located(code: Code) -> Located:
            array_of = _array(code)
            base, index = array_of or code[1:3]
            if code.kind != nodes.Subscript or not isinstance(base, Code) or not isinstance(index, Code):
                raise OtherError
            owner = emitter.objects[base.place] if isinstance(base, Lifted) else program
            if owner is channel.memory.language.r:
                return _r_parameter(channel, emitter, index, literal)
            if not isinstance(index, Lifted) or (owner is program and base[1] != "L"):
                raise OtherError
            slot = emitter.objects[index.place]
            kept = self._keep(channel, owner, slot)
            if bool(kept.length) != (array_of is not None):
                raise OtherError
            element = code[2] if array_of is not None else None
            assert element is None or isinstance(element, Code)
            return Located(kept.sort, kept.place, element)

        return located

    def place_of(self, channel: SinumerikChannel, program: SinumerikProgram, slot: object) -> Located:
        """Where a single variable of a program lies.

        Raises:
            OtherError: The scanner does not have it.
        """
        kept = self._keep(channel, program, slot)
        if kept.length:
            raise OtherError
        return Located(kept.sort, kept.place)

    def _keep(self, channel: SinumerikChannel, owner: Any, slot: Any) -> _Kept:
        key = id(owner), slot
        kept = self._kept.get(key)
        if kept is None:
            variable = _declared(channel, owner, slot)
            sort = _SORTS.get(variable.type)
            count = element_count(variable.dims) if variable.dims else 0
            if sort is None or self._end + max(count, 1) > VARIABLES:
                raise OtherError
            kept = self._kept[key] = _Kept(owner, slot, sort, self._end, count)
            self._end += max(count, 1)
        return kept

    # ---- their values --------------------------------------------------------------------------------------

    @staticmethod
    def numbered(channel: SinumerikChannel) -> int:
        """How many R parameters are at hand."""
        return min(len(channel.memory.language.r), NUMBERED)

    def put(self, channel: SinumerikChannel, variables: Floats) -> None:
        """Give the kernel their values; not a number for a variable that is not there."""
        count = self.numbered(channel)
        variables[:count] = array("d", channel.memory.language.r[:count])
        for kept in self._kept.values():
            values, count = kept.values(channel), kept.length or 1
            # A program that is called gives its variables values before it reads them.
            first = nan if kept.owner is channel.level.code else 0.0
            variables[kept.place : kept.place + count] = array("d", values or [first] * count)

    def of_level(self, program: SinumerikProgram, variables: Sequence[float]) -> list[Any]:
        """The variables of a program that a scan has called, as its level has them."""
        own = {kept.slot: kept for kept in self._kept.values() if kept.owner is program}
        return [
            _VALUES[own[slot].sort](variables[own[slot].place]) if slot in own else None
            for slot in range(max(own, default=-1) + 1)
        ]

    def take(self, channel: SinumerikChannel, before: Sequence[float], after: Sequence[float]) -> None:
        """Values that have changed, if only from 0 to -0."""
        _take(channel.memory.language.r, before, after, 0, self.numbered(channel), float)
        for kept in self._kept.values():
            values = kept.values(channel)
            if not values:
                continue
            if kept.length:
                _take(values, before, after, kept.place, kept.length, _VALUES[kept.sort])
            elif _bits(before, kept.place, 1) != _bits(after, kept.place, 1):
                items = kept.items(channel)
                assert items is not None
                items[kept.slot] = _VALUES[kept.sort](after[kept.place])


def _declared(channel: SinumerikChannel, owner: object, slot: object) -> Variable:
    """The declaration of what lies in a slot."""
    if isinstance(owner, list):
        found = channel.memory.language.global_variables.values()
        return next((each for each in found if each.store is owner and each.slot == slot), None) or _other()
    assert isinstance(owner, SinumerikProgram)
    own = owner.scope_of(channel).variables.values()
    return next((each for each in own if each.slot == slot), None) or _other()


def _other() -> Variable:
    raise OtherError


def _array(code: Code) -> tuple[object, object] | None:
    """List and slot of an array of whose elements the code speaks: `L[slot].items[index]`."""
    items = code[1] if code.kind == nodes.Subscript else None
    if not isinstance(items, Code) or items.kind != nodes.Attribute or items[2] != "items":
        return None
    variable = items[1]
    return (
        (variable[1], variable[2])
        if isinstance(variable, Code) and variable.kind == nodes.Subscript
        else None
    )


def _r_parameter(
    channel: SinumerikChannel, emitter: Emitter, index: Code, literal: Callable[[int], int] | None
) -> Located:
    if not isinstance(index, Lifted):
        if len(channel.memory.language.r) > NUMBERED:
            raise OtherError
        return Located(Sort.REAL, 0, index)
    number = emitter.objects[index.place]
    if literal is not None:
        return Located(Sort.REAL, literal(index.place), numbered=True)
    if not isinstance(number, int) or number >= VariablesAtHand.numbered(channel):
        raise OtherError
    return Located(Sort.REAL, number)


def _take(
    target: Any,
    before: Sequence[float],
    after: Sequence[float],
    first: int,
    count: int,
    value: Callable[[float], Any],
) -> None:
    if (
        array("d", before[first : first + count]).tobytes()
        == array("d", after[first : first + count]).tobytes()
    ):
        return
    old, new = _bits(before, first, count), _bits(after, first, count)
    for i in range(count):
        if old[i] != new[i]:
            target[i] = value(after[first + i])


def _bits(variables: Sequence[float], first: int, count: int) -> list[int]:
    """Variables as whole numbers, which are equal where nothing tells them apart."""
    return array("q", array("d", variables[first : first + count]).tobytes()).tolist()
