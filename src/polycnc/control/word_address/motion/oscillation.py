"""An axis that oscillates beside its program: strokes between two vertices until the program or a hold ends them.

What the controls share of G81.1 (FANUC, SYNTEC) and G81.2 (SYNTEC). On the path the axis stands at its R point, from
where the strokes begin; the main run makes them. A hold, a reset and an alarm lead the axis back to R, or let it stop
where it is; without power it stops at once.
"""

from __future__ import annotations

from enum import Enum

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import PreprocessingStop
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.interpolator import Commanded


class Strokes(NamedTuple):
    """Between which machine positions the axis moves, mm or degrees, and how fast, mm/s or degrees/s."""

    vertices: tuple[float, float]
    speed: float


def speed_of_feed(channel: Channel, column: int) -> float:
    """The feed as the speed of an axis, mm/s; that of a rotary one, degrees/s, is no length in inches."""
    inch = channel.control.is_inch(channel.mode) and channel.axis_data[column].rotary
    return channel.feed / INCH_MM if inch else channel.feed


class Source(Protocol):
    """Where the data of the strokes come from; asked at every reversal."""

    def read(self) -> Strokes:
        """The data now."""


class Phase(Enum):
    """What the axis does."""

    OFF = "nothing"
    STROKES = "it oscillates"
    HELD = "the program is held"
    ENDING = "it comes to its last place"


