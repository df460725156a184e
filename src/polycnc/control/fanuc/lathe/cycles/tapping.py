"""Rigid tapping of the lathe: what makes a tap rigid, its conditions, its way out (0i-TF Plus II.4.5)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.cycles.drilling import CycleState
from polycnc.control.word_address.motion.path import FEED_MODES
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import CycleData

#: Modal group of M29.
RIGID, RIGID_ON, RIGID_OFF = "rigid", "M29", "off"
TAPS = frozenset({"G84", "G88", "G84.2"})
#: Fastest spindle whose encoder still gives fewer than 32768 pulses in 8 ms (4095 a turn), rev/min.
_MAX_RPM = 32767 * 1000 / 8 * 60 / 4095
#: Highest speed of the spindle in each gear.
_GEAR_LIMITS = (
    LatheParameters.tap_speed_gear_1,
    LatheParameters.tap_speed_gear_2,
    LatheParameters.tap_speed_gear_3,
    LatheParameters.tap_speed_gear_4,
)


@dataclass(slots=True)
class ClampState(State, lifetime=Lifetime.RESET):
    """The M code that clamps the C axis in the active drilling cycle, 0 for none."""

    code: int = 0


def is_rigid(channel: LatheChannel) -> bool:
    """Whether a tap is cut in step with a servo spindle: M29, 5200#0, or G84.2."""
    return _is_rigid(channel.mode, channel.memory.parameters)


def was_rigid(builder: Builder) -> bool:
    """Whether a rigid tapping cycle was active before a block."""
    return builder.before["cycle"] in TAPS and _is_rigid(builder.before, builder.channel.memory.parameters)


def taps_rigidly(builder: Builder) -> bool:
    """Whether a tap in a block is rigid: by the state before it, or by an M29 of its own."""
    return _is_rigid(builder.mode, builder.channel.memory.parameters) or 29 in builder.m_codes


def _is_rigid(mode: Mode, parameters: LatheParameters) -> bool:
    return mode[RIGID] == RIGID_ON or parameters.G84 or mode["cycle"] == "G84.2"


def rigid_tapping(channel: LatheChannel, _words: Words) -> None:
    """M29: the next tapping cycle locks spindle and axis."""
    channel.mode = channel.mode.with_code(RIGID, RIGID_ON)


def check_block(builder: Builder, axis_before: int, axis: int) -> None:
    """Within rigid tapping neither M29 nor another plane or drilling axis is allowed."""
    if not was_rigid(builder):
        return
    if 29 in builder.m_codes:
        raise builder.control.fail("rigid_m29", address="M29")
    if builder.mode["plane"] != builder.before["plane"] or axis != axis_before:
        raise builder.control.fail("rigid_plane", address=builder.mode["plane"])


def _wait(builder: Builder, plan: Plan) -> Step | None:
    """Between M29 and its tapping cycle neither S nor a move of axes is allowed."""
    if builder.before[RIGID] != RIGID_ON or builder.before["cycle"] != "G80":
        return None
    if any(row.code in TAPS for row in builder.codes):
        # The cycle, even one that a motion code of its block cancels.
        return None
    if builder.has("S") or plan.axis_words:
        raise builder.control.fail(
            "rigid_between", address="S" if builder.has("S") else plan.axis_words[0].address
        )
    return None


def check(channel: LatheChannel, data: CycleData) -> None:
    """A rigid tap needs a speed that the gear and the encoder allow, no constant surface speed, and a feed."""
    if not is_rigid(channel):
        return
    fail, speed = channel.control.fail, channel.memory.spindle.speed
    highest = gear_limit(channel)
    if channel.mode["surface_speed"] == "G96" or not speed > 0.0 or (highest and speed > highest):
        raise fail("rigid_speed", address="S")
    if speed >= _MAX_RPM + 1.0:
        raise fail("rigid_pulses", address="S")
    if not channel.feed > 0.0:
        raise fail("rigid_feed", address="F")
    per_revolution = FEED_MODES[channel.mode["feed"]] is FeedMode.PER_REVOLUTION
    mm_min = channel.feed * (speed if per_revolution else 60.0)
    limit = channel.memory.parameters.of(channel.axes[data.axis]).largest_feed
    if limit and mm_min >= limit:
        # II.4.5.1 and II.4.5.2 name different alarms for the same mistake.
        raise fail("no_feed" if data.amount("Q") else "rigid_feed", address="F")


def gear_limit(channel: LatheChannel) -> float:
    """Highest speed of the spindle in the gear that the machine reports (GR1, GR2), rev/min; 0 for none."""
    parameters = channel.memory.parameters
    if not any(parameters.value(limit) for limit in _GEAR_LIMITS):
        return 0.0  # no need to stop preparation for the signals
    signals = channel.memory.signals
    gear = int(bool(signals.get("GR1"))) + 2 * int(bool(signals.get("GR2")))
    return parameters.value(_GEAR_LIMITS[gear])


def ask_for_gear(channel: LatheChannel, code: str) -> None:
    """A block that taps waits here for the signals of the gear, before it has done anything."""
    if code in TAPS:
        gear_limit(channel)


def largest_override(channel: LatheChannel) -> float:
    """The feed override (5203#4) may not lead the spindle above its gear's highest speed; 0 for any (II.4.5.4.2)."""
    speed = channel.memory.spindle.speed
    return gear_limit(channel) / speed if speed > 0.0 else 0.0


def extraction(channel: LatheChannel) -> float:
    """How much faster a rigid tap comes out (5200#4 DOV, 5201#4 OV3, 5211, J; II.4.5.4)."""
    memory = channel.memory
    if not is_rigid(channel) or not memory.parameters.DOV:
        return 1.0
    factor = _wanted_extraction(channel)
    highest = gear_limit(channel)
    return min(factor, highest / memory.spindle.speed) if highest else factor


def _wanted_extraction(channel: LatheChannel) -> float:
    memory = channel.memory
    parameters, data, speed = memory.parameters, CycleState.of(channel).active, memory.spindle.speed
    if "J" in data and parameters.OV3:
        rpm = data.amount("J") * (1.0 if channel.control.number_rules(channel).calculator else 1000.0)
        factor = rpm / speed
        return factor if 1.0 <= factor <= 2.0 else 1.0
    percent = parameters.tap_extraction_override * (10.0 if parameters.OVU else 1.0)
    return percent / 100.0 if percent > 0.0 else 1.0


def plan_leaving(builder: Builder, _plan: Plan) -> Step | None:
    """The end of a drilling cycle: clamp code and rigid mode are forgotten, and the S of a rigid tap (II.4.5.3).

    A tapping cycle that a motion code of its own block cancels has ended before it began.
    """
    cancelled = any(row.code in TAPS for row in builder.codes)
    if builder.mode["cycle"] != "G80" or not (cancelled or builder.before["cycle"] != "G80"):
        return None
    forgets_speed = was_rigid(builder) and not builder.has("S")

    def leave(channel: LatheChannel, _values: list[float]) -> None:
        ClampState.of(channel).code = 0
        channel.mode = channel.mode.with_code(RIGID, RIGID_OFF)
        if forgets_speed:
            channel.memory.spindle.speed = 0.0
            channel.context_changed()

    return leave


#: What M29 asks of the blocks up to its cycle.
WAITING_RULE = Rule("blocks behind M29", unless={RIGID: RIGID_OFF}, in_cycles=False, motion=_wait)
#: What the end of a drilling cycle forgets.
LEAVING_RULE = Rule("end of a tap", unless={"cycle": "G80"}, codes=TAPS, after=plan_leaving)
