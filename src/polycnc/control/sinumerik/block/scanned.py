"""What the scanner asks of a SINUMERIK control: recipes of plain blocks, and what beside them it must know."""

from __future__ import annotations

from math import inf

from polycnc.control.sinumerik.block.routines import SinumerikRoutines, sort_of
from polycnc.control.sinumerik.block.variables_at_hand import VariablesAtHand
from polycnc.control.sinumerik.limits.working_area import BASIC, MACHINE, Ranges, radius_beside
from polycnc.control.sinumerik.motion.last_move import ArcOfMove, LastMove
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import is_even
from polycnc.language.bulk import (
    Conditions,
    Recipe,
    Spelling,
)
from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.formulas.typed_postfix import TypedPostfix
from polycnc.language.bulk.layout import (
    ASSIGNED,
    CR_FORM,
    CR_FORMULA,
    DIRECTION_FORM,
    FIRST_CODE,
    FIRST_FORMULA,
    FIRST_TOKEN,
    FORMS,
    PLAIN_MARK,
    Token,
)
from polycnc.language.expressions import nodes
from polycnc.language.sinumerik.emitter import own_number
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Hashable, Sequence

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import Plan
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.bulk.scanner import LastMoves
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.words import Block

SPELLING = Spelling(
    max_digits=15, semicolon_comments=True, equals=True, forms_count=False, cr_radius=True, directions=True,
    blank_lines_are_blocks=False, expressions=True,
)  # fmt: skip


