"""Spindles that follow others: synchronous (COUPDEF), slaves (MASLDEF), in gears (EGON); job planning 9.4 to 9.6.

A following spindle turns with the speed of its leading spindle times the ratio, and with a difference speed of its own
on top. Where both stand, its position is that of the leading one times the ratio, and an offset. Spindles have no
angle while they turn.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block.positions import ModuloRange
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.feed import spindle_speed
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.graph import CircularCouplingError, in_order
from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle

#: `$AA_COUP_ACT` of a synchronous spindle.
SYNCHRONOUS = 4
#: Bit of MD20110 that keeps couplings of spindles over a reset, where its bit 0 is set.
KEPT_BY_MASK = 10
#: MD35300: speed of a spindle that is positioned, rpm.
_POSITIONING = "$MA_SPIND_POSCTRL_VELO"


@dataclass(slots=True)
class Pair:
    """How one spindle follows another one.

    Attributes:
        leading: Number of the leading spindle.
        numerator: Speed of the following spindle for `denominator` of the leading one.
        denominator: See `numerator`.
        block_change: What the block that switches on waits for.
        type: `DV` by set points, `AV` by actual values, `VV` by speeds: alike where nothing lags.
        is_slave: Of a master (MASLDEF): no difference speed, no synchronous state.
        is_gear: Of an electronic gear (EGON).
        acts: It is switched on.
        overlaid: What M3, M4 and S of the following spindle say is a difference speed.
        offset: From the leading spindle's position to that of the following one, degrees.
        settles_s: Seconds that the following spindle still needed at `since` to be synchronous.
        since: Dwell time and number of moves of the program then.
    """

    leading: int
    numerator: float = 1.0
    denominator: float = 1.0
    block_change: str = "IPOSTOP"
    type: str = "DV"
    is_slave: bool = False
    is_gear: bool = False
    acts: bool = False
    overlaid: bool = False
    offset: float = 0.0
    settles_s: float = 0.0
    since: tuple[float, int] = (0.0, 0)

    @property
    def is_synchronous(self) -> bool:
        """Whether it is one of synchronous spindles (COUPDEF)."""
        return not (self.is_slave or self.is_gear)

    @property
    def ratio(self) -> float:
        """Speed of the following spindle by that of the leading one."""
        return self.numerator / self.denominator


@dataclass(slots=True)
class SpindlePairs(State, lifetime=Lifetime.POWER):
    """The pairs of a channel that are defined, by the number of the following spindle."""

    by_following: dict[int, Pair] = field(default_factory=dict)

    def acting(self, following: int) -> Pair | None:
        """The pair that leads a spindle now."""
        pair = self.by_following.get(following)
        return pair if pair is not None and pair.acts else None

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset opens synchronous pairs unless MD20110 keeps them; power-on ends all definitions."""
        if lifetime >= Lifetime.POWER:
            self.by_following.clear()
        elif lifetime >= Lifetime.RESET:
            mask = MachineData.of(channel).integer("$MC_RESET_MODE_MASK")
            if not (mask & 1 and mask >> KEPT_BY_MASK & 1):
                for pair in self.by_following.values():
                    pair.acts, pair.overlaid = pair.acts and not pair.is_synchronous, False


def refuse_ring(channel: SinumerikChannel, following: int, leading: int) -> None:
    """A spindle must not lead itself, at once (16785) or by way of others (16778)."""
    if following == leading:
        raise AlarmError("16785", axis=f"S{following}")
    pairs = {**SpindlePairs.of(channel).by_following, following: Pair(leading, acts=True)}
    laws = {number: [Ratio(pair.leading, pair.ratio)] for number, pair in pairs.items() if pair.acts}
    try:
        in_order(laws)
    except CircularCouplingError as error:
        raise AlarmError("16778", axis=f"S{error.column}") from None


def turns(channel: SinumerikChannel, number: int) -> float:
    """What a spindle turns with, rpm, positive for M3; couplings included."""
    spindle = channel.memory.spindles.get(number)
    pair = SpindlePairs.of(channel).acting(number)
    if pair is None:
        return spindle.direction * _own_speed(channel, spindle)
    own = spindle.direction * spindle.speed if pair.overlaid else 0.0
    return pair.ratio * turns(channel, pair.leading) + own


