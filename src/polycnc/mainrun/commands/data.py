"""Data that an operator reads and writes: variables by their names, and the programs in the memory.

What is confirmed lasts: each command ends with a `commit` of the retained memory.
"""

from __future__ import annotations

from contextlib import suppress
from math import isfinite

from polycnc.control.parameters import known_parameters
from polycnc.control.word_address.macro_b.parameter_input import set_parameter
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.setup.values import parameter_key
from polycnc.mainrun.commands.states import Command
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.parameters import KnownParameter
    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.commands.program_keys import ProgramCommands
    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.operation import Operation
    from polycnc.memory.retained import RetainedStore
    from polycnc.program import Program


#: The signal of the key switch that protects what is stored.
PROTECTED = "EDIT_PROTECT"


def _check_finite(name: str, value: object) -> None:
    """What no program could write is no value: a length without end would be one.

    Raises:
        CommandRefused: It is infinite or not a number.
    """
    if isinstance(value, float) and not isfinite(value):
        raise CommandRefused("setup.no-variable", name=name)


@dataclass(frozen=True, slots=True)
class ProgramEntry:
    """A program in a directory listing: its name as the control shows it, its directory, how many blocks it has."""

    name: str
    directory: str
    blocks: int


class DataCommands:
    """Variables and programs.

    Args:
        operation: The channels, and what the control does with them.
        programs: The programs.
        commands: What loads them.
        permission: Asked in front of commands.
        retained: What outlives the power.
    """

    def __init__(
        self,
        operation: Operation,
        programs: Programs,
        commands: ProgramCommands,
        permission: Permission,
        retained: RetainedStore,
    ) -> None:
        self._operation = operation
        self._programs = programs
        self._commands = commands
        self._permission = permission
        self._retained = retained

    def write_variable(self, name: str, value: object, channel: int) -> None:
        """Give a variable, an offset or a datum another value."""
        self._check_protection()
        _check_finite(name, value)
        run = self._operation.runs.named(channel)
        try:
            run.channel.control.write_variable(run.channel, name, value)
        except (KeyError, ValueError, TypeError, AlarmError):
            raise CommandRefused("setup.no-variable", name=name) from None
        self._show()

    def change(self, action: Callable[[Channel], object], channel: int, *, protected: bool) -> None:
        """Change data by a function of the control's."""
        if protected:
            self._check_protection()
        action(self._operation.runs.named(channel).channel)
        self._show()

    def _show(self) -> None:
        """What has been changed lasts, and displays show it at once where no program is under way."""
        self._retained.commit()
        for run in self._operation.runs:
            if not run.is_active:
                run.show_own_state()

    # ---- parameters ----------------------------------------------------------------------------------------

    @property
    def parameters(self) -> tuple[KnownParameter, ...]:
        """The parameters that the control knows."""
        return known_parameters(self._operation.control)

    def read_parameter(self, number: str) -> object:
        """The value of a parameter: what has been set, else the delivered one; None where only the machine knows it."""
        channel = self._operation.runs.first.channel
        if number.startswith("$"):
            return channel.control.read_variable(channel, number)
        key, given = parameter_key(number), channel.setup.parameters
        known = next((each for each in self.parameters if each.key == key._replace(axis=None)), None)
        delivered = known.delivered if known is not None else None
        if variable := self._machine_datum(number):
            with suppress(KeyError, ValueError, AlarmError):
                return channel.control.read_variable(channel, variable)
        if key.bit is not None:
            bit = given.bit(key.id, key.bit, key.axis, default=-1)
            return delivered if bit < 0 else bit
        value = given.get(key.id, key.axis)
        return delivered if value is None else value

    def write_parameter(self, number: str, value: float) -> None:
        """Give a parameter another value."""
        self._permission.ask(Command.LOAD)
        self._check_protection()
        _check_finite(number, value)
        plain = number.split("#", maxsplit=1)[0]
        if not number.startswith("$"):
            try:
                plain = str(parameter_key(number).id)
            except ValueError:
                raise CommandRefused("setup.no-variable", name=number) from None
        if not any(plain in map(str, each.ids) for each in self.parameters):
            raise CommandRefused("setup.no-variable", name=number)
        variable = number if number.startswith("$") else self._machine_datum(number)
        for run in self._operation.runs:
            if variable:
                try:
                    run.channel.control.write_variable(run.channel, variable, value)
                except (KeyError, ValueError, AlarmError):
                    raise CommandRefused("setup.no-variable", name=number) from None
            else:
                set_parameter(run.channel, parameter_key(number), value)
        self._retained.commit()

    def _machine_datum(self, number: str) -> str:
        """The variable of a machine datum by its number (`20110`, `32020 X`); empty where it has no such name."""
        key = parameter_key(number)
        known = next((each for each in self.parameters if each.key == key._replace(axis=None)), None)
        if known is None or not known.name.startswith("$") or key.bit is not None:
            return ""
        axis = key.axis or self._operation.runs.first.channel.axes[0]
        return f"{known.name}[{axis}]" if known.by_axis else known.name

    # ---- programs ------------------------------------------------------------------------------------------

    def entries(self) -> tuple[ProgramEntry, ...]:
        """Every program that is loaded or in the memory, in the order of names."""
        programs = sorted(self._programs.all, key=lambda each: (each.directory, each.name))
        return tuple(ProgramEntry(each.name, each.directory, len(each.lines)) for each in programs)

    def first_line(self, name: str) -> int:
        """The line of its file at which a program begins."""
        return self._shown(name).first_line

    def lines(self, name: str) -> Sequence[str]:
        """The lines of a program."""
        return self._shown(name).lines

    def store(self, name: str, text: str) -> None:
        """Put a program, or what a text has, into the memory in the place of those with their names."""
        self._check_protection()
        self._check_free(name)
        self._programs.keep(name, text)
        self._retained.commit()

    def delete(self, name: str) -> None:
        """Take a program out of the memory."""
        self._check_protection()
        self._check_free(name)
        self._programs.forget(self.named(name))
        self._retained.commit()

    def select(self, name: str, channel: int) -> None:
        """Load a program of the memory as the main program of a channel."""
        self._permission.ask(Command.LOAD)
        self._commands.select(self.named(name), channel)

    def named(self, name: str) -> Program:
        """A program by its name or number; refused where there is none."""
        found = self._programs.named(name)
        if found is None:
            raise CommandRefused("mainrun.no-such-program", name=name)
        return found

    def _shown(self, name: str) -> Program:
        """A program of the memory, or one that a channel has called from elsewhere: a file beside, a folder."""
        called = (each for run in self._operation.runs for each in reversed(run.channel.programs))
        found = self._programs.named(name) or next((each for each in called if each.name == name), None)
        return found or self.named(name)

    def _check_free(self, name: str) -> None:
        """A program that is under way is not changed."""
        under_way = (run.active_block.program for run in self._operation.runs if run.is_active)
        found = self._programs.named(name)
        if found is not None and found.name in set(under_way):
            raise CommandRefused("mainrun.program-runs", name=found.name)

    def _check_protection(self) -> None:
        if self._operation.signals[PROTECTED]:
            raise CommandRefused("panel.protected")