class SinumerikPlainBlocks:
    """What the scanner asks of a SINUMERIK control.

    The modal state of a shape is the mode and the program: names may mean something else in another one.

    Args:
        plan: What a block does in the modal state that holds.
        tool: What must be known to stand the tool along a direction (`transformation.orientation.standing`).
        note_turn: Called behind blocks that have turned the tool, with the positions before and behind the last one.
    """

    spelling = SPELLING

    def __init__(
        self,
        plan: Callable[[SinumerikChannel, Block], Plan],
        tool: Callable[[SinumerikChannel], array[float]],
        note_turn: Callable[[SinumerikChannel, list[float], list[float]], None],
    ) -> None:
        self._plan = plan
        self.tool, self.turned = tool, note_turn
        self._conditions = Conditions()
        self._variables = VariablesAtHand()
        self.routines = SinumerikRoutines(self._variables)
        self.numbered, self.put_variables = self._variables.numbered, self._variables.put

    def ready(self, channel: SinumerikChannel) -> bool:
        """Nothing watches blocks, bends arcs or follows a block, and only runs are held back; the program is open.

        Under a transformation no working area acts beside limits of travel: they hold all along the curves of the axes.
        """
        c = channel.coordinates
        return (
            channel.path.takes_runs
            and not channel.single_block
            and c.direct
            and is_even(c.zero)
            and (c.transformation is None or not channel.limits or not Ranges.of(channel).limits)
            and channel.memory.language.modal_call is None
            and channel.level.code.whole.is_open
        )

    def generation(self, channel: SinumerikChannel) -> Hashable:
        """Changes when plans are forgotten, with names that a program gives a meaning, and with conditions."""
        language = channel.memory.language
        names = language.programs.generation, len(language.macros), len(language.global_variables)
        return channel.modes.generation, names, self._conditions.changes(channel)

    def state(self, channel: SinumerikChannel) -> tuple[Mode, object]:
        """The modal state in the running program."""
        return channel.mode, channel.level.code.whole

    def enter(self, channel: SinumerikChannel, state: tuple[Mode, object]) -> None:
        """Another modal state."""
        channel.mode = state[0]

    def owes(self, channel: SinumerikChannel) -> bool:
        """Whether incremental words are owed a change of offsets."""
        return channel.coordinates.owes

    def limits(self, channel: SinumerikChannel) -> Sequence[tuple[float, float]]:
        """The machine's travel, software limit switches and the working area, whichever is narrower."""
        limits = Ranges.of(channel).limits
        if not limits:
            return channel.limits
        ranges = list(channel.limits) or [(float("-inf"), float("inf"))] * len(channel.axes)
        geometry = channel.coordinates.geometry
        for limit in limits:
            if limit.system not in (MACHINE, BASIC):
                return [(inf, -inf)] * len(ranges)  # in another system only the interpreter can look
            low, high = ranges[limit.column]
            margin = radius_beside(channel, limit, channel.mode["plane"])
            tool = limit.system == BASIC and limit.column in geometry
            length = channel.coordinates.offsets[limit.column] if tool else 0.0
            ranges[limit.column] = (
                max(low, limit.low + length + margin),
                min(high, limit.high + length - margin),
            )
        return ranges

    def tolerance(self, channel: SinumerikChannel) -> float:
        """MD21000, mm."""
        return float(channel.memory.data.number("$MC_CIRCLE_ERROR_CONST"))

    def skipped(self, channel: SinumerikChannel) -> int:
        """As `Control.skipped`; a mark without a level is one of level 0."""
        on = channel.setup.switches.block_skip_mask(plain=0)
        return on | (on & 1) << PLAIN_MARK

    def drilled(self, _channel: SinumerikChannel) -> None:
        """Cycles are the interpreter's."""

    def stood(self, _channel: SinumerikChannel, _times: int, _seconds: float) -> None:
        """There are no holes."""

    def moved(self, channel: SinumerikChannel, last: LastMoves) -> None:
        """Where the last move came from, for CT."""
        move = LastMove.of(channel)
        kind = Kind(last.kind)
        if kind in (Kind.RAPID, Kind.FEED):
            move.start, move.arc = last.came_from, None
        else:
            x, y, z, i, j, k, *_ = last.curve
            sense = 1.0 if kind in CCW_KINDS else -1.0
            move.start, move.arc = last.came_from, ArcOfMove((x, y, z), (i, j, k), sense)

    def recipe(self, channel: SinumerikChannel, keys: Sequence[int], line: str) -> Recipe | None:
        """What the plan of a shape does, if all of it can be told."""
        code = channel.level.code.whole
        try:
            emitter = code.unmarked(channel.level.index, channel, line).emitter
            if emitter.is_empty:
                return None if keys else Recipe((channel.mode, code))
            if ASSIGNED in keys:
                return self._assignments(channel, code, emitter, keys)
            block = _block(emitter, keys)
            if block is None:
                return None
            formulas = self._formulas(channel, code, emitter, keys)
            return self._planned(channel, code, block, formulas)
        except (AlarmError, OtherError):
            return None  # the interpreter comes to the same block and raises it

    def recipe_of_step(
        self, channel: SinumerikChannel, code: SinumerikProgram, step: int, _keys: Sequence[int]
    ) -> Recipe | None:
        """The same for a block of a routine: all its numbers are in formulas."""
        try:
            emitter = code.compiled(step, channel).emitter
            execution = emitter.executes
            if execution is None:
                return None
            postfix = self.routines.postfix(channel, code, emitter)
            for slot, value in enumerate(execution.values):
                postfix.stored(value, slot)
            return self._planned(channel, code, execution.block, tuple(postfix.done))
        except (AlarmError, OtherError):
            return None

    def _planned(
        self, channel: SinumerikChannel, code: SinumerikProgram, block: Block, formulas: tuple[int, ...]
    ) -> Recipe | None:
        if not block.codes and not block.words:
            return Recipe((channel.mode, code))
        plan = channel.mode.plans.get(block) or self._plan(channel, block)
        if plan.shared or plan.ends:
            return None
        recipe = self._conditions.recipe(channel, plan.steps, channel.mode)
        if recipe is None:
            return None
        return recipe._replace(next_state=(recipe.next_state, code), formulas=formulas)

    def _formulas(
        self, channel: SinumerikChannel, code: SinumerikProgram, emitter: Emitter, keys: Sequence[int]
    ) -> tuple[int, ...]:
        """What words with expressions calculate, whichever numbers stand in them."""
        execution = emitter.executes
        if execution is None or not any(key >= FIRST_FORMULA for key in keys):
            return ()
        words = [key for key in keys if not FIRST_CODE <= key < FIRST_FORMULA and key < FIRST_TOKEN]
        typed = {
            own_number(value) for key, value in zip(words, execution.values, strict=True) if key < FIRST_CODE
        }
        postfix = self._of_text(channel, code, emitter, keys, typed)
        for slot, (key, value) in enumerate(zip(words, execution.values, strict=True)):
            if key >= FIRST_FORMULA:
                postfix.stored(value, slot)
            elif own_number(value) < 0:
                raise OtherError
        return tuple(postfix.done)

    def _assignments(
        self, channel: SinumerikChannel, code: SinumerikProgram, emitter: Emitter, keys: Sequence[int]
    ) -> Recipe | None:
        """Assignments to R parameters, and nothing else."""
        if any(key < FIRST_FORMULA or ASSIGNED != key < FIRST_TOKEN for key in keys) or not emitter.joins:
            return None
        postfix = self._of_text(channel, code, emitter, keys, set())
        for statement in emitter.statements:
            if statement.kind != nodes.Assign:
                return None
            postfix.assignment(statement)
        return Recipe((channel.mode, code), formulas=tuple(postfix.done))

    def _of_text(
        self,
        channel: SinumerikChannel,
        code: SinumerikProgram,
        emitter: Emitter,
        keys: Sequence[int],
        typed: set[int],
    ) -> TypedPostfix:
        """What makes operations of the code of a block that is read from text: its numbers in the order of the text.

        Raises:
            OtherError: The scanner has read other numbers than the compiler, as in a macro.
        """
        numbers = [
            (number.start, "n", place) for place, number in enumerate(emitter.numbers) if place not in typed
        ]
        found = sorted([*numbers, *((start, "o", place) for place, start in emitter.positions.items())])
        read = ["o" if key in (ASSIGNED, _VARIABLE) else "n" for key in keys if key in _WITH_NUMBER]
        language = channel.memory.language
        if [kind for _, kind, _ in found] != read or language.macros or code.scope_of(channel).macros:
            raise OtherError
        literals = {(kind, place): i for i, (_, kind, place) in enumerate(found)}
        located = self._variables.locate(
            channel, code, emitter, lambda place: _literal(literals, ("o", place))
        )
        return TypedPostfix(
            lambda place: sort_of(emitter, place), lambda place: _literal(literals, ("n", place)), located
        )


