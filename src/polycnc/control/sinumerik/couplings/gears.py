"""Electronic gears: EGDEF, EGON, EGONSYN, EGONSYNE, EGOFS, EGOFC, EGDEL (job planning 9.4).

A following axis goes, beside its own way, those of up to five leading axes, each times its ratio or by a curve table.
Synchronised gears lead it to its place first, beside the path, if the machine's controller enables that. What a spindle
leads goes beside the path altogether. A leading spindle is told from a leading axis by its negative number.
"""

from __future__ import annotations

from functools import partial
from math import inf

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import ModuloRange
from polycnc.control.sinumerik.couplings import switching
from polycnc.control.sinumerik.couplings.approach import approach
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link, places
from polycnc.control.sinumerik.couplings.spindle_pairs import turns
from polycnc.control.sinumerik.curve_tables import definition as curve_definition
from polycnc.control.sinumerik.curve_tables.memory import table_of
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.variables import in_force
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed
from polycnc.transformation.couplings.laws import ByCurve, Ratio

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.channel.interpolator import Interpolator
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel

MOST_LEADING = 5
#: Speed of an axis without limit, degrees/s; part of its speed at which a spindle may lead it: it has to catch up too.
LARGE, LED_PART = 1e9, 0.8
#: When the block of a gear ends.
AT_ONCE = "NOC"
BLOCK_CHANGES = frozenset((AT_ONCE, "FINE", "COARSE", "IPOSTOP"))
#: Ways of approach: to the next tooth gap; to the place itself by the shorter way, downwards, upwards.
TOOTH_GAPS, SHORTEST, DOWN, UP = frozenset(("NTGT", "NTGP")), frozenset(("DCT", "DCP")), "ACN", "ACP"


class Wheel(NamedTuple):
    """A leading axis of a call.

    Attributes:
        leading: Its column.
        synchronous: Its synchronous place; None without one.
        numerator: Numerator of the ratio, or number of a curve table.
        denominator: Denominator, 0 for a curve table.
    """

    leading: int
    synchronous: float | None
    numerator: float
    denominator: float


@dataclass(slots=True)
class Gear:
    """A gear that EGDEF has defined.

    Attributes:
        types: What each leading axis leads by, by its column in the order of definition: 0 actual value, 1 setpoint.
        wheels: What it was switched on with, by the column of the leading axis.
        place: Synchronous place of the following axis.
        block_change: When the block that switched it on ended.
        beside: It is on, and a spindle leads it: beside the path, or as a spindle itself.
    """

    types: dict[int, int]
    wheels: dict[int, Wheel] = field(default_factory=dict)
    place: float = 0.0
    block_change: str = ""
    beside: bool = False

    @property
    def ratio_to_spindle(self) -> float:
        """Degrees for one of the spindle that leads it; 0 where none does."""
        ratios = (wheel.numerator / wheel.denominator for wheel in self.wheels.values() if wheel.leading < 0)
        return sum(ratios) if self.beside else 0.0


@dataclass(slots=True)
class Gears(State, lifetime=Lifetime.POWER):
    """Gears that are defined, by the column of the following axis, or the number of the following spindle, negative."""

    defined: dict[int, Gear] = field(default_factory=dict)


def define(channel: SinumerikChannel, args: Arguments) -> None:
    """EGDEF(following,leading 1,type 1,…): types 0 actual value, 1 setpoint; a preprocessing stop.

    Raises:
        AlarmError: 16797 for an axis that follows already, or has a gear; 16779 for more than five leading axes.
    """
    if len(args) < 3 or not len(args) % 2 or None in args:
        raise AlarmError("14020", text="EGDEF")
    following, leading = _column(channel, args[0]), [key_of(channel, axis) for axis in args[1::2]]
    if any(arguments.whole(type_) not in (0, 1) for type_ in args[2::2]) or len(set(leading)) < len(leading):
        raise AlarmError("14020", text="EGDEF")
    if len(leading) > MOST_LEADING:
        raise AlarmError("16779", axis=channel.axes[following])
    if following in leading:
        raise AlarmError("16785", axis=channel.axes[following])
    if following in Gears.of(channel).defined or following in Couplings.of(channel).links:
        raise AlarmError("16797", axis=channel.axes[following])
    stop(channel, "EGDEF")
    types = map(arguments.whole, args[2::2])
    Gears.of(channel).defined[following] = Gear(dict(zip(leading, types, strict=True)))


