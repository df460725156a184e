"""Joining steps that follow each other into one.

A block on its own costs more to get to than to run. When lines come round again, the steps of a stretch of them (macro
statements, blocks of words) are joined into one generated function that does what they would do one by one; a loop
whose whole body is such a stretch becomes a loop in Python. Between the steps the function keeps the level's `current`
and the channel's `mark`, so that an alarm names its line and takes back its block, and it hands over as soon as a block
asks for attention (a call, a stop, a stage in the path) or has jumped. The steps themselves stay where jumps find them.

Every block is counted, and near the block limit (`Channel.joined_below`) only the first step runs.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions import joined, nodes
from polycnc.language.expressions.code import (
    added,
    assigned,
    attribute,
    binary,
    call,
    compared,
    constant,
    deleted,
    either,
    given,
    item,
    moved,
    name,
    negation,
    repeated,
    run,
    when,
)
from polycnc.language.expressions.joined import ATTENTION, BLOCKS, BURST, CHANNEL, CURRENT, INDEX, ROOM
from polycnc.language.expressions.shapes import Function
from polycnc.language.word_address.statements import Assignment, ConditionalJump, LoopEnd
from polycnc.language.word_address.words import ExpressionBlock, WordBlock

if TYPE_CHECKING:
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Body, Code
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.language.word_address.macro_b import Lifting

JOINABLE = (Assignment, ConditionalJump, WordBlock, ExpressionBlock)


class _Stretch:
    """The code of joined steps."""

    def __init__(self) -> None:
        self.numbers: list[float] = []
        self.objects: list[Step] = []
        self.count = 0

    def lift(self, step: Step) -> Code:
        """A step as a parameter of the code."""
        self.objects.append(step)
        return joined.lifted_object(len(self.objects) - 1)

    def _placed(self, lifting: Lifting) -> Code:
        """Code of one step, with its numbers among those of all."""
        offset = len(self.numbers)
        self.numbers += lifting.numbers
        return moved(lifting.code, {"n": offset})

    def step(self, index: int, step: Step) -> Body:
        """One step."""
        self.count += 1
        current = assigned(CURRENT, constant(index))
        if isinstance(step, Assignment):
            return current, self._placed(step.statement)
        following = constant(index + 1)
        hands_over = either(nodes.Or, compared(INDEX, nodes.NotEq, following), ATTENTION)
        if isinstance(step, ConditionalJump):
            condition = self._placed(step.condition.lifting)
            return current, when(condition, self._acting(step.jump, following, hands_over))
        return current, joined.MARK, *self._acting(step, following, hands_over)

    def _acting(self, step: Step, following: Code, hands_over: Code) -> Body:
        return (
            assigned(INDEX, following),
            run(call(self.lift(step), CHANNEL)),
            when(hands_over, (added(BLOCKS, self.count - 1), given())),
        )

    def function(self, shapes: Shapes, body: Body, alone: Step) -> Step:
        """The step; near the block limit it runs the first of its steps alone."""
        near_limit = compared(BLOCKS, nodes.Gt, ROOM)
        first = given(call(self.lift(alone), CHANNEL))
        head = (
            when(near_limit, (assigned(ATTENTION, constant(True)), first)),
            assigned(name("m"), attribute(CHANNEL, "memory")),
            assigned(name("level"), attribute(CHANNEL, "level")),
        )
        function = Function(("channel",), len(self.numbers), len(self.objects), (*head, *body))
        return shapes.single(function, (*self.numbers, *self.objects))


def join(shapes: Shapes, steps: list[tuple[int, Step]]) -> Step:
    """One step for a stretch of steps, given with their numbers."""
    stretch = _Stretch()
    body = [statement for index, step in steps for statement in stretch.step(index, step)]
    body += [assigned(INDEX, constant(steps[-1][0] + 1)), added(BLOCKS, stretch.count - 1)]
    return stretch.function(shapes, tuple(body), steps[0][1])


def join_loop(shapes: Shapes, steps: list[tuple[int, Step]], end: int, loop_end: LoopEnd) -> Step:
    """One step for a stretch of steps that is the whole body of a loop; `end` is the step of its END."""
    first, count = steps[0][0], len(steps) + 1
    stretch = _Stretch()
    loop, condition, number = name("loop"), name("condition"), constant(loop_end.number)
    loops = attribute(name("level"), "data")
    entered = _any(
        compared(loop, nodes.Is, constant(None)),
        compared(attribute(loop, "end"), nodes.NotEq, constant(end)),
        compared(attribute(loop, "start"), nodes.NotEq, constant(first - 1)),
    )
    one_by_one = run(call(stretch.lift(join(shapes, steps)), CHANNEL))
    room = binary(nodes.FloorDiv, binary(nodes.Sub, ROOM, BLOCKS), constant(count))
    passes = call("range", call("min", constant(BURST), binary(nodes.Add, room, constant(1))))
    over = either(
        nodes.And, compared(condition, nodes.IsNot, constant(None)), negation(call(condition, CHANNEL))
    )
    last = (
        assigned(CURRENT, constant(end)),
        added(BLOCKS, count),
        when(
            over,
            (deleted(item(loops, number)), assigned(INDEX, constant(end + 1)), added(BLOCKS, -1), given()),
        ),
    )
    body = (
        assigned(loop, call(attribute(loops, "get"), number)),
        when(entered, (one_by_one, given())),
        assigned(condition, attribute(loop, "condition")),
        repeated(passes, (*(line for index, step in steps for line in stretch.step(index, step)), *last)),
        assigned(INDEX, constant(first)),
        assigned(ATTENTION, constant(True)),
        added(BLOCKS, -1),
    )
    return stretch.function(shapes, body, steps[0][1])


def _any(*conditions: Code) -> Code:
    first, *others = conditions
    for condition in others:
        first = either(nodes.Or, first, condition)
    return first
