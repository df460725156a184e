"""Steps from source text: blocks of equal shape share one compiled function and differ in numbers only.

Compiled code has its numbers (`n0`, `n1`, …) and its objects (`o0`, …) as parameters. Python's compiler
therefore runs once for each shape of block, not for each block.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from polycnc.language.sinumerik import runtime
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.place import fail
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.steps import Step
    from polycnc.language.sinumerik.lexer import Token

    Factory = Callable[[tuple[int | float, ...], tuple[Any, ...]], Step]

_SIMPLE = re.compile(r"-?[\w.]+(?:\[\w+\])?")
_factories: dict[str, Factory] = {}


class Number(NamedTuple):
    """A number of a block that its code has as parameter, and where it stands in the line."""

    value: int | float
    start: int
    end: int


class Branch(NamedTuple):
    """How a block of a control structure goes on.

    Attributes:
        kind: Its word: IF, ELSE, LOOP, …
        condition: Code of what must hold for the program to go on at `target`; empty for always.
        target: Step, or -1 for a block that only marks a place.
    """

    kind: str
    condition: str = ""
    target: int = -1


class Emitter:
    """Collects the code of one block.

    Attributes:
        lines: Statements.
        numbers: Numbers of the block that the code has as parameters.
        objects: Objects that the code uses.
        branch: How the block goes on, if it belongs to a control structure.
        knows_place: The code holds step numbers or columns: it is good for this block only.
        can_join: The block is of a kind that may run in one function with others.
        acts: The control acts in it: the channel may have to look after something behind it.
        has_text: A text stands in the code.
        temporaries: How many temporary names the code uses.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.numbers: list[Number] = []
        self.objects: list[Any] = []
        self.uses_locals = False
        self.uses_main = False
        self.uses_stop = False
        self.branch: Branch | None = None
        self.knows_place = False
        self.can_join = False
        self.acts = False
        self.has_text = False
        self.temporaries = 0
        self.indent = 0

    def line(self, text: str) -> None:
        """Add a statement."""
        self.lines.append("    " * self.indent + text)

    def number(self, value: float, token: Token) -> str:
        """Name of a number that stands in the block."""
        self.numbers.append(Number(value, token.start, token.end))
        return f"n{len(self.numbers) - 1}"

    def as_real(self, code: str) -> str:
        """Code for a number as REAL; a number of the block becomes one."""
        if code[0] == "n" and code[1:].isdecimal():
            place = int(code[1:])
            self.numbers[place] = self.numbers[place]._replace(value=float(self.numbers[place].value))
            return code
        return f"float({code})"

    def object(self, value: Any) -> str:
        """Name of an object that the code uses."""
        for i, known in enumerate(self.objects):
            if known is value:
                return f"o{i}"
        self.objects.append(value)
        return f"o{len(self.objects) - 1}"

    def local(self) -> str:
        """Name of the list of local variables."""
        self.uses_locals = True
        return "L"

    def main(self) -> str:
        """Name of the list of the main program's variables."""
        self.uses_main = True
        return "M"

    @property
    def joins(self) -> bool:
        """Whether the block may run in one function with its neighbours."""
        return self.can_join and not (self.has_text or self.uses_stop or self.uses_main)

    def twice(self, code: str) -> tuple[str, str]:
        """Code to use first and code to use afterwards for a value that is needed twice."""
        if _SIMPLE.fullmatch(code):
            return code, code
        name = f"t{self.temporaries}"
        self.temporaries += 1
        return f"({name} := {code})", name

    def source(self) -> str:
        """The function that makes the step."""
        head = ["def make(numbers, objects):"]
        if self.numbers:
            head.append(f"    {', '.join(f'n{i}' for i in range(len(self.numbers)))}, = numbers")
        if self.objects:
            head.append(f"    {', '.join(f'o{i}' for i in range(len(self.objects)))}, = objects")
        head += ["    def step(channel):", "        try:"]
        body = []
        if self.uses_stop:
            body.append("if channel.control.preprocessing_stop(channel): return")
        if self.uses_locals:
            body.append("L = channel.level.locals")
        if self.uses_main:
            body.append("M = channel.stack[0].locals")
        body += self.lines
        if self.branch is not None and self.branch.target >= 0:
            when = f"if {self.branch.condition}: " if self.branch.condition else ""
            body.append(f"{when}channel.level.index = {self.branch.target}")
        if not body:
            body.append("pass")
        head += ["            " + line for line in body]
        head += ["        except (AlarmError, ZeroDivisionError, OverflowError) as error:"]
        head += ["            fail(error, channel)", "    return step"]
        return "\n".join(head)

    def factory(self) -> Factory:
        """The function that makes steps of this shape out of numbers and objects."""
        source = self.source()
        factory = _factories.get(source)
        if factory is None:
            factory = _factories[source] = compiled(source, "make")
        return factory

    def step(self) -> Step:
        """The step of the block."""
        return self.factory()(tuple(number.value for number in self.numbers), tuple(self.objects))


_NAMESPACE: dict[str, Any] = {
    **runtime.NAMESPACE,
    "AlarmError": AlarmError,
    "WordAlarm": WordAlarm,
    "fail": fail,
}


def compiled(source: str, name: str) -> Any:
    """A function of generated code, which may use what `provide` has made known.

    Raises:
        NcSyntaxError: 12540 if the code is nested too deeply for Python: the block is too complex.
    """
    try:
        code = compile(source, "<block>", "exec")
    except (SyntaxError, RecursionError, MemoryError):
        raise NcSyntaxError("12540", 1) from None
    exec(code, _NAMESPACE)
    return _NAMESPACE.pop(name)


def provide(**names: Any) -> None:
    """Make functions known to compiled code (modules that compile statements bring their own)."""
    _NAMESPACE.update(names)
