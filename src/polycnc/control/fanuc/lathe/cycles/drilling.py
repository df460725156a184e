"""Drilling cycles of the lathe: face and side, Series 15 format, clamping of C (0i-TF Plus II.4.3, 4.5, 6.5)."""

from __future__ import annotations

from functools import cache, partial

from polycnc.control.fanuc.lathe.coordinates.systems import without_rotation
from polycnc.control.fanuc.lathe.cycles import speed_arrival, tapping
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.word_address.auxiliary.overrides import OverrideState
from polycnc.control.word_address.block.codes import MCode
from polycnc.control.word_address.cycles import drilling as base
from polycnc.control.word_address.cycles.drilling import CycleState, DrillCycle, Drilling
from polycnc.control.word_address.cycles.hole_halts import Halts
from polycnc.cycles.drilling import holes, lathe
from polycnc.cycles.drilling.lathe import Joint
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.toolpath.context import OVERLAPS, STROKE
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.mode import Mode
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.cycles.drilling.holes import Cycle, Hole, Stroke
    from polycnc.toolpath import Context

#: K, or L in the Series 15 format, is a whole number up to this one (II.4.3).
MOST_REPEATS = 9999
BORE = partial(holes.bore, out=2.0)
#: Cycles with their axis: the face is drilled along Z, the side along X (II.4.3).
NORMAL_CYCLES = ("G83", "G83.5", "G83.6", "G84", "G85", "G87", "G87.5", "G87.6", "G88", "G89")
#: Series 15 format (II.6.5).
SERIES_15_CYCLES = ("G81", "G82", "G83", "G83.1", "G84", "G84.2", "G85", "G89")
_RELIEF = {
    "G83.1": LatheParameters.peck_retract,
    "G83.5": LatheParameters.peck_retract,
    "G87.5": LatheParameters.peck_retract,
    "G83.6": LatheParameters.peck_clearance,
    "G87.6": LatheParameters.peck_clearance,
    "G84": LatheParameters.tap_peck_retract,
    "G88": LatheParameters.tap_peck_retract,
    "G84.2": LatheParameters.tap_peck_retract,
}

#: The bit of 1681 that keeps the strokes at a joint apart.
_APART = {
    Joint.HOLE: LatheParameters.DPS,
    Joint.R_LEVEL: LatheParameters.DRL,
    Joint.RETRACT: LatheParameters.DRV,
    Joint.REENTRY: LatheParameters.DFW,
    Joint.PECK: LatheParameters.DQL,
    Joint.BOTTOM: LatheParameters.DZL,
}


def is_series_15(channel: LatheChannel) -> bool:
    """Whether programs are in the Series 15 format (0001#1 FCV)."""
    return channel.memory.parameters.FCV


def drills_in_series_15(channel: LatheChannel) -> bool:
    """Whether drilling is in that format too. 5102#3 F16: drilling stays in the normal format, with repeats by L."""
    return is_series_15(channel) and not channel.memory.parameters.F16


@dataclass(frozen=True, slots=True)
class _Choice:
    """What parameters choose among the drilling cycles."""

    series_15: bool
    repeats_by_l: bool
    clears_chips: bool
    taps_clear: bool
    absolute_r: bool
    diameter_r: bool


def rules(channel: LatheChannel) -> Drilling:
    """The drilling cycles by the channel's parameters."""
    parameters = channel.memory.parameters
    series_15 = drills_in_series_15(channel)
    return _rules(
        _Choice(
            series_15,
            repeats_by_l=is_series_15(channel),
            clears_chips=parameters.RTR,
            taps_clear=parameters.PCP,
            absolute_r=series_15 and parameters.RAB,
            diameter_r=series_15 and parameters.RDI,
        )
    )