def _literal(literals: dict[tuple[str, int], int], key: tuple[str, int]) -> int:
    if key not in literals:
        raise OtherError
    return literals[key]


def _block(emitter: Emitter, keys: Sequence[int]) -> Block | None:
    """The block that the interpreter would run, if its functions and words are those that the scanner has read."""
    execution = emitter.executes
    if execution is None:
        return None
    block = execution.block
    codes = [f"G{key - FIRST_CODE}" for key in keys if FIRST_CODE <= key < FIRST_FORMULA]
    addresses = [_address(key) for key in keys if key < FIRST_CODE or FIRST_FORMULA <= key < FIRST_TOKEN]
    words = [word.address if word.index is None and not word.modifier else "" for word in block.words]
    if not any(key >= FIRST_FORMULA for key in keys):
        return block if codes == list(block.codes) and addresses == words and emitter.plain else None
    return block if codes == list(block.codes) and addresses == words else None


_VARIABLE = FIRST_TOKEN + Token.VARIABLE
_WITH_NUMBER = frozenset((ASSIGNED, _VARIABLE, FIRST_TOKEN + Token.NUMBER, FIRST_TOKEN + Token.DECIMAL))


def _address(key: int) -> str:
    if key >= FIRST_FORMULA:
        return "CR" if key == CR_FORMULA else chr(ord("A") + key - FIRST_FORMULA)
    letter, form = divmod(key, FORMS)
    if form == DIRECTION_FORM:
        return f"{chr(ord('A') + letter)}3"
    return "CR" if form == CR_FORM else chr(ord("A") + letter)
