"""Orientable toolholders: TCARR, TCOABS, TCOFR, what they do to lengths and table, and CUTMOD that follows them.

A holder is worked out anew with T, D, TCARR and a change between TCOABS and TCOFR; another frame alone changes nothing
(job planning 7.9). The table offset goes into `$P_PARTFRAME` as a shift, which PAROT turns (Function Manual W1).

Source: job planning 7.9 (TCARR), 7.11 (CUTMOD).
"""

from __future__ import annotations

from itertools import product

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.tools.holders.stored import Carrier, CarrierData
from polycnc.control.sinumerik.tools.lengths import direction_of
from polycnc.control.sinumerik.tools.selection import rules_of
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.angles import TURN_DEG
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, dot
from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.machine.model import Joint
from polycnc.messages import AlarmError
from polycnc.transformation.orientation.solutions import solutions_for

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector

    Positions = tuple[float, float]

#: Axis of the frame along which group 42 stands the tool; TCOABS takes the angles as they are.
ALONG = {"TCOFR": 2, "TCOFRZ": 2, "TCOFRY": 1, "TCOFRX": 0}
#: Bits of MD20110: the reset value of the holder acts, and the tool keeps its offsets.
SETS_AT_RESET, KEEPS_EDGE = 1, 1 << 6
#: CUTMOD: off, with any holder, with the one that is active.
OFF, ANY, ACTIVE = 0, -1, -2
#: A tool stands along a direction where their cosine is not farther from 1.
SAME_DIRECTION = 1e-9