@cache
def _rules(choice: _Choice) -> Drilling:
    common = Drilling(
        {},
        r_is_increment=not choice.absolute_r,
        r_as_axis=choice.diameter_r,
        by_r=True,
        repeats="L" if choice.repeats_by_l else "K",
        most_repeats=MOST_REPEATS,
        triggers="R",
        least_increments="Q",
        axis=_axis,
        relief=_relief,
        largest_override=tapping.largest_override,
        check=tapping.ask_for_gear,
        turn=_turn,
        dress=_dress,
        halts=_halts,
        overlaps=_overlaps_hole,
    )
    peck: Cycle = holes.peck_clearing_chips if choice.clears_chips else holes.peck_breaking_chips
    tap: Cycle = lathe.tap_clearing_chips if choice.taps_clear else lathe.tap
    if choice.series_15:
        cycles = {
            "G81": DrillCycle(holes.drill),
            "G82": DrillCycle(holes.drill, dwells=True),
            "G83": DrillCycle(holes.peck_clearing_chips, pecks=True, dwells=True, once="P"),
            "G83.1": DrillCycle(holes.peck_breaking_chips, pecks=True, dwells=True, once="P"),
            "G84": DrillCycle(tap, dwells=True, once="P"),
            "G84.2": DrillCycle(tap, dwells=True, pecks=True, once="P"),
            "G85": DrillCycle(BORE),
            "G89": DrillCycle(BORE, dwells=True),
        }
        return replace(common, cycles=cycles, kept=("R", "P", "Q", ",D", "J"))
    face = {
        "G83": DrillCycle(peck, dwells=True, pecks=True, axis="Z"),
        "G83.5": DrillCycle(holes.peck_breaking_chips, dwells=True, pecks=True, axis="Z"),
        "G83.6": DrillCycle(holes.peck_clearing_chips, dwells=True, pecks=True, axis="Z"),
        "G85": DrillCycle(BORE, dwells=True, axis="Z"),
    }
    side = {"G87": "G83", "G87.5": "G83.5", "G87.6": "G83.6", "G89": "G85"}
    taps = dict.fromkeys(("G84", "G88"), DrillCycle(tap, dwells=True, pecks=True))
    cycles = {**face, **{code: replace(face[like], axis="X") for code, like in side.items()}, **taps}
    pecks = ("G83", "G83.5", "G83.6", "G87", "G87.5", "G87.6")
    cycles.update({code: replace(cycles[code], once="Q") for code in pecks})
    return replace(common, cycles=cycles, kept=("R", "P", "Q", ",D", "J"))


def _axis(builder: Builder) -> int:
    """The axis of the block's cycle where its row names none."""
    return _free_axis(builder.channel, builder.mode, is_rigid=tapping.taps_rigidly(builder))


def _free_axis(channel: LatheChannel, mode: Mode, *, is_rigid: bool) -> int:
    """Taps: Z (G84) or X (G88); rigid ones by 5209#0 RTX the plane's first or second axis (II.4.3, 4.5.1).

    Series 15: Z, or the axis on the plane by 5101#0 FXY.
    """
    plane, geometry = PLANES[mode["plane"]], channel.coordinates.geometry
    if drills_in_series_15(channel):
        return geometry[plane[2] if channel.memory.parameters.FXY else 2]
    is_face = mode["cycle"] == "G84"
    if channel.memory.parameters.RTX or not is_rigid:
        return geometry[2 if is_face else 0]
    return geometry[plane[0 if is_face else 1]]


def _drilling_axis(builder: Builder, mode: Mode) -> int:
    """The axis along which the cycle of a modal state drills; -1 without a cycle."""
    cycle = rules(builder.channel).cycles.get(mode["cycle"])
    if cycle is None:
        return -1
    if cycle.axis:
        return builder.channel.axis_index[cycle.axis]
    return _free_axis(builder.channel, mode, is_rigid=tapping.taps_rigidly(builder))


def _relief(channel: LatheChannel, code: str) -> float:
    """Retract or clearance between pecks: `,D`, else the cycle's parameter, mm."""
    data = CycleState.of(channel).active
    if ",D" in data:
        return data.amount(",D")
    parameters = channel.memory.parameters
    chosen = _RELIEF.get(code)
    if chosen is not None:
        return parameters.value(chosen)
    clears = parameters.RTR or drills_in_series_15(channel)
    return parameters.peck_clearance if clears else parameters.peck_retract


def plan(builder: Builder, plan: Plan) -> Step:
    """A block while a drilling cycle is active."""
    tapping.check_block(
        builder, _drilling_axis(builder, builder.before), _drilling_axis(builder, builder.mode)
    )
    _check_plane(builder)
    return _along_parallel(builder, plan) or base.plan_drilling(builder, plan)


def _check_plane(builder: Builder) -> None:
    """A plane code while a cycle is active: both axes of the plane exist, or 5103#3 PNA lets it pass (II.6.5)."""
    channel = builder.channel
    if not drills_in_series_15(channel) or channel.memory.parameters.PNA:
        return
    if not any(row.group == "plane" for row in builder.codes):
        return
    geometry = channel.coordinates.geometry
    if any(geometry[i] < 0 for i in PLANES[builder.mode["plane"]][:2]):
        raise builder.control.fail("plane", address=builder.mode["plane"])


def _along_parallel(builder: Builder, plan: Plan) -> Step | None:
    """Series 15 with 5101#0 FXY: a parallel axis (1022) named in the cycle's block drills in place of the basic one."""
    channel = builder.channel
    if not (drills_in_series_15(channel) and channel.memory.parameters.FXY):
        return None
    third = PLANES[builder.mode["plane"]][2]
    if not any(row.group == "cycle" for row in builder.codes):
        return None
    axis = next(
        (w.axis for w in plan.axis_words if channel.control.axis_role(channel, w.axis) == third + 5), -1
    )
    if axis < 0:
        return None

    def choose(channel: LatheChannel) -> None:
        geometry = list(channel.coordinates.geometry)
        geometry[third] = axis
        channel.coordinates.geometry = (geometry[0], geometry[1], geometry[2])

    choose(channel)
    drill = base.plan_drilling(builder, plan)

    def run(channel: LatheChannel, values: list[float]) -> None:
        choose(channel)
        drill(channel, values)

    return run


