"""Steps from the code of blocks: blocks of equal shape share one compiled function and differ in values only.

Compiled code has its numbers (`n0`, `n1`, …) and its objects (`o0`, …) as parameters. Python's compiler therefore runs
once for each shape of block, not for each block.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import (
    PASS,
    Code,
    Lifted,
    assigned,
    attribute,
    bound,
    call,
    constant,
    dotted,
    given,
    guarded,
    is_simple,
    item,
    name,
    run,
    when,
)
from polycnc.language.expressions.shapes import Function, Shapes, TooDeepError
from polycnc.language.sinumerik import runtime
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.place import fail
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Body
    from polycnc.language.expressions.shapes import Template
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.words import Block

CHANNEL = name("channel")
#: What a block may run into, and what becomes of it.
CAUGHT = ("AlarmError", "ZeroDivisionError", "OverflowError")
FAIL = (run(call("fail", name("error"), CHANNEL)),)
_LOCALS, _MAIN = name("L"), name("M")
_STOP = when(call("channel.control.preprocessing_stop", CHANNEL), (given(),))
_ON_CLOCK = run(call("channel.on_clock"))
_FETCH_LOCALS = assigned(_LOCALS, dotted("channel.level.locals"))
_FETCH_MAIN = assigned(_MAIN, attribute(item(dotted("channel.stack"), constant(0)), "locals"))
_INDEX = dotted("channel.level.index")
#: A block that only calculates or goes elsewhere is none for stages that look ahead; asked for where there are any.
OFF_PATH = assigned(dotted("channel.off_path"), dotted("channel.attention"))


class Number(NamedTuple):
    """A number of a block that its code has as parameter, and where it stands in the line."""

    value: int | float
    start: int
    end: int


class Branch(NamedTuple):
    """How a block of a control structure goes on.

    Attributes:
        kind: Its word: IF, ELSE, LOOP, …
        condition: Code of what must hold for the program to go on at `target`; None for always.
        target: Step, or -1 for a block that only marks a place.
    """

    kind: str
    condition: Code | None = None
    target: int = -1


class Execution(NamedTuple):
    """The words of a block that the control gets, where they are the same whenever the block runs.

    Attributes:
        block: The block without its values.
        values: Codes of the values, one for each word.
    """

    block: Block
    values: tuple[Code, ...]


class Emitter:
    """Collects the code of one block.

    Attributes:
        shapes: Compiled code of the control.
        statements: What the block does.
        uses_clock: A block reads or writes what only a program has that is executed in time.
        numbers: Numbers of the block that the code has as parameters.
        objects: Objects that the code uses.
        positions: Where the numbers of R parameters begin in the line, by the places of theirs among the objects.
        branch: How the block goes on, if it belongs to a control structure.
        execution: The words that one of the statements hands to the control.
        knows_place: The code holds step numbers or columns: it is good for this block only.
        can_join: The block is of a kind that may run in one function with others.
        acts: The control acts in it: the channel may have to look after something behind it.
        is_block: It has words or procedures; else it only calculates or goes elsewhere, and the main run gets nothing.
        leaves: A statement ends the step before its end.
        temporaries: How many temporary names the code uses.
    """

    def __init__(self, shapes: Shapes) -> None:
        self.shapes = shapes
        self.statements: list[Code] = []
        self.numbers: list[Number] = []
        self.objects: list[object] = []
        self.positions: dict[int, int] = {}
        self.uses_locals = False
        self.uses_main = False
        self.uses_stop = self.uses_clock = False
        self.branch: Branch | None = None
        self.execution: Execution | None = None
        self.knows_place = False
        self.can_join = False
        self.acts = False
        self.is_block = False
        self.leaves = False
        self.temporaries = 0

    def add(self, *statements: Code) -> None:
        """Add statements."""
        self.statements += statements

    def run(self, expression: Code) -> None:
        """Add an expression as a statement."""
        self.statements.append(run(expression))

    def number(self, value: float, token: Token) -> Lifted:
        """A number that stands in the block, as a parameter of the code."""
        self.numbers.append(Number(value, token.start, token.end))
        return Lifted("n", len(self.numbers) - 1)

    def as_real(self, code: Code) -> Code:
        """Code for a number as REAL; a number of the block becomes one."""
        if isinstance(code, Lifted) and code.letter == "n":
            number = self.numbers[code.place]
            self.numbers[code.place] = number._replace(value=float(number.value))
            return code
        return call("float", code)

    def object(self, value: object) -> Lifted:
        """An object that the code uses, as a parameter of it."""
        for i, known in enumerate(self.objects):
            if known is value:
                return Lifted("o", i)
        self.objects.append(value)
        return Lifted("o", len(self.objects) - 1)

    def parameter(self, number: int, token: Token) -> Lifted:
        """The number of an R parameter as an object of its own: each that is written may be another one."""
        self.objects.append(number)
        self.positions[len(self.objects) - 1] = token.start
        return Lifted("o", len(self.objects) - 1)

    def local(self) -> Code:
        """The list of local variables."""
        self.uses_locals = True
        return _LOCALS

    def main(self) -> Code:
        """The list of the main program's variables."""
        self.uses_main = True
        return _MAIN

    @property
    def joins(self) -> bool:
        """Whether the block may run in one function with its neighbours."""
        return self.can_join and not (self.uses_stop or self.uses_main)

    @property
    def is_empty(self) -> bool:
        """Whether the block does nothing."""
        return not self.statements and self.branch is None and not self.uses_stop

    @property
    def executes(self) -> Execution | None:
        """The words, if all that the block does is to hand them to the control."""
        alone = len(self.statements) == 1 and self.branch is None and not (self.uses_stop or self.uses_main)
        return self.execution if alone else None

    @property
    def plain(self) -> Block | None:
        """The block, if all that it does is to hand its own numbers to the control in their order."""
        execution = self.executes
        if execution is None:
            return None
        places = [own_number(value) for value in execution.values]
        return execution.block if places == list(range(len(places))) else None

    def twice(self, code: Code) -> tuple[Code, Code]:
        """Code to use first and code to use afterwards for a value that is needed twice."""
        if is_simple(code):
            return code, code
        temporary = f"t{self.temporaries}"
        self.temporaries += 1
        return bound(temporary, code), name(temporary)

    def body(self) -> Body:
        """The statements of the step."""
        body: list[Code] = [] if self.is_block else [OFF_PATH]
        if self.uses_clock:
            body.append(_ON_CLOCK)
        if self.uses_stop:
            body.append(_STOP)
        if self.uses_locals:
            body.append(_FETCH_LOCALS)
        if self.uses_main:
            body.append(_FETCH_MAIN)
        body += self.statements
        if self.branch is not None and self.branch.target >= 0:
            goes_on = assigned(_INDEX, self.object(self.branch.target))
            condition = self.branch.condition
            body.append(goes_on if condition is None else when(condition, (goes_on,)))
        return (guarded(tuple(body) or PASS, CAUGHT, FAIL),)

    def template(self) -> Template:
        """The shape of the block.

        Raises:
            NcSyntaxError: 12540 if the code is nested too deeply for Python: the block is too complex.
        """
        body = self.body()
        try:
            return self.shapes.template(Function(("channel",), len(self.numbers), len(self.objects), body))
        except TooDeepError:
            raise NcSyntaxError("12540", 1) from None

    def step(self) -> Step:
        """The step of the block."""
        template = self.template()
        return template.function((*(number.value for number in self.numbers), *self.objects))


def own_number(code: Code) -> int:
    """Which of the block's numbers a value is, with or without a sign and as REAL or not; -1 for another value."""
    if code.kind == nodes.Call and code[1] == name("float"):
        arguments = code[2]
        assert isinstance(arguments, tuple)
        code = arguments[0]
    if code.kind == nodes.UnaryOp and code[1] in (nodes.USub, nodes.UAdd):
        operand = code[2]
        assert isinstance(operand, Code)
        code = operand
    return code.place if isinstance(code, Lifted) and code.letter == "n" else -1


_NAMES: dict[str, object] = {
    **runtime.NAMESPACE,
    "AlarmError": AlarmError,
    "WordAlarm": WordAlarm,
    "fail": fail,
}


def nc_shapes() -> Shapes:
    """A place for the compiled code of a control's programs."""
    return Shapes(_NAMES)


def provide(**names: object) -> None:
    """Make functions known to compiled code (modules that compile statements bring their own)."""
    _NAMES.update(names)
