"""How fast a piece of the path is run from where the axes are now: phases of constant acceleration.

As in the planner, `x` is the square of the path speed v and changes in proportion to the way: `x₁ = x₀ + 2·u·s`
under a constant acceleration u. The planner asks for the fastest way from rest to rest; here the axes may be
faster than what is now allowed, because an override was turned down or feed hold was pressed: then they brake as
hard as their limits let them, along the path.
"""

from __future__ import annotations

from array import array
from math import inf, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.averaging import way_after
from polycnc.motion.kernels.alone import level_peak
from polycnc.motion.kernels.columns import UNEVEN_FORMS, PieceRecord
from polycnc.motion.kernels.columns import Limits as MachineLimits
from polycnc.motion.kernels.speeds import bound2, curved_time, ways_to_cap
from polycnc.motion.law import Phase

if TYPE_CHECKING:
    from collections.abc import Iterable, MutableSequence, Sequence

#: Relative difference of squared speeds, and a way in mm, that count as none.
SAME, NO_WAY_MM = 1e-12, 1e-12


#: Relative difference of bounds that meet where the axes can only just go on.
CLOSE = 1e-9
#: A phase shorter than this is rounding: it has no acceleration worth the name.
LEAST_PHASE_S = 1e-12


class Profile(NamedTuple):
    """The phases of a piece.

    Attributes:
        phases: In order.
        end2: Squared speed behind them.
        arrives: They lead to the end of the piece; else the axes come to rest before it.
    """

    phases: tuple[Phase, ...]
    end2: float
    arrives: bool

    @property
    def seconds(self) -> float:
        """Time of all phases."""
        return sum(phase.seconds for phase in self.phases)

    def after(self, seconds: float) -> tuple[float, float]:
        """Way and speed after a time."""
        way = 0.0
        for phase in self.phases:
            if seconds < phase.seconds:
                speed = phase.speed + seconds * (phase.pull + 0.5 * seconds * phase.jerk)
                return way + way_after(seconds, *phase[2:]), max(speed, 0.0)
            seconds -= phase.seconds
            way += phase.way
        return way, sqrt(self.end2)


class Calm(NamedTuple):
    """How long a line from rest to rest must keep its speed before its acceleration changes its sign.

    Such a line uses the whole jerk for one step of acceleration (`motion/kernels/alone.py`); two of them may not come
    within the time that it is averaged over.

    Attributes:
        level: That time.
        before_up: What is left of it, by what has been run last, before the axes may accelerate.
        before_down: The same before they may brake.
    """

    level: float = 0.0
    before_up: float = 0.0
    before_down: float = 0.0


#: A motion that may change its acceleration at any moment.
FREE = Calm()


def calm_after(calm: Calm, phases: Iterable[Phase], since: float, time: float) -> Calm:
    """What holds at a time, behind phases that have begun at another one, at which `calm` held."""
    level, up, down = calm.level, calm.before_up - (time - since), calm.before_down - (time - since)
    for phase in phases:
        if since >= time or level == 0.0:
            break
        since += phase.seconds
        left = level - max(time - since, 0.0)
        if phase.pull > 0.0:
            down = max(down, left)
        elif phase.pull < 0.0:
            up = max(up, left)
    return Calm(level, max(up, 0.0), max(down, 0.0))


def ramp(way: float, start2: float, end2: float) -> Phase:
    """The phase that leads over a way from one squared speed to another."""
    start, end = sqrt(start2), sqrt(end2)
    seconds = 2.0 * way / (start + end) if way > 0.0 else 0.0
    return Phase(seconds, way, start, (end - start) / seconds if seconds > LEAST_PHASE_S else 0.0)


