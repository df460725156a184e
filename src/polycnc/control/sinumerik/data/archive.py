"""COMPLETE and INITIAL: the data of the working memory as initialisation programs (job planning 2.2).

INITIAL writes `_N_INITIAL_INI` over all areas, COMPLETE a program for each type of data (`_N_COMPLETE_TOA_INI` …),
beside the selected program in the control's own store. Running such a program brings the data back; what has its
standard value is not in it.
"""

from __future__ import annotations

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.tools.edges import DP_TYPE
from polycnc.control.sinumerik.tools.holders.stored import TYPES, CarrierData
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.frame import COMPONENTS, GEOMETRY_AXES, NEUTRAL, NcFrame
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.names.variables import Array
from polycnc.messages import AlarmError
from polycnc.program import Form, Program

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.language.sinumerik.names.variables import Variable

_NEUTRAL_COMPONENTS = {"SC": 1.0}
#: Angles are worked out from a matrix: what lies behind these decimals is no angle of anybody's.
_PLACES = 12
#: Values of a list in one block.
_LISTED = 10


def initial(channel: SinumerikChannel, args: Arguments) -> None:
    """INITIAL: one program over all areas."""
    _refuse_arguments(args, "INITIAL")
    lines = [
        f"CHANDATA({channel.number})",
        *(line for area in AREAS.values() for line in area(channel)),
    ]
    _store(channel, "_N_INITIAL_INI", lines)


def complete(channel: SinumerikChannel, args: Arguments) -> None:
    """COMPLETE: a program for each type of data."""
    _refuse_arguments(args, "COMPLETE")
    for type_, area in AREAS.items():
        _store(channel, f"_N_COMPLETE_{type_}_INI", list(area(channel)))


def _refuse_arguments(args: Arguments, name: str) -> None:
    if args:
        raise AlarmError("14020", text=name)


def _store(channel: SinumerikChannel, name: str, lines: list[str]) -> None:
    directory = channel.stack[0].code.program.directory
    channel.store.replace(Program(name, (*lines, "M17"), directory=directory, form=Form.SINUMERIK))
    channel.memory.language.programs.forget_steps()


# ---- areas


def _machine_data(channel: SinumerikChannel) -> Iterator[str]:
    yield from _data(channel, "$M")


def _setting_data(channel: SinumerikChannel) -> Iterator[str]:
    yield from _data(channel, "$S")


def _data(channel: SinumerikChannel, prefix: str) -> Iterator[str]:
    for (name, indices), value in channel.memory.data.items():
        if name.startswith(prefix):
            index = f"[{','.join(map(str, indices))}]" if indices else ""
            yield f"{name}{index}={_text(value)}"


def _tool_data(channel: SinumerikChannel) -> Iterator[str]:
    for number, tool in channel.memory.tools.tools.items():
        if tool.name or not tool.edges:
            yield f"$TC_TP2[{number}]={_text(tool.name)}"
        yield from (f"{name}[{number}]={_text(value)}" for name, value in tool.values.items())
        for d, edge in tool.edges.items():
            yield from (f"{name}[{number},{d}]={_text(value)}" for name, value in _edge_data(edge))
    for number, values in CarrierData.of(channel).carriers.items():
        for n, value in values.items():
            held = Axis(str(value)) if TYPES.get(n) is Type.AXIS else value
            yield f"$TC_CARR{n}[{number}]={_text(held)}"


def _edge_data(edge: Edge) -> Iterator[tuple[str, float]]:
    """Every parameter of an edge that is not zero; its type makes the edge."""
    for parameter, value in enumerate(edge.values):
        if value or parameter == DP_TYPE:
            yield f"$TC_DP{parameter}", value
    if edge.teeth:
        yield "$TC_DPNT", edge.teeth
    if edge.cutting_edge:
        yield "$TC_DPCE", edge.cutting_edge
    yield from ((f"$TC_DP{part}", value) for part, value in edge.directions.items() if value)
    for (kind, number), value in edge.additive.items():
        if value:
            yield f"$TC_{kind}{number}", value


def _frames(channel: SinumerikChannel) -> Iterator[str]:
    stored = {
        "$P_CHBFR": channel.memory.frames.base,
        "$P_NCBFR": channel.memory.frames.global_base,
        "$P_UIFR": channel.memory.frames.settable,
    }
    for name, frames in stored.items():
        for number, frame in enumerate(frames):
            for index, value in _components(frame):
                yield f"{name}[{number},{index}]={value}"


def _components(frame: NcFrame) -> Iterator[tuple[str, str]]:
    """Index and value of every component that is not neutral."""
    if frame is NEUTRAL:
        return
    for axis in (*GEOMETRY_AXES, *frame.others):
        for component in COMPONENTS:
            if component == "RT" and axis in frame.others:
                continue
            value = frame.component(axis, component)
            if abs(value - _NEUTRAL_COMPONENTS.get(component, 0.0)) > 1e-12:
                yield f"{axis},{component}", _text(round(value, _PLACES) if component == "RT" else value)


def _r_parameters(channel: SinumerikChannel) -> Iterator[str]:
    yield from (f"R{n}={_text(value)}" for n, value in enumerate(channel.memory.language.r) if value)


def _user_variables(channel: SinumerikChannel) -> Iterator[str]:
    for name, variable in channel.memory.language.global_variables.items():
        if variable.store is None or name in tables.CYCLE_SYMBOLS:
            continue
        held = variable.store[0]
        if isinstance(held, Array):
            yield from _array(variable, held)
        elif variable.type is Type.FRAME:
            yield from (f"{name}[{index}]={value}" for index, value in _components(held))
        else:
            yield f"{name}={_text(held)}"


def _array(variable: Variable, held: Array) -> Iterator[str]:
    for first in range(0, len(held.items), _LISTED):
        items = held.items[first : first + _LISTED]
        if variable.type is Type.FRAME:
            for place, frame in enumerate(items, first):
                for index, value in _components(frame):
                    yield f"{variable.name}[{_indices(held, place)},{index}]={value}"
        else:
            yield f"{variable.name}[{_indices(held, first)}]=SET({','.join(map(_text, items))})"


def _indices(held: Array, place: int) -> str:
    indices: list[int] = []
    for size in reversed(held.dims):
        place, index = divmod(place, size)
        indices.insert(0, index)
    return ",".join(map(str, indices))


def _text(value: Any) -> str:
    """A value as a program writes it."""
    if isinstance(value, Axis):
        return f"({value.name})"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, bool):
        return str(value).upper()
    text = repr(value)
    return text.removesuffix(".0").replace("e", "EX").replace("EX+", "EX")


#: Types of data in the order in which a start needs them.
AREAS: dict[str, Callable[[SinumerikChannel], Iterator[str]]] = {
    "TEA": _machine_data,
    "SEA": _setting_data,
    "GUD": _user_variables,
    "TOA": _tool_data,
    "UFR": _frames,
    "RPA": _r_parameters,
}
PROCEDURES: dict[str, Procedure] = {"INITIAL": initial, "COMPLETE": complete}
