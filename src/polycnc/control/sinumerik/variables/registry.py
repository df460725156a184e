"""System variables: the registry, positions, states, and those that only store.

`SystemVariables.find` looks a name up in `VARIABLES`, then in the families (machine data, tool data), and
tells names that SINUMERIK has and polycnc does not keep from names that nobody has. What belongs to the main
run has `stop`: the program waits for it (implicit preprocessing stop).

Source: job planning 1.1.2 (prefixes), 5.1 (actual values), and the manual of system variables by name.
"""

from __future__ import annotations

from functools import partial
from math import isnan

from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.actions.variables import ACTION_VARIABLES, OF_ACTIONS, TIMED_VARIABLES
from polycnc.control.sinumerik.axes.geometry import GEOMETRY_VARIABLES
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import shown
from polycnc.control.sinumerik.channels import link_memory
from polycnc.control.sinumerik.channels.axis_containers import CONTAINER_VARIABLES
from polycnc.control.sinumerik.couplings import links
from polycnc.control.sinumerik.couplings.spindle_pairs import SpindlePairs, turns
from polycnc.control.sinumerik.couplings.variables import COUPLING_VARIABLES
from polycnc.control.sinumerik.curve_tables.definition import DEFINITION_VARIABLES
from polycnc.control.sinumerik.data.machine_data import DELIVERED, MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import spindle_speed
from polycnc.control.sinumerik.feed.axis_settings import AXIS_VARIABLES
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.feed.tolerances import TOLERANCE_VARIABLES
from polycnc.control.sinumerik.frames.variables import FRAME_VARIABLES
from polycnc.control.sinumerik.iso.macro_words import MACRO_VARIABLES
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.motion.indexing import INDEX_VARIABLES
from polycnc.control.sinumerik.motion.repositioning import REPOS_VARIABLES
from polycnc.control.sinumerik.replaced import REPLACED_VARIABLES
from polycnc.control.sinumerik.signals.measuring import MEASURE_VARIABLES
from polycnc.control.sinumerik.signals.measuring_actions import ACTIVITY_VARIABLES
from polycnc.control.sinumerik.signals.sections import SECTION_VARIABLES
from polycnc.control.sinumerik.signals.workpiece import WORKPIECE_VARIABLES
from polycnc.control.sinumerik.tables import MINUTE
from polycnc.control.sinumerik.tools.management.adapters import ADAPTER_VARIABLES
from polycnc.control.sinumerik.tools.management.environments import ENVIRONMENT_VARIABLES
from polycnc.control.sinumerik.tools.management.lists import LIST_VARIABLES
from polycnc.control.sinumerik.tools.management.magazines import MAGAZINE_VARIABLES
from polycnc.control.sinumerik.tools.management.monitoring import MONITORING_VARIABLES
from polycnc.control.sinumerik.tools.online import OVERLAY_VARIABLES
from polycnc.control.sinumerik.tools.sides import Contour
from polycnc.control.sinumerik.tools.variables import IN_MAIN_RUN, TOOL_VARIABLES
from polycnc.control.sinumerik.transformations import smoothing
from polycnc.control.sinumerik.transformations.seat import Transformations
from polycnc.control.sinumerik.variables import in_force
from polycnc.control.sinumerik.variables.block_types import BLOCK_VARIABLES
from polycnc.control.sinumerik.variables.clock import PARTS, part_of_clock
from polycnc.control.sinumerik.variables.known import is_known
from polycnc.control.sinumerik.variables.lengths import Unit, unit_of
from polycnc.control.sinumerik.variables.part_counts import PART_COUNTS
from polycnc.control.sinumerik.variables.row import Indices, Reader, Writer
from polycnc.control.sinumerik.variables.run_times import KEPT_TIMES, RUN_TIMES
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.control.sinumerik.variables.surroundings import SURROUNDINGS
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.frame import NcFrame
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import ValueWrite
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle


