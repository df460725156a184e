"""Frame variables `$P_UIFR`, `$P_PFRAME` …: whole frames, and their components by axis.

Source: job planning 5.1.1 (predefined frame variables), 5.2 (components), 5.7 (base frames).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from polycnc.control.sinumerik import frames
from polycnc.language.sinumerik.nc_frame import GEOMETRY_AXES, NcFrame
from polycnc.language.sinumerik.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.frames import Frames

Indices = tuple[Any, ...]
Row = tuple[Type, Callable[["Channel", Indices], Any], Callable[["Channel", Indices, Any], None] | None]
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


def frame_axis(channel: Channel, axis: str) -> str:
    """The name by which frames know an axis: X, Y, Z for the geometry, else the channel's name."""
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

    def read(channel: Channel, indices: Indices) -> Any:
        number, axis, component = split(indices, name, numbered=numbered)
        frame = _got(channel, name, number, get)
        return frame.component(frame_axis(channel, axis), component) if axis else frame

    def write(channel: Channel, indices: Indices, value: Any) -> None:
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
        if plain and frame.has_rotation:
            raise AlarmError("18310", text=name)
        put(channel.memory.frames, number, frame)
        if acts:
            frames.changed(channel)

    return Type.FRAME, read, write if put is not None else None


def _got(channel: Channel, name: str, number: int, get: Get) -> NcFrame:
    try:
        if number < 0:
            raise IndexError
        return get(channel.memory.frames, number)
    except IndexError:
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
        return frame

    def put(state: Frames, _number: int, frame: NcFrame) -> None:
        setattr(state, attribute, frame.folded() if folds else frame)

    return get, put


def _system(name: str) -> tuple[Get, Put]:
    def put(state: Frames, _number: int, frame: NcFrame) -> None:
        state.system[name] = frame

    return (lambda state, _number: state.system[name]), put


def _mask(attribute: str) -> Row:
    def read(channel: Channel, _indices: Indices) -> int:
        mask: int = getattr(channel.memory.frames, attribute)
        return mask

    def write(channel: Channel, _indices: Indices, value: int) -> None:
        setattr(channel.memory.frames, attribute, value)
        frames.changed(channel)

    return Type.INT, read, write


def _number(channel: Channel, _indices: Indices) -> int:
    number: int = channel.memory.frames.number
    return number


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
    "$P_UIFRNUM": (Type.INT, _number, None),
    "$P_CHBFRMASK": _mask("base_mask"),
    "$P_NCBFRMASK": _mask("global_base_mask"),
    **{name: _variable(name, *_system(name), acts=True) for name in frames.SYSTEM_FRAMES},
}
