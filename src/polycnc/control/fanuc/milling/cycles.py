"""Drilling cycles of FANUC machining centres (Hartford manual §3.3.3; FANUC macro B reference §11)."""

from __future__ import annotations

from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.auxiliary.functions import RigidTappingState
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.cycles.drilling import (
    CycleState,
    DrillCycle,
    Drilling,
    rapid_over,
    third_axis,
    turn_by_m_code,
    turn_spindle,
)
from polycnc.control.word_address.cycles.shift import shift_by_i_and_j
from polycnc.cycles.drilling import holes
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.word_address.transformations import workpiece
    from polycnc.cycles.drilling import lathe

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.auxiliary.functions import RigidTapping
    from polycnc.control.word_address.block.plan import AxisWord, Builder
    from polycnc.control.word_address.cycles.drilling import CycleData
    from polycnc.control.word_address.family import MillingChannel
    from polycnc.cycles.drilling.holes import Cycle

CYCLES = {
    "G73": DrillCycle(holes.peck_breaking_chips, pecks=True, needs="Q"),
    "G74": DrillCycle(holes.tap, dwells=True, pecks=True),
    "G76": DrillCycle(holes.bore_and_shift, dwells=True),
    "G81": DrillCycle(holes.drill),
    "G82": DrillCycle(holes.drill, dwells=True),
    "G83": DrillCycle(holes.peck_clearing_chips, pecks=True, needs="Q"),
    "G84": DrillCycle(holes.tap, dwells=True, pecks=True),
    "G84.2": DrillCycle(holes.tap, dwells=True, pecks=True),
    "G84.3": DrillCycle(holes.tap, dwells=True, pecks=True),
    "G85": DrillCycle(holes.bore),
    "G86": DrillCycle(holes.bore_and_stop),
    "G87": DrillCycle(holes.bore_back, dwells=True),
    "G88": DrillCycle(holes.bore_and_halt, dwells=True),
    "G89": DrillCycle(holes.bore, dwells=True),
}
#: Tapping cycles that M29 makes rigid.
RIGID = frozenset({"G74", "G84"})
TAPS = RIGID | {"G84.2", "G84.3"}
#: The axes count as standing still within this, mm.
WINDOW_MM = 0.0005
#: Retract or clearance of each pecking cycle, mm.
RELIEF = {"G73": FanucMillingParameters.peck_retract, "G83": FanucMillingParameters.peck_clearance}


def drilling_axis(builder: Builder) -> int:
    """Z; the axis on the plane where 5101#0 FXY says so."""
    if FanucMillingParameters.naming(builder.channel.setup.parameters).FXY:
        return third_axis(builder)
    return builder.channel.coordinates.geometry[2]


def relief(channel: Channel, code: str) -> float:
    """Retract or clearance between pecks, mm."""
    parameters = FanucMillingParameters.naming(channel.setup.parameters)
    if code in RELIEF:
        return parameters.value(RELIEF[code])
    return parameters.tap_peck_retract if code in TAPS else 0.0


def shift_off_wall(channel: Channel, data: CycleData, plane: tuple[int, int]) -> tuple[float, float]:
    """I and J (Hartford manual); else Q in the direction of 5148 (signed axis number) or 5101#4 RD1, #5 RD2."""
    if "I" in data or "J" in data:
        return shift_by_i_and_j(channel, data, plane)
    amount = abs(data.amount("Q"))
    parameters = FanucMillingParameters.naming(channel.setup.parameters)
    towards = parameters.of(channel.axes[data.axis]).shift_direction
    if towards:
        second = channel.coordinates.geometry[plane[1]] == abs(towards) - 1
        amount = amount if towards > 0 else -amount
    else:
        second = parameters.RD2
        amount = -amount if parameters.RD1 else amount
    return (0.0, amount) if second else (amount, 0.0)


def check_rigid_tapping(channel: Channel, code: str) -> None:
    """Between M29 and its tapping cycle nothing may move and S may not change; the spindle needs a speed, not G96."""
    state, data = RigidTappingState.of(channel), CycleState.of(channel).active
    armed = state.armed
    if code in RIGID and armed is not None:
        state.armed = None
        data.rigid = True
        _check_wait(channel, code, armed)
    if code in TAPS - RIGID:
        data.rigid = True
    is_tap = data.rigid and code in TAPS
    if is_tap and (channel.mode["surface_speed"] == "G96" or not channel.memory.spindle.speed > 0.0):
        raise channel.control.fail("rigid_speed", address=code)


def _check_wait(channel: Channel, code: str, armed: RigidTapping) -> None:
    c = channel.coordinates
    if any(abs(a - b) > WINDOW_MM for a, b in zip(c.machine, armed.machine, strict=True)):
        raise channel.control.fail("rigid_position", address=code)
    if armed.speed != channel.memory.spindle.speed:
        raise channel.control.fail("rigid_position", address=code)


def check_tapping(channel: Channel, code: str) -> None:
    """The conditions of a rigid tap, which every tap is by 5200#0 G84."""
    if code in RIGID and FanucMillingParameters.naming(channel.setup.parameters).G84:
        CycleState.of(channel).active.rigid = True
    check_rigid_tapping(channel, code)


def _taps_rigidly(channel: Channel) -> bool:
    return CycleState.of(channel).active.rigid and channel.mode["cycle"] in TAPS


def in_step(channel: Channel, _code: str, cycle: Cycle) -> Cycle:
    """Pecks of a rigid tap break chips, or clear them by 5200#5 PCP; it dwells at its bottom (0i-TF Plus II.4.5.2)."""
    if not _taps_rigidly(channel):
        return cycle
    clears = FanucMillingParameters.naming(channel.setup.parameters).PCP
    return lathe.tap_clearing_chips if clears else lathe.tap


def turn(channel: Channel, direction: int) -> None:
    """A rigid tap leads the spindle without M codes."""
    (turn_spindle if _taps_rigidly(channel) else turn_by_m_code)(channel, direction)


def go_over_hole(channel: MillingChannel, words: Sequence[AxisWord], end: list[float]) -> None:
    """Rapid over a hole; where axes of the table turn on the way, as the work zero lies when they have."""
    (workpiece.go_over_hole if OnTable.of(channel).acts else rapid_over)(channel, words, end)


MILLING_DRILLING = Drilling(
    CYCLES,
    kept="RQPIJ",
    repeats="KL",
    most_repeats=9999,
    triggers="R",
    axis=drilling_axis,
    relief=relief,
    shift=shift_off_wall,
    check=check_tapping,
    dress=in_step,
    turn=turn,
    over=go_over_hole,
)