@dataclass(frozen=True, slots=True)
class SystemVariable:
    """One variable `$…`.

    Attributes:
        name: With its `$`.
        type: Type of its values.
        reader: Gives the value for indices.
        writer: Sets the value; None for one that can only be read.
        stop: It belongs to the main run: reading it waits for that.
        goes_along: Writing it does not wait: the value goes along with the path.
        size: Number of its elements, or the machine datum that says it; empty where neither does.
        first: Index of its first element.
        timed: Only a program that is executed in time can read or write it.
        of_actions: Synchronised actions alone can write it.
        unit: For indices the mm, or mm/min, that one unit of the program is; None where no value is a length.
    """

    name: str
    type: Type
    reader: Reader
    writer: Writer | None = None
    stop: bool = False
    size: str | int = ""
    goes_along: bool = False
    timed: bool = False
    of_actions: bool = False
    unit: Unit | None = None
    first: int = 0

    def element_count(self, channel: SinumerikChannel) -> int | None:
        """How many elements an array with one index has; None where that is not told."""
        if isinstance(self.size, int):
            return self.size
        return channel.memory.data.integer(self.size) if self.size else None

    def read(self, channel: SinumerikChannel, indices: Indices) -> Any:
        """The value; indices are ints, axes or frame components as programmed."""
        return self.reader(channel, indices)

    def write(self, channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        """Set the value; alarm 17210 for a variable that can only be read."""
        if self.writer is None:
            raise AlarmError("17210", text=self.name)
        self.writer(channel, indices, value)


class SystemVariables:
    """All system variables by name."""

    def __init__(self) -> None:
        self._found: dict[str, SystemVariable] = {}

    def find(self, name: str) -> SystemVariable:
        """The variable of a name in capitals.

        Raises:
            AlarmError: PC0001 for a variable of the control that polycnc does not keep, 12550 for no
                variable.
        """
        variable = self._found.get(name)
        if variable is None:
            variable = replace(self._make(name), unit=unit_of(name))
            if name in in_force.NAMES:
                variable = replace(variable, reader=in_force.live(name, variable.reader))
            self._found[name] = variable
        return variable

    @staticmethod
    def _make(name: str) -> SystemVariable:
        if name in VARIABLES:
            return VARIABLES[name]
        # `$$` reads machine and setting data in the main run (job planning 1.1.2).
        if _DATUM.match(name) is not None:
            return _machine_datum("$" + name.lstrip("$"), live=name.startswith("$$"))
        if is_known(name):
            raise not_supported(name)
        raise AlarmError("12550", text=name)


# ---- indices


def index_of(indices: Indices, name: str, size: int, first: int = 0) -> int:
    """The one number in brackets; alarm 17020 outside the array, 12400 for a missing index."""
    if len(indices) != 1 or isinstance(indices[0], (Axis, str)):
        raise AlarmError("12400", text=name)
    index = int(indices[0])
    if not first <= index < size:
        raise AlarmError("17020", text=name, index=index)
    return index


def axis_of(indices: Indices, name: str) -> str:
    """The one axis in brackets; alarm 12400 without one."""
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text=name)
    return indices[0].name


def _spindle_of(channel: SinumerikChannel, axis: str) -> Spindle | None:
    memory = channel.memory
    number = axis[1:]
    return memory.spindles.all.get(int(number)) if axis[:1] == "S" and number.isdigit() else None


# ---- machine and setting data

#: Machine and setting data of the control, a channel or an axis; those of cycles have an S behind it (`$SCS_`).
_DATUM = regex(r"\$\$?[MS][NCA]S?_")
#: Data that polycnc knows by their names alone: these are texts.
_TEXT_DATUM = regex(r"_(NAME|NAME_TAB|PATH|SERIAL_NUMBER|VERSION)$")

#: Data that a program may only clear: what they switch on is not executed.
NOT_EXECUTED = frozenset(("$SC_CUTDIRMOD",))


def _machine_datum(name: str, *, live: bool = False) -> SystemVariable:
    """A machine or setting datum, as prepared blocks see it or, `live`, the main run."""
    value = DELIVERED[name] if name in DELIVERED else "" if _TEXT_DATUM.search(name) else 0.0
    kinds = {bool: Type.BOOL, int: Type.INT, str: Type.STRING}
    axial = name[2] == "A"

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        if axial and not any(isinstance(index, Axis) for index in indices):
            raise AlarmError("12400", text=name)
        data: MachineData = channel.memory.data
        found = data.read(name, *indices) if live else data.read_ahead(name, *indices)
        if isinstance(value, str):
            return "" if found is None else str(found)
        if not isinstance(found, int | float):  # the setup says a text, or nothing
            raise AlarmError("12150", text=name)
        return found

    def write(channel: SinumerikChannel, indices: Indices, new: Any) -> None:
        if name in NOT_EXECUTED and new:
            raise not_supported(name)
        channel.memory.data.write(name, indices, new)
        if name in working_area.DATA:
            working_area.refresh(channel)
        elif name in spindle_speed.DATA or name in smoothing.DATA:
            channel.context_changed()

    return SystemVariable(name, kinds.get(type(value), Type.REAL), read, write)


