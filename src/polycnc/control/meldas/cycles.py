"""Drilling cycles of MELDAS: FANUC's, with amounts from its own parameters and F of a tap as its pitch."""

from __future__ import annotations

from polycnc.control.fanuc.milling.cycles import CYCLES, MILLING_DRILLING, check_rigid_tapping
from polycnc.control.meldas.parameters import MeldasParameters
from polycnc.control.word_address.cycles.drilling import CycleState, third_axis
from polycnc.control.word_address.cycles.shift import shift_by_i_and_j
from polycnc.control.word_address.motion.path import FEED_MODES
from polycnc.control.word_address.tools.radius import active_compensation
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.cycles.drilling import CycleData

#: Retract or clearance of each pecking cycle, mm (G73 n, G83 n).
RELIEF = {"G73": MeldasParameters.peck_retract, "G83": MeldasParameters.peck_clearance}
#: Whether a tap is cut in step with its spindle.
SYNCHRONOUS = ",R"
#: Tapping cycles that FANUC has and MELDAS has not.
_FOREIGN = ("G84.2", "G84.3")


def drilling_axis(builder: Builder) -> int:
    """The axis that stands on the plane; Z where #1080 Dril_Z says so (M700 programming manual, fixed cycles)."""
    if MeldasParameters.naming(builder.channel.setup.parameters).drills_along_z:
        return builder.channel.coordinates.geometry[2]
    return third_axis(builder)


def relief(channel: Channel, code: str) -> float:
    """Retract or clearance between pecks, mm."""
    parameters = MeldasParameters.naming(channel.setup.parameters)
    return parameters.value(RELIEF[code]) if code in RELIEF else 0.0


def shift_off_wall(channel: Channel, data: CycleData, plane: tuple[int, int]) -> tuple[float, float]:
    """I and J (Hartford manual §3.3.3, G76 and G87); the Q of FANUC is no shift, and none would scratch the bore."""
    if "Q" in data and "I" not in data and "J" not in data:
        raise channel.control.fail("cycle_word", address="Q", hint="hint.meldas.shift")
    return shift_by_i_and_j(channel, data, plane)


def pitch_of_tap(channel: Channel) -> float:
    """F of G74 and G84 is the pitch, whatever the feed mode (Hartford manual §3.3.3, G84)."""
    return (
        channel.feed if FEED_MODES[channel.mode["feed"]] is FeedMode.PER_REVOLUTION else channel.feed * 60.0
    )


def check(channel: Channel, code: str) -> None:
    """Compensation must be off in a cycle (Hartford manual 3.3.1 C, rule 4): P155; the conditions of a rigid tap.

    `,R1` makes a tap rigid, `,R0` one that follows its spindle, until the cycle ends (M700 programming manual, G84).
    """
    if active_compensation(channel) is not None:
        raise channel.control.fail("comp_cycle", address=code)
    data = CycleState.of(channel).active
    if SYNCHRONOUS in data:
        chosen = data.amount(SYNCHRONOUS)
        if chosen not in (0.0, 1.0):
            raise channel.control.fail("g10_value", address=SYNCHRONOUS)
        data.rigid = chosen == 1.0
    check_rigid_tapping(channel, code)


DRILLING = replace(
    MILLING_DRILLING,
    cycles={code: cycle for code, cycle in CYCLES.items() if code not in _FOREIGN},
    axis=drilling_axis,
    relief=relief,
    shift=shift_off_wall,
    lead=pitch_of_tap,
    check=check,
    choices=(SYNCHRONOUS,),
)