def delete(channel: SinumerikChannel, args: Arguments) -> None:
    """EGDEL(following): its definition is no more; 16797 while it is on. A preprocessing stop."""
    following = _following(channel, "EGDEL", args, only=True)
    if is_on(channel, following):
        raise AlarmError("16797", axis=channel.axes[following])
    stop(channel, "EGDEL")
    Gears.of(channel).defined.pop(following, None)


def switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """EGON(following,block change,leading,numerator,denominator,…): from where the axes are."""
    following = _begin(channel, "EGON", args)
    wheels = list(wheels_of(channel, "EGON", following, args[2:], width=3))
    switching.begin(channel, "EGON")
    _engage(channel, following, wheels)


def switch_on_in_place(channel: SinumerikChannel, args: Arguments) -> None:
    """EGONSYN(following,block change,synchronous place,leading,its synchronous place,numerator,denominator,…)."""
    following = _begin(channel, "EGONSYN", args)
    _synchronise(channel, "EGONSYN", following, args[2], "", args[3:])


def switch_on_by_approach(channel: SinumerikChannel, args: Arguments) -> None:
    """EGONSYNE(following,block change,synchronous place,approach,leading,…): of turning axes, by a way of approach."""
    following = _begin(channel, "EGONSYNE", args)
    how = str(args[3]).upper() if len(args) > 3 else ""
    if how not in {*TOOTH_GAPS, *SHORTEST, DOWN, UP}:
        raise AlarmError("16795", text=how)
    _synchronise(channel, "EGONSYNE", following, args[2], how, args[4:])


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """EGOFS(following[,leading,…]): the gear ends, or leading axes are taken out of it; a preprocessing stop."""
    following = _following(channel, "EGOFS", args)
    leading = [key_of(channel, axis) for axis in args[1:]]
    stop(channel, "EGOFS")
    gear = Gears.of(channel).defined.get(following)
    if gear is not None and gear.beside:
        _leave_beside(channel, following, gear, leading)
        return
    switching.begin(channel, "EGOFS")
    links = Couplings.of(channel).links.get(following, [])
    stay = [
        link for link in links if link.kind is not Kind.GEAR or (leading and link.law.leading not in leading)
    ]
    if len(stay) != len(links):
        switching.change(channel, following, stay)


def leave_turning(channel: SinumerikChannel, args: Arguments) -> None:
    """EGOFC: of spindles alone; 14020 for an axis."""
    _following(channel, "EGOFC", args, only=True)
    raise AlarmError("14020", text="EGOFC")


# ---- calls


def _column(channel: SinumerikChannel, value: Any) -> int:
    """Column of a following axis; PC0001 for a spindle."""
    if isinstance(value, Axis) and spindle_number(value) is not None:
        raise not_supported(f"EG {value.name}")
    return arguments.column(channel, value)


def key_of(channel: SinumerikChannel, value: Any) -> int:
    """Column of a leading axis, or the number of a leading spindle, negative."""
    number = spindle_number(value) if isinstance(value, Axis) else None
    return arguments.column(channel, value) if number is None else -channel.memory.spindles.get(number).number


def name_of(channel: SinumerikChannel, key: int) -> str:
    """Name of a leading axis or spindle."""
    return channel.axes[key] if key >= 0 else f"S{-key}"


def is_on(channel: SinumerikChannel, following: int) -> bool:
    """Whether a gear leads an axis."""
    gear = Gears.of(channel).defined.get(following)
    return bool(Couplings.of(channel).of_kind(following, Kind.GEAR)) or (gear is not None and gear.beside)


def _following(channel: SinumerikChannel, name: str, args: Arguments, *, only: bool = False) -> int:
    if not args or None in args or (only and len(args) > 1):
        raise AlarmError("14020", text=name)
    return _column(channel, args[0])


def stop(channel: SinumerikChannel, name: str) -> None:
    """A preprocessing stop of a word; 10942 in a curve table."""
    curve_definition.refuse(channel, name)
    channel.flush()
    channel.synchronise()


def _begin(channel: SinumerikChannel, name: str, args: Arguments) -> int:
    """What all ways to switch a gear on check: 16796 without a definition, 16797 where it is on, 16795 for a mode."""
    if len(args) < 5 or None in args:
        raise AlarmError("14020", text=name)
    following = _column(channel, args[0])
    if str(args[1]).upper() not in BLOCK_CHANGES:
        raise AlarmError("16795", text=str(args[1]))
    gear = Gears.of(channel).defined.get(following)
    if gear is None:
        raise AlarmError("16796", axis=channel.axes[following])
    if is_on(channel, following):
        raise AlarmError("16797", axis=channel.axes[following])
    gear.block_change = str(args[1]).upper()
    return following


