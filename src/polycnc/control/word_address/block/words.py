"""The words of one block as a handler sees them: by address, in internal units."""

from __future__ import annotations

from polycnc.control.word_address.block.numbers import angle_converter, length_converter
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.language.word_address.functions import round_half_away

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.word_address.block.plan import Plan
    from polycnc.messages import AlarmError


class Words:
    """The numbers of a block. Reading a word that is missing gives None."""

    __slots__ = ("plan", "values")

    def __init__(self, plan: Plan, values: list[float]) -> None:
        self.plan = plan
        self.values = values

    def __contains__(self, address: str) -> bool:
        return address in self.plan.slots

    def __iter__(self) -> Iterator[str]:
        return iter(self.plan.slots)

    def typed(self, address: str) -> float | None:
        """The number as typed."""
        slot = self.plan.slots.get(address)
        return None if slot is None else self.values[slot[0]]

    def form(self, address: str) -> str:
        """How the number was written; see `language.word_address.words`."""
        return self.plan.slots[address][1]

    def length(self, address: str, *, diameter: bool = False) -> float | None:
        """A length in millimetres."""
        slot = self.plan.slots.get(address)
        if slot is None:
            return None
        convert = length_converter(slot[1], self.plan.rules, inch=self.plan.inch, diameter=diameter)
        value = self.values[slot[0]]
        return convert(value) if convert else value

    def part(self, address: str) -> float | None:
        """A part of a direction, of which only the ratio to the others counts.

        Without a point it counts least increments, as a length does; with one no digit is cut off.
        """
        slot = self.plan.slots.get(address)
        if slot is None:
            return None
        value = self.values[slot[0]]
        convert = length_converter(slot[1], self.plan.rules, inch=self.plan.inch) if slot[1] == "" else None
        return convert(value) if convert else value * (INCH_MM if self.plan.inch else 1.0)

    def angle(self, address: str) -> float | None:
        """An angle in degrees."""
        slot = self.plan.slots.get(address)
        if slot is None:
            return None
        convert = angle_converter(slot[1], self.plan.rules)
        value = self.values[slot[0]]
        return convert(value) if convert else value

    def way(self, address: str, *, rotary: bool) -> float | None:
        """A way of one axis: millimetres, or degrees of a rotary one."""
        return self.angle(address) if rotary else self.length(address)

    def integer(self, address: str) -> int | None:
        """A whole number; what a decimal point in it does is the control's."""
        slot = self.plan.slots.get(address)
        if slot is None:
            return None
        value = self.values[slot[0]]
        if slot[1] == "#":
            return int(round_half_away(value))
        point = self.plan.control.POINT_IN_WHOLE_NUMBERS
        if point is not DecimalPoint.CUT and (
            value != int(value) or (slot[1] and point is DecimalPoint.REFUSED)
        ):
            raise self.fail("point", address)
        return int(value)

    def axes(self) -> list[tuple[int, float, bool]]:
        """The axis words as (axis index, value in mm radius or degrees, whether it is an increment)."""
        return [
            (
                word.axis,
                word.convert(self.values[word.slot]) if word.convert else self.values[word.slot],
                word.incremental,
            )
            for word in self.plan.axis_words
        ]

    def names_axis(self, address: str) -> bool:
        """Whether a word is an axis word."""
        return any(word.address == address for word in self.plan.axis_words)

    def fail(self, mistake: str, address: str = "") -> AlarmError:
        """The control's alarm for a mistake in this block."""
        return self.plan.control.fail(mistake, address=address)