# ---- spindle ---------------------------------------------------------------------------------------------------


def _turn(channel: LatheChannel, direction: int) -> None:
    """A reversal goes to the machine as M03 or M04, by 5105#3 M5T with M05 in front; rigid tapping sends none."""
    memory = channel.memory
    base.turn_spindle(channel, direction)
    if tapping.is_rigid(channel):
        return
    if memory.parameters.M5T:
        channel.event(Auxiliary(5))
    if direction:
        channel.event(Auxiliary(3 if direction > 0 else 4))


# ---- what the machine adds ---------------------------------------------------------------------------------------


def _dress(channel: LatheChannel, code: str, cycle: Cycle) -> Cycle:
    """Clamping of the C axis about the hole, and the speed of a rigid tap on its way out."""
    taps = code in tapping.TAPS
    if taps:
        tapping.check(channel, CycleState.of(channel).active)

    def dressed(hole: Hole) -> Iterator[Stroke]:
        strokes = speed_arrival.waiting(channel, code, cycle(hole))
        if taps:
            strokes = lathe.with_extraction(strokes, hole, tapping.extraction(channel))
        else:
            strokes = lathe.overlapping(strokes, hole, _apart(channel))
        if channel.memory.parameters.SAC:
            strokes = lathe.leading_on(strokes, hole)
        clamp = tapping.ClampState.of(channel).code
        if clamp:
            seconds = channel.memory.parameters.unclamp_dwell / 1000.0
            strokes = lathe.clamped(strokes, clamp, _unclamp(channel, clamp), seconds)
        return strokes

    return dressed


def _apart(channel: LatheChannel) -> frozenset[Joint]:
    """Joints of strokes at which the axes come to rest (1681#0 to #5; II.4.4, 6.6)."""
    parameters = channel.memory.parameters
    return frozenset(joint for joint, bit in _APART.items() if parameters.value(bit))


def _overlaps_hole(channel: LatheChannel, code: str) -> float | None:
    """How the way over a hole and the one to R overlap; to a hole that is tapped only SAC lets the way begin early."""
    if code in tapping.TAPS:
        return STROKE if channel.memory.parameters.SAC else None
    return STROKE if Joint.HOLE in _apart(channel) else OVERLAPS


def _halts(channel: LatheChannel, code: str) -> Halts:
    """Single block halts over the hole, on R and at the end; in rigid tapping by 5200#6 FHD behind every action."""
    rigid = code in tapping.TAPS and tapping.is_rigid(channel)
    return Halts.ALL if rigid and channel.memory.parameters.FHD else Halts.APPROACH


def is_clamp(channel: LatheChannel, number: int) -> bool:
    """Whether an M code clamps the C axis in a drilling block (5110; with 5161#4 also 13544)."""
    parameters = channel.memory.parameters
    if drills_in_series_15(channel) or not number:
        return False
    codes = [parameters.clamp_code]
    if parameters.second_clamp_pair:
        codes.append(parameters.second_clamp_code)
    return number in codes


def _unclamp(channel: LatheChannel, clamp: int) -> int:
    parameters = channel.memory.parameters
    if not parameters.second_clamp_pair:
        return clamp + 1
    return parameters.unclamp_code if clamp == parameters.clamp_code else parameters.second_unclamp_code


def clamp_row(builder: Builder, number: int) -> MCode | None:
    """The clamp code of a drilling block: it belongs to the cycle and holds until that ends."""
    if builder.mode["cycle"] == "G80" or not is_clamp(builder.channel, number):
        return None

    def note(channel: LatheChannel, _words: Words) -> None:
        tapping.ClampState.of(channel).code = number

    return MCode(number, handler=note, silent=True)


def in_cycle(channel: LatheChannel, context: Context) -> Context:
    """A context with what taps keep from the operator, and with where strokes overlap."""
    tapping, overlap = OverrideState.of(channel).tapping, CycleState.of(channel).overlap
    if tapping or overlap != context.overlap:
        return replace(context, feed_hold=context.feed_hold and not tapping, overlap=overlap)
    return context


def _plan_axis_words(builder: Builder, plan_: Plan) -> Step | None:
    if builder.mode["cycle"] != "G80":
        return without_rotation(plan(builder, plan_))
    base.give_way(builder)
    return None


#: While a cycle is active the axis words of a block are a hole, and coordinate rotation has no effect.
RULE = replace(base.RULE, motion=_plan_axis_words)
