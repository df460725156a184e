"""Blocks that follow each other as one function, loops and branches included.

Getting to a block costs more than running it. When blocks come round again, a stretch of them (assignments, words,
jumps, control structures) is joined into one generated function: IF becomes `if`, a loop becomes a loop. Between the
blocks the function keeps the level's `current` and the channel's `mark`, so that an alarm names its line and takes back
its block. It hands over as soon as a block asks for attention (a call, a stop, a stage in the path), has jumped, or was
never run before. The steps of single blocks stay where jumps find them.

Every block is counted, those of ELSE and ENDIF too, and near the block limit (`Channel.joined_below`) only the first
block runs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import (
    BREAK,
    PASS,
    added,
    assigned,
    attribute,
    binary,
    call,
    compared,
    constant,
    dotted,
    either,
    given,
    guarded,
    listed,
    moved,
    name,
    negation,
    quoted,
    repeated,
    when,
)
from polycnc.language.expressions.joined import (
    ATTENTION,
    BURST,
    CHANNEL,
    CURRENT,
    INDEX,
    LEVEL,
    MARK,
    MAX_JOINED,
    ROOM,
    lifted_object,
)
from polycnc.language.expressions.joined import BLOCKS as ALL_BLOCKS
from polycnc.language.expressions.shapes import Function, TooDeepError
from polycnc.language.sinumerik.emitter import CAUGHT, FAIL, OFF_PATH

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Code
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.statements.structures import Structure

    #: Gives the code of a block that has been run and may join, else None.
    Source = Callable[[int], Emitter | None]

#: Blocks that this function has run, and those that it may run.
_BLOCKS, _ROOM = name("blocks"), name("room")
_COUNT = added(_BLOCKS, 1)
_PASSES = call("range", constant(BURST))
_LEAVE = given()
#: What is said to stages that look ahead when such a block, or one that only calculates, hands over.
_ON_PATH = {True: (assigned(dotted("channel.off_path"), constant(False)),), False: ()}


class _Stretch(NamedTuple):
    """Code of blocks that follow each other.

    Attributes:
        body: Their statements.
        end: The step at which they end.
        closed: Whether the code never comes to this end: it was a loop, or it has left.
    """

    body: list[Code]
    end: int
    closed: bool


class Joiner:
    """Joins the blocks from one step on.

    Args:
        source: Code of single blocks.
        structures: Structure of every step that belongs to one.
        first: The step.
        alone: Runs the block of that step alone.
    """

    def __init__(self, source: Source, structures: dict[int, Structure], first: int, alone: Step) -> None:
        self._alone = alone
        self._source = source
        self._structures = structures
        self._first = first
        self._numbers: list[int | float] = []
        self._objects: list[object] = [alone]
        self.count = 0
        self.exits: set[int] = set()

    def step(self, shapes: Shapes) -> Step | None:
        """The joined step; None if it would hold fewer than two blocks.

        `exits` then names the steps at which the function stops because they have not been run yet.
        """
        stretch = self._stretch(self._first, None)
        if self.count < 2:
            return None
        body = stretch.body if stretch.closed else [*stretch.body, *_left(stretch.end)]
        near_limit = (assigned(ATTENTION, constant(True)), quoted("return {0}(channel)", lifted_object(0)))
        statements = (
            assigned(_ROOM, binary(nodes.Sub, ROOM, ALL_BLOCKS)),
            when(compared(_ROOM, nodes.Lt, constant(0)), near_limit),
            OFF_PATH,
            assigned(LEVEL, attribute(CHANNEL, "level")),
            assigned(name("L"), attribute(LEVEL, "locals")),
            assigned(_BLOCKS, constant(-1)),  # the channel counts the step itself
            guarded(tuple(body), CAUGHT, FAIL, (quoted("channel.blocks += blocks"),)),
        )
        function = Function(("channel",), len(self._numbers), len(self._objects), statements)
        try:
            return shapes.single(function, (*self._numbers, *self._objects))
        except TooDeepError:
            return None  # loops nested deeper than Python nests them

    # ---- stretches -----------------------------------------------------------------------------------------

    def _stretch(self, index: int, inside: Structure | None) -> _Stretch:
        """The blocks from a step on; inside a structure they end at its ELSE or at its last block."""
        body: list[Code] = []
        while self.count < MAX_JOINED:
            structure = self._structures.get(index)
            if inside is not None and structure is inside:
                return _Stretch(body, index, closed=False)
            emitter = self._source(index)
            if emitter is None:
                self.exits.add(index)
                break
            if structure is None or structure.error:
                body += self._block(index, emitter)
                index += 1
            elif structure.start == index:
                joined = self._structure(structure)
                if joined is None:
                    break
                body += joined
                index = structure.end + 1
            elif (
                structure.end == index and emitter.branch is not None and emitter.branch.target == self._first
            ):
                return _Stretch(self._outer_loop(index, body, emitter), index + 1, closed=True)
            elif emitter.branch is not None and emitter.branch.kind == "ENDIF":
                body.append(_COUNT)
                index += 1
            else:
                break
        if inside is not None:
            body += _left(index)
        return _Stretch(body, index, closed=inside is not None)

    def _block(self, index: int, emitter: Emitter) -> list[Code]:
        """One block without its branch; a block in which something happens hands over if it must."""
        self.count += 1
        body = [assigned(CURRENT, constant(index))]
        if emitter.acts or emitter.leaves:
            body.append(assigned(INDEX, constant(index + 1)))
        if emitter.acts:
            body.append(MARK)
        body += [_COUNT, *self._statements(emitter)]
        if emitter.acts:
            jumped = compared(INDEX, nodes.NotEq, constant(index + 1))
            body.append(when(either(nodes.Or, ATTENTION, jumped), (*_ON_PATH[emitter.is_block], _LEAVE)))
        return body

    def _statements(self, emitter: Emitter) -> list[Code]:
        """The statements of a block, with its numbers and objects among those of all."""
        offsets = self._keep(emitter)
        return [moved(statement, offsets) for statement in emitter.statements]

    def _keep(self, emitter: Emitter) -> dict[str, int]:
        """Take a block's numbers and objects; where they are now."""
        offsets = {"n": len(self._numbers), "o": len(self._objects)}
        self._numbers += [number.value for number in emitter.numbers]
        self._objects += emitter.objects
        return offsets

    # ---- structures ----------------------------------------------------------------------------------------

    def _structure(self, structure: Structure) -> list[Code] | None:
        """A whole structure; None if it cannot be joined."""
        if structure.end < 0:
            return None
        return self._if(structure) if structure.kind == "IF" else self._loop(structure)

    def _condition(self, emitter: Emitter) -> Code:
        """Code of a block's branch condition; its numbers and objects are kept."""
        assert emitter.branch is not None
        assert emitter.branch.condition is not None
        return moved(emitter.branch.condition, self._keep(emitter))

    def _if(self, structure: Structure) -> list[Code]:
        emitter = self._source(structure.start)
        assert emitter is not None
        self.count += 1
        failed = self._condition(emitter)
        other: tuple[Code, ...] = PASS
        if structure.otherwise <= structure.end:
            other = self._branch(structure.otherwise, structure)
        then = self._branch(structure.start + 1, structure)
        return [assigned(CURRENT, constant(structure.start)), _COUNT, when(failed, other, then)]

    def _branch(self, index: int, structure: Structure) -> tuple[Code, ...]:
        """The blocks of one branch, and its ELSE or ENDIF."""
        stretch = self._stretch(index, structure)
        return tuple(stretch.body) if stretch.closed else (*stretch.body, _COUNT)

    def _loop(self, structure: Structure) -> list[Code] | None:
        """LOOP, WHILE, FOR, REPEAT: after a burst of passes the channel has a look."""
        first, last = self._source(structure.start), self._source(structure.end)
        if first is None or last is None:
            return None
        self.count += 1
        head = [assigned(CURRENT, constant(structure.start)), _COUNT]
        passes, again = _PASSES, structure.start + 1
        before: list[Code] = []
        begin: list[Code] = []
        over = _left(again)
        if structure.kind == "FOR":
            passes = name("burst")
            before = [*head, *self._statements(first)]
            none, some = (assigned(passes, listed(())),), (assigned(passes, _PASSES),)
            before.append(when(self._condition(first), none, some))
            over = (when(passes, over),)
        elif structure.kind == "WHILE":
            again = structure.start
            over = _left(again)
            begin = [*head, when(self._condition(first), (BREAK,))]
        else:
            before = [_COUNT]
        body = [*begin, *self._stretch(structure.start + 1, structure).body, *self._close(structure, last)]
        return [*before, _repeated(passes, again, body, over)]

    def _close(self, structure: Structure, last: Emitter) -> list[Code]:
        """The end of a loop: what its last block does, and whether there is another pass."""
        body = [assigned(CURRENT, constant(structure.end)), _COUNT, *self._statements(last)]
        assert last.branch is not None
        if last.branch.condition is not None:
            body.append(when(negation(self._condition(last)), (BREAK,)))
        return body

    def _outer_loop(self, index: int, body: list[Code], last: Emitter) -> list[Code]:
        """The blocks so far are the body of a loop that began before them: put them into one."""
        body = [*body, *self._close(self._structures[index], last)]
        self.count += 1
        return [_repeated(_PASSES, self._first, body, _left(self._first)), *_left(index + 1)]


def _repeated(passes: Code, again: int, body: list[Code], over: tuple[Code, ...]) -> Code:
    """A loop, which the channel takes over at step `again` when the block limit is near; `over`: behind a burst."""
    handed_over = when(compared(_BLOCKS, nodes.Gt, _ROOM), _left(again))
    return repeated(passes, (handed_over, *body), over)


def _left(index: int) -> tuple[Code, ...]:
    """Go back to the channel, which goes on at a step."""
    return assigned(INDEX, constant(index)), _LEAVE
