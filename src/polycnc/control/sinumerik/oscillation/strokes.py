"""What an oscillating axis does: start position, strokes with their dwells, sparking-out strokes, end position (11.1).

It is told by setting data 43700 to 43790, which the words write. Switching off is looked at behind the dwell at a
reversal point.
"""

from __future__ import annotations

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block.positions import ModuloRange
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.oscillation.infeed import Infeed

#: Setting data of an axis.
REVERSAL = ("$SA_OSCILL_REVERSE_POS1", "$SA_OSCILL_REVERSE_POS2")
DWELL = ("$SA_OSCILL_DWELL_TIME1", "$SA_OSCILL_DWELL_TIME2")
VELOCITY, SPARKS = "$SA_OSCILL_VELO", "$SA_OSCILL_NUM_SPARK_CYCLES"
END, START = "$SA_OSCILL_END_POS", "$SA_OSCILL_START_POS"
OPTIONS, ACTIVE = "$SA_OSCILL_CTRL_MASK", "$SA_OSCILL_IS_ACTIVE"
#: Bits of the options: where it stops (two of them), to the end position; behind DELDTG strokes and end position all
#: the same, or the reversal point first; a new speed waits for the next reversal; a rotary axis takes the
#: shorter way; single sparking-out strokes, start position first.
STOPS_AT, TO_END, ENDS_IF_BROKEN, REVERSES_IF_BROKEN, SPEED_WAITS, SHORTEST = 3, 4, 8, 16, 32, 128
SINGLE_SPARKS, FROM_START = 256, 512
ALL_OPTIONS = range(2 * FROM_START)
AT_NEXT, AT_FIRST, AT_SECOND, AT_ONCE = range(4)


@dataclass(slots=True, eq=False)
class Strokes:
    """An axis that oscillates.

    Attributes:
        column: The axis.
        goes_to: The reversal point that it goes to, 0 or 1; -1 for the start position, -2 for the end position.
        left: Single sparking-out strokes that are left; None before it is switched off.
        shall_stop: It has been switched off, or broken off by DELDTG.
        ends: Sparking-out strokes and end position come behind that.
        dwells_until: When a dwell ends, s.
        datum: The setting datum with the position that it goes to, of the work; `speed` how fast.
    """

    column: int
    goes_to: int = -1
    left: int | None = None
    shall_stop: bool = False
    ends: bool = True
    dwells_until: float = -1.0
    dwelt: bool = True
    datum: str = REVERSAL[0]
    speed: float = 0.0

    def step(self, channel: SinumerikChannel) -> bool:
        """Go on where the axis stands; whether the oscillation is over."""
        clocked = channel.on_clock()
        axis = clocked.commanded(self.column)
        if self.shall_stop and self.left is None and self._options(channel) & STOPS_AT == AT_ONCE:
            axis.stop()
            self._begin_sparks(channel)
        if axis.moves:
            self.dwelt = False
            self._follow(channel)
            return False
        if not self.dwelt and self.goes_to >= 0:
            self.dwelt = True
            self.dwells_until = clocked.time + max(self._number(channel, DWELL[self.goes_to]), 0.0)
        if clocked.time < self.dwells_until - NO_WAY:
            return False
        return self._next(channel)

    @property
    def waits(self) -> bool:
        """Whether it counts a dwell."""
        return self.dwells_until >= 0.0

    def begin(self, channel: SinumerikChannel) -> None:
        """It is switched on."""
        if self._options(channel) & FROM_START:
            self._go(channel, START, -1)
        else:
            self._go(channel, REVERSAL[0], 0)

    def take_speed(self, channel: SinumerikChannel) -> None:
        """A new feed acts at once, unless the options let it wait for the next reversal point."""
        speed = self._number(channel, VELOCITY) / tables.MINUTE
        if speed != self.speed and not self._options(channel) & SPEED_WAITS:
            self.speed = speed
            channel.on_clock().commanded(self.column).change_speed(speed)

    def break_off(self, channel: SinumerikChannel) -> bool:
        """DELDTG: the options say what is still to come; whether nothing is, and the axis stops where it is."""
        options = self._options(channel)
        self.shall_stop, self.ends = True, bool(options & ENDS_IF_BROKEN)
        if options & REVERSES_IF_BROKEN:
            return False
        channel.on_clock().commanded(self.column).stop()
        if self.ends:
            self.dwelt = True
            self._begin_sparks(channel)
        return not self.ends

    def _next(self, channel: SinumerikChannel) -> bool:
        self.dwells_until = -1.0
        if self.goes_to == -2:
            return True
        if self.goes_to == -1:
            first, start = self._number(channel, REVERSAL[0]), self._number(channel, START)
            place = int(abs(first - start) <= NO_WAY)
            self._go(channel, REVERSAL[place], place)
            return False
        if self.shall_stop and self.left is None:
            option = self._options(channel) & STOPS_AT
            if option == AT_NEXT or option - 1 == self.goes_to:
                self._begin_sparks(channel)
        if self.left is None or self.left > 0:
            self.left = None if self.left is None else self.left - 1
            other = 1 - self.goes_to
            self._go(channel, REVERSAL[other], other)
            return False
        if self.ends and self._options(channel) & TO_END:
            self._go(channel, END, -2)
            return False
        return True

    def _begin_sparks(self, channel: SinumerikChannel) -> None:
        strokes = int(self._number(channel, SPARKS)) if self.ends else 0
        self.left = strokes if self._options(channel) & SINGLE_SPARKS else 2 * strokes

    def _go(self, channel: SinumerikChannel, datum: str, goes_to: int) -> None:
        """To a position of the work."""
        self.goes_to, self.dwelt, self.datum = goes_to, False, datum
        self.speed = self._number(channel, VELOCITY) / tables.MINUTE
        channel.on_clock().commanded(self.column).move_to(self._target(channel), self.speed)

    def _follow(self, channel: SinumerikChannel) -> None:
        """Under a transformation other axes move the place of the work that the axis goes to."""
        axis = channel.on_clock().commanded(self.column)
        if channel.coordinates.transformation is not None and axis.left:
            target = self._target(channel)
            if abs(channel.actual.machine[self.column] + axis.left - target) > NO_WAY:
                axis.move_to(target, self.speed)

    def _target(self, channel: SinumerikChannel) -> float:
        """Machine position of where it goes to: of a modulo axis in its turn, or (128) by the shorter way."""
        work = channel.actual.work[self.column]
        place, offset = self._number(channel, self.datum), channel.actual.machine[self.column] - work
        if channel.memory.axes[self.column].modulo:
            turn = ModuloRange.of(channel.memory.data, channel.axes[self.column])
            place = turn.below(work) + turn.shown(place)
            if self._options(channel) & SHORTEST:
                place += turn.length * round((work - place) / turn.length)
        return place + offset

    def _number(self, channel: SinumerikChannel, datum: str) -> float:
        return channel.memory.data.number(datum, channel.axes[self.column])

    def _options(self, channel: SinumerikChannel) -> int:
        return int(self._number(channel, OPTIONS))


