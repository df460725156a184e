"""TRAILON, TRAILOF, LEADON, LEADOF of actions: axes that follow others beside the path (job planning 10.4.21, 10.4.22).

The main run adds what leading axes do to where the following axis stands, whatever moves them: path, action or overlay.
It gets to its speed, and stops behind TRAILOF or LEADOF, with its acceleration; then the program has it again. One that
could not brake within its travel any more, or would be too fast, is led no more: an alarm. An axis that is away from
its place on the table waits until that comes to where it stands (9.3).
"""

from __future__ import annotations

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.curve_tables.memory import CurveTables, table_of
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.graph import CircularCouplingError
from polycnc.transformation.couplings.laws import ByCurve, Ratio

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.couplings import generated
    from polycnc.control.sinumerik.variables import in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.actions.run import Running
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.curve_tables.curve import CurveTable
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.transformation.couplings.laws import Law

MOST_LEADING = 2
#: Part of its acceleration with which an axis brakes that is led no more; speeds of many digits are equal.
BRAKING_PART, _ROUNDING = 0.5, 1e-3
#: How far an axis may be from its place when it begins to follow.
_TOLERANCE = "$MA_COUPLE_POS_TOL_COARSE"


def _pair(run: Running, name: str, args: Arguments, least: int, most: int) -> tuple[int, int]:
    if not least <= len(args) <= most or None in args[:least]:
        raise AlarmError("14020", text=name)
    following, leading = (arguments.column(run.channel, axis) for axis in args[:2])
    if following == leading:
        raise AlarmError("16785", axis=run.channel.axes[following])
    if Couplings.of(run.channel).links:
        raise not_supported(f"DO {name}: TRAILON LEADON EGON")
    return following, leading


@dataclass(slots=True)
class Led:
    """An axis that a table leads.

    Attributes:
        leading: Column of the leading axis.
        table: The table.
        gap: How far its place is from where it stands, while it waits for that; None once it follows.
    """

    leading: int
    table: CurveTable
    gap: float | None