def wheels_of(
    channel: SinumerikChannel, name: str, following: int, args: Sequence[Any], *, width: int
) -> Iterator[Wheel]:
    """The leading axes of a call; 16796 for one that the definition does not name, 14020 for one twice."""
    if not args or len(args) % width:
        raise AlarmError("14020", text=name)
    seen: set[int] = set()
    for k in range(0, len(args), width):
        leading = key_of(channel, args[k])
        if leading in seen:
            raise AlarmError("14020", text=name)
        seen.add(leading)
        if leading not in Gears.of(channel).defined[following].types:
            raise AlarmError("16796", axis=name_of(channel, leading))
        numerator, denominator = (arguments.real(value) for value in args[k + width - 2 : k + width])
        place = None if width == 3 else _place(channel, leading, args[k + 1])
        if not denominator:
            table_of(channel, arguments.whole(numerator))
        yield Wheel(leading, place, numerator, denominator)


def _place(channel: SinumerikChannel, column: int, value: Any) -> float:
    """A place of an axis as the program writes it."""
    turning = column < 0 or channel.memory.axes[column].rotary
    return arguments.real(value) * (1.0 if turning else length_factor(channel.mode))


# ---- motion


def _link(channel: SinumerikChannel, wheel: Wheel, place: float) -> Link:
    """What a leading axis does from a place on."""
    if wheel.denominator:
        return Link(Kind.GEAR, Ratio(wheel.leading, wheel.numerator / wheel.denominator, place))
    table = table_of(channel, int(wheel.numerator))
    return Link(Kind.GEAR, ByCurve(wheel.leading, table, table.followed(place).place), table.number)


def _engage(
    channel: SinumerikChannel, following: int, wheels: Sequence[Wheel], place: float | None = None
) -> None:
    """The gear is on; `place` is the synchronous place of the following axis, by default where it is."""
    machine = places(channel)
    gear = Gears.of(channel).defined[following]
    if any(wheel.leading < 0 for wheel in wheels):
        _engage_beside(channel, following, wheels)
        gear.beside = True
    else:
        links = [
            link for link in Couplings.of(channel).links.get(following, []) if link.kind is not Kind.GEAR
        ]
        links += [_link(channel, wheel, machine[wheel.leading]) for wheel in wheels]
        switching.change(channel, following, links)
    gear.place = machine[following] if place is None else place
    gear.wheels = {
        wheel.leading: wheel
        if wheel.synchronous is not None
        else wheel._replace(synchronous=_here(channel, machine, wheel.leading))
        for wheel in wheels
    }
    if gear.beside:
        _bound_spindles(channel)


def _synchronise(
    channel: SinumerikChannel, name: str, following: int, place: Any, how: str, args: Sequence[Any]
) -> None:
    """The axis goes to its place, and the gear is on from there."""
    wheels = list(wheels_of(channel, name, following, args, width=4))
    switching.begin(channel, name)
    for wheel in wheels:
        if wheel.leading < 0 and (turns(channel, -wheel.leading) or not wheel.denominator):
            raise not_supported(f"{name} {name_of(channel, wheel.leading)}: M3, M4")
    here = places(channel)
    wanted = _place(channel, following, place)
    target = _target(channel, following, wanted, wheels, how)
    approach(channel, following, target - here[following])
    _engage(channel, following, wheels, wanted)


def _target(
    channel: SinumerikChannel, following: int, place: float, wheels: Sequence[Wheel], how: str
) -> float:
    """Where the following axis belongs now: of all places that are in step, the one that the approach asks for."""
    machine, axes, data = places(channel), channel.memory.axes, channel.memory.data
    target, pitches = place, []
    for wheel in wheels:
        assert wheel.synchronous is not None
        now = _here(channel, machine, wheel.leading)
        if wheel.leading < 0:
            target += wheel.numerator / wheel.denominator * (now - wheel.synchronous)
            pitches.append(abs(tables.TURN * wheel.numerator / wheel.denominator))
            continue
        if axes[wheel.leading].modulo:
            turn = ModuloRange.of(data, axes[wheel.leading].name)
            now = turn.shown(now)
            if wheel.denominator:
                pitches.append(abs(turn.length * wheel.numerator / wheel.denominator))
        link = _link(channel, wheel, wheel.synchronous)
        target += link.law.share(now)
    if not axes[following].modulo:
        return target
    circle = ModuloRange.of(data, axes[following].name).length
    way = (target - machine[following]) % circle
    if how == DOWN:
        return machine[following] + way - (circle if way else 0.0)
    if how == UP:
        return machine[following] + way
    step = circle if how in SHORTEST or not pitches else min([circle, *(pitch for pitch in pitches if pitch)])
    way %= step
    return machine[following] + (way if way <= step / 2.0 else way - step)