# ---- positions


def _inner_frame(channel: SinumerikChannel, _indices: Indices, *, settable: bool) -> NcFrame:
    """From the work to the base system, or where a settable frame is none of them, to its zero system."""
    state = channel.memory.frames
    inner = NcFrame()
    for frame in (*((state.active_settable,) if settable else ()), *state.inner()):
        inner = inner @ frame
    return inner


def _of_tool(channel: SinumerikChannel) -> list[float] | None:
    """Machine position beside a compensated contour, where blocks are programmed elsewhere; None where they are not."""
    if channel.actual.clocked is not None or channel.mode["compensation"] == "G40":
        return None
    toolpath = channel.toolpath
    if (context := toolpath.last_context()) is None:
        return None
    return toolpath.to_machine(toolpath.last_end(), context, channel.coordinates.geometry)


def _with_geometry(channel: SinumerikChannel, values: Sequence[float], tool: Sequence[float]) -> list[float]:
    """Values of all axes with the tool's own in the geometry axes: others may have moved without a row."""
    columns = {column for column in channel.coordinates.geometry if column >= 0}
    return [tool[i] if i in columns else value for i, value in enumerate(values)]


def _machine(channel: SinumerikChannel) -> list[float]:
    """Machine position of all axes now."""
    values, tool = channel.actual.machine, _of_tool(channel)
    return list(values) if tool is None else _with_geometry(channel, values, tool)


def _work(channel: SinumerikChannel) -> list[float]:
    """Work position of all axes now."""
    values, tool = channel.actual.work, _of_tool(channel)
    if tool is None:
        return list(values)
    return _with_geometry(channel, values, channel.coordinates.from_machine(tool))


#: The frames between the work and a system: SZS, BZS.
_INNER: dict[str, Reader] = {
    "settable": in_force.live("$AA_IEN", partial(_inner_frame, settable=False)),
    "base": in_force.live("$AA_IBN", partial(_inner_frame, settable=True)),
}


def _below_the_work(channel: SinumerikChannel, system: str) -> list[float]:
    """Positions of all axes now in a system between the work and the basic one."""
    memory = channel.memory
    inner: NcFrame = _INNER[system](channel, ())
    point = channel.coordinates.image(inner.frame, links.shown(channel, _work(channel)))
    for axis, part in inner.others.items():
        if axis not in memory.columns:  # a spindle
            continue
        column = memory.column(axis)
        point = [*point[:column], point[column] + part.coarse + part.fine, *point[column + 1 :]]
    return point


def _basic(channel: SinumerikChannel) -> list[float]:
    """Positions of all axes now in the basic system: those of the machine, but for what a transformation leads."""
    machine, seated = _machine(channel), Transformations.of(channel).seated
    if seated is None:
        return machine
    point = seated.basic(_work(channel))
    led = {column for column in channel.coordinates.geometry if column >= 0}
    return [point[i] if i in led else value for i, value in enumerate(machine)]


_SYSTEMS: dict[str, Callable[[SinumerikChannel], list[float]]] = {
    "machine": _machine,
    "basic": _basic,
    "base": partial(_below_the_work, system="base"),
    "settable": partial(_below_the_work, system="settable"),
    "actual": lambda channel: links.shown(channel, _work(channel)),
    "programmed": lambda channel: channel.coordinates.position,
}
#: Systems in which positions are no diameters.
_OF_AXES = frozenset(("machine", "basic"))


def _position(name: str, system: str, *, stop: bool = True) -> SystemVariable:
    def read(channel: SinumerikChannel, indices: Indices) -> float:
        axis = axis_of(indices, name)
        spindle = _spindle_of(channel, axis)
        if spindle is not None:
            return spindle.position
        column = channel.memory.column(axis)
        return shown(channel, column, _SYSTEMS[system](channel)[column], work=system not in _OF_AXES)

    return SystemVariable(name, Type.REAL, read, stop=stop)


# ---- states of the program


