"""Frame variables `$P_UIFR`, `$P_PFRAME` …: whole frames, and their components by axis.

Source: job planning 5.1.1 (predefined frame variables), 5.2 (components), 5.7 (base frames).
"""

from __future__ import annotations

from collections.abc import Callable

from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.frames.memory import SYSTEM_FRAMES
from polycnc.control.sinumerik.variables.row import Indices, Row
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES, NcFrame
from polycnc.language.sinumerik.names.spindles import axis_of_spindle
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.frames.memory import Frames

Get = Callable[["Frames", int], NcFrame]
Put = Callable[["Frames", int, NcFrame], None]


def split(indices: Indices, name: str, *, numbered: bool) -> tuple[int, str, str]:
    """Frame number, axis and component (both empty for the whole frame) of the indices in brackets."""
    rest = list(indices)
    number = 0
    if numbered:
        if not rest or isinstance(rest[0], (Axis, str)):
            raise AlarmError("12400", text=name)
        number = int(rest.pop(0))
    if not rest:
        return number, "", ""
    if len(rest) != 2 or not isinstance(rest[0], Axis) or not isinstance(rest[1], str):
        raise AlarmError("12400", text=name)
    return number, rest[0].name, rest[1]


def frame_axis(channel: SinumerikChannel, axis: str) -> str:
    """The name by which frames know an axis: X, Y, Z for the geometry, else the channel's name.

    A spindle goes by the axis that it is, or by its own name.
    """
    axis = axis_of_spindle(channel, Axis(axis)).name
    if axis in (f"S{number}" for number in channel.memory.spindles.all):
        return axis
    column = channel.memory.column(axis)
    geometry = channel.coordinates.geometry
    return GEOMETRY_AXES[geometry.index(column)] if column in geometry else channel.axes[column]


def _variable(
    name: str, get: Get, put: Put | None, *, numbered: bool = False, acts: bool = False, plain: bool = False
) -> Row:
    """A frame variable.

    Args:
        name: With its `$`.
        get: Gives the frame.
        put: Sets it; None for one that can only be read.
        numbered: It is an array.
        acts: Writing it acts at once.
        plain: It takes no rotation (frames of the whole control, 18310).
    """

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        number, axis, component = split(indices, name, numbered=numbered)
        frame = _got(channel, name, number, get)
        return frame.component(frame_axis(channel, axis), component) if axis else frame

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        assert put is not None
        number, axis, component = split(indices, name, numbered=numbered)
        frame = _got(channel, name, number, get)
        if axis:
            try:
                frame = frame.with_component(frame_axis(channel, axis), component, float(value))
            except ValueError:
                raise AlarmError("18310" if component == "RT" else "12160", text=name) from None
        else:
            frame = value
        _check_allowed(channel, name, frame, plain=plain)
        put(channel.memory.frames, number, frame)
        if acts:
            frames.changed(channel)

    return Type.FRAME, read, write if put is not None else None


def _check_allowed(channel: SinumerikChannel, name: str, frame: NcFrame, *, plain: bool) -> None:
    """18310 for the rotation of a frame of the whole control, 18312 for a fine offset without MD18600."""
    memory = channel.memory
    is_global = plain or (name == "$P_UIFR" and memory.data.integer("$MN_MM_NUM_GLOBAL_USER_FRAMES") > 0)
    if is_global and frame.has_rotation:
        raise AlarmError("18310", text=name)
    if frame.has_fine and not memory.data.integer("$MN_MM_FRAME_FINE_TRANS"):
        raise AlarmError("18312")


def _external(channel: SinumerikChannel, indices: Indices) -> tuple[str, int]:
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AA_ETRANS")
    return frame_axis(channel, indices[0].name), channel.memory.column(indices[0].name)


def _external_shift(channel: SinumerikChannel, indices: Indices) -> float:
    _, column = _external(channel, indices)
    return float(Stored.of(channel).values.get(("$AA_ETRANS", (column,)), 0.0))


