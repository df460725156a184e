"""What the NC language and the control ask of each other."""

from __future__ import annotations

from polycnc.channel.stack import Executable
from polycnc.channel.states.state import Lifetime, State, lasting, retained
from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol, TypeAlias
from polycnc.language.sinumerik.names.values import Axis
from polycnc.memory.retained import USER_VARIABLES, VARIABLES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.language.sinumerik.actions.code import ActionCode
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.iso_dialect import IsoBlock
    from polycnc.language.sinumerik.names.initialisation import FirstValues
    from polycnc.language.sinumerik.names.values import Type
    from polycnc.language.sinumerik.names.variables import Variable
    from polycnc.language.sinumerik.words import Block


class NcExecutable(Executable, Protocol):
    """What runs on a level: a program, a section of one, or a cycle of the control."""

    @property
    def whole(self) -> SinumerikProgram:
        """The program whose names and labels hold: of a section the program that it stands in."""

    def text(self, index: int) -> str:
        """The line of a step; empty where it has none."""

    def word_columns(self, channel: Channel, position: int) -> int:
        """The column of a word of the running block."""


#: A channel whose programs are such.
NcChannel: TypeAlias = "Channel[Any, Any, NcExecutable]"


class SystemVariable(Protocol):
    """A variable of the control (`$…`).

    Attributes:
        type: Type of its values.
        stop: Reading or writing it in a program waits for the main run (implicit preprocessing stop).
        goes_along: Writing it does not wait: the value goes along with the path.
    """

    @property
    def type(self) -> Type:
        """Data type."""

    @property
    def stop(self) -> bool:
        """Whether it belongs to the main run."""

    @property
    def goes_along(self) -> bool:
        """Whether a value that is written goes along with the path."""

    @property
    def timed(self) -> bool:
        """Whether only a program that is executed in time can read or write it."""

    @property
    def of_actions(self) -> bool:
        """Whether synchronised actions alone can write it."""

    @property
    def name(self) -> str:
        """With its `$`."""

    @property
    def unit(self) -> Callable[[Any, tuple[Any, ...]], float] | None:
        """For indices the mm, or mm/min, that one unit of the program is; None where no value is a length."""

    @property
    def first(self) -> int:
        """Index of the first element of an array with one index."""

    def element_count(self, channel: Channel) -> int | None:
        """How many elements an array with one index has; None where that is not told."""

    def read(self, channel: Channel, indices: tuple[Any, ...]) -> Any:
        """The value; indices are ints, axes or frame components (text) as programmed."""

    def write(self, channel: Channel, indices: tuple[Any, ...], value: Any) -> None:
        """Set the value, already converted to `type`."""


class LanguageControl(Protocol):
    """What compiled blocks call. Procedures, functions and cycles are named as in `keywords.py`."""

    g_groups: Mapping[str, int]
    """Group number of every G function in canonical spelling (`G1`, `CIP`, `KONT`)."""

    @property
    def shapes(self) -> Shapes:
        """Compiled code of the control's programs."""

    def language_memory(self, channel: Channel) -> LanguageMemory:
        """What the language begins with at power-on."""

    def g_function(self, group: int, number: int) -> str:
        """The function of `G[group]=number`; alarm 12470 for none, or a group that is not modal."""

    def execute(self, channel: Channel, block: Block, values: tuple[Any, ...]) -> bool:
        """Run the functions and words of a block; true if a modal subprogram (MCALL) follows the block."""

    def select_iso(self, channel: Channel) -> None:
        """G291 acts: blocks of the ISO dialect come."""

    def calls_iso(self, channel: Channel) -> bool:
        """Whether ISOCALL calls programs of the ISO dialect; PC0001 where that is not executed."""

    def run_iso(self, channel: Channel, block: IsoBlock, perform: Callable[[str], None]) -> None:
        """A block of the ISO dialect comes; PC0001 where G291 does not act. `perform` runs one of the language here."""

    def procedure(self, channel: Channel, name: str, args: tuple[Any, ...], column: int) -> None:
        """Run a predefined procedure or a cycle; an argument left out is None, VAR is a `Reference`."""

    def define_action(
        self, channel: Channel, code: ActionCode, number: int | None, frozen: tuple[Any, ...]
    ) -> None:
        """A synchronised action begins with the next block, with the values that were worked out now."""

    def function(self, channel: Channel, name: str, args: tuple[Any, ...], column: int) -> Any:
        """The value of a function that depends on the control's state; `keywords.py` knows its type."""

    def system_variable(self, name: str) -> SystemVariable:
        """The variable `$NAME`; alarm 12550 for one that does not exist (or is not supported yet)."""

    def preprocessing_stop(self, channel: Channel) -> bool:
        """Wait for the main run before a block; true if the block has to come again later."""

    def reads_inches(self, channel: Channel) -> bool:
        """Whether the program reads and writes values with units of length in inches now."""

    def unit_of(self, channel: Channel, axis: str) -> float:
        """The mm that one unit of the program is for an axis: 25.4 for a linear one in inches, else 1."""

    def restore_setting(self, channel: Channel, name: str) -> None:
        """Give a setting or machine datum the values that it had before any program."""

    def restarts(self, channel: Channel) -> bool:
        """Whether GOTOS goes back to the program start (DB21,… DBX384.0)."""

    def skipped(self, channel: Channel, level: int) -> bool:
        """Whether blocks marked `/` with this level (0…9) are skipped now."""

    def restore(self, channel: Channel, saved: object) -> None:
        """Bring back what `save` returned (PROC … SAVE)."""

    def save(self, channel: Channel) -> object:
        """What a subprogram with SAVE brings back at its end."""