def _here(channel: SinumerikChannel, machine: Sequence[float], key: int) -> float:
    """Where a leading axis is, or a spindle that stands."""
    return machine[key] if key >= 0 else channel.memory.spindles.get(-key).position


# ---- beside the path


def _engage_beside(channel: SinumerikChannel, following: int, wheels: Sequence[Wheel]) -> None:
    """A spindle leads the axis: it goes beside the path, with those of the path that lead it too.

    Raises:
        AlarmError: PC0001 for a curve table, or beside another coupling.
    """
    for wheel in wheels:
        if wheel.leading < 0 and not wheel.denominator:
            raise not_supported(f"EGON {name_of(channel, wheel.leading)}")
    clocked = channel.on_clock()
    channel.control.system_variable(in_force.SPEED)
    in_force.watch(channel, (in_force.SPEED,))
    action_axes.expect(channel, (following,))
    ActionAxes.of(channel).geared.add(following)
    _lead(channel, clocked, following, wheels)


def _lead(channel: SinumerikChannel, clocked: Interpolator, following: int, wheels: Sequence[Wheel]) -> None:
    """These lead the axis from here on in the order of the blocks; it stands behind the last one.

    The block ends when the axis has caught up with what turns, unless it changes at once (NOC).
    """
    gear = Gears.of(channel).defined[following]
    machine, at_once = channel.coordinates.machine, gear.block_change == AT_ONCE
    laws = [_link(channel, wheel, machine[wheel.leading]).law for wheel in wheels if wheel.leading >= 0]
    spindles = {-wheel.leading: wheel.numerator / wheel.denominator for wheel in wheels if wheel.leading < 0}

    def do() -> None:
        clocked.follow(following, laws, spindles, partial(_speed, channel))

    def moves() -> bool:
        axis = clocked.commanded(following)
        return axis.is_turning and not at_once if wheels else axis.moves

    channel.event(Deed("EGON", None, do, is_silent=False, awaits=moves))


def _speed(channel: SinumerikChannel, number: int, override: float) -> float:
    """What a spindle turns with in the block in execution, as far as axes that it leads can follow."""
    most = channel.memory.spindles.get(number).most
    return max(-most, min(most, override * in_force.turning(channel, number)))


def _leave_beside(channel: SinumerikChannel, following: int, gear: Gear, leading: Sequence[int]) -> None:
    """Some leading axes or spindles lead no more, all where none is named; where none is left the axis brakes."""
    stay = [wheel for key, wheel in gear.wheels.items() if leading and key not in leading]
    if PathFeed.of(channel).axis == following and not any(wheel.leading < 0 for wheel in stay):
        raise not_supported(f"EGOFS: FPR({channel.axes[following]})")  # the path would wait for ever
    gear.wheels, gear.beside = {wheel.leading: wheel for wheel in stay}, bool(stay)
    clocked = channel.on_clock()
    action_axes.expect(channel, (following,))
    _lead(channel, clocked, following, stay)
    if not stay:
        ActionAxes.of(channel).geared.discard(following)
    _bound_spindles(channel)


def _bound_spindles(channel: SinumerikChannel) -> None:
    """Spindles that lead axes turn no faster than these can follow; what the axes go by the path is not looked at."""
    most = dict.fromkeys(channel.memory.spindles.all, inf)
    for column, gear in Gears.of(channel).defined.items():
        for key, wheel in gear.wheels.items() if gear.beside and column >= 0 else ():
            if key < 0 and wheel.numerator:
                top = LED_PART * (channel.axis_data[column].rapid or LARGE)
                degrees = top * abs(wheel.denominator / wheel.numerator)
                most[-key] = min(most[-key], degrees * tables.MINUTE / tables.TURN)
    for number, spindle in channel.memory.spindles.all.items():
        spindle.most = most[number]
    channel.context_changed()
