"""CTABDEF … CTABEND: blocks that define a curve table and move nothing (job planning 9.2.1).

The whole language may be used, but for what would need the axes (10942: preprocessing stops). Behind CTABEND modal
functions, frames, positions and R parameters are as before CTABDEF.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.curve_tables.curve import ONCE, PERIODIC_IN_BOTH, CurveTable
from polycnc.control.sinumerik.curve_tables.memory import CurveTables, memory_named
from polycnc.control.sinumerik.motion.contour_reading import ContourReading, reading_from_here
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.curve_tables.recorder import CurveRecorder

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row


#: Before a table is read its axes are thought this far away: whole turns, and so little beside them that the first
#: block always is a move.
_TURNS = 2778 * 360.0
_AWAY = _TURNS + 2.0**-13


@dataclass(slots=True, eq=False)
class Definition:
    """A table that is being defined.

    Attributes:
        number: Its number.
        period: Its periodicity.
        memory: Where it shall lie.
        turning: Whether its leading and following axis are rotary.
        level: How many program levels were there at CTABDEF.
        contour: The blocks, and what is put back behind them.
        recorder: Catches their moves.
        r_parameters: R parameters before it.
    """

    number: int
    period: int
    memory: str
    turning: tuple[bool, bool]
    level: int
    contour: ContourReading
    recorder: CurveRecorder
    r_parameters: list[float]


@dataclass(slots=True)
class CurveDefinition(State, lifetime=Lifetime.RESET):
    """The table that a channel defines now; None for none."""

    open: Definition | None = None


def begin(channel: SinumerikChannel, args: Arguments) -> None:
    """CTABDEF(following,leading,n,periodicity[,memory]): the blocks of a table follow.

    Raises:
        AlarmError: 10940 for a table that is locked or in use, 10942 within a definition, 10945 for the same axis
            twice.
    """
    if not 4 <= len(args) <= 5 or None in args[:4]:
        raise AlarmError("14020", text="CTABDEF")
    following, leading = (arguments.column(channel, axis) for axis in args[:2])
    number, period = (arguments.whole(value) for value in args[2:4])
    memory = memory_named(channel, args[4] if len(args) > 4 else None)
    state = CurveDefinition.of(channel)
    if state.open is not None:
        raise AlarmError("10942", number=number, text="CTABDEF")
    if number < 1 or not ONCE <= period <= PERIODIC_IN_BOTH:
        raise AlarmError("14020", text=f"CTABDEF({number},{period})")
    if following == leading:
        raise AlarmError("10945", number=number, axis=channel.axes[leading])
    CurveTables.of(channel).check_free(number)
    contour = reading_from_here(channel, keeps_modes=True)
    recorder = CurveRecorder(channel, leading, following, number, _known(channel, contour.position.copy()))
    contour.recorder = recorder
    axes = channel.memory.axes
    state.open = Definition(
        number, period, memory, (axes[leading].rotary, axes[following].rotary), len(channel.stack), contour,
        recorder, channel.memory.language.r.copy(),
    )  # fmt: skip
    contour.begin(channel, {leading, following}, _AWAY)


def _known(channel: SinumerikChannel, start: list[float]) -> Callable[[list[float]], list[float]]:
    """From positions of the definition to true ones: axes that it has not named yet are where they stand."""
    modulo = [axis.rotary and axis.modulo for axis in channel.memory.axes]

    def true(position: list[float]) -> list[float]:
        point = position.copy()
        for column, (value, place) in enumerate(zip(position, start, strict=True)):
            if value == place + _AWAY:
                point[column] = place
            elif abs(value) > _AWAY / 2.0:
                point[column] = value - (_TURNS if modulo[column] else _AWAY)
        return point

    return true


def end(channel: SinumerikChannel, _args: Arguments) -> None:
    """CTABEND: the table is there, everything else is as before CTABDEF.

    Raises:
        AlarmError: 10942 without CTABDEF on the same program level, 10946 for a table without segments.
    """
    definition = CurveDefinition.of(channel).open
    if definition is None:
        raise AlarmError("10942", number="", text="CTABEND")
    is_same_level = len(channel.stack) == definition.level
    _leave(channel, definition)
    if not is_same_level:
        raise AlarmError("10942", number=definition.number, text="CTABEND")
    segments = definition.recorder.segments()
    if not any(not segment.is_jump for segment in segments):
        raise AlarmError("10946", number=definition.number)
    table = CurveTable(definition.number, definition.period, segments, definition.turning)
    CurveTables.of(channel).put(channel, table, definition.memory)


def _leave(channel: SinumerikChannel, definition: Definition) -> None:
    """A definition ends: everything is as before it."""
    CurveDefinition.of(channel).open = None
    definition.contour.end(channel)
    channel.memory.language.r[:] = definition.r_parameters


def check_end(channel: SinumerikChannel) -> None:
    """10942: the program ends while a table is being defined."""
    definition = CurveDefinition.of(channel).open
    if definition is not None:
        _leave(channel, definition)
        raise AlarmError("10942", number=definition.number, text="M30")


def refuse(channel: SinumerikChannel, what: str) -> None:
    """10942 for what no definition may hold: preprocessing stops, waits for axes, couplings."""
    definition = CurveDefinition.of(channel).open
    if definition is not None:
        raise AlarmError("10942", number=definition.number, text=what)


def _is_defining(channel: SinumerikChannel, _indices: Indices) -> bool:
    return CurveDefinition.of(channel).open is not None


PROCEDURES = {"CTABDEF": begin, "CTABEND": end}
DEFINITION_VARIABLES: dict[str, Row] = {"$P_CTABDEF": (Type.BOOL, _is_defining, None)}
