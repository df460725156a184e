"""Drilling cycles of FANUC machining centres (Hartford manual §3.3.3; FANUC macro B reference §11)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.word_address.auxiliary.functions import RigidTappingState
from polycnc.control.word_address.cycles.drilling import DrillCycle, Drilling, third_axis
from polycnc.cycles.drilling import holes

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.cycles.drilling import CycleData

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
#: The axes count as standing still within this, mm.
WINDOW_MM = 0.0005
#: Parameter with the retract or clearance of each pecking cycle, mm.
RELIEF_PARAMETERS = {"G73": 5114, "G83": 5115, "G74": 5213, "G84": 5213, "G84.2": 5213, "G84.3": 5213}


def drilling_axis(builder: Builder) -> int:
    """Z; the axis on the plane where 5101#0 says so."""
    if builder.channel.setup.parameters.bit(5101, 0):
        return third_axis(builder)
    return builder.channel.coordinates.geometry[2]


def relief(channel: Channel, code: str) -> float:
    """Retract or clearance between pecks, mm. A pecking tap goes back to R where 5200#5 says so."""
    parameters = channel.setup.parameters
    number = RELIEF_PARAMETERS.get(code)
    if number is None or (number == 5213 and parameters.bit(5200, 5)):
        return 0.0
    return parameters.number(number)


def shift_off_wall(channel: Channel, data: CycleData, plane: tuple[int, int]) -> tuple[float, float]:
    """I and J (Hartford manual); else Q in the direction of 5148 (signed axis number) or 5101#4, #5."""
    if "I" in data or "J" in data:
        return data.amount("I"), data.amount("J")
    amount = abs(data.amount("Q"))
    parameters = channel.setup.parameters
    towards = int(parameters.number(5148, channel.axes[data.axis]))
    if towards:
        second = channel.coordinates.geometry[plane[1]] == abs(towards) - 1
        amount = amount if towards > 0 else -amount
    else:
        second = bool(parameters.bit(5101, 5))
        amount = -amount if parameters.bit(5101, 4) else amount
    return (0.0, amount) if second else (amount, 0.0)


def check_rigid_tapping(channel: Channel, code: str) -> None:
    """Between M29 and its tapping cycle nothing may move and S may not change; the spindle needs a speed."""
    state = RigidTappingState.of(channel)
    armed = state.armed
    if code not in RIGID or armed is None:
        return
    state.armed = None
    c = channel.coordinates
    if any(abs(a - b) > WINDOW_MM for a, b in zip(c.machine, armed.machine, strict=True)):
        raise channel.control.fail("rigid_position", address=code)
    if armed.speed != channel.memory.spindle_speed:
        raise channel.control.fail("rigid_position", address=code)
    if not armed.speed > 0.0:
        raise channel.control.fail("rigid_speed", address=code)


MILLING_DRILLING = Drilling(
    CYCLES,
    kept="RQPIJ",
    repeats="KL",
    triggers="R",
    axis=drilling_axis,
    relief=relief,
    shift=shift_off_wall,
    check=check_rigid_tapping,
)