def straight_profile(
    length: float,
    start2: float,
    aim2: float,
    cap2: float,
    pull: float,
    calm: Calm = FREE,
    rise: float = 0.0,
) -> Profile:
    """Phases over a straight way.

    Args:
        length: The way.
        start2: Squared speed now.
        aim2: Squared speed wanted at the end; no more than what can be reached there is taken.
        cap2: Largest squared speed; above it the axes brake first.
        pull: Acceleration along the way.
        calm: How long the speed must stay before the acceleration changes its sign.
        rise: What `cap2`, then that at the start, rises by in a mm (`motion/kernels/leads.py`).
    """
    phases: list[Phase] = []
    if calm.level > 0.0 and max(start2, cap2) > 0.0:
        wait = _kept_speed(length, start2, aim2, cap2, pull, calm)
        if wait.seconds > 0.0:
            phases.append(wait)
            length -= wait.way
        elif calm.before_up > 0.0:
            cap2 = min(cap2, start2)
    if start2 > cap2 * (1.0 + SAME):
        brake = (start2 - cap2) / (2.0 * pull + rise)
        if brake >= length:
            end2 = max(start2 - 2.0 * pull * length, 0.0)
            return Profile((*phases, ramp(length, start2, end2)), end2, arrives=True)
        cap2 += rise * brake
        phases.append(ramp(brake, start2, cap2))
        length, start2 = length - brake, cap2
    if cap2 <= 0.0:
        return Profile(tuple(phases), 0.0, arrives=False)
    last2 = cap2 + rise * length
    end2 = min(max(min(aim2, last2), start2 - 2.0 * pull * length, 0.0), start2 + 2.0 * pull * length)
    if rise != 0.0:
        up, down = ways_to_cap(start2, end2, cap2, rise, pull, length)
        first2, last2 = start2 + 2.0 * pull * up, end2 + 2.0 * pull * down
        level = max(length - up - down, 0.0)
        phases += [ramp(up, start2, first2), ramp(level, first2, last2), ramp(down, last2, end2)]
        return Profile(tuple(phase for phase in phases if phase.seconds > 0.0), end2, arrives=True)
    peak = level_peak(start2, end2, length, pull, calm.level)
    peak2 = max(min(cap2, peak * peak), start2, end2)
    up, down = (peak2 - start2) / (2.0 * pull), (peak2 - end2) / (2.0 * pull)
    level = max(length - up - down, 0.0)
    phases += [ramp(up, start2, peak2), ramp(level, peak2, peak2), ramp(down, peak2, end2)]
    return Profile(tuple(phase for phase in phases if phase.seconds > 0.0), end2, arrives=True)


def first_part(profile: Profile, length: float) -> Profile:
    """The phases of a profile over the first part of its way."""
    phases: list[Phase] = []
    for phase in profile.phases:
        left = length - sum(before.way for before in phases)
        if phase.way > left:
            end2 = max(phase.speed * phase.speed + 2.0 * phase.pull * left, 0.0)
            part = ramp(left, phase.speed * phase.speed, end2)
            return Profile((*phases, part), end2, arrives=True)
        phases.append(phase)
    return profile


def _kept_speed(length: float, start2: float, aim2: float, cap2: float, pull: float, calm: Calm) -> Phase:
    """The phase at the present speed that must come first; of no duration where none must, or none can."""
    speed, brakes = sqrt(start2), max(start2 - aim2, 0.0) / (2.0 * pull)
    slower = start2 > cap2 * (1.0 + SAME) or brakes >= length
    seconds = calm.before_down if slower else calm.before_up
    way = speed * seconds
    room = length if slower else length - brakes
    return Phase(seconds, way, speed, 0.0) if way <= room else Phase(0.0, 0.0, speed, 0.0)


class Limits(NamedTuple):
    """What a curved piece allows: q' and q'' of every axis at its start and end, and the axes' accelerations."""

    tangent: tuple[float, ...]
    bend: tuple[float, ...]
    end_tangent: tuple[float, ...]
    end_bend: tuple[float, ...]
    acceleration: tuple[float, ...]

    def lowest(self, length: float, start2: float) -> float:
        """Least squared speed at the end of a way under one acceleration."""
        low, half = -inf, 0.5 / length
        for q, b, q_end, b_end, a in zip(*self, strict=True):
            if q != 0.0:
                low = max(low, min(start2 + (sign * a - b * start2) / (q * half) for sign in (-1.0, 1.0)))
            own = b_end + q_end * half
            if own != 0.0:
                low = max(low, min((sign * a + q_end * half * start2) / own for sign in (-1.0, 1.0)))
        return low

    def brake(self, start2: float) -> float:
        """Deceleration that holds at both ends of the piece for every squared speed up to this one."""
        hardest = inf
        for q, b, q_end, b_end, a in zip(*self, strict=True):
            for tangent, bend in ((q, b), (q_end, b_end)):
                if tangent != 0.0:
                    spent = max(-bend * start2 * (1.0 if tangent > 0.0 else -1.0), 0.0)
                    hardest = min(hardest, (a - spent) / abs(tangent))
        return max(hardest, 0.0)


