"""Variables that only the main run knows: where the block in execution is, what actions make of the speeds."""

from __future__ import annotations

from polycnc.control.sinumerik.actions import fifo, fixed_stop, overlay, polynomials, timers
from polycnc.control.sinumerik.actions.actions import SynchronisedActions
from polycnc.control.sinumerik.actions.axes import EXCHANGE_VARIABLES
from polycnc.control.sinumerik.actions.run import Deleted
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import shown
from polycnc.control.sinumerik.tables import MINUTE
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.interpolator import Influence, Interpolator
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, RowWithStop

_PERCENT = 100.0
#: `$AC_TANEB` where no block follows.
_NO_CORNER = -180.0


def _live(value: Callable[[SinumerikChannel, Interpolator], float]) -> Reader:
    """A value of the main run; 0 where none executes the program."""

    def read(channel: SinumerikChannel, _indices: Indices) -> float:
        clocked = channel.actual.clocked
        return value(channel, clocked) if clocked is not None else 0.0

    return read


def _axial(value: Callable[[SinumerikChannel, Interpolator, int], float]) -> Reader:
    """The same of an axis."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        column = arguments.column(channel, indices[0] if indices else None)
        clocked = channel.actual.clocked
        return value(channel, clocked, column) if clocked is not None else 0.0

    return read


def _influence(channel: SinumerikChannel) -> Influence:
    return SynchronisedActions.of(channel).run.influence


def _override(channel: SinumerikChannel, _indices: Indices) -> float:
    return _influence(channel).factor * _PERCENT


def _set_override(channel: SinumerikChannel, _indices: Indices, value: float) -> None:
    _influence(channel).factor = max(value, 0.0) / _PERCENT


def _of_operator(channel: SinumerikChannel, _indices: Indices) -> float:
    """$AC_PLC_OVR: what the operator has set."""
    clocked = channel.actual.clocked
    return _PERCENT * (1.0 if clocked is None else clocked.operator_override)


def _total_override(channel: SinumerikChannel, indices: Indices) -> float:
    """$AC_TOTAL_OVR: per cent of per cent (10.4.29)."""
    return _influence(channel).factor * _of_operator(channel, indices)


def _added_feed(channel: SinumerikChannel, _indices: Indices) -> float:
    return _influence(channel).addend * MINUTE


def _add_feed(channel: SinumerikChannel, _indices: Indices, value: float) -> None:
    _influence(channel).addend = value / MINUTE


def _axis_override(channel: SinumerikChannel, indices: Indices) -> float:
    column = arguments.column(channel, indices[0] if indices else None)
    return _influence(channel).of_axes.get(column, 1.0) * _PERCENT


def _set_axis_override(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    column = arguments.column(channel, indices[0] if indices else None)
    _influence(channel).of_axes[column] = max(value, 0.0) / _PERCENT


def _to_go(channel: SinumerikChannel, clocked: Interpolator, column: int) -> float:
    """Way of an axis to its end, signed: of the block, or of what commands it."""
    commanded = clocked.left(column)
    return shown(channel, column, commanded, work=False)


def _cycles(channel: SinumerikChannel, clocked: Interpolator) -> float:  # noqa: ARG001 - as all of these
    return float(max(SynchronisedActions.of(channel).looks, 0))


_PATH: dict[str, RowWithStop] = {
    "$AC_TIME": (Type.REAL, _live(lambda _, clocked: clocked.on_path.seconds), None, True),
    "$AC_TIMEC": (Type.REAL, _live(_cycles), None, True),
    "$AC_DTEB": (Type.REAL, _live(lambda _, clocked: clocked.on_path.left), None, True),
    "$AC_DTEW": (Type.REAL, _live(lambda _, clocked: clocked.on_path.left), None, True),
    "$AC_DTBB": (Type.REAL, _live(lambda _, clocked: clocked.on_path.done), None, True),
    "$AC_DTBW": (Type.REAL, _live(lambda _, clocked: clocked.on_path.done), None, True),
    "$AC_PLTBB": (Type.REAL, _live(lambda _, clocked: clocked.on_path.done), None, True),
    "$AC_PLTEB": (Type.REAL, _live(lambda _, clocked: clocked.on_path.left), None, True),
    "$AC_VACTB": (Type.REAL, _live(lambda _, clocked: clocked.on_path.speed * MINUTE), None, True),
    "$AC_VACTW": (Type.REAL, _live(lambda _, clocked: clocked.on_path.speed * MINUTE), None, True),
    "$AC_DELT": (Type.REAL, lambda channel, _indices: Deleted.of(channel).path, None, True),
    "$AC_OVR": (Type.REAL, _override, _set_override, True),
    "$AC_VC": (Type.REAL, _added_feed, _add_feed, True),
    "$AC_PLC_OVR": (Type.REAL, _of_operator, None, True),
    "$AC_TOTAL_OVR": (Type.REAL, _total_override, None, True),
}


def _corner(_channel: SinumerikChannel, clocked: Interpolator) -> float:
    """$AC_TANEB: the angle to the next block, -180 where there is none."""
    angle = clocked.corner_angle()
    return _NO_CORNER if angle is None else angle


def _path_share(channel: SinumerikChannel, clocked: Interpolator) -> float:  # noqa: ARG001 - as all of these
    """How much of the block is done, 0 to 1."""
    path = clocked.on_path
    whole = path.done + path.left
    return path.done / whole if whole > 0.0 else 1.0


def _dropped(channel: SinumerikChannel, indices: Indices) -> float:
    return Deleted.of(channel).axes.get(arguments.column(channel, indices[0] if indices else None), 0.0)


_AXES: dict[str, RowWithStop] = {
    "$AC_TANEB": (Type.REAL, _live(_corner), None, True),
    "$AC_PATHN": (Type.REAL, _live(_path_share), None, True),
    "$AA_DTEB": (Type.REAL, _axial(_to_go), None, True),
    "$AA_DTEW": (Type.REAL, _axial(_to_go), None, True),
    "$AA_DTEPB": (Type.REAL, _axial(_to_go), None, True),
    "$AA_DTEPW": (Type.REAL, _axial(_to_go), None, True),
    "$AA_DELT": (Type.REAL, _dropped, None, True),
    "$AA_OVR": (Type.REAL, _axis_override, _set_axis_override, True),
    "$AA_PLC_OVR": (Type.REAL, lambda _channel, _indices: _PERCENT, None, True),
    "$AA_TOTAL_OVR": (Type.REAL, _axis_override, None, True),
    **{
        name: (Type.REAL, _axial(lambda _, clocked, column: clocked.speed(column) * MINUTE), None, True)
        for name in ("$AA_VACTM", "$AA_VACTB", "$AA_VACTW", "$VA_VACTM")
    },
}
ACTION_VARIABLES: dict[str, RowWithStop] = {
    **_PATH,
    **_AXES,
    **EXCHANGE_VARIABLES,
    **overlay.OVERLAY_VARIABLES,
    **fixed_stop.FIXED_STOP_VARIABLES,
    **fifo.FIFO_VARIABLES,
    **polynomials.POLYNOMIAL_VARIABLES,
}
#: Variables that no program writes: they hold for the cycle in which an action writes them.
OF_ACTIONS = frozenset({"$AC_OVR", "$AC_VC", "$AA_OVR", "$AA_OFF"})
#: Variables for which a program needs the clock.
TIMED_VARIABLES: dict[str, RowWithStop] = {timers.NAME: (Type.REAL, timers.read, timers.write, True)}
