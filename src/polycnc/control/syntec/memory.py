"""The memory of a SYNTEC control: what the word-address base keeps, and the variables of macros."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

from polycnc.control.syntec.macros import functions
from polycnc.control.syntec.macros.system_variables import SYSTEM_VARIABLES
from polycnc.control.syntec.macros.variables import Globals, Locals, is_local, put
from polycnc.control.syntec.parameters import decimals, is_diameter, parameter
from polycnc.control.word_address.memory import Memory
from polycnc.geometry.frames import IDENTITY
from polycnc.language.syntec.expressions import NO_SUCH_VARIABLE
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value, whole
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.macros.interrupts import Interrupt
    from polycnc.control.syntec.motion.oscillation import Oscillation
    from polycnc.control.syntec.motion.skips import SkipGroup
    from polycnc.control.syntec.spindles import SpindlePair

#: Names of single bits of the PLC interface that setups may give, and the functions that read them.
BIT_FAMILIES = "IOAC"


class SyntecMemory(Memory):
    """State of a SYNTEC channel beside modal codes and positions.

    Attributes:
        locals: #1 to #400 of the running level.
        user: #401 to #999; `modal_longs` #1080 on; `modal_doubles` #2001 on; `words` #1502 and the like.
        globals: `@` variables and R registers.
        stack: PUSH and POP.
        bits: Bits I, O, A, C of the PLC interface by name.
        skip_flags: #1608; `skip_machine` the machine position of the last skip.
        last_center: Centre vector of the last arc.
        mid_point: Mid point of a G02.4 whose end point is still to come; `curve` a G06.2 with knots to come.
        scale_factors: Factors of the active G51.
        lead: F of G33, mm; `retract_feed` F2 of G81, in the unit of the feed, 0 for a rapid.
        rapid_speed: F1 of the running G00 P1, mm/s; 0 for none.
        feeds: The last feed of each feed mode that was left.
        surface_axis: Reference axis of G96.
        speeds: Own S of each spindle; `reported` the speed last recorded.
        pairs: Spindles in step, by group K.
        tilt: Frame of the tilted plane in the work system; `table_turn` how the table has turned it since.
        rotates_work: G54.4 P1 is active (#1849).
        posture_frame: Directions of the tool refer to the work system under G43.4 (#1848).
        interrupt: What M96 has prepared.
        skip_groups: Groups of G31.10 that G31.11 will move; the step behind the last one.
        oscillation: The axis that oscillates; `precise` by G81.2, `was_precise` that there was one, on `precise_axis`.
        virtual_axes: Axes that move with a name that is none of theirs.
        corner_way: P of G10 L450.
        borrow_tries: How often the running G52.2 has waited.
        diameters: Axes switched by G10.9: programmed in diameter or not.
    """

    CLEARED = (
        *Memory.CLEARED, "locals", "stack", "mid_point", "tilt", "rotates_work", "scale_factors", "modal_longs",
        "modal_doubles", "skip_groups", "feeds", "feed_mode", "interrupt",
    )  # fmt: skip

    def __init__(self, channel: Channel) -> None:
        super().__init__(channel)
        self.channel = channel
        self.locals: dict[int, Value] = {}
        self.user: dict[int, Value] = {}
        self.modal_longs: dict[int, Value] = {}
        self.modal_doubles: dict[int, Value] = {}
        self.words: dict[int, Value] = {}
        self.globals = Globals()
        self.stack: list[Value] = []
        self.random = Random(0)
        self.bits: dict[str, int] = {
            name: int(bool(value))
            for name, value in channel.setup.switches.signals.items()
            if name[:1] in BIT_FAMILIES and name[1:].isdigit()
        }
        self.skip_flags: int = 0
        self.skip_machine: list[float] | None = None
        self.last_center = (0.0, 0.0, 0.0)
        self.mid_point: list[float] | None = None
        self.preset_angle = 0.0
        self.preset_axis = [0.0, 0.0, 1.0]
        self.scale_factors = (1.0, 1.0, 1.0)
        self.lead = 0.0
        self.retract_feed = 0.0
        self.rapid_speed = 0.0
        self.feeds: dict[str, float] = {}
        self.feed_mode = "G94"
        self.surface_axis = 0
        self.speeds: dict[int, float] = {}
        self.reported: dict[int, float] = {}
        self.pairs: dict[int, SpindlePair] = {}
        self.tilt = IDENTITY
        self.table_turn = IDENTITY
        self.posture_frame: bool = channel.setup.parameters.get(3057) == 1
        self.rotates_work: bool = False
        self.interrupt: Interrupt | None = None
        self.skip_groups: list[SkipGroup] = []
        self.skip_groups_end = 0
        self.diameters: dict[int, bool] = {}
        self.borrow_tries = 0
        self.corner_way = 0
        self.virtual_axes: dict[str, list[int]] = {}
        self.oscillation: Oscillation | None = None
        self.precise = self.was_precise = False
        self.precise_axis = 0
        self.colour = 0
        self.print_file = ""
        self.functions: dict[str, Callable[..., Value]] = functions.bound(self)

    # ---- what generated expressions call -----------------------------------------------------------------

    def variable(self, index: Value) -> Value:
        """The value of `#index`."""
        at = whole(index, NO_SUCH_VARIABLE)
        if at == 0:
            return VACANT
        if is_local(at):
            return self.locals.get(at, VACANT)
        space = SYSTEM_VARIABLES.find(at)
        return space.read(self, at - space.first)

    def set_variable(self, index: Value, value: Value) -> None:
        """`#index := value`."""
        at = whole(index, NO_SUCH_VARIABLE)
        if is_local(at):
            put(self.locals, at, value)
            return
        space = SYSTEM_VARIABLES.find(at)
        if space.write is None:
            raise AlarmError(NO_SUCH_VARIABLE, variable=f"#{at}", hint="hint.syntec.read-only")
        space.write(self, at - space.first, value)

    def register(self, index: Value) -> Value:
        """The value of `@index`."""
        return self.globals.read(index)

    def set_register(self, index: Value, value: Value) -> None:
        """`@index := value`."""
        self.globals.write(index, value)

    # ---- units -------------------------------------------------------------------------------------------

    @property
    def is_inch(self) -> bool:
        """Whether the program's unit is the inch."""
        return self.channel.mode["unit"] == "G70"

    @property
    def least_unit(self) -> float:
        """Least input unit of lengths, in the program's unit (#1600)."""
        return float(10.0 ** -decimals(self.parameters, inch=self.is_inch))

    @property
    def least_angle(self) -> float:
        """Least input unit of angles and times (#1602)."""
        return float(10.0 ** -decimals(self.parameters, inch=False))

    def parameter(self, number: int) -> int:
        """A machine parameter as a Long."""
        return parameter(self.parameters, number)

    def is_diameter(self, axis: int) -> bool:
        """Whether an axis is programmed in diameters now (Pr281~, G10.9)."""
        switched = self.diameters.get(axis)
        return is_diameter(self.parameters, axis) if switched is None else switched

    # ---- levels ------------------------------------------------------------------------------------------

    @property
    def arguments(self) -> Locals | None:
        """The words of the running macro's call; None outside of macros."""
        return self.locals if isinstance(self.locals, Locals) else None

    # ---- by name, for reports and test cases -------------------------------------------------------------

    def read_text(self, name: str) -> object:
        """A variable as a user names it: `#100`, `@5`, `R6000`; None where it is vacant."""
        family, index = name[:1].upper(), name[1:]
        if not index.isdigit() or family not in "#@R":
            raise KeyError(name)
        try:
            if family == "R":
                return self.globals.registers.get(int(index), 0)
            value = self.variable(int(index)) if family == "#" else self.register(int(index))
        except AlarmError as error:
            raise KeyError(name) from error
        return None if isinstance(value, Vacant) else value

    def write_text(self, name: str, value: object) -> None:
        """Set a variable as a user names it."""
        family, index = name[:1].upper(), name[1:]
        if not index.isdigit() or family not in "#@R":
            raise KeyError(name)
        typed: Value = Text(value) if isinstance(value, str) else VACANT
        if isinstance(value, int | float):
            typed = value
        if family == "R":
            self.globals.registers[int(index)] = int(float(str(value)))
        elif family == "#":
            self.set_variable(int(index), typed)
        else:
            self.set_register(int(index), typed)