@dataclass(slots=True)
class ActiveCarrier(State, lifetime=Lifetime.POWER):
    """The toolholder that is active.

    Attributes:
        number: TCARR, 0 for none.
        positions_deg: Of v1 and v2, as they count.
        rests_deg: What Hirth teeth left of the positions that were wanted.
        cut_mode: CUTMOD: a number, 0 or -1.
    """

    number: int = 0
    positions_deg: tuple[float, float] = (0.0, 0.0)
    rests_deg: tuple[float, float] = (0.0, 0.0)
    cut_mode: int = OFF

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset brings the holder of MD20126 back, unless the tool keeps its offsets; CUTMOD stays."""
        super().end(channel, lifetime)
        data = MachineData.of(channel)
        ends = data.integer("$MC_RESET_MODE_MASK") & (SETS_AT_RESET | KEEPS_EDGE) == SETS_AT_RESET
        if lifetime is Lifetime.RESET and self.number and ends:
            activate(channel, data.integer("$MC_TOOL_CARRIER_RESET_VALUE"))

    @property
    def cuts_turn(self) -> bool:
        """Whether CUTMOD acts with the holder that is active."""
        return bool(self.number) and self.cut_mode in (ANY, self.number)


def activate(channel: SinumerikChannel, number: int) -> None:
    """TCARR=m: another toolholder, 0 for none.

    Raises:
        AlarmError: 14150 for one that is not defined, PC0017 with FTOCON, and what `follow` finds.
    """
    state = ActiveCarrier.of(channel)
    if number:
        CarrierData.of(channel).find(number)
        if channel.mode["fine_tool_offset"] == "FTOCON":
            raise AlarmError("PC0017")
    if number and state.cut_mode > 0 and state.cut_mode != number:
        state.cut_mode = OFF
    state.number = number
    if number:
        follow(channel)
    else:
        release(channel)


def release(channel: SinumerikChannel) -> None:
    """No toolholder is active; the table offset goes with it."""
    tools, system = channel.memory.tools, channel.memory.frames.system
    state = ActiveCarrier.of(channel)
    state.number, state.positions_deg, state.rests_deg = 0, (0.0, 0.0), (0.0, 0.0)
    tools.carrier, tools.cut_turns = None, False
    system["$P_PARTFRAME"] = NEUTRAL


def follow(channel: SinumerikChannel) -> None:
    """The active toolholder is worked out anew; without one nothing happens.

    Raises:
        AlarmError: 14151 for positions beyond their limits, 14152 for a direction that cannot be reached, and what
            `Carrier.of` finds.
    """
    state, memory = ActiveCarrier.of(channel), channel.memory
    if not state.number:
        return
    carrier = carrier_of(channel, state.number)
    axis = ALONG.get(channel.mode["tool_carrier"])
    wanted = _from_axes(channel, carrier) if axis is None else _from_frame(channel, carrier, axis)
    first, second = (carrier.on_teeth(i, wanted[i]) for i in range(2))
    state.positions_deg = (first, second)
    state.rests_deg = (wanted[0] - first, wanted[1] - second)
    memory.tools.carrier = carrier.tool_turn(state.positions_deg) if memory.tools.edge is not None else None
    memory.tools.cut_turns = state.cuts_turn
    turn_table(channel)


def carrier_of(channel: SinumerikChannel, number: int) -> Carrier:
    """The kinematics of a toolholder as they are stored now."""
    return Carrier.of(CarrierData.of(channel).find(number), channel.memory.data, number)


def turn_table(channel: SinumerikChannel) -> None:
    """What the table of the active holder does to the work: a shift, with PAROT a turn."""
    state = ActiveCarrier.of(channel)
    table = carrier_of(channel, state.number).table_turn(state.positions_deg) if state.number else IDENTITY
    matrix = table.m if channel.mode["workpiece_frame"] == "PAROT" else IDENTITY.m
    channel.memory.frames.system["$P_PARTFRAME"] = NcFrame(matrix=matrix, coarse=table.t)


def modify_cuts(channel: SinumerikChannel, value: int) -> None:
    """CUTMOD: whether edge positions turn with the holder; values below -2 count as not programmed."""
    state = ActiveCarrier.of(channel)
    if value < ACTIVE:
        return
    state.cut_mode = state.number if value == ACTIVE else value
    channel.memory.tools.cut_turns = state.cuts_turn


# ---- positions of the axes -----------------------------------------------------------------------------------------


def _from_axes(channel: SinumerikChannel, carrier: Carrier) -> Positions:
    """TCOABS: positions of the rotary axes that the data name, else those that are stored."""
    memory, machine = channel.memory, channel.coordinates.machine
    found = list(carrier.stored_deg)
    for i, name in enumerate(carrier.axis_names):
        column = memory.columns.get(name)
        if column is not None and channel.axis_data[column].rotary:
            found[i] = machine[column]
        if carrier.axes[i] is not None and not carrier.reaches(i, carrier.on_teeth(i, found[i])):
            raise AlarmError("14151", number=i + 1)
    return (found[0], found[1])


def _from_frame(channel: SinumerikChannel, carrier: Carrier, axis: int) -> Positions:
    """TCOFR: positions that stand the tool along an axis of the active frame, near to those that are stored."""
    found = [solution for solution in _solutions(channel, carrier, axis) if _is_reached(carrier, solution)]
    if not found:
        raise AlarmError("14152")
    return min(found, key=lambda solution: _way(solution, carrier.stored_deg))


def _solutions(channel: SinumerikChannel, carrier: Carrier, axis: int) -> list[Positions]:
    """All positions that stand the tool along an axis of the frame, on all turns that come into question."""
    edge, plane = channel.memory.tools.edge, channel.mode["plane"]
    own = None if edge is None else direction_of(edge, channel.memory.tools.rules or rules_of(channel), plane)
    tool = own or axis_vector(PLANES[plane][2])
    wanted = _direction(channel, axis)
    chains = [
        tuple(
            Joint(str(i), True, "tool", direction, (0.0, 0.0, 0.0))
            for i in chain
            if (direction := carrier.axes[i]) is not None
        )
        for chain in carrier.chains
    ]
    if not any(chains):
        return [carrier.zeros_deg] if dot(wanted, tool) > 1.0 - SAME_DIRECTION else []
    near = {str(i): carrier.stored_deg[i] - carrier.zeros_deg[i] for i in range(2)}
    turned = solutions_for(Kinematics(chains[0], chains[1], tool), wanted, near)
    first, second = carrier.zeros_deg
    return [
        (first + angles.get("0", near["0"]) + a, second + angles.get("1", near["1"]) + b)
        for angles in turned
        for a, b in product((0.0, TURN_DEG, -TURN_DEG), repeat=2)
    ]


def _direction(channel: SinumerikChannel, axis: int) -> Vector:
    """Direction of an axis of the frame on the table as it stands unturned, length 1."""
    state = channel.memory.frames
    total = state.total().frame
    turned = state.system["$P_PARTFRAME"].frame.inverse().direct(*total.direct(*axis_vector(axis)))
    return unit(turned)


def _is_reached(carrier: Carrier, positions: Positions) -> bool:
    return all(
        carrier.axes[i] is None or carrier.reaches(i, carrier.on_teeth(i, positions[i])) for i in range(2)
    )


def _way(positions: Positions, near: Positions) -> float:
    return sum(abs(position - stored) for position, stored in zip(positions, near, strict=True))
