"""Where the lathe may not go: stroke limits, forbidden zone, barrier, largest increments (G22, G23, G91.1, 1320 ff)."""

from __future__ import annotations

from math import inf

from polycnc.channel.moves.travel import Untold
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.lathe.coordinates.barrier import barrier, is_described
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.word_address.coordinates import stroke_check

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.interface import Boundary
    from polycnc.channel.moves.travel import Travel
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.coordinates.stroke_check import StrokeZone


@dataclass(slots=True)
class LimitState(State, lifetime=Lifetime.POWER):
    """What programs have forbidden.

    Attributes:
        zone: Forbidden zone of G22, or the barrier; None for none.
        programmed_zone: The zone that the words of the last G22 have stored.
        increments: Largest increment of axes by column, mm (G91.1).
    """

    zone: Boundary | None = None
    programmed_zone: Boundary | None = None
    increments: dict[int, float] = field(default_factory=dict)


def at_power_on(channel: LatheChannel) -> None:
    """What parameters forbid before any program speaks."""
    if channel.mode["stroke"] == "G22":
        LimitState.of(channel).zone = barrier(channel) or _zone_of_parameters(channel)
    renew_zones(channel)


def stroke_check_on(channel: LatheChannel, words: Words) -> None:
    """G22 X Z I K: stored stroke check 2 in machine coordinates; values of a diameter axis are diameters.

    The zone stays stored: a G22 without words brings back the one of the last words.
    """
    state = LimitState.of(channel)
    state.programmed_zone = _zone_of_words(channel, words) or state.programmed_zone
    # The barrier takes the place of stored stroke checks 2 and 3 (III.2.2).
    state.zone = barrier(channel) or state.programmed_zone or _zone_of_parameters(channel)
    renew_zones(channel)


def stroke_check_off(channel: LatheChannel, _words: Words) -> None:
    """G23: no forbidden zone."""
    LimitState.of(channel).zone = None
    renew_zones(channel)


def limit_increment(channel: LatheChannel, words: Words) -> None:
    """G91.1: largest increment of each named axis in one block; 0 ends the check."""
    limits = LimitState.of(channel).increments
    for axis, value, _ in words.axes():
        limits[axis] = abs(value)
    for axis in [axis for axis, limit in limits.items() if not limit]:
        del limits[axis]
    renew_zones(channel)


def renew_zones(channel: LatheChannel) -> None:
    """Let the channel check every move against what is forbidden now."""
    state = LimitState.of(channel)
    travel = _travel(channel)
    found: list[Boundary] = []
    if state.increments:
        found.append(IncrementCheck(dict(state.increments)))
    if travel:
        found.append(TravelCheck(travel))
    if state.zone is not None:
        found.append(state.zone)
    inner = None if is_described(channel) else _zone_3(channel)
    if inner is not None:
        found.append(inner)
    channel.boundary = Boundaries(tuple(found)) if found else None


def _zone_of_words(channel: LatheChannel, words: Words) -> StrokeZone | None:
    upper = {axis: value for axis, value, _ in words.axes()}
    stroke_check.refuse_others(channel, words)
    named: list[tuple[int, float, float]] = []
    for letter, axis in zip("IJK", channel.coordinates.geometry, strict=True):
        low = words.length(letter, diameter=axis >= 0 and channel.control.is_diameter(channel, axis))
        if (low is None) != (axis not in upper):
            raise words.fail("address", letter)
        if low is not None:
            named.append((axis, low, upper[axis]))
    return _zone(channel, named)


def _zone_of_parameters(channel: LatheChannel) -> StrokeZone | None:
    """Stored stroke check 2 of the axes that 1310#0 names, with the limits of 1322 and 1323."""
    parameters = channel.memory.parameters
    named = [
        (i, channel.memory.radius_of(i, of.zone_2_lower), channel.memory.radius_of(i, of.zone_2_upper))
        for i, of in enumerate(map(parameters.of, channel.axes))
        if of.OT2
    ]
    return _zone(channel, named)


def _zone_3(channel: LatheChannel) -> StrokeZone | None:
    """Stored stroke check 3, always on: the inside of 1324 and 1325, of the axes that 1310#1 names."""
    parameters = channel.memory.parameters
    named = [
        (i, channel.memory.radius_of(i, of.zone_3_lower), channel.memory.radius_of(i, of.zone_3_upper))
        for i, of in enumerate(map(parameters.of, channel.axes))
        if of.OT3
    ]
    zone = _zone(channel, named)
    return None if zone is None else replace(zone, inside=True, number=3)


def _zone(channel: LatheChannel, named: list[tuple[int, float, float]]) -> StrokeZone | None:
    if not named:
        return None
    return stroke_check.zone_between(named, inside=not channel.memory.parameters.OUT)


def hand_range(channel: LatheChannel, axis: int) -> tuple[float, float]:
    """Where stored stroke check 1 lets an axis go by hand: it stops at the limit (1320, 1321)."""
    return _travel(channel).get(axis, (-inf, inf))


def _travel(channel: LatheChannel) -> dict[int, tuple[float, float]]:
    """Stored stroke check 1: limits by parameter, where the setup gives them."""
    parameters = channel.memory.parameters
    found: dict[int, tuple[float, float]] = {}
    for i, of in enumerate(map(parameters.of, channel.axes)):
        low, high = of.travel_lower, of.travel_upper
        if low is not None or high is not None:
            found[i] = (
                -inf if low is None else channel.memory.radius_of(i, low),
                inf if high is None else channel.memory.radius_of(i, high),
            )
    return found


@dataclass(frozen=True, slots=True)
class Boundaries(Untold):
    """Several things to check, in order."""

    all: tuple[Boundary, ...]

    def check(self, channel: LatheChannel, travel: Travel) -> None:
        """The alarm of the first one that is violated."""
        for each in self.all:
            each.check(channel, travel)


@dataclass(frozen=True, slots=True)
class IncrementCheck(Untold):
    """The largest increment of axes in one block."""

    limits: Mapping[int, float]

    def check(self, channel: LatheChannel, travel: Travel) -> None:
        """The control's alarm for a longer way of an axis, from the start of the block to its end."""
        start, end = travel.machine[0], travel.machine[-1]
        for axis, limit in self.limits.items():
            if abs(end[axis] - start[axis]) > limit + 1e-9:
                raise channel.control.fail("increment_limit", address=channel.axes[axis])


@dataclass(frozen=True, slots=True)
class TravelCheck(Untold):
    """Limits of the travel of axes, machine coordinates."""

    limits: Mapping[int, tuple[float, float]]

    def check(self, channel: LatheChannel, travel: Travel) -> None:
        """The control's alarm for a way beyond a limit; where all limits are equal points, for every way."""
        closed = all(low == high for low, high in self.limits.values())
        for machine in travel.machine[1:]:
            for axis, (low, high) in self.limits.items():
                if closed or not low - 1e-9 <= machine[axis] <= high + 1e-9:
                    raise channel.control.over_travel(channel.axes[axis], 1 if machine[axis] > high else -1)
