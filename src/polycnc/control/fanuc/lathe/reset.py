"""The lathe after RESET and after M02, M30: what 3402#6 CLR and its companions leave (II.2, II.5.1.3)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, end_of
from polycnc.control.fanuc.lathe.coordinates import limits, systems
from polycnc.control.fanuc.lathe.cycles.modal import CYCLES
from polycnc.control.fanuc.lathe.cycles.tapping import ClampState
from polycnc.control.fanuc.lathe.memory import TurningFrames
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.states import BalanceState
from polycnc.control.fanuc.lathe.tools import offsets
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState
from polycnc.control.word_address.coordinates.systems import ZeroState
from polycnc.control.word_address.cycles.drilling import CycleState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.word_address.transformations import cylinder, normal_line, polar_interpolation

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel

#: Groups that a reset never touches.
_KEPT = ("unit", "stroke")
#: Groups that the clear state keeps by a parameter.
_KEPT_BY = {
    LatheParameters.C01: "motion",
    LatheParameters.C02: "surface_speed",
    LatheParameters.C03: "distance",
    LatheParameters.C05: "feed",
    LatheParameters.C10: "cycle",
    LatheParameters.C11: "return",
    LatheParameters.C14: "wcs",
    LatheParameters.C15: "path",
    LatheParameters.C16: "plane",
}
#: Groups that every reset brings back.
_CLEARED = (
    "polar_interpolation", "cylinder", "normal_line", "shape", "macro", "calls", "data_input"
)  # fmt: skip


def reset(channel: LatheChannel) -> None:
    """Clear state (CLR = 1): power-on codes but for units, stroke check, groups of 3406 on; reset state: all stay."""
    memory, c = channel.memory, channel.coordinates
    parameters = memory.parameters
    clears = parameters.CLR
    polar_interpolation.leave_polar(channel)
    cylinder.end_cylinder(channel)
    normal_line.end(channel)
    machine = c.machine
    channel.path.clear()
    before = channel.mode.codes
    fresh = channel.control.start_codes(channel)
    codes = {**fresh, **{group: before[group] for group in _KEPT}} if clears else dict(before)
    codes.update({group: fresh[group] for group in _CLEARED if group in fresh})
    codes.pop("shape", None)
    if clears:
        codes |= {group: before[group] for bit, group in _KEPT_BY.items() if parameters.value(bit)}
    if codes["motion"] in CYCLES:
        codes["motion"] = "G1"
    system = ZeroState.of(channel).system if not clears or parameters.C14 else codes["wcs"]
    channel.mode = channel.modes.mode(codes)
    _end_states(channel, clears=clears)
    ZeroState.of(channel).system = system
    _cancel_offsets(channel, wear=parameters.LVC, geometry=parameters.TGC)
    systems.CodeState.of(channel).plane = codes["plane"]
    offsets.refresh(channel)
    c.set_programming(memory.frames.product(), memory.frames.shift)
    c.pending = [0.0] * len(channel.axes)
    c.owes = False
    c.arrive_machine(machine)
    limits.renew_zones(channel)
    channel.context_changed()


def _end_states(channel: LatheChannel, *, clears: bool) -> None:
    """What a reset ends; a drilling cycle that stays modal stays with its words, modal G54 to G59 with its system."""
    memory = channel.memory
    if BalanceState.of(channel).paths:
        # Balance cutting always ends (II.7.1), whatever becomes of other modal codes.
        channel.mode = channel.mode.with_code("turret_mirror", "G69")
    drills = channel.mode["cycle"] != "G80"
    kept = ((CycleState, ClampState) if drills else ()) + (() if clears else (ZeroState, TurningFrames))
    end_of(channel, Lifetime.RESET, (*kept, *memory.kept_at_reset))
    memory.forget_locals()
    # G41 or G42 that stays modal waits for the next offset number (II.5.4.1).
    radius = RadiusState.of(channel)
    radius.side = radius.engaged_side = {"G41": 1, "G42": -1}.get(channel.mode["compensation"], 0)
    if memory.parameters.RLC:
        ZeroState.of(channel).local = [0.0] * len(channel.axes)


def _cancel_offsets(channel: LatheChannel, *, wear: bool, geometry: bool) -> None:
    """5006#3 LVC ends movement and wear, 5003#7 TGC geometry that shifts."""
    memory, active = channel.memory, OffsetState.of(channel)
    if wear:
        memory.frames.offset = [0.0] * len(channel.axes)
        active.shift = list(active.geometry_shift)
        active.number = RadiusState.of(channel).number = 0
    if geometry and not memory.parameters.LGT:
        active.shift = [s - g for s, g in zip(active.shift, active.geometry_shift, strict=True)]
        active.geometry_shift = [0.0] * len(channel.axes)