def _set_external_shift(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    """$AA_ETRANS: kept; it acts when the PLC takes it over (DB31 ff., DBX3.0), as part of $P_EXTFRAME (5.4)."""
    axis, column = _external(channel, indices)
    Stored.of(channel).values["$AA_ETRANS", (column,)] = float(value)
    number = 30 + channel.machine.axis_number(channel.axis_data[column].name)
    if channel.setup.switches.plc.get(f"DB{number}.DBX3.0"):
        system = channel.memory.frames.system
        system["$P_EXTFRAME"] = system["$P_EXTFRAME"].with_component(axis, "TR", float(value))
        frames.changed(channel)


def _got(channel: SinumerikChannel, name: str, number: int, get: Get) -> NcFrame:
    try:
        if number < 0:
            raise IndexError
        return get(channel.memory.frames, number)
    except IndexError:
        if name in _CHANNEL_BASES and not channel.memory.frames.base:
            raise AlarmError("18311", text=name) from None
        raise AlarmError("17020", text=name, index=number) from None


def _list(attribute: str) -> tuple[Get, Put]:
    def get(state: Frames, number: int) -> NcFrame:
        frame: NcFrame = getattr(state, attribute)[number]
        return frame

    def put(state: Frames, number: int, frame: NcFrame) -> None:
        getattr(state, attribute)[number] = frame

    return get, put


def _first(attribute: str) -> tuple[Get, Put]:
    get, put = _list(attribute)
    return (lambda state, _number: get(state, 0)), (lambda state, _number, frame: put(state, 0, frame))


def _single(attribute: str, *, folds: bool = False) -> tuple[Get, Put]:
    def get(state: Frames, _number: int) -> NcFrame:
        frame: NcFrame = getattr(state, attribute)
        return frame.folded() if folds else frame

    def put(state: Frames, _number: int, frame: NcFrame) -> None:
        setattr(state, attribute, frame.folded() if folds else frame)

    return get, put


def _system(name: str) -> tuple[Get, Put]:
    def put(state: Frames, _number: int, frame: NcFrame) -> None:
        state.system[name] = frame

    return (lambda state, _number: state.system[name]), put


def _mask(attribute: str) -> Row:
    def read(channel: SinumerikChannel, _indices: Indices) -> int:
        mask: int = getattr(channel.memory.frames, attribute)
        return mask

    def write(channel: SinumerikChannel, _indices: Indices, value: int) -> None:
        setattr(channel.memory.frames, attribute, value)
        frames.changed(channel)

    return Type.INT, read, write


def _number(channel: SinumerikChannel, _indices: Indices) -> int:
    number: int = channel.memory.frames.number
    return number


#: Base frames of the channel; 18311 where it has none (MD28081).
_CHANNEL_BASES = frozenset({"$P_CHBFR", "$P_UBFR", "$P_BFRAME", "$P_CHBFRAME"})
FRAME_VARIABLES: dict[str, Row] = {
    "$P_UIFR": _variable("$P_UIFR", *_list("settable"), numbered=True),
    "$P_CHBFR": _variable("$P_CHBFR", *_list("base"), numbered=True),
    "$P_NCBFR": _variable("$P_NCBFR", *_list("global_base"), numbered=True, plain=True),
    "$P_UBFR": _variable("$P_UBFR", *_first("base")),
    "$P_IFRAME": _variable("$P_IFRAME", *_single("active_settable"), acts=True),
    "$P_PFRAME": _variable("$P_PFRAME", *_single("programmable", folds=True), acts=True),
    "$P_BFRAME": _variable("$P_BFRAME", *_first("active_base"), acts=True),
    "$P_CHBFRAME": _variable("$P_CHBFRAME", *_list("active_base"), numbered=True, acts=True),
    "$P_NCBFRAME": _variable(
        "$P_NCBFRAME", *_list("active_global_base"), numbered=True, acts=True, plain=True
    ),
    "$P_ACTBFRAME": _variable("$P_ACTBFRAME", lambda state, _number: state.actual_base(), None),
    "$P_ACTFRAME": _variable("$P_ACTFRAME", lambda state, _number: state.total(), None),
    "$AA_ETRANS": (Type.REAL, _external_shift, _set_external_shift),
    "$P_UIFRNUM": (Type.INT, _number, None),
    "$P_CHBFRMASK": _mask("base_mask"),
    "$P_NCBFRMASK": _mask("global_base_mask"),
    **{name: _variable(name, *_system(name), acts=True) for name in SYSTEM_FRAMES},
}