@dataclass(slots=True)
class LedAxes(PassiveWatcher, State, lifetime=Lifetime.RESET):
    """Axes that tables lead by LEADON of actions; satisfies the channel's `Watcher`.

    Attributes:
        channel: Whose axes they are.
        led: By the column of the following axis.
        guarded: All axes that actions couple, by tables and by ratios: program and line of the action by column.
    """

    channel: Channel[Any, Any, Any]
    led: dict[int, Led] = field(default_factory=dict)
    guarded: dict[int, tuple[str, int]] = field(default_factory=dict)

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> LedAxes:
        """None is led."""
        return cls(channel)

    def begin(self, following: int, leading: int, table: CurveTable, *, at_once: bool) -> None:
        """A table leads an axis: where it is at its place or goes there at once, else when that comes to it."""
        self.let_go(following)
        CurveTables.of(self.channel).use(table.number)
        gap = self._gap(following, leading, table)
        self.led[following] = Led(leading, table, gap)
        if at_once or self._is_near(following, gap):
            self._synchronise(following)

    def guard(self, run: Running, following: int) -> None:
        """An action couples an axis: from now on it is kept within its travel and its speed."""
        self.guarded[following] = run.action.code.program, run.action.code.line
        self.channel.on_clock().watch(self)

    def let_go(self, following: int) -> None:
        """No table leads an axis any more, or none that it waits for."""
        led = self.led.pop(following, None)
        if led is not None:
            CurveTables.of(self.channel).leave(led.table.number)

    def _gap(self, following: int, leading: int, table: CurveTable) -> float:
        clocked = self.channel.on_clock()
        return table.followed(clocked.machine(leading)).place - clocked.machine(following)

    def _is_near(self, following: int, gap: float) -> bool:
        tolerance: float = self.channel.memory.data.number(_TOLERANCE, self.channel.axes[following])
        return abs(gap) <= tolerance

    def _synchronise(self, following: int) -> None:
        """The table leads an axis from where that is; it goes to its place by itself."""
        led, clocked = self.led[following], self.channel.on_clock()
        wanted = led.table.followed(clocked.machine(led.leading)).place
        led.gap = None
        _follow(self.channel, following, [ByCurve(led.leading, led.table, wanted)])
        if abs(wanted - clocked.machine(following)) > NO_WAY:
            clocked.commanded(following).move_to(wanted, self.channel.axis_data[following].rapid)

    def look(self) -> None:
        """An interpolation cycle: a place may have come to its axis, an axis to the end of what it can do."""
        for following, place in tuple(self.guarded.items()):
            error = self._excess(following)
            if error is not None:
                self.let_go(following)
                _follow(self.channel, following, [])
                self.channel.on_clock().fail(error, program=place[0], line=place[1])
        for following, led in tuple(self.led.items()):
            if led.gap is None:
                continue
            before, led.gap = led.gap, self._gap(following, led.leading, led.table)
            if before * led.gap <= 0.0 or self._is_near(following, led.gap):
                self._synchronise(following)

    def _excess(self, following: int) -> AlarmError | None:
        """The alarm of an axis that could not brake within its travel any more, or is too fast."""
        clocked, channel = self.channel.on_clock(), self.channel
        if not clocked.led_by(following):
            return None
        axis, speed = channel.axis_data[following], clocked.speed(following)
        if axis.rapid and abs(speed) > axis.rapid * (1.0 + _ROUNDING):
            return AlarmError("25030", axis=channel.axes[following])
        braked = speed * abs(speed) / (2.0 * BRAKING_PART * axis.acceleration) if axis.acceleration else 0.0
        ahead = clocked.machine(following) + speed * clocked.cycle_s + braked
        return action_axes.beyond(channel, following, ahead) if speed else None

    def block_begins(self) -> None:
        """An axis waits over the ends of blocks."""
        self.look()

    @property
    def is_quiet(self) -> bool:
        """No place can come to its axis, and no coupled one moves."""
        return not self.guarded or self.channel.on_clock().is_still

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, and with it what its actions couple."""
        self.guarded.clear()
        for following in tuple(self.led):
            self.let_go(following)


def waits_for_place(channel: SinumerikChannel, following: int) -> bool:
    """Whether an axis waits until its place on a table comes to it."""
    led = LedAxes.of(channel).led.get(following)
    return led is not None and led.gap is not None


def _follow(
    channel: SinumerikChannel, following: int, laws: Sequence[Law], *, catches_up: bool = True
) -> None:
    try:
        channel.on_clock().follow(following, laws, catches_up=catches_up)
    except CircularCouplingError as error:
        raise AlarmError("16778", axis=channel.axes[error.column]) from None
    ActionAxes.of(channel).states[following] = action_axes.COMMANDED
    in_force.refresh(channel)


def trail(run: Running, args: Arguments) -> None:
    """TRAILON(following,leading[,factor])."""
    following, leading = _pair(run, "TRAILON", args, 2, 3)
    factor = 1.0 if len(args) < 3 or args[2] is None else arguments.real(args[2])
    laws = run.clocked.led_by(following)
    if any(isinstance(law, Ratio) and (law.leading, law.factor) == (leading, factor) for law in laws):
        return
    others = [law for law in laws if law.leading != leading or not isinstance(law, Ratio)]
    if len(others) >= MOST_LEADING:
        raise AlarmError("16779", axis=run.channel.axes[following])
    origin = run.clocked.machine(leading)
    _follow(run.channel, following, [*others, Ratio(leading, factor, origin)], catches_up=False)
    LedAxes.of(run.channel).guard(run, following)
    run.changed = True


def lead(run: Running, args: Arguments) -> None:
    """LEADON(following,leading,n[,overwrite]): the axis goes to its place as fast as it can, and follows from there.

    An axis that is farther from its place than MD37200 says waits for that. Overwrite 1 lets another table act at once
    (10.4.22); else an axis that is led already stays with its table.
    """
    following, leading = _pair(run, "LEADON", args, 3, 4)
    table = table_of(run.channel, arguments.whole(args[2]))
    overwrites = len(args) > 3 and args[3] is not None and bool(arguments.whole(args[3]))
    if generated.is_generated(run.channel, leading):
        _lead_by_value(run, following, leading, table, overwrites=overwrites)
        return
    axes = LedAxes.of(run.channel)
    led = axes.led.get(following)
    if led is not None and (not overwrites or (led.leading == leading and led.table is table)):
        return
    axes.guard(run, following)  # and the end of the program lets go of the table
    axes.begin(following, leading, table, at_once=overwrites)
    run.changed = True


def _lead_by_value(
    run: Running, following: int, leading: int, table: CurveTable, *, overwrites: bool
) -> None:
    """LEADON of an axis whose master value programs and actions write (`$SA_LEAD_TYPE` 2)."""
    follower = generated.MasterValues.of(run.channel).led.get(following)
    same = follower is not None and (follower.leading, follower.table) == (leading, table)
    if same or (follower is not None and not overwrites):
        return
    generated.lead_now(run.channel, following, leading, table, at_once=overwrites)
    ActionAxes.of(run.channel).states[following] = action_axes.COMMANDED
    in_force.refresh(run.channel)
    run.changed = True


def _end(kind: type, name: str) -> Callable[[Running, Arguments], None]:
    """TRAILOF, LEADOF(following[,leading[,leading 2]]): the axis stays where it is."""

    def end(run: Running, args: Arguments) -> None:
        if not 1 <= len(args) <= 3 or args[0] is None:
            raise AlarmError("14020", text=name)
        following, *leading = (arguments.column(run.channel, axis) for axis in args if axis is not None)
        axes = LedAxes.of(run.channel)
        led = axes.led.get(following)
        follower = generated.MasterValues.of(run.channel).led.get(following)
        if kind is ByCurve and follower is not None and (not leading or follower.leading in leading):
            generated.leave_now(run.channel, following)
            run.changed = True
            return
        if kind is ByCurve and led is not None and (not leading or led.leading in leading):
            axes.let_go(following)
        laws = run.clocked.led_by(following)
        stay = [law for law in laws if not isinstance(law, kind) or (leading and law.leading not in leading)]
        if len(stay) != len(laws):
            _follow(run.channel, following, stay)
            run.changed = True

    return end


PROCEDURES = {
    "TRAILON": trail,
    "TRAILOF": _end(Ratio, "TRAILOF"),
    "LEADON": lead,
    "LEADOF": _end(ByCurve, "LEADOF"),
}