#: No axis: what NO_AXIS means where MD20082 names none.
NO_AXIS = Axis("")


@unchanging
class CompiledPrograms:
    """The programs of a channel that have resolved names. Snapshots leave them as they are, and so their list too.

    Attributes:
        generation: Grows whenever a text may mean something else than before, in any of them.
    """

    def __init__(self) -> None:
        self.generation = 0
        self._programs: list[SinumerikProgram] = []

    def add(self, program: SinumerikProgram) -> None:
        """A program has resolved its names."""
        self._programs.append(program)

    def forget_steps(self) -> None:
        """Files, search paths or block skip have changed: names are looked up again, blocks read again."""
        for program in self._programs:
            program.forget_steps()


@dataclass(slots=True, eq=False)
class LanguageMemory(State, lifetime=Lifetime.POWER):
    """What the NC language keeps for one channel; it is `channel.memory.language`, and begins as the control says.

    Attributes:
        r_parameters: The R parameters by their name, retained.
        user_variables: Values of global user variables of the channel by declaration, one list for each; retained.
        nck_user_variables: Values of those that all channels share.
        r: R parameters. Compiled blocks hold this very list: change it in place only.
        axes: Every axis and spindle identifier of the channel (channel, geometry and machine axes, `S1`…), upper case.
        default_axis: The axis that AXIS variables have before anything is assigned, NO_AXIS (MD20082).
        exact_order: `<` and `>` compare exactly (MD10280 bit 0); otherwise equal within 1E-12 is neither.
        main_variables_everywhere: Variables of the main program are known in subprograms (MD11120).
        global_variables: User variables of the definition files (GUD), upper case.
        access_level: Protection level of programs.
        directory_levels: Protection level of programs in some directories, which holds if it is the higher one.
        write_levels: Protection level that WRITE needs in some directories.
        rights: What REDEF has made of the rights of system variables, R parameters and words, by name and keyword.
        nck_variables: Those of the global variables that all channels share.
        refused: Words that this variant of the control does without.
        macros: Texts of DEFINE … AS of the definition files, and names of channels, upper case.
        call_path: Directory of CALLPATH, or empty.
        modal_call: What MCALL has set: called after every block with path motion.
        definitions_loaded: The definition files have been read.
        user_data: Limits and units that REDEF has given R parameters and user data of the control, by name.
        first_values: Init times and first values that REDEF has given data of the control, by name.
        programs: Every compiled program.
    """

    r_parameters: dict[str, list[float]] = retained(VARIABLES)
    user_variables: dict[str, list[Any]] = retained(USER_VARIABLES)
    nck_user_variables: dict[str, list[Any]] = retained(USER_VARIABLES, of_control=True)
    r: list[float] = field(default_factory=list)
    axes: Mapping[str, Axis] = field(default_factory=dict)
    default_axis: Axis = NO_AXIS
    exact_order: bool = False
    main_variables_everywhere: bool = False
    global_variables: dict[str, Any] = field(default_factory=dict)
    access_level: int = 0
    directory_levels: dict[str, int] = field(default_factory=dict)
    write_levels: dict[str, int] = field(default_factory=dict)
    rights: dict[str, dict[str, int]] = field(default_factory=dict)
    nck_variables: dict[str, Any] = field(default_factory=dict)
    macros: dict[str, str] = field(default_factory=dict)
    refused: frozenset[str] = frozenset()
    call_path: str = ""
    modal_call: Callable[[Channel], None] | None = lasting(Lifetime.RESET, None)
    definitions_loaded: bool = False
    user_data: dict[str, Variable] = field(default_factory=dict)
    first_values: dict[str, FirstValues] = field(default_factory=dict)
    programs: CompiledPrograms = field(default_factory=CompiledPrograms)

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> LanguageMemory:
        """What the control says."""
        control: LanguageControl = channel.control
        return control.language_memory(channel)
