"""The channel while its actions run: what their compiled effects call (10.4)."""

from __future__ import annotations

from polycnc.control.sinumerik.actions import polynomials
from polycnc.control.sinumerik.actions.cycles import RunningCycle
from polycnc.control.sinumerik.actions.procedures import PROCEDURES
from polycnc.control.sinumerik.actions.run import Running
from polycnc.control.sinumerik.actions.words import WORDS
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import ModuloRange
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.runtime import elements_left, read_length, set_elements, write_length
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.language.sinumerik.actions.code import Cycle
    from polycnc.language.sinumerik.interface import SystemVariable

#: Positions by the systems of POSRANGE: machine, basic, settable zero, workpiece (10.4.13).
POSITIONS = ("$AA_IM", "$AA_IB", "$AA_IEN", "$AA_IW")
#: Variables that go on by themselves: writing the same value again is a change.
_GOING = ("$AC_TIMER", "$AC_FIFO", "$AA_OFF", "$AC_OVR", "$AA_OVR", "$AC_VC", "$AC_PROG_NET_TIME")


class LiveReference(NamedTuple):
    """A system variable that a function of an action may change."""

    run: ActionRun
    variable: SystemVariable
    indices: tuple[Any, ...]

    @property
    def value(self) -> Any:
        """The value now."""
        return read_length(self.run.channel, self.variable, self.indices)

    @value.setter
    def value(self, value: Any) -> None:
        self.run.store(self.variable, self.indices, value)


class ActionRun(Running):
    """A look at the actions; satisfies the language's `Acting`."""

    # ---- variables -----------------------------------------------------------------------------------------

    def store(self, variable: SystemVariable, indices: tuple[Any, ...], value: Any) -> None:
        """Write a system variable."""
        if not self.changed:
            name = variable.name
            if name.startswith("$A") and not name.startswith(_GOING):
                self.changed = read_length(self.channel, variable, indices) != value
            else:
                self.changed = not name.startswith(("$AC_OVR", "$AA_OVR", "$AC_VC"))
        main_run, self.channel.main_run = self.channel.main_run, None  # it is written at once
        try:
            write_length(self.channel, variable, indices, value)
        finally:
            self.channel.main_run = main_run

    def store_item(self, values: list[Any], index: int, value: Any) -> None:
        """Write an R parameter, or an element of a variable."""
        if values[index] != value:
            values[index] = value
            self.changed = True

    def store_all(self, variable: SystemVariable, indices: tuple[Any, ...], values: tuple[Any, ...]) -> None:
        """Fill an array from an element on; alarm 12400 where the variable has no elements."""
        if not indices or not isinstance(indices[0], int):
            raise AlarmError("12400", text=variable.name)
        for place, value in enumerate(values, indices[0]):
            self.store(variable, (place, *indices[1:]), value)

    def repeat(self, variable: SystemVariable, indices: tuple[Any, ...], values: tuple[Any]) -> None:
        """Fill an array with one value, from an element to its end; alarm 12260 where that is not known."""
        self.store_all(variable, indices, values * elements_left(self.channel, variable, indices))

    def store_items(self, items: list[Any], start: int, values: tuple[Any, ...]) -> None:
        """Fill an array of the user from an element on; alarm 12260 if it ends before the list."""
        set_elements(items, start, values)
        self.changed = True

    def repeat_items(self, items: list[Any], start: int, values: tuple[Any]) -> None:
        """Fill an array of the user with one value, from an element to its end."""
        self.store_items(items, start, values * (len(items) - start))

    # ---- words ---------------------------------------------------------------------------------------------

    def word(self, address: str, index: Any, modifier: str, value: Any) -> None:
        """`POS[X]=IC(10)`, `M3`, `S2=500`, `SPOS=90`."""
        word = WORDS.get(address)
        if word is None:
            raise not_supported(address)
        word(self, index, modifier, value)

    # ---- procedures and functions --------------------------------------------------------------------------

    def procedure(self, name: str, args: tuple[Any, ...]) -> None:
        """`DELDTG(X)`, `LOCK(1)`, `RDISABLE`."""
        procedure = PROCEDURES.get(name)
        if procedure is None:
            raise not_supported(name)
        procedure(self, args)

    def function(self, name: str, args: tuple[Any, ...]) -> Any:
        """A function that the main run answers."""
        if name != "POSRANGE":
            return self.channel.control.function(self.channel, name, args, 0)
        column = arguments.column(self.channel, args[0])
        system = 0 if args[3] is None else arguments.whole(args[3])
        if system not in range(len(POSITIONS)):
            raise AlarmError("14020", text=name)
        here = self.channel.control.system_variable(POSITIONS[system]).read(self.channel, (args[0],))
        off, axis = here - args[1], self.channel.memory.axes[column]
        if axis.modulo:
            turn = ModuloRange.of(self.channel.memory.data, axis.name).length
            off -= turn * round(off / turn)
        return bool(abs(off) <= abs(args[2]))

    def reference(self, variable: SystemVariable, indices: tuple[Any, ...]) -> LiveReference:
        """A system variable that a function may change."""
        return LiveReference(self, variable, indices)

    def polynomial(self, number: int, value: float) -> float:
        """The value of a function of FCTDEF."""
        return polynomials.value(self.channel, number, value)

    def call(self, cycle: Cycle, args: tuple[Any, ...]) -> None:
        """Run a technology cycle, behind those that were called before in this action."""
        self.action.cycles.append(RunningCycle(cycle, list(args)))


def is_executed(word: str) -> bool:
    """Whether an address or procedure of an action is executed; a variable's name stands for writing it."""
    return word in WORDS or word.removesuffix("()") in PROCEDURES or word.startswith("SYG_")
