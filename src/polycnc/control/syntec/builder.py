"""Plans of SYNTEC blocks: what differs from the word-address base in reading a block's shape."""

from __future__ import annotations

from polycnc.control.word_address.block.codes import GCode
from polycnc.control.word_address.block.plan import Builder
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.model import program_called

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Plan
    from polycnc.control.word_address.control import WordAddressControl
    from polycnc.program import Program

FIRST_MACRO, LAST_MACRO = 200, 999
#: One-shot codes that take the axis words of their block and move with them.
MOVING_CODES = frozenset({"G28", "G29", "G30", "G31", "G53"})
CALLS = frozenset({"G65", "G66", "G66.1"})
TEXT = '"'
_ARC_CODES = frozenset({"G2", "G3"})


class SyntecBuilder(Builder):
    """Works out one plan.

    Attributes:
        g_macros: G codes of the block that call a program, each with it, in order.
        called_m: The registered M code of the block.
        plain: Registered codes act as standard codes.
    """

    def __init__(
        self,
        channel: SyntecChannel,
        control: WordAddressControl,
        signature: tuple[str, ...],
        *,
        plain: bool = False,
    ) -> None:
        self.g_macros: list[tuple[str, Program]] = []
        self.called_m: int | None = None
        self.plain = plain
        self._plain_plan: Plan | None = None
        super().__init__(channel, control, signature)
        self._refuse_texts()

    def _refuse_texts(self) -> None:
        """Only the arguments of a macro may be texts."""
        if self.g_macros or any(row.code in CALLS for row in self.codes):
            return
        for address, _, form in self.typed:
            if form == TEXT:
                raise self.control.fail("argument", address=address, word=address)

    def _row(self, code: str) -> GCode:
        """A code of the table, or one of a macro: G200 to G999, G123.4 where its file exists, a machine's own."""
        function = self.channel.machine.g_functions.get(code)
        calls = function.calls if function is not None else ""
        program = self.declared_program(calls) if calls else self._macro_program(code)
        if program is not None:
            self.g_macros.append((code, program))
            return GCode(code, takes="P", axis_words=True)
        return super()._row(code)

    def _macro_program(self, code: str) -> Program | None:
        return macro_program(self.channel, code)

    @property
    def repeated_macro(self) -> str:
        """The code whose macro blocks without a code of motion call again, for it has written itself to #1000."""
        code = self.mode["motion"]
        if code in self.footing.planners or self.mode["cycle"] != "G80" or not self.moves_by_words():
            return ""
        return code

    def replacement(self, plan: Plan) -> Step | None:
        """As everywhere; a block whose registered codes are plain has been asked already."""
        if not self.plain:
            return super().replacement(plan)
        if self.repeated_macro:
            raise self.control.unknown_code(self.repeated_macro)
        return None

    def code_program(self, name: str) -> Program:
        """The program of a registered code."""
        program = self.channel.store.find_name(name)
        if program is None:
            raise self.control.fail("no_program", number=name)
        return program

    def declared_program(self, calls: str) -> Program:
        """The program that a code of the machine file calls."""
        called = program_called(calls)
        if isinstance(called, str):
            return self.code_program(called)
        program: Program = self.channel.control.find_program(self.channel, called)
        return program

    def moves_by_words(self) -> bool:
        """Whether axis or centre words stand in the block that no one-shot code takes."""
        if any(row.axis_words for row in self.codes):
            return False
        centers = self.mode["motion"] in _ARC_CODES and any(self.has(letter) for letter in "IJK")
        return centers or bool(self.axis_words())

    def moves(self, plan: Plan) -> bool:
        """Whether the block moves axes (what G66 asks)."""
        if any(row.axis_words and row.code not in MOVING_CODES for row in self.codes):
            return False
        return bool(plan.axis_words) or self.moves_by_words()

    def plain_plan(self, channel: SyntecChannel) -> Plan:
        """The plan of the block without its registered codes."""
        if self._plain_plan is None:
            self._plain_plan = type(self)(channel, self.control, self.signature, plain=True).build()
        return self._plain_plan


def may_call_by_g(builder: Builder) -> bool:
    """Whether a G code of the block, or the motion code that holds in it, may call a macro."""
    assert isinstance(builder, SyntecBuilder)  # the control makes no other
    repeats = builder.mode["motion"] not in builder.footing.planners
    return bool(builder.g_macros) or repeats or any(builder.channel.memory.parameters.g_macros)


def macro_program(channel: SyntecChannel, code: str) -> Program | None:
    """The program that a G code of the user calls (G200 to G999, G123.4); None where there is no such file."""
    whole, point, fraction = code[1:].partition(".")
    if point:
        return channel.store.find_name(f"G{int(whole):03d}{int(fraction or 0):03d}")
    if not FIRST_MACRO <= int(whole) <= LAST_MACRO:
        return None
    return channel.store.find_name(f"G{int(whole):04d}")
