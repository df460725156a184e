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

import re
from typing import TYPE_CHECKING, Any

from polycnc.language.sinumerik.emitter import compiled
from polycnc.language.sinumerik.errors import NcSyntaxError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.steps import Step
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.statements.structures import Structure

    #: Gives the code of a block that has been run and may join, else None.
    Source = Callable[[int], Emitter | None]

#: How many blocks are joined at the most.
MAX_JOINED = 200
#: Passes of a loop between two looks at the block limit and the size of the chunk.
BURST = 256
_NAME = re.compile(r"\b([not])(\d+)\b")


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
        self._lines: list[str] = []
        self._numbers: list[int | float] = []
        self._objects: list[Any] = []
        self._temporaries = 0
        self.count = 0
        self.exits: set[int] = set()

    def step(self) -> Step | None:
        """The joined step; None if it would hold fewer than two blocks.

        `exits` then names the steps at which the function stops because they have not been run yet.
        """
        self._add(0, "def run(channel):")
        self._add(
            1,
            "room = channel.joined_below - channel.blocks",
            "if room < 0:",
            "    channel.attention = True",
            "    return alone(channel)",
            "level = channel.level",
            "L = level.locals",
            "blocks = -1",  # the channel counts the step itself
            "try:",
        )
        end, looped = self._stretch(self._first, 2, None)
        if self.count < 2:
            return None
        if not looped:
            self._leave(2, end)
        self._add(
            1, "except (AlarmError, ZeroDivisionError, OverflowError) as error:", "    fail(error, channel)"
        )
        self._add(1, "finally:", "    channel.blocks += blocks")
        head = ["def make(numbers, objects, alone):"]
        head += [f"    {name}{i} = {values}[{i}]" for i, (name, values) in self._parameters()]
        source = "\n".join([*head, *("    " + line for line in self._lines), "    return run"])
        try:
            run: Step = compiled(source, "make")(self._numbers, self._objects, self._alone)
        except NcSyntaxError:
            return None  # loops nested deeper than Python nests them
        return run

    def _parameters(self) -> list[tuple[int, tuple[str, str]]]:
        numbers = [(i, ("n", "numbers")) for i in range(len(self._numbers))]
        return numbers + [(i, ("o", "objects")) for i in range(len(self._objects))]

    def _add(self, indent: int, *lines: str) -> None:
        self._lines += ["    " * indent + line for line in lines]

    def _leave(self, indent: int, index: int) -> None:
        """Go back to the channel, which goes on at a step."""
        self._add(indent, f"level.index = {index}", "return")

    # ---- stretches -----------------------------------------------------------------------------------------

    def _stretch(self, index: int, indent: int, inside: Structure | None) -> tuple[int, bool]:
        """Add blocks from a step on.

        Returns:
            The step at which the stretch ends, and whether the code never comes to this end (it was a loop, or it
            has left). Inside a structure the stretch ends at its ELSE or at its last block.
        """
        start = len(self._lines)
        while self.count < MAX_JOINED:
            structure = self._structures.get(index)
            if inside is not None and structure is inside:
                return index, False
            emitter = self._source(index)
            if emitter is None:
                self.exits.add(index)
                break
            if structure is None or structure.error:
                self._block(index, indent, emitter)
                index += 1
            elif structure.start == index:
                following = self._structure(structure, indent)
                if following < 0:
                    break
                index = following
            elif (
                structure.end == index and emitter.branch is not None and emitter.branch.target == self._first
            ):
                return self._outer_loop(index, start, indent, emitter), True
            elif emitter.branch is not None and emitter.branch.kind == "ENDIF":
                self._add(indent, "blocks += 1")
                index += 1
            else:
                break
        if inside is not None:
            self._leave(indent, index)
        return index, inside is not None

    def _block(self, index: int, indent: int, emitter: Emitter) -> None:
        """One block without its branch; a block in which something happens hands over if it must."""
        self.count += 1
        jumps = any("return" in line for line in emitter.lines)
        self._add(indent, f"level.current = {index}")
        if emitter.acts or jumps:
            self._add(indent, f"level.index = {index + 1}")
        if emitter.acts:
            self._add(indent, "channel.mark = len(channel.toolpath.chunk.kind)")
        self._add(indent, "blocks += 1")
        for line in emitter.lines:
            self._add(indent, self._renamed(line))
        self._keep(emitter)
        if emitter.acts:
            self._add(indent, f"if channel.attention or level.index != {index + 1}: return")

    def _renamed(self, code: str) -> str:
        """Code of one block with its numbers, objects and temporaries among those of all."""
        offset = {"n": len(self._numbers), "o": len(self._objects), "t": self._temporaries}
        return _NAME.sub(lambda match: f"{match[1]}{int(match[2]) + offset[match[1]]}", code)

    def _keep(self, emitter: Emitter) -> None:
        self._numbers += [number.value for number in emitter.numbers]
        self._objects += emitter.objects
        self._temporaries += emitter.temporaries

    # ---- structures ----------------------------------------------------------------------------------------

    def _structure(self, structure: Structure, indent: int) -> int:
        """Add a whole structure; the step behind it, or -1 if it cannot be joined."""
        if structure.end < 0:
            return -1
        if structure.kind == "IF":
            return self._if(structure, indent)
        return self._loop(structure, indent)

    def _condition(self, emitter: Emitter) -> str:
        """Code of a block's branch condition; its numbers and objects are kept."""
        assert emitter.branch is not None
        code = self._renamed(emitter.branch.condition)
        self._keep(emitter)
        return code

    def _if(self, structure: Structure, indent: int) -> int:
        emitter = self._source(structure.start)
        assert emitter is not None
        self.count += 1
        self._add(indent, f"level.current = {structure.start}", "blocks += 1")
        self._add(indent, f"if {self._condition(emitter)}:")
        if structure.otherwise <= structure.end:
            self._branch(structure.otherwise, indent + 1, structure)
        else:
            self._add(indent + 1, "pass")
        self._add(indent, "else:")
        self._branch(structure.start + 1, indent + 1, structure)
        return structure.end + 1

    def _branch(self, index: int, indent: int, structure: Structure) -> None:
        """The blocks of one branch, and its ELSE or ENDIF."""
        _, has_left = self._stretch(index, indent, structure)
        if not has_left:
            self._add(indent, "blocks += 1")

    def _loop(self, structure: Structure, indent: int) -> int:
        """LOOP, WHILE, FOR, REPEAT: after a burst of passes the channel has a look."""
        first, last = self._source(structure.start), self._source(structure.end)
        if first is None or last is None:
            return -1
        self.count += 1
        again = structure.start if structure.kind == "WHILE" else structure.start + 1
        if structure.kind == "FOR":
            self._add(indent, f"level.current = {structure.start}", "blocks += 1")
            self._add(indent, *(self._renamed(line) for line in first.lines))
            self._add(indent, f"if {self._condition(first)}: burst = ()")
            self._add(indent, f"else: burst = range({BURST})")
        else:
            if structure.kind != "WHILE":
                self._add(indent, "blocks += 1")
            self._add(indent, f"burst = range({BURST})")
        self._passes(indent, "burst", again)
        if structure.kind == "WHILE":
            self._add(indent + 1, f"level.current = {structure.start}", "blocks += 1")
            self._add(indent + 1, f"if {self._condition(first)}: break")
        self._stretch(structure.start + 1, indent + 1, structure)
        self._close(structure, indent + 1, last)
        self._add(indent, "else:")
        if structure.kind == "FOR":
            self._add(indent + 1, "if burst:")
            self._leave(indent + 2, again)
        else:
            self._leave(indent + 1, again)
        return structure.end + 1

    def _passes(self, indent: int, passes: str, again: int) -> None:
        """The head of a loop, which the channel takes over at step `again` when the block limit is near."""
        self._add(indent, f"for _ in {passes}:")
        self._add(indent + 1, "if blocks > room:")
        self._leave(indent + 2, again)

    def _close(self, structure: Structure, indent: int, last: Emitter) -> None:
        """The end of a loop: what its last block does, and whether there is another pass."""
        self._add(indent, f"level.current = {structure.end}", "blocks += 1")
        for line in last.lines:
            self._add(indent, self._renamed(line))
        assert last.branch is not None
        if last.branch.condition:
            self._add(indent, f"if not ({self._condition(last)}): break")

    def _outer_loop(self, index: int, start: int, indent: int, last: Emitter) -> int:
        """The blocks so far are the body of a loop that began before them: put them into one."""
        body = ["    " + line for line in self._lines[start:]]
        del self._lines[start:]
        self._passes(indent, f"range({BURST})", self._first)
        self._lines += body
        self._close(self._structures[index], indent + 1, last)
        self.count += 1
        self._add(indent, "else:")
        self._leave(indent + 1, self._first)
        self._leave(indent, index + 1)
        return index + 1
