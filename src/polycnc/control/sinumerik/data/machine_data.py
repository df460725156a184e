"""Machine and setting data: what a program reads as `$MN_…`, `$MC_…`, `$MA_…`, `$SN_…` and so on.

A datum has an identifier and a number; `machine_data.toml` lists those that polycnc acts on or that programs commonly
read, with their delivered values; some say what the machine is (`of_machine`). What the setup says overrides them, by
number (`36110[X]`) or identifier (`$MA_POS_LIMIT_PLUS[X]`). Lengths are mm, angles degrees, as the control keeps them
with a metric basic system.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, lasting, retained
from polycnc.control.sinumerik import axis_names
from polycnc.control.sinumerik.data import of_machine
from polycnc.control.sinumerik.data.delivered import DATA
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.memory.retained import PARAMETERS
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.machine.setup.values import ParameterKey, Parameters

Index = int | str
#: No control has memory for more of anything that a datum counts.
MOST_ELEMENTS = 32767
#: Where a datum stands that is named without an index.
_WITHOUT_INDEX: tuple[tuple[Index, ...], ...] = ((), (0,))
Key = tuple[str, tuple[Index, ...]]


DELIVERED: dict[str, bool | float | str] = {name: value for name, (_, value) in DATA.items()}
_IDENTIFIER_OF = {number: name for name, (number, _) in DATA.items()}


@dataclass(slots=True, eq=False)
class MachineData(State, lifetime=Lifetime.POWER):
    """The machine and setting data of one channel.

    Attributes:
        axes: The channel's name of an axis by every identifier: `X`, `X1` and `AX1` mean the same axis.
        built: What the machine says.
        preset: What the setup says.
        values: What has a value of its own: what the setup says, and then what was changed.
        changed: What programs have given other values, retained; None for the delivered value.
        changed_everywhere: The same for data of the control (`$MN_`, `$SN_`).
        ahead: What prepared blocks say of setting data that the main run has not written yet.
    """

    changed: dict[Key, object] = retained(PARAMETERS)
    changed_everywhere: dict[Key, object] = retained(PARAMETERS, of_control=True)
    axes: Mapping[str, str] = field(default_factory=dict)
    built: Mapping[Key, object] = field(default_factory=dict)
    preset: dict[Key, object] = field(default_factory=dict)
    values: dict[Key, object] = field(default_factory=dict)
    ahead: dict[Key, object] = lasting(Lifetime.RESET, factory=dict)

    @classmethod
    def first(cls, channel: Channel) -> MachineData:
        """As the setup gives them, but for what was changed."""
        columns = {**axis_names.machine_columns(channel), **axis_names.columns(channel)}
        names = {name: channel.axes[column] for name, column in columns.items()}
        tables = (channel.retained.table(PARAMETERS, number) for number in (channel.number, 0))
        data = cls.of_setup(channel.setup.parameters, names, *tables)
        data.built = of_machine.built(channel)
        return data

    @classmethod
    def of_setup(
        cls,
        parameters: Parameters,
        axes: Mapping[str, str],
        changed: dict[Key, object] | None = None,
        changed_everywhere: dict[Key, object] | None = None,
    ) -> MachineData:
        """What a setup says, by number or identifier, but for what was changed."""
        data = cls(
            {} if changed is None else changed, {} if changed_everywhere is None else changed_everywhere, axes
        )
        for key, value in parameters.items():
            data._preset(key, value)
        data.values = data.preset.copy()
        for table in (data.changed, data.changed_everywhere):
            for key_, value_ in table.items():
                data._put(key_, value_)
        return data

    def _put(self, key: Key, value: object) -> None:
        """Give a datum a value of its own; None takes it away."""
        if value is None:
            self.values.pop(key, None)
        else:
            self.values[key] = value

    def _change(self, key: Key, value: object) -> None:
        """A datum has another value from here on, beyond power-off; None: the delivered one."""
        (self.changed_everywhere if key[0][2] == "N" else self.changed)[key] = value
        self._put(key, value)

    def _preset(self, key: ParameterKey, value: object) -> None:
        """Take a value of the setup; a list gives its elements, a bit is set in what holds so far."""
        name = _IDENTIFIER_OF.get(key.id, str(key.id)) if isinstance(key.id, int) else key.id
        element = (
            key.element if isinstance(key.element, tuple) else () if key.element is None else (key.element,)
        )
        axis = () if key.axis is None else (self._index(key.axis),)
        indices: tuple[Index, ...] = (*element, *axis)
        if key.bit is not None:
            before = self.preset.get((name, indices), DELIVERED.get(name, 0))
            bits = int(before) if isinstance(before, (int, float)) else 0
            self.preset[name, indices] = bits | 1 << key.bit if value else bits & ~(1 << key.bit)
        elif isinstance(value, tuple):
            for i, item in enumerate(value):
                self.preset[name, (i, *indices)] = item
        else:
            self.preset[name, indices] = value

    def _index(self, value: object) -> Index:
        """An index in one form: a number, or the channel's name of an axis."""
        text = str(value).upper()
        return int(text) if text.lstrip("-").isdigit() else self.axes.get(text, text)

    def said(self, name: str) -> object:
        """What the setup or a program says of a datum, of whatever index; None where neither does."""
        return next((value for (known, _), value in self.values.items() if known == name), None)

    def knows(self, name: str) -> bool:
        """Whether a datum is known: delivered, or named by the setup or a program before."""
        return name in DELIVERED or any(known == name for known, _ in self.values)

    def read(self, name: str, *indices: object) -> object:
        """The value of a datum; without its index that of the first element.

        Raises:
            AlarmError: PC0001 for a datum that polycnc does not keep.
        """
        if not indices:
            wanted: tuple[tuple[Index, ...], ...] = _WITHOUT_INDEX
        else:
            key = tuple(self._index(index) for index in indices)
            wanted = (key, key[-1:], ())
        for place in wanted:
            if (name, place) in self.values:
                return self.values[name, place]
        for place in wanted:
            if (name, place) in self.built:
                return self.built[name, place]
        if name in DELIVERED:
            return DELIVERED[name]
        raise not_supported(name)

    def number(self, name: str, *indices: object) -> float:
        """The value of a datum as a number."""
        value = self.read(name, *indices)
        return float(value) if isinstance(value, (int, float)) else 0.0

    def integer(self, name: str, *indices: object) -> int:
        """The value of a datum as a whole number."""
        return int(self.number(name, *indices))

    def count(self, name: str, *indices: object) -> int:
        """The value of a datum that says how many of something the control keeps.

        Raises:
            AlarmError: 17080 for less than none, 17090 for more than a control has memory for.
        """
        count = self.integer(name, *indices)
        if not 0 <= count <= MOST_ELEMENTS:
            raise AlarmError("17080" if count < 0 else "17090", text=name)
        return count

    def element_with(self, name: str, value: object) -> int | None:
        """The first index at which a datum has a value of setup or program, 0 for one without an index; or None."""
        held = (indices for (known, indices), own in self.values.items() if known == name and own == value)
        found = sorted(int(indices[0]) if indices else 0 for indices in held)
        return found[0] if found else None

    def write(self, name: str, indices: tuple[object, ...], value: object) -> None:
        """Set a datum."""
        key = (name, tuple(self._index(index) for index in indices))
        self.ahead.pop(key, None)
        self._change(key, value)

    def items(self) -> list[tuple[Key, object]]:
        """Every datum that setup or programs gave a value, sorted by name and index."""
        return sorted(self.values.items(), key=lambda item: (item[0][0], tuple(map(str, item[0][1]))))

    def say_ahead(self, name: str, indices: tuple[object, ...], value: object) -> None:
        """A prepared block says a value: what is prepared behind it has it, the main run when that writes it."""
        self.ahead[name, tuple(self._index(index) for index in indices)] = value

    def write_as_said(self, name: str, indices: tuple[object, ...], value: object) -> None:
        """The main run writes what a block has said; what later blocks have said stays."""
        key = (name, tuple(self._index(index) for index in indices))
        later = self.ahead.pop(key, value)
        self.write(name, indices, value)
        if later != value:
            self.ahead[key] = later

    def read_ahead(self, name: str, *indices: object) -> object:
        """The value for a block that is prepared now; else as `read`."""
        key = (name, tuple(self._index(index) for index in indices))
        return self.ahead[key] if key in self.ahead else self.read(name, *indices)

    def restore(self, name: str) -> None:
        """A datum takes the values that the setup gave it, or the delivered ones."""
        for table in (self.values, self.changed, self.changed_everywhere):
            for key in [key for key in table if key[0] == name]:
                del table[key]
        self.values.update((key, value) for key, value in self.preset.items() if key[0] == name)

    @property
    def keeps_first_values(self) -> bool:
        """MD11270 bit 0: user variables go back to the values of their definition, not to zero."""
        return bool(self.integer("$MN_DEFAULT_VALUES_MEM_MASK") & 1)

    def forget_settings(self) -> None:
        """Setting data take their delivered values."""
        for key in [key for key in self.values if key[0].startswith("$S")]:
            self._change(key, None)

    def is_set(self, name: str, *indices: object) -> bool:
        """Whether the setup or a program gave a datum a value of its own."""
        return (name, tuple(self._index(index) for index in indices)) in self.values
