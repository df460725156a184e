"""Joining steps that follow each other into one.

A block on its own costs more to get to than to run. When lines come round again, the steps of a stretch of them (macro
statements, blocks of words) are joined into one generated function that does what they would do one by one; a loop
whose whole body is such a stretch becomes a loop in Python. Between the steps the function keeps the level's `current`
and the channel's `mark`, so that an alarm names its line and takes back its block, and it hands over as soon as a block
asks for attention (a call, a stop, a stage in the path) or has jumped. The steps themselves stay where jumps find them.

Every block is counted, and near the block limit (`Channel.joined_below`) only the first step runs.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from polycnc.language.word_address.functions import NAMESPACE
from polycnc.language.word_address.statements import Assignment, ConditionalJump, LoopEnd
from polycnc.language.word_address.words import ExpressionBlock, WordBlock

if TYPE_CHECKING:
    from polycnc.channel.steps import Step

JOINABLE = (Assignment, ConditionalJump, WordBlock, ExpressionBlock)
#: How many steps are joined at the most.
MAX_JOINED = 200
#: Passes of a loop between two looks at the block limit and the size of the chunk.
BURST = 256
_LITERAL = re.compile(r"(?<![\w.])k\[(\d+)\]")


class _Source:
    """Generated Python of joined steps."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.literals: list[float] = []
        self.steps: dict[int, Any] = {}
        self.statements = 0

    def add(self, indent: str, *lines: str) -> None:
        """Add lines."""
        self.lines += [indent + line for line in lines]

    def shifted(self, source: str, literals: list[float]) -> str:
        """A generated expression with its literals placed among those of the whole."""
        offset = len(self.literals)
        self.literals += literals
        return _LITERAL.sub(lambda match: f"k[{int(match[1]) + offset}]", source)

    def step(self, indent: str, index: int, step: Step) -> None:
        """One step."""
        self.statements += 1
        self.add(indent, f"level.current = {index}")
        if isinstance(step, Assignment):
            self.add(indent, f"{step.target} = {self.shifted(step.source, step.literals)}")
            return
        self.steps[index] = step.jump if isinstance(step, ConditionalJump) else step
        if isinstance(step, ConditionalJump):
            self.add(indent, f"if {self.shifted(step.source, step.literals)}:")
            indent += "    "
        else:
            self.add(indent, "channel.mark = len(channel.toolpath.chunk.kind)")
        self.add(
            indent,
            f"level.index = {index + 1}",
            f"s[{index}](channel)",
            f"if level.index != {index + 1} or channel.attention:",
            f"    channel.blocks += {self.statements - 1}",
            "    return",
        )

    def function(self, **names: Step) -> Step:
        """The step."""
        space: dict[str, Any] = {
            **NAMESPACE, **names, "k": self.literals, "s": self.steps, "range": range, "len": len, "min": min,
        }  # fmt: skip
        exec(compile("\n".join(self.lines), "<macro>", "exec"), space)
        step: Step = space["run"]
        return step


def join(steps: list[tuple[int, Step]]) -> Step:
    """One step for a stretch of steps, given with their numbers."""
    source = _start()
    for index, step in steps:
        source.step("    ", index, step)
    source.add("    ", f"level.index = {steps[-1][0] + 1}", f"channel.blocks += {source.statements - 1}")
    return source.function(first=steps[0][1])


def join_loop(steps: list[tuple[int, Step]], end: int, loop_end: LoopEnd) -> Step:
    """One step for a stretch of steps that is the whole body of a loop; `end` is the step of its END."""
    first, count = steps[0][0], len(steps) + 1
    source = _start()
    source.add(
        "    ",
        f"loop = level.data.get({loop_end.number})",
        f"if loop is None or loop.end != {end} or loop.start != {first - 1}:",
        "    one_by_one(channel)",
        "    return",
        "condition = loop.condition",
        f"for _ in range(min({BURST}, (channel.joined_below - channel.blocks) // {count} + 1)):",
    )
    for index, step in steps:
        source.step("        ", index, step)
    source.add(
        "        ",
        f"level.current = {end}",
        f"channel.blocks += {count}",
        "if condition is not None and not condition(channel):",
        f"    del level.data[{loop_end.number}]",
        f"    level.index = {end + 1}",
        "    channel.blocks -= 1",
        "    return",
    )
    source.add("    ", f"level.index = {first}", "channel.attention = True", "channel.blocks -= 1")
    return source.function(first=steps[0][1], one_by_one=join(steps))


def _start() -> _Source:
    source = _Source()
    source.add("", "def run(channel):")
    source.add(
        "    ",
        "if channel.blocks > channel.joined_below:",
        "    channel.attention = True",
        "    return first(channel)",
        "m = channel.memory",
        "level = channel.level",
    )
    return source
