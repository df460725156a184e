"""The memory of a SYNTEC control: what the word-address base keeps, and the variables of macros."""

from __future__ import annotations

from functools import cached_property

from polycnc.control.syntec.coordinates.diameters import DiameterState
from polycnc.control.syntec.macros.variables import (
    USER,
    GlobalState,
    Locals,
    LocalState,
    SpaceState,
    is_local,
    is_retentive_global,
    is_retentive_register,
    put,
)
from polycnc.control.syntec.units import decimals, least_unit
from polycnc.control.word_address.memory import Memory
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.expressions import NO_SUCH_VARIABLE
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value, whole
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.syntec.macros import functions, registers, system_variables

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.parameters import SyntecParameters


class SyntecMemory(Memory):
    """What SYNTEC's features share of a channel's state.

    Attributes:
        channel: The channel.
        locals: #1 to #400 of the running level.
        globals: `@` variables and R registers.
    """

    parameters: SyntecParameters

    def __init__(self, channel: SyntecChannel) -> None:
        super().__init__(channel)
        self.channel: SyntecChannel = channel
        self.locals = LocalState.of(channel).main
        self.globals = GlobalState.of(channel)
        if channel.number == 1:  # the first axis group is switched on first; all share them
            self.globals.forget()
        user = SpaceState.of(channel).user
        self._was_kept = bool(self.globals.values or self.globals.registers or user)

    @cached_property
    def functions(self) -> dict[str, Callable[..., Value]]:
        """The functions of the macro language, by name."""
        return functions.bound(self)

    def forget_locals(self) -> None:
        """The local variables are those of the main program, as they begin."""
        self.locals = LocalState.of(self.channel).main

    # ---- what generated expressions call -----------------------------------------------------------------

    def variable(self, index: Value) -> Value:
        """The value of `#index`."""
        at = whole(index, NO_SUCH_VARIABLE)
        if at == 0:
            return VACANT
        if is_local(at):
            return self.locals.get(at, VACANT)
        space = system_variables.found(at)
        return space.read(self, at - space.first)

    def set_variable(self, index: Value, value: Value) -> None:
        """`#index := value`."""
        at = whole(index, NO_SUCH_VARIABLE)
        if is_local(at):
            put(self.locals, at, value)
            return
        space = system_variables.found(at)
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
        return least_unit(self.parameters)

    def is_diameter(self, axis: int) -> bool:
        """Whether an axis is programmed in diameters now (Pr281~, G10.9)."""
        switched = DiameterState.of(self.channel).switched.get(axis)
        return self.parameters.diameter_axes[axis] == 1 if switched is None else switched

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
                return self.globals.read_register(int(index))
            value = self.variable(int(index)) if family == "#" else self.register(int(index))
        except AlarmError as error:
            raise KeyError(name) from error
        return None if isinstance(value, Vacant) else value

    def is_kept(self, name: str) -> bool:
        """Whether a variable has its value from an earlier power-on: #401 to #999, some of `@` and R."""
        family, index = name[:1].upper(), name[1:]
        if not self._was_kept or family not in "#@R" or not index.isdigit():
            return False
        if family == "#":
            return int(index) in USER
        return is_retentive_register(int(index)) if family == "R" else is_retentive_global(int(index))

    def write_text(self, name: str, value: object) -> None:
        """Set a variable as a user names it."""
        family, index = name[:1].upper(), name[1:]
        if not index.isdigit() or family not in "#@R":
            raise KeyError(name)
        typed: Value = Text(value) if isinstance(value, str) else VACANT
        if isinstance(value, int | float):
            typed = int(value) if isinstance(value, bool) else value
        if family == "R":
            registers.check_register(self.channel, int(index), int(float(str(value))))
            self.globals.registers[int(index)] = int(float(str(value)))
        elif family == "#":
            self.set_variable(int(index), typed)
        else:
            self.set_register(int(index), typed)
