"""Programs ready to run, and the stack of program levels."""

from __future__ import annotations

from enum import StrEnum
from functools import cached_property

from polycnc.channel.family import ProgramT_co
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.interface import Scanner
    from polycnc.channel.steps import FewSteps, Step
    from polycnc.program import Program


class Executable(Protocol):
    """A program whose blocks are compiled when they are first reached.

    Steps are numbered from 0. A step is a callable that does what its block says; jumps set `level.index`.
    """

    @property
    def program(self) -> Program:
        """The text."""

    @property
    def steps(self) -> Sequence[Step | None] | FewSteps:
        """Steps that are compiled and kept, by number; None, or nothing at all, where `step` must be asked."""

    def step(self, index: int, *, alone: bool = False) -> Step | None:
        """The step of a block, compiled on demand; None behind the last block.

        It may hold the blocks behind it too, which `alone` forbids: single block runs them one by one.
        """

    def line(self, index: int) -> int:
        """The line of the program's file, from 1, at which the block of a step begins."""

    def column(self, index: int, address: str) -> int:
        """The column of an address or a code in the block of a step, from 1; 0 when unknown."""

    def counts(self, index: int) -> bool:
        """Whether a step is a block for stages that look ahead (a macro statement is none)."""


class LevelKind(StrEnum):
    """How a level of the program stack came about."""

    MAIN = "main"
    SUBPROGRAM = "sub"
    MACRO = "macro"
    MODAL = "modal"
    """A modal call, behind a block that moves."""
    EVERY_BLOCK = "b-macro"
    """A macro that every block calls (G66.1)."""
    G_SUBPROGRAM = "g-sub"
    G_MACRO = "g-macro"
    M_SUBPROGRAM = "m-sub"
    M_MACRO = "m-macro"
    T_SUBPROGRAM = "t-sub"
    T_MACRO = "t-macro"
    EXTERNAL = "external"
    """A program from outside the memory (M198, EXTCALL)."""
    INTERRUPT = "interrupt"
    SECTION = "repeat"
    """A section of the calling program (REPEAT)."""
    SHAPE = "shape"
    """The shape of a turning cycle, read or finished."""
    CYCLE = "cycle"
    TYPED_IN = "mdi"
    """Blocks that are typed in while a program waits (MDI intervention)."""

    @cached_property
    def code_letter(self) -> str:
        """The letter of the code that called the program; empty where none did."""
        return self[0].upper() if self[1:2] == "-" else ""


@dataclass(slots=True)
class Level(Generic[ProgramT_co]):
    """One level of the program stack: where a program stands, and what belongs to this call of it.

    Attributes:
        code: The program, of the class that the channel's family knows.
        steps: Kept steps of the program; `line_of` and `counts` are its methods: at hand, because every block asks.
        index: The step that runs next.
        current: The step that is running.
        program_number: Number of the program in the toolpath.
        repeats: How often the program is still to be run after this pass.
        entry: Step at which each pass begins.
        kind: How the level came about.
        locals: Local variables, shared with the caller or its own, as the kind of call has it. A family knows their
            form, and reads them with a function of its own.
        data: What the control's language keeps for this level.
        scanner: What scans the plain blocks of the program, if anything does.
    """

    UNFOLLOWED: ClassVar = frozenset({"steps", "line_of", "counts"})  # those of the program

    code: ProgramT_co
    index: int = 0
    current: int = 0
    program_number: int = 0
    repeats: int = 0
    entry: int = 0
    kind: LevelKind = LevelKind.MAIN
    locals: object = None
    data: dict[Any, Any] = field(default_factory=dict)
    scanner: Scanner | None = None
    steps: Sequence[Step | None] | FewSteps = field(init=False)
    line_of: Callable[[int], int] = field(init=False)
    counts: Callable[[int], bool] = field(init=False)

    def __post_init__(self) -> None:
        self.steps = self.code.steps
        self.line_of = self.code.line
        self.counts = self.code.counts

    def block_name(self, line: int = 0) -> str:
        """The block that runs, or that at a line of the program, as its sequence number or else its line."""
        name: str = self.code.program.block_name(line or self.line_of(self.current))
        return name
