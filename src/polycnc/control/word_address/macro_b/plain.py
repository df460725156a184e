"""Plain blocks of controls with custom macro B, for the scanner: words may hold formulas of variables."""

from __future__ import annotations

from array import array
from math import nan

from polycnc.control.word_address.block.plain import PlainBlocks
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Recipe
from polycnc.language.bulk.layout import ASSIGNED
from polycnc.language.word_address.patterns import MEMORIES
from polycnc.language.word_address.words import is_fixed_code
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.control.word_address.macro_b.routines import MacroRoutines
    from polycnc.kernels.layout import Floats


class MacroPlainBlocks(PlainBlocks):
    """What the scanner asks of a control with custom macro B."""

    @property
    def routines(self) -> MacroRoutines:
        """Subprograms, macros and loops."""
        from polycnc.control.word_address.macro_b.routines import MacroRoutines

        return MacroRoutines()

    def formulas(self, channel: MacroChannel, line: str) -> tuple[tuple[str, ...], tuple[int, ...] | None]:
        """What the reader makes of the line, if the scanner can calculate it."""
        from polycnc.language.bulk.formulas.postfix import formulas  # for programs with formulas

        try:
            found = channel.level.code.words_of(line)
        except AlarmError:
            return (), None  # the interpreter comes to the same block and raises it
        if found is None:
            return (), None
        words, spots = found
        valued = [key for key in words.keys if not is_fixed_code(key)]
        if "M" in words.keys or len(valued) != len(words.codes) or None in spots:
            return (), None
        coded = list(zip(valued, words.codes, strict=True))
        typed = {code[1] for key, code in coded if not key.endswith("#")}
        literals = [place for place in range(len(spots)) if place not in typed]
        calculated = [(slot, code) for slot, (key, code) in enumerate(coded) if key.endswith("#")]
        within_turn = not channel.memory.angle_range_signed
        return tuple(words.keys), formulas(
            calculated, {place: i for i, place in enumerate(literals)}, within_turn=within_turn
        )

    def generation(self, channel: Channel) -> Hashable:
        """Also with the range of arc functions."""
        return super().generation(channel), channel.memory.angle_range_signed

    def recipe(self, channel: Channel, keys: Sequence[int], line: str) -> Recipe | None:
        """Also of a statement that gives a variable a value."""
        if ASSIGNED not in keys:
            return super().recipe(channel, keys, line)
        from polycnc.control.word_address.macro_b.routines import assignment_as_data

        told = assignment_as_data(channel, line)
        return None if told is None else Recipe(channel.mode, formulas=told)

    def put_variables(self, channel: MacroChannel, variables: Floats) -> None:
        """Local and common variables; system variables are the interpreter's."""
        memory = channel.memory
        kept = memory.kept
        for name, values in (
            ("locals", memory.locals[1:]),
            ("common", memory.common[100:]),
            ("kept", [kept.get(number) for number in MEMORIES["kept"]]),
        ):
            numbers = MEMORIES[name]
            variables[numbers.start : numbers.stop] = _numbers(values)


def _numbers(values: Iterable[float | None]) -> Sequence[float]:
    return array("d", [nan if value is None else value for value in values])
