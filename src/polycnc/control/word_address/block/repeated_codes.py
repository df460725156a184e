"""Codes that are in force already: when writing them once more changes nothing, so that their blocks stay plain.

Posts write `G17`, `G54`, `G40` again and again. Interpreter and scanner pass over those whose
condition here holds (`WordAddressControl.repeated_codes`, by code). A condition may rest on what blocks change that are
not plain, never on where the axes stand.
"""

from __future__ import annotations

from polycnc.control.word_address.coordinates.systems import ZeroState, work_frame, zero_offsets
from polycnc.control.word_address.states import CylinderState, LengthState, ModalCallState, TiltState
from polycnc.control.word_address.tools.radius import RadiusState, active_compensation
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.language.bulk import Condition

#: Parts that a parallel axis can play (1022).
_PARALLELS = (5, 6, 7)


def plane(channel: MacroChannel) -> bool:
    """G17 to G19: the plane has its basic axes, and there are no parallel ones that a word could name."""
    memory, control = channel.memory, channel.control
    return (
        channel.coordinates.geometry == tuple(memory.basic_geometry)
        and CylinderState.of(channel).active is None
        and not RadiusState.of(channel).side
        and not any(control.axis_role(channel, axis) in _PARALLELS for axis in range(len(channel.axes)))
    )


def work_offset(channel: WordAddressChannel) -> bool:
    """G54 to G59: the offsets in force are still those of the table."""
    state = ZeroState.of(channel)
    c = channel.coordinates
    unchanged = c.zero == work_frame(channel, c.offsets) and c.offsets == zero_offsets(channel)
    return c.direct and unchanged and bool(state.system == channel.mode["wcs"])


def compensation(channel: WordAddressChannel) -> bool:
    """G40: no compensation is to be led back from."""
    return active_compensation(channel) is None


def frame(channel: WordAddressChannel) -> bool:
    """G50, G69: nothing is scaled, rotated or tilted."""
    return channel.coordinates.direct and TiltState.of(channel).plane is None


def length(channel: WordAddressChannel) -> bool:
    """G49: no length is in force, and neither a shift nor an incremental word is owed any."""
    state = ZeroState.of(channel)
    c = channel.coordinates
    none = LengthState.of(channel).number == 0 and not any(state.length) and not c.owes
    unchanged = c.zero == work_frame(channel, c.offsets) and c.offsets == zero_offsets(channel)
    return c.direct and c.transformation is None and c.geometry[2] >= 0 and none and unchanged


def modal_call(channel: MacroChannel) -> bool:
    """G67: there is no modal call, and its end without one is allowed (6000#0)."""
    return not ModalCallState.of(channel).calls and channel.memory.parameters.G67


def stroke_limit(channel: WordAddressChannel) -> bool:
    """G23: no zone is forbidden."""
    return channel.boundary is None


#: Codes of machining centres.
MILLING: dict[str, Condition] = {
    **dict.fromkeys(("G17", "G18", "G19"), plane),
    **dict.fromkeys(("G54", "G55", "G56", "G57", "G58", "G59"), work_offset),
    "G40": compensation,
    "G49": length,
    "G50": frame,
    "G67": modal_call,
    "G69": frame,
    "G23": stroke_limit,
}
