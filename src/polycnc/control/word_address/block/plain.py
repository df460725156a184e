"""Plain blocks of the word-address controls: their plans told as data, for the scanner.

A plan is a tuple of steps. Where every step says what it does (`language.bulk.declare`), the block is plain; a step
that anything has wrapped or added (a modal macro, a corner, an interruption) says nothing, and the block is not.
"""

from __future__ import annotations

from polycnc.control.machine_words import may_refuse_moves
from polycnc.control.word_address.auxiliary.functions import Clocks
from polycnc.control.word_address.motion import arcs
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.language.bulk import Arc, Conditions, Recipe, Spelling
from polycnc.language.bulk.layout import (
    FIRST_CODE,
    FIRST_FORMULA,
    FIRST_M_CODE,
    FORMS,
    NUMBERED,
    PLAIN_MARK,
)
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.word_address.transformations import tool_center_point

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.mode import Mode
    from polycnc.control.word_address.block.plan import Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.kernels.layout import Floats
    from polycnc.language.bulk.recipe import Drilled
    from polycnc.language.bulk.routines.running import RoutineDialect
    from polycnc.language.bulk.scanner import LastMoves
    from polycnc.language.word_address.executable import WordAddressProgram

#: How a number was written, as the scanner counts it; see `language.word_address.words`.
_FORMS = ("", ".", ":", ";")


class PlainBlocks:
    """What the scanner asks of a word-address control.

    Attributes:
        spelling: How the control's text looks.
    """

    def __init__(self, spelling: Spelling) -> None:
        self.spelling = spelling
        self._conditions = Conditions()

    @property
    def routines(self) -> RoutineDialect | None:
        """What the scanner asks of programs that are called; None where the interpreter calls them."""
        return None

    def ready(self, channel: WordAddressChannel) -> bool:
        """Single blocks are watched; forbidden zones, unrolled surfaces and most held moves are not."""
        if channel.single_block or channel.boundary is not None:
            return False
        if not (channel.path.is_idle or channel.path.takes_runs):
            return False
        if channel.coordinates.transformation is not None and not channel.path.is_idle:
            return False
        if may_refuse_moves(channel) or channel.coordinates.naming is not None:
            return False
        return channel.coordinates.direct or _keeps_circles(channel)

    def generation(self, channel: WordAddressChannel) -> Hashable:
        """Changes when plans are forgotten, and with the conditions on which recipes rest."""
        return channel.modes.generation, channel.skip_levels, self._conditions.changes(channel)

    def state(self, channel: WordAddressChannel) -> Mode:
        """The modal state."""
        return channel.mode

    def enter(self, channel: WordAddressChannel, state: Mode) -> None:
        """Another modal state."""
        channel.mode = state

    def owes(self, channel: WordAddressChannel) -> bool:
        """Whether incremental words are owed a change of offsets."""
        return channel.coordinates.owes

    def limits(self, channel: WordAddressChannel) -> Sequence[tuple[float, float]]:
        """The channel's own."""
        return channel.limits

    def tolerance(self, channel: WordAddressChannel) -> float:
        """The control's arc tolerance, mm."""
        control = channel.control
        return min(float(control.arc_tolerance(channel)), float(control.spiral_tolerance(channel)))

    def formulas(self, _channel: Channel, _line: str) -> tuple[tuple[str, ...], tuple[int, ...] | None]:
        """Signature of a block with formulas, and what they calculate; None for what the interpreter must."""
        return (), None

    def numbered(self, _channel: Channel) -> int:
        """As many as lie there."""
        return NUMBERED

    def skipped(self, channel: Channel) -> int:
        """As the interpreter asks; a mark without a level is one of the first."""
        on = channel.skip_levels
        return on | (on >> 1 & 1) << PLAIN_MARK

    def put_variables(self, _channel: Channel, _variables: Floats) -> None:
        """No formulas read any."""

    def tool(self, channel: WordAddressChannel) -> Sequence[float]:
        """Blocks of G43.5 name directions."""
        by_vector = channel.mode.codes.get("length") == "G43.5"
        return tool_center_point.record_of(channel) if by_vector else ()

    def drilled(self, channel: WordAddressChannel) -> Drilled | None:
        """The strokes of the active cycle."""
        if not channel.mode.codes.get("cycle"):
            return None
        from polycnc.control.word_address.cycles.holes_as_data import next_hole  # for long programs only

        return next_hole(channel)

    def turned(self, channel: WordAddressChannel, start: list[float], end: list[float]) -> None:
        """How the tool has turned is not remembered."""

    def stood(self, channel: WordAddressChannel, times: int, seconds: float) -> None:
        """The clocks of the macro variables count dwells, one by one as the interpreter does."""
        clocks = Clocks.of(channel)
        for _ in range(times):
            clocks.seconds += seconds

    def moved(self, channel: WordAddressChannel, last: LastMoves) -> None:
        """Nothing is remembered of a move."""

    def recipe(self, channel: WordAddressChannel, keys: Sequence[int], line: str) -> Recipe | None:
        """What the plan of a shape does, if all of it can be told."""
        calculated: tuple[int, ...] | None = ()
        if any(key >= FIRST_FORMULA for key in keys):
            signature, calculated = self.formulas(channel, line)
        else:
            signature = tuple(_key(key) for key in keys)
        if calculated is None:
            return None
        plan: Plan | None = channel.mode.plans.get(signature)
        try:
            plan = plan or channel.control.plan(channel, signature)
        except AlarmError:
            return None  # the interpreter comes to the same block and raises it
        recipe = self._conditions.recipe(channel, plan.steps, plan.mode)
        if recipe is not None:
            recipe = recipe._replace(formulas=calculated)
        if recipe is None or not isinstance(recipe.motion, Arc):
            return recipe
        geometry = channel.coordinates.geometry
        return None if any(geometry[axis] < 0 for axis in recipe.motion.plane[:2]) else recipe

    def recipe_of_step(
        self, channel: WordAddressChannel, code: WordAddressProgram, step: int, keys: Sequence[int]
    ) -> Recipe | None:
        """Steps are lines: as their text says."""
        return self.recipe(channel, keys, code.program.lines[step])


def _keeps_circles(channel: WordAddressChannel) -> bool:
    """Whether the programming frame leaves circles of the plane circles, mirrored as a whole or not at all."""
    frame, plane = channel.coordinates.programming, PLANES[channel.mode["plane"]]
    mirrored = arcs.mirrors_plane(frame, plane) == frame.mirrors
    return mirrored and not arcs.is_stretched(frame, plane)


def _key(key: int) -> str:
    """The scanner's key as one of a signature."""
    if key >= FIRST_M_CODE:
        return f"M{key - FIRST_M_CODE}"
    if key >= FIRST_CODE:
        return f"G{key - FIRST_CODE}"
    letter, form = divmod(key, FORMS)
    return chr(ord("A") + letter) + _FORMS[form]