def _group_number(channel: SinumerikChannel, indices: Indices) -> int:
    number = index_of(indices, "$P_GG", 62, first=1)
    group = gcodes.BY_NUMBER.get(number)
    return gcodes.number_of(channel.mode[group.name]) if group and group.is_modal else 0


def _geometry_axis(position: int) -> Reader:
    def read(channel: SinumerikChannel, _indices: Indices) -> Axis:
        column = channel.coordinates.geometry[position]
        return Axis(channel.axes[column] if column >= 0 else "XYZ"[position])

    return read


def _programmed_feed(channel: SinumerikChannel, _indices: Indices) -> float:
    feed: float = 0.0 if isnan(channel.feed) else channel.feed
    return feed * MINUTE if PathFeed.of(channel).mode is not FeedMode.PER_REVOLUTION else feed


def _spindle_value(attribute: str) -> Reader:
    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        number = arguments.spindle(indices[0]) if indices else None
        return getattr(channel.memory.spindles.get(number), attribute)

    return read


def _turning_speed(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_S[n]`: what a spindle turns with, rpm, negative for M4; 0 while it stands."""
    number = arguments.spindle(indices[0]) if indices else None
    return turns(channel, channel.memory.spindles.get(number).number)


def _direction(channel: SinumerikChannel, indices: Indices) -> int:
    """3, 4 or 5, as the M function."""
    direction: int = _spindle_value("direction")(channel, indices)
    return {1: 3, -1: 4}.get(direction, 5)


def _turning_direction(channel: SinumerikChannel, indices: Indices) -> int:
    """How a spindle turns, couplings included, as the M function."""
    spindle = channel.memory.spindles.get(arguments.spindle(indices[0]) if indices else None)
    if SpindlePairs.of(channel).acting(spindle.number) is None:
        return _direction(channel, indices)
    speed = turns(channel, spindle.number)
    return 3 if speed > 0.0 else 4 if speed < 0.0 else 5


def _allowance(channel: SinumerikChannel, _indices: Indices) -> float:
    return Contour.of(channel).allowance_mm


def _program_name(channel: SinumerikChannel, indices: Indices) -> str:
    level = index_of(indices, "$P_PROG", len(channel.stack)) if indices else len(channel.stack) - 1
    return channel.stack[level].code.program.name


def _line_number(channel: SinumerikChannel, _indices: Indices) -> int:
    return channel.line


def _always(value: Any) -> Reader:
    return lambda _channel, _indices: value


_STATES = (
    SystemVariable("$P_GG", Type.INT, _group_number),
    SystemVariable("$P_EP", Type.REAL, _position("$P_EP", "programmed").reader),
    SystemVariable("$P_AXN1", Type.AXIS, _geometry_axis(0)),
    SystemVariable("$P_AXN2", Type.AXIS, _geometry_axis(1)),
    SystemVariable("$P_AXN3", Type.AXIS, _geometry_axis(2)),
    SystemVariable("$P_F", Type.REAL, _programmed_feed),
    SystemVariable("$P_S", Type.REAL, _spindle_value("speed")),
    SystemVariable("$P_SDIR", Type.INT, _direction),
    SystemVariable("$P_MSNUM", Type.INT, lambda channel, _indices: channel.memory.spindles.master),
    SystemVariable("$P_GWPS", Type.BOOL, _spindle_value("has_wheel_speed")),
    SystemVariable("$P_OFFN", Type.REAL, _allowance),
    SystemVariable("$P_PROG", Type.STRING, _program_name),
    SystemVariable("$P_LINENO", Type.INT, _line_number),
    SystemVariable("$P_CHANNO", Type.INT, lambda channel, _indices: channel.number),
    SystemVariable("$P_SEARCH", Type.BOOL, lambda channel, _indices: channel.is_searched),
    SystemVariable("$P_TECCYCLE", Type.BOOL, _always(False)),
    SystemVariable("$P_ISTEST", Type.BOOL, lambda channel, _indices: channel.is_tested),
    SystemVariable("$P_SIM", Type.BOOL, _always(False)),
    SystemVariable("$P_DRYRUN", Type.BOOL, _always(False)),
    SystemVariable("$P_PROG_EVENT", Type.INT, _always(0)),
    SystemVariable("$P_EXTGG", Type.INT, _always(0)),
    SystemVariable(
        "$AC_MSNUM", Type.INT, lambda channel, _indices: channel.memory.spindles.master, stop=True
    ),
    SystemVariable("$AC_SDIR", Type.INT, _turning_direction, stop=True),
    SystemVariable("$AA_S", Type.REAL, _turning_speed, stop=True),
    SystemVariable("$AC_STAT", Type.INT, _always(2), stop=True),
    SystemVariable("$PI", Type.REAL, _always(3.141592653589793)),
    _position("$AA_IW", "actual"),
    _position("$AA_IEN", "settable"),
    _position("$AA_IBN", "base"),
    _position("$AA_IB", "basic"),
    _position("$AA_IM", "machine"),
    _position("$VA_IM", "machine"),
)


# ---- variables that only store


def _store(
    name: str, type_: Type, size_datum: str | int, *, first: int = 0, stop: bool = True
) -> SystemVariable:
    """An array that keeps what is written; its size is a number or a machine datum."""
    empty: Any = {Type.BOOL: False, Type.INT: 0}.get(type_, 0.0)

    def place(channel: SinumerikChannel, indices: Indices) -> int:
        size = variable.element_count(channel) or 0
        return index_of(indices, name, size + first, first)

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        return Stored.of(channel).of_name(name).get((name, (place(channel, indices),)), empty)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        index = place(channel, indices)
        written = ValueWrite(f"{name}[{index}]", value, Stored.of(channel).of_name(name), (name, (index,)))
        if channel.main_run is None:
            written.store()
        else:
            channel.event(written)

    variable = SystemVariable(name, type_, read, write, stop, size_datum, goes_along=True, first=first)
    return variable


def _output(name: str, type_: Type) -> SystemVariable:
    return _store(name, type_, 64, first=1)


_STORED = (
    _store("$AC_MARKER", Type.INT, "$MC_MM_NUM_AC_MARKER"),
    _store("$AC_PARAM", Type.REAL, "$MC_MM_NUM_AC_PARAM"),
    _output("$A_OUT", Type.BOOL),
    _output("$A_OUTA", Type.REAL),
    _output("$A_IN", Type.BOOL),
    _output("$A_INA", Type.REAL),
)
_LINKED = tuple(
    SystemVariable(
        name, access.type, link_memory.reader(name), link_memory.writer(name), stop=True, goes_along=True
    )
    for name, access in link_memory.ACCESS.items()
)
VARIABLES: dict[str, SystemVariable] = {
    **{variable.name: variable for variable in (*_STATES, *_STORED, *_LINKED)},
    **{name: SystemVariable(name, *row) for name, row in GEOMETRY_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in FRAME_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in TOOL_VARIABLES.items()},
    **{
        name: SystemVariable(name, *row)
        for name, row in {
            **LIST_VARIABLES,
            **MAGAZINE_VARIABLES,
            **ADAPTER_VARIABLES,
            **MONITORING_VARIABLES,
            **ENVIRONMENT_VARIABLES,
        }.items()
    },
    **{name: SystemVariable(name, *TOOL_VARIABLES[of], stop=True) for name, of in IN_MAIN_RUN.items()},
    **{name: SystemVariable(name, *row) for name, row in OVERLAY_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in working_area.AREA_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in SECTION_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in AXIS_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in TOLERANCE_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in COUPLING_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in CONTAINER_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in INDEX_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in REPOS_VARIABLES.items()},
    **{
        name: SystemVariable(name, *row)
        for name, row in {**MEASURE_VARIABLES, **ACTIVITY_VARIABLES, **WORKPIECE_VARIABLES}.items()
    },
    **{name: SystemVariable(name, *row) for name, row in DEFINITION_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in {**SURROUNDINGS, **BLOCK_VARIABLES}.items()},
    **{name: SystemVariable(name, *row) for name, row in REPLACED_VARIABLES.items()},
    **{name: SystemVariable(name, *row) for name, row in MACRO_VARIABLES.items()},
    **{name: SystemVariable(name, Type.INT, part_of_clock(part), stop=True) for name, part in PARTS.items()},
    **{
        name: SystemVariable(name, *row, of_actions=name in OF_ACTIONS)
        for name, row in ACTION_VARIABLES.items()
    },
    **{
        name: SystemVariable(name, *row, goes_along=True, timed=True)
        for name, row in {**TIMED_VARIABLES, **RUN_TIMES}.items()
    },
    **{name: SystemVariable(name, *row) for name, row in {**KEPT_TIMES, **PART_COUNTS}.items()},
}