def _own_speed(channel: SinumerikChannel, spindle: Spindle) -> float:
    """The speed that a spindle is programmed with, as far as those that follow it can go."""
    memory, feed = channel.memory, channel.mode["feed"]
    if tables.feed_type(channel.mode).surface_speed and spindle.number == memory.spindles.master:
        speed = spindle_speed.speed_at(
            channel, spindle.cutting_speed, spindle_speed.highest(memory, spindle, "G96")
        )
    else:
        speed = spindle_speed.turning_speed(memory, spindle, feed)
    for number, pair in SpindlePairs.of(channel).by_following.items():
        if pair.acts and pair.leading == spindle.number and pair.ratio:
            limit = spindle_speed.highest(memory, memory.spindles.get(number), feed)
            most = channel.machine.spindle[number].max_rpm or limit
            speed = min(speed, min(limit, most) / abs(pair.ratio))
    return speed


def place(channel: SinumerikChannel, spindle: Spindle, value: float, modifier: str) -> float:
    """SPOS and the like: a spindle is positioned, and spindles that follow it go along; gives its way, degrees.

    Of a following spindle it is a way beside the coupling: its offset changes.

    Raises:
        AlarmError: PC0001 for a position of a following spindle whose leading one turns: only IC is a way then.
    """
    spindle.refuse_leading("SPOS")
    pair = SpindlePairs.of(channel).acting(spindle.number)
    if pair is None:
        spindle.direction = 0
    elif turns(channel, pair.leading) and modifier != "IC":
        raise AlarmError("PC0001", hint="hint.not-supported", code=f"SPOS[{spindle.number}]")
    else:
        pair.overlaid = False
    way = _way(spindle.position, value, modifier)
    spindle.controlled = True
    if pair is not None:
        pair.offset = _within_a_turn(pair.offset + way)
    _turn_by(channel, spindle.number, way)
    channel.context_changed()
    return way


def _way(before: float, value: float, modifier: str) -> float:
    """The way of a positioning, degrees: the shorter one where none is told."""
    if modifier == "IC":
        return value
    way = (value - before) % tables.TURN
    if modifier == "ACP":
        return way
    if modifier == "ACN":
        return way - tables.TURN if way else 0.0
    return way if way <= tables.TURN / 2.0 else way - tables.TURN


def _turn_by(channel: SinumerikChannel, number: int, way: float) -> None:
    """A spindle turns by an angle, and those that follow it by their share."""
    memory = channel.memory
    spindle = memory.spindles.get(number)
    spindle.position = ModuloRange.of(memory.data, f"S{number}").shown(spindle.position + way)
    for following, pair in SpindlePairs.of(channel).by_following.items():
        if pair.acts and pair.leading == number:
            _turn_by(channel, following, way * pair.ratio)


def stand(channel: SinumerikChannel, following: int, pair: Pair) -> None:
    """The following spindle stands where the leading one and the offset have it."""
    memory = channel.memory
    at = memory.spindles.get(pair.leading).position * pair.ratio + pair.offset
    memory.spindles.get(following).position = ModuloRange.of(memory.data, f"S{following}").shown(at)


def offset_of(channel: SinumerikChannel, following: int, pair: Pair) -> float:
    """From the leading spindle to the following one as both stand now, degrees; 0 while one turns."""
    if turns(channel, pair.leading) or turns(channel, following):
        return 0.0
    spindles = channel.memory.spindles
    return _within_a_turn(spindles.get(following).position - spindles.get(pair.leading).position * pair.ratio)


def seconds_to(channel: SinumerikChannel, following: int, before: float) -> float:
    """Seconds in which a spindle gets from a speed (rpm) to that of its coupling."""
    acceleration = channel.machine.spindle[following].acceleration_rpm_s
    return abs(turns(channel, following) - before) / acceleration if acceleration > 0.0 else 0.0


def seconds_for(channel: SinumerikChannel, following: int, way: float) -> float:
    """Seconds of a way beside the coupling, degrees, at the positioning speed of the spindle."""
    name = f"S{following}"
    rpm = channel.memory.data.number(_POSITIONING, name)
    speed = channel.memory.spindles.get(following).positioning or rpm * tables.TURN / tables.MINUTE
    return abs(way) / speed if speed > 0.0 else 0.0


def _within_a_turn(angle: float) -> float:
    return angle % tables.TURN
