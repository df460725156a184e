"""G05 and G05.1 of SYNTEC: high-precision modes (manual 2.9 to 2.11).

Both let the control bend the path within a tolerance: rows keep the points of the program, and the planner may round
what lies between them within the tolerance that the mode gives. The curve that G05 fits, and the filter of G05.1 Q1,
leave points too: where a program or Pr407 gives a tolerance, cuts are led beside their ends, within the same tolerance
(`channel/moves/fairing.py`). Q2 adds points, and Q5 only bounds speeds: their points stay.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec.coordinates.turns import leads_tip
from polycnc.control.syntec.motion.fitting import FittingStage
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.motion.path_modes import PathModeState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath.context import Fairing
from polycnc.toolpath.events import Deed
from polycnc.toolpath.modes import CornerMode

with loaded_when_called():
    from polycnc.control.word_address.motion import nurbs

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.deferred.typing import Self
    from polycnc.toolpath import Context

ON = 10_000
#: Smallest and largest tolerance of G05.1 Q5, in the program's unit.
TOLERANCES = (0.001, 1.0)
STOPPING_MODES = ("G61", "G63")
MAX_ROTARY = 2
FILTER = 1
FILTERS = (FILTER, 2)
INTELLIGENT = 5
#: Largest tolerance of G05.1 Q1 and Q2, in the program's unit; what is above counts as this.
LARGEST_FILTER = 1.0
#: Tolerance of corners where neither code nor parameter gives one, mm.
DEFAULT_MM = 0.01
#: How many ends before and behind one tell where the smooth path lies, and the longest cut that is led beside its end,
#: mm: the manual has no figures; those of SINUMERIK for COMPCAD.
REACH, LONGEST_MM = 16, 20.0
#: Pr3802: G05 is on from the start.
FITS_AT_START = 2


@dataclass(slots=True)
class SmoothingState(State, lifetime=Lifetime.RESET):
    """How far the path may be bent where blocks meet, mm; 0 where no mode does that. Arcs keep their shape.

    Attributes:
        tolerance: The distance.
        fits: By G05, under which G09 has no effect (2.10.3).
        turns: How far rotary axes that G05 names may leave their way, degrees, with their columns.
        leaves_points: Cuts are led beside their ends within the tolerance.
        filters: By G05.1 Q1 or Q2: of these the manual does not say that tip control suspends them, as it does of G05
            (2.11.3) and Q5 (2.9.2).
    """

    tolerance: float = 0.0
    fits: bool = False
    turns: tuple[tuple[int, float], ...] = ()
    leaves_points: bool = False
    filters: bool = False

    @classmethod
    def first(cls, channel: Channel) -> Self:
        """Pr3802 may switch G05 on without a code, Pr3986 tolerance control."""
        given = SyntecParameters.naming(channel.setup.parameters)
        if given.fits_at_start == FITS_AT_START and given.option_path_fitting:
            return cls(_fit_tolerance(given), fits=True, leaves_points=given.fit_tolerance > 0.0)
        return cls(_corner_tolerance(given) if given.tolerance_control == 1 else 0.0)


def _corner_tolerance(parameters: SyntecParameters) -> float:
    return parameters.corner_control * least_unit(parameters) or DEFAULT_MM


def _fit_tolerance(parameters: SyntecParameters) -> float:
    """Pr407, mm."""
    return parameters.fit_tolerance / 1000.0 or DEFAULT_MM


def smoothed(channel: SyntecChannel, context: Context) -> Context:
    """A context under G05 or G05.1: corners are rounded within the tolerance, but under G61 and G63.

    Under tip control the filters act alone, on the tip: they name no tolerance for the axes that turn the tool.
    """
    state = SmoothingState.of(channel)
    tolerance = state.tolerance
    if not tolerance or channel.mode["path"] in STOPPING_MODES or (leads_tip(channel) and not state.filters):
        return context
    if context.corner_mode is not CornerMode.CONTINUOUS and not state.fits:
        return context
    return replace(
        context,
        corner_mode=CornerMode.ROUNDED,
        tolerance_mm=tolerance,
        # At corners two rotary axes have one tolerance here, the smaller one: it keeps both.
        turn_tolerance_deg=min((degrees for _, degrees in state.turns), default=0.0),
        fairing=Fairing(tolerance, REACH, LONGEST_MM, state.turns) if state.leaves_points else None,
    )


def smooth_path(channel: SyntecChannel, words: Words) -> None:
    """G05.1 Q1 E, Q2 E: filter or insert points; Q5 R E: tolerance of arcs and corners; Q0: off."""
    kind = words.typed("Q")
    if kind not in (0, *FILTERS, INTELLIGENT):
        raise words.fail("smoothing_format", "Q" if kind is not None else "G5.1")
    error = words.typed("E")
    if kind in FILTERS:
        if error is None or error <= 0.0:
            raise words.fail("smoothing_format", "E" if error is not None else "G5.1")
        if channel.mode["path"] in STOPPING_MODES:
            raise words.fail("smoothing_stops", "G5.1")
    if kind == INTELLIGENT:
        low, high = TOLERANCES
        for address in ("R", "E"):
            value = words.typed(address)
            if value is not None and not low <= value <= high:
                raise words.fail("smoothing_format", address)
    unit = INCH_MM if words.plan.inch else 1.0
    if kind == 0 or (kind in FILTERS and channel.memory.parameters.uvw_increments == 1):
        tolerance = 0.0
    elif error is None:
        tolerance = _corner_tolerance(channel.memory.parameters)
    else:
        tolerance = min(error, LARGEST_FILTER) * unit
    _switch(channel, tolerance, "G5.1", leaves_points=kind == FILTER, filters=kind in FILTERS)
    _put_stages(channel, ())


def begin(channel: SyntecChannel) -> None:
    """A program begins: what parameters have switched on acts."""
    state = SmoothingState.of(channel)
    if state.fits:
        if _cannot_fit(channel):
            state.tolerance = 0.0
        _put_stages(channel, [axis for axis in channel.coordinates.geometry if axis >= 0])


def leave(channel: SyntecChannel) -> None:
    """Nothing holds cuts back any more, or chooses between blocks that are fitted and others (also at reset)."""
    channel.path.take(FittingStage)
    if SmoothingState.of(channel).leaves_points:
        from polycnc.control.syntec.motion.smoother import Smoother  # where one is on

        channel.path.take(Smoother)


def _put_stages(channel: SyntecChannel, geometry: Sequence[int], rotary: Sequence[int] = ()) -> None:
    """Put into the path what the state asks for; these axes are fitted."""
    state = SmoothingState.of(channel)
    if state.tolerance == 0.0:
        return
    if state.leaves_points:
        from polycnc.control.syntec.motion.smoother import Smoother  # where one is on

        channel.path.put(Smoother(channel))
    if state.fits and len(geometry) + len(rotary) < len(channel.axes):
        channel.path.put(FittingStage(channel, geometry, rotary))


def _switch(
    channel: SyntecChannel,
    tolerance: float,
    code: str,
    *,
    fits: bool = False,
    turns: tuple[tuple[int, float], ...] = (),
    leaves_points: bool,
    filters: bool = False,
) -> None:
    """Another tolerance holds from here on; the axes come to rest in between."""
    state = SmoothingState.of(channel)
    channel.flush()
    leave(channel)
    state.tolerance, state.fits, state.turns = tolerance, fits, turns
    state.leaves_points, state.filters = leaves_points and tolerance > 0.0, filters
    PathModeState.of(channel).contour_control = tolerance > 0.0
    channel.event(Deed(code, None, None, is_silent=False))  # the planner knows the tolerance from the rows
    channel.context_changed()


def high_precision(channel: SyntecChannel, words: Words) -> None:
    """G05 P10000 [E] [axes], G05 E: curve fitting on; G05 P0, G05: off."""
    if not channel.memory.parameters.option_path_fitting:
        raise words.fail("option", "G5")
    nurbs.check_complete(channel)
    switch = words.typed("P")
    error = words.typed("E")
    if switch is None:
        switch = 0 if error is None else ON
    if switch not in (0, ON) or (error is not None and error <= 0.0):
        raise words.fail("smoothing_format", "P" if switch not in (0, ON) else "E")
    geometry, rotary = _axes(channel, words)
    if switch == ON and leads_tip(channel):
        raise words.fail("tip_smoothing", "G5")
    if switch == ON and channel.mode["path"] in STOPPING_MODES:
        raise words.fail("smoothing_stops", "G5")
    tolerance = 0.0
    if switch == ON and error is not None:
        tolerance = error * (INCH_MM if words.plan.inch else 1.0)
    elif switch == ON:
        tolerance = _fit_tolerance(channel.memory.parameters)
    if _cannot_fit(channel):
        tolerance = 0.0
    given = error is not None or channel.memory.parameters.fit_tolerance > 0.0
    _switch(channel, tolerance, "G5", fits=True, turns=tuple(rotary.items()), leaves_points=given)
    _put_stages(channel, geometry, tuple(rotary))


def _cannot_fit(channel: SyntecChannel) -> bool:
    """Whether U, V, W are increments, or an axis of the geometry is a diameter: G05 has no effect then (2.10.3)."""
    axes = (axis for axis in channel.coordinates.geometry if axis >= 0)
    return channel.memory.parameters.uvw_increments == 1 or any(map(channel.memory.is_diameter, axes))


def _axes(channel: SyntecChannel, words: Words) -> tuple[list[int], dict[int, float]]:
    """Columns that G05 fits: geometry axes named with 0, all where it names none; rotary ones with their tolerance."""
    geometry: list[int] = []
    rotary: dict[int, float] = {}
    for axis, value, _ in words.axes():
        if axis in channel.coordinates.geometry:
            geometry.append(axis)
            wrong = value != 0.0
        else:
            rotary[axis] = value
            wrong = value <= 0.0 or not channel.axis_data[axis].rotary
        if wrong:
            raise words.fail("smoothing_format", channel.axes[axis])
    if len(rotary) > MAX_ROTARY or (rotary and not geometry):
        raise words.fail("smoothing_format", "G5")
    return geometry or [axis for axis in channel.coordinates.geometry if axis >= 0], rotary