@dataclass(slots=True)
class Oscillations(PassiveWatcher, State, lifetime=Lifetime.POWER):
    """The oscillating axes of a channel; satisfies the channel's `Watcher`.

    Attributes:
        channel: The channel.
        axes: Strokes by column.
        infeeds: Axes that are fed in by OSCILL.
    """

    channel: SinumerikChannel
    axes: dict[int, Strokes] = field(default_factory=dict)
    infeeds: list[Infeed] = field(default_factory=list)

    @classmethod
    def first(cls, channel: Channel) -> Oscillations:
        """None."""
        return cls(channel)

    def switch_on(self, column: int) -> None:
        """OS[axis]=1: the axis begins, unless it oscillates."""
        if column not in self.axes:
            strokes = self.axes[column] = Strokes(column)
            ActionAxes.of(self.channel).held.add(column)
            strokes.begin(self.channel)

    def switch_off(self, column: int) -> None:
        """OS[axis]=0: it ends as the options say."""
        if column in self.axes:
            self.axes[column].shall_stop = True

    def break_off(self, column: int) -> bool:
        """DELDTG of an axis: its oscillation ends as the options say; False for an axis that does not oscillate."""
        strokes = self.axes.get(column)
        if strokes is not None and strokes.break_off(self.channel):
            del self.axes[column]
            ActionAxes.of(self.channel).held.discard(column)
        return strokes is not None

    def look(self) -> None:
        """An interpolation cycle has come."""
        for column, strokes in tuple(self.axes.items()):
            if strokes.step(self.channel):
                del self.axes[column]
                ActionAxes.of(self.channel).held.discard(column)
        clocked = self.channel.on_clock()
        for infeed in self.infeeds:
            infeed.step(clocked)
        self.infeeds = [infeed for infeed in self.infeeds if not infeed.is_done(clocked)]

    @property
    def is_quiet(self) -> bool:
        """Whether another look would find everything as it is, until an axis comes to rest."""
        if self.axes and self.channel.coordinates.transformation is not None:
            return False
        return not self.infeeds and not any(strokes.waits for strokes in self.axes.values())

    def block_begins(self) -> None:
        """The program may have written another feed since the block before."""
        for strokes in self.axes.values():
            strokes.take_speed(self.channel)

    @property
    def lingers(self) -> bool:
        """The end of the program switches oscillation off, and waits for its strokes."""
        for column in self.axes:
            self.switch_off(column)
        return bool(self.axes)

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, or was given up: axes that still oscillate stop where they are."""
        clocked = self.channel.on_clock()
        for column in (*self.axes, *(infeed.column for infeed in self.infeeds)):
            clocked.commanded(column).stop()
            ActionAxes.of(self.channel).held.discard(column)
        self.axes.clear()
        self.infeeds.clear()