@dataclass(slots=True)
class Oscillator(PassiveWatcher, State, lifetime=Lifetime.POWER):
    """The oscillating axis of a channel; satisfies the channel's `Watcher`.

    Attributes:
        channel: The channel.
        column: The axis.
        source: The data of its strokes.
        home: Machine position of its R point; None to stop wherever it is.
        phase: What it does.
        toward: Vertex that it goes to, 0 or 1.
        last: Where it shall end, in phase ENDING; None for where it stops.
        speed: That of its strokes, without override.
        override: That of oscillation, 1 for 100 %; at 0 the axis waits.
    """

    channel: Channel
    column: int = -1
    source: Source | None = None
    home: float | None = None
    phase: Phase = Phase.OFF
    toward: int = 0
    last: float | None = None
    speed: float = 0.0
    override: float = 1.0

    @classmethod
    def first(cls, channel: Channel) -> Oscillator:
        """No axis oscillates."""
        return cls(channel)

    # ---- commands of the program -----------------------------------------------------------------------------

    def begin(self, column: int, source: Source, home: float | None, override: float = 1.0) -> None:
        """The strokes begin when the axes are there, at an override of theirs.

        Raises:
            AlarmError: A vertex lies beyond the travel of the axis.
        """
        channel, clocked = self.channel, self.channel.on_clock()
        for place in source.read().vertices if channel.limits else ():
            low, high = channel.limits[column]
            if not low <= place <= high:
                raise channel.control.over_travel(channel.axes[column], 1 if place > high else -1)

        self.override = (
            override  # not with the start: another channel may change it before the axes are there
        )

        def start() -> None:
            self.column, self.source, self.home = column, source, home
            self.phase = Phase.STROKES
            clocked.watch(self)
            clocked.move_static(column, static=True)
            axis = clocked.commanded(column)
            here, vertices = self.channel.actual.machine[column], source.read().vertices
            self.toward = int(abs(vertices[1] - here) > abs(vertices[0] - here) + NO_WAY)
            self._stroke(axis)

        self.channel.event(Deed("OSCILLATION", None, start, is_silent=False))

    def change(self, source: Source, home: float | None) -> None:
        """Other data hold from the next reversal on."""

        def do() -> None:
            self.source, self.home = source, home

        self.channel.event(Deed("OSCILLATION", None, do, is_silent=False))

    def change_override(self, override: float, commander: Channel | None = None) -> None:
        """Another override holds at once when the axes of the channel that commands it are there, in a stroke too."""

        def do() -> None:
            self.override = override
            if self.phase is not Phase.OFF:
                clocked = self.channel.on_clock()
                clocked.commanded(self.column).change_speed(self._speed)
                clocked.wake()

        (commander or self.channel).event(Deed("OSCILLATION", None, do, is_silent=False))

    def finish(self, last: float | None) -> bool:
        """The strokes end at a machine position, or at once; whether the axis belongs to the path again.

        Raises:
            PreprocessingStop: The axis still moves.
        """
        channel = self.channel
        clocked = channel.on_clock()
        channel.flush()
        channel.synchronise()
        if self.column < 0:
            return False
        self.stop_at(last)
        if self.phase is not Phase.OFF:
            raise PreprocessingStop
        machine = channel.coordinates.machine
        machine[self.column] = clocked.take_back(self.column)
        channel.coordinates.arrive_machine(machine)
        self.column = -1
        return True

    def stop_at(self, last: float | None) -> None:
        """The last stroke leads to a place, straight on or from the next vertex; None lets it stop at once."""
        if self.phase in (Phase.OFF, Phase.ENDING):
            return
        clocked = self.channel.on_clock()
        axis = clocked.commanded(self.column)
        self.phase, self.last = Phase.ENDING, last
        if last is None:
            axis.stop()
        elif not (axis.moves and self.speed > 0.0) or self._lies_ahead(axis, last):
            axis.move_to(last, self._own_speed)
        clocked.wake()

    @property
    def _own_speed(self) -> float:
        """Speed of the strokes, else that of rapid traverse, with the override."""
        speed = self.speed if self.speed > 0.0 else self.channel.axis_data[self.column].rapid
        return speed * self.override

    @property
    def _speed(self) -> float:
        """Speed of what the axis does now, with the override."""
        return self.speed * self.override if self.phase is Phase.STROKES else self._own_speed

    def _lies_ahead(self, axis: Commanded, place: float) -> bool:
        """Whether the axis can brake to a place on its way, without turning round."""
        clocked = self.channel.on_clock()
        speed = clocked.speed(self.column)
        way = place - clocked.machine(self.column)
        braking = speed * speed / (2.0 * (self.channel.axis_data[self.column].acceleration or 1e9))
        return way * axis.left > 0.0 and braking <= abs(way)

    # ---- in the main run ---------------------------------------------------------------------------------------

    def look(self) -> None:
        """An interpolation cycle has come."""
        if self.phase is Phase.OFF:
            return
        clocked = self.channel.on_clock()
        axis = clocked.commanded(self.column)
        if not clocked.has_power:
            axis.stop()
        elif clocked.is_held and self.phase is Phase.STROKES:
            self.phase = Phase.HELD
            if self.home is None:
                axis.stop()
            else:
                axis.move_to(self.home, self._own_speed)
        elif self.phase is Phase.HELD:
            if not clocked.is_held:
                self.phase = Phase.STROKES
                self._stroke(axis)
        elif not axis.moves:
            self._next(axis)

    def _next(self, axis: Commanded) -> None:
        """The axis has come to rest."""
        if self.phase is Phase.STROKES:
            self.toward = 1 - self.toward
            self._stroke(axis)
        elif self.last is None or abs(self.last - self._here()) <= NO_WAY:
            self.phase = Phase.OFF
        else:
            axis.move_to(self.last, self._own_speed)

    def _here(self) -> float:
        return self.channel.on_clock().machine(self.column)

    def _stroke(self, axis: Commanded) -> None:
        """To the vertex that comes."""
        assert self.source is not None
        strokes = self.source.read()
        self.speed = strokes.speed
        axis.move_to(strokes.vertices[self.toward], self._speed)

    @property
    def lingers(self) -> bool:
        """The end of the program ends the strokes, and waits for that."""
        self.stop_at(self.home)
        return self.phase is not Phase.OFF

    @property
    def goes_home(self) -> bool:
        """A reset waits until the axis has come to its place of rest."""
        if self.phase is Phase.OFF:
            return False
        clocked = self.channel.on_clock()
        return clocked.has_power and (self.phase is Phase.STROKES or clocked.commanded(self.column).moves)

    @property
    def is_quiet(self) -> bool:
        """Nothing happens before the axis comes to rest or the program is held."""
        return True

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, or was given up."""
        if self.phase is not Phase.OFF:
            clocked = self.channel.on_clock()
            clocked.commanded(self.column).stop()
            clocked.move_static(self.column, static=False)
        self.phase, self.column = Phase.OFF, -1


@dataclass(frozen=True, slots=True)
class Fixed:
    """Strokes that the program has given once."""

    strokes: Strokes

    def read(self) -> Strokes:
        """They stay what they are."""
        return self.strokes


@dataclass(frozen=True, slots=True)
class Read:
    """Strokes that something else holds, such as registers."""

    reader: Callable[[], Strokes]

    def read(self) -> Strokes:
        """What it holds now."""
        return self.reader()