def curved_profile(
    record: MutableSequence[float], start2: float, aim2: float, cap2: float, axes: int, limits: MachineLimits
) -> Profile:
    """Phases over a curved piece: one acceleration, or over a peak where that is quicker, as the planner decides.

    Args:
        record: The planner's record of the piece, or of the rest of one.
        start2: Squared speed now.
        aim2: Squared speed wanted at the end.
        cap2: Largest squared speed; above it the axes brake.
        axes: Number of axes.
        limits: The machine, as the planner's kernels take it.
    """
    length, curve = record[PieceRecord.LENGTH], limits_of(record, axes, limits)
    low, high = curve.lowest(length, start2), bound2(record, 0, axes, limits, start2, False)[0]
    end2 = min(aim2, max(high, 0.0), cap2)
    if low > end2 and record[PieceRecord.MARGIN] > 1.0:
        # From within a piece, or a little too fast, it takes of what MARGIN leaves, or the end would come too fast.
        low = min(low, max(limits_of(record, axes, limits, as_stored=False).lowest(length, start2), end2))
    if start2 > cap2 * (1.0 + SAME) or end2 < low * (1.0 - CLOSE):
        hardest = curve.brake(start2)
        rest2 = start2 - 2.0 * hardest * length
        if rest2 < 0.0 and cap2 <= 0.0:
            way = start2 / (2.0 * hardest)
            return Profile((ramp(way, start2, 0.0),) if way > 0.0 else (), 0.0, arrives=False)
        end2 = max(min(max(low, end2), start2), 0.0) if low <= high * (1.0 + CLOSE) else max(rest2, 0.0)
    if cap2 <= 0.0 and start2 <= 0.0:
        return Profile((), 0.0, arrives=False)
    if end2 <= 0.0 and cap2 <= 0.0:
        return Profile((ramp(length, start2, 0.0),), 0.0, arrives=True)
    record[PieceRecord.CAP2] = cap2
    seconds, peak2, rate = curved_time(record, 0, axes, limits, start2, end2)
    if seconds == inf:
        return Profile((), end2, arrives=True)
    if rate == 0.0:
        return Profile((ramp(length, start2, end2),), end2, arrives=True)
    return straight_profile(length, start2, end2, peak2, rate)


def limits_of(record: Sequence[float], axes: int, limits: MachineLimits, *, as_stored: bool = True) -> Limits:
    """The limits of a curved piece from its record and those of the machine (`kernels/columns.py`).

    Its q' and q'' are larger than they are by MARGIN if they are taken as they are stored.
    """
    margin, first = 1.0 if as_stored else record[PieceRecord.MARGIN], PieceRecord.VECTORS
    blocks = [
        tuple(value / margin for value in record[first + k * axes : first + (k + 1) * axes]) for k in range(4)
    ]
    return Limits(blocks[0], blocks[2], blocks[1], blocks[3], tuple(limits.acceleration))


def profile_of(
    record: Sequence[float],
    done: float,
    start2: float,
    aim2: float,
    cap2: float,
    axes: int,
    limits: MachineLimits,
    calm: Calm = FREE,
) -> Profile:
    """Phases over what is left of a piece.

    Args:
        record: The planner's record of the piece.
        done: Way along it that lies behind.
        start2: Squared speed now.
        aim2: Squared speed wanted at its end.
        cap2: Largest squared speed on it.
        axes: Number of axes.
        limits: The machine, as the planner's kernels take it.
        calm: How long a line from rest to rest keeps its speed.
    """
    length = record[PieceRecord.LENGTH] - done
    if length <= NO_WAY_MM:
        return Profile((), start2, arrives=True)
    if record[PieceRecord.FORM] not in UNEVEN_FORMS:
        own2, rise = record[PieceRecord.CAP2], record[PieceRecord.RISE]
        if rise != 0.0:  # an override acts on all of it alike
            rise *= cap2 / own2
            cap2 += rise * done
        return straight_profile(length, start2, aim2, cap2, record[PieceRecord.PULL], calm, rise)
    return curved_profile(_rest_of(record, done, axes), start2, aim2, cap2, axes, limits)


def _rest_of(record: Sequence[float], done: float, axes: int) -> MutableSequence[float]:
    """The record of what is left of a curved piece behind a way: q' and q'' change evenly along it."""
    rest = array("d", record)
    length, first = rest[PieceRecord.LENGTH], PieceRecord.VECTORS
    rest[PieceRecord.LENGTH] = length - done
    for k in (*range(axes), *range(2 * axes, 3 * axes)):
        rest[first + k] += (rest[first + axes + k] - rest[first + k]) * done / length
    return rest
