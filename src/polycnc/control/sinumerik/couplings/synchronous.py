"""Synchronous spindles: COUPDEF, COUPON, COUPONC, COUPOF, COUPOFS, COUPRES, COUPDEL, WAITC (job planning 9.5).

Set points, actual values and speeds are the same where nothing lags, so the three types of coupling act alike. The time
in which the following spindle gets to its speed passes where the block change or WAITC waits for it. Switch-off
positions are passed within a turn, which takes no time here.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.couplings import spindle_pairs
from polycnc.control.sinumerik.couplings.spindle_pairs import Pair, SpindlePairs, turns
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tables import TURN
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError
from polycnc.toolpath.events import SpindleWait

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.variables.clock import Clock

if TYPE_CHECKING:
    from collections.abc import Collection

    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle

#: When the block of a coupling ends; two letters suffice.
BLOCK_CHANGES = {name[:2]: name for name in ("NOC", "FINE", "COARSE", "IPOSTOP")}
TYPES = frozenset(("DV", "AV", "VV"))
#: Pairs that a channel can have switched on at once.
MOST_PAIRS = 2


def define(channel: SinumerikChannel, args: Arguments) -> None:
    """COUPDEF(following,leading,numerator,denominator,block change,type): what is left out stays as it is.

    Raises:
        AlarmError: 14020 and 16795 for a wrong argument, 16785 and 16778 for a spindle that would lead itself; while
            the coupling is on, 16797 for another leading spindle and 16787 for another type.
    """
    following, leading = (_spindle(channel, "COUPDEF", value) for value in _padded(args, 2)[:2])
    numerator, denominator, change, type_ = _padded(args, 6)[2:]
    spindle_pairs.refuse_ring(channel, following, leading)
    pairs = SpindlePairs.of(channel).by_following
    before = pairs.get(following)
    pair = Pair(leading)
    if before is not None and before.leading == leading and before.is_synchronous:
        pair = before
    elif before is not None and before.acts:
        raise AlarmError("16797", axis=f"S{following}")
    wanted = pair.type if type_ is None else str(type_).upper()
    if wanted not in TYPES:
        raise AlarmError("16795", text=wanted)
    if pair.acts and wanted != pair.type:
        raise AlarmError("16787", axis=f"S{following}")
    ratio = pair.numerator, pair.denominator
    if numerator is not None:
        ratio = arguments.real(numerator), 1.0 if denominator is None else arguments.real(denominator)
    elif denominator is not None:
        ratio = pair.numerator, arguments.real(denominator)
    if not all(ratio):
        raise AlarmError("14020", text="COUPDEF")
    if change is not None:
        pair.block_change = _block_change(change)
    (pair.numerator, pair.denominator), pair.type = ratio, wanted
    if pair.acts:
        pair.offset = spindle_pairs.offset_of(channel, following, pair)
    pairs[following] = pair
    channel.context_changed()


def switch_on(name: str, channel: SinumerikChannel, args: Arguments, *, takes_over: bool) -> None:
    """COUPON(following[,leading[,offset]]); COUPONC takes over the programmed speed as a difference.

    Raises:
        AlarmError: 16796 without a definition, 16792 for a third pair, 16778 for a spindle that would lead itself.
    """
    following, pair = _defined(channel, name, args)
    offset = _angle(name, _padded(args, 3)[2])
    others = [each for each in SpindlePairs.of(channel).by_following.values() if each is not pair]
    if sum(each.acts and each.is_synchronous for each in others) >= MOST_PAIRS:
        raise AlarmError("16792", axis=f"S{following}")
    spindle_pairs.refuse_ring(channel, following, pair.leading)
    before, stood = turns(channel, following), spindle_pairs.offset_of(channel, following, pair)
    pair.overlaid = takes_over and not channel.memory.spindles.get(following).controlled
    pair.acts = True
    pair.offset = stood if offset is None else offset
    if not turns(channel, following):
        spindle_pairs.stand(channel, following, pair)
    settles(channel, pair, spindle_pairs.seconds_to(channel, following, before))
    if pair.block_change != "NOC":
        await_synchronism(channel, following, pair)
    channel.context_changed()


def switch_off(name: str, channel: SinumerikChannel, args: Arguments, *, stops: bool, most: int) -> None:
    """COUPOF(following[,leading[,position[,position of the leading one]]]): the speed stays; COUPOFS stops it.

    Raises:
        AlarmError: PC0013 for switch-off positions where the spindles stand elsewhere: the block would never end.
    """
    if len(args) > most:
        raise AlarmError("14020", text=name)
    following, pair = _defined(channel, name, args)
    if not pair.acts:
        return
    for number, value in zip((following, pair.leading), _padded(args, 4)[2:], strict=True):
        at = _angle(name, value)
        spindle = channel.memory.spindles.get(number)
        if at is not None and not turns(channel, number) and spindle.position != at:
            raise AlarmError("PC0013")
    leave(channel, following, pair, stops=stops)


def delete(channel: SinumerikChannel, args: Arguments) -> None:
    """COUPDEL(following[,leading]): the coupling ends, and its definition with it."""
    following, pair = _defined(channel, "COUPDEL", args)
    if pair.acts:
        leave(channel, following, pair, stops=False)
    del SpindlePairs.of(channel).by_following[following]


def reset(channel: SinumerikChannel, args: Arguments) -> None:
    """COUPRES(following[,leading]): ratio, block change and type are those delivered again."""
    following, pair = _defined(channel, "COUPRES", args)
    fresh = Pair(pair.leading)
    if pair.acts and pair.type != fresh.type:
        raise AlarmError("16787", axis=f"S{following}")
    pair.numerator, pair.denominator = fresh.numerator, fresh.denominator
    pair.block_change, pair.type = fresh.block_change, fresh.type
    channel.context_changed()


def wait(channel: SinumerikChannel, args: Arguments) -> None:
    """WAITC([following[,block change[,following 2,block change]]]): what COUPDEF says where none is told.

    Raises:
        AlarmError: 16796 for a spindle without a definition.
    """
    pairs = SpindlePairs.of(channel).by_following
    if not args:
        for following, pair in pairs.items():
            await_synchronism(channel, following, pair)
        return
    for named, change in zip(args[::2], (*args, None)[1::2], strict=False):
        following, pair = _defined(channel, "WAITC", (named,))
        if change is not None:
            _block_change(change)
        await_synchronism(channel, following, pair)


# ---- words of a following spindle


def position(
    channel: SinumerikChannel, spindle: Spindle, value: float, modifier: str, *, awaited: bool
) -> None:
    """SPOS and the like; the block of SPOS ends where a following spindle has made its way beside the coupling."""
    way = spindle_pairs.place(channel, spindle, value, modifier)
    pair = SpindlePairs.of(channel).acting(spindle.number)
    if pair is None:
        return
    settles(channel, pair, spindle_pairs.seconds_for(channel, spindle.number, way))
    if awaited:
        await_synchronism(channel, spindle.number, pair)


def check_speed(channel: SinumerikChannel, number: int | None, beside: Collection[str]) -> None:
    """M3 or M4 of a following spindle need S in the same block: a difference speed has to be told (16111)."""
    spindles = channel.memory.spindles
    wanted = spindles.master if number is None else number
    pair = SpindlePairs.of(channel).acting(wanted)
    named = {f"S{wanted}", "S"} if wanted == spindles.master or number is not None else {"S"}
    if pair is not None and not pair.is_slave and named.isdisjoint(beside):
        raise AlarmError("16111", axis=f"S{wanted}")


def overlay(channel: SinumerikChannel, spindle: Spindle, before: float) -> None:
    """M3, M4, M5 or S of a following spindle, which has turned with `before` rpm: it says a difference speed.

    Raises:
        AlarmError: PC0001 for a slave of a master.
    """
    pair = SpindlePairs.of(channel).acting(spindle.number)
    if pair is None:
        return
    if pair.is_slave:
        raise not_supported(f"MASLON S{spindle.number}")
    pair.overlaid = True
    settles(channel, pair, spindle_pairs.seconds_to(channel, spindle.number, before))


# ---- what slaves of a master do as well


def leave(channel: SinumerikChannel, following: int, pair: Pair, *, stops: bool) -> None:
    """A pair opens: the spindle goes on by itself with the speed that it has, or stops."""
    speed, spindle = turns(channel, following), channel.memory.spindles.get(following)
    pair.acts = pair.overlaid = False
    if speed:
        spindle.speed, spindle.controlled = abs(speed), False
    spindle.direction = 0 if stops else (speed > 0.0) - (speed < 0.0)
    channel.context_changed()


def settles(channel: SinumerikChannel, pair: Pair, seconds: float) -> None:
    """From now on a spindle needs so long to be synchronous."""
    pair.settles_s, pair.since = seconds, (Clock.of(channel).waited, channel.toolpath.ways)


def await_synchronism(channel: SinumerikChannel, following: int, pair: Pair) -> None:
    """Wait for what is left of the time in which a spindle becomes synchronous; a move in between lasts that long."""
    waited, ways = Clock.of(channel).waited - pair.since[0], channel.toolpath.ways - pair.since[1]
    left = 0.0 if ways else pair.settles_s - waited
    pair.settles_s = 0.0
    if pair.acts and left > 0.0:
        channel.event(SpindleWait(following, left))
        Clock.of(channel).waited += left


# ---- arguments


def _padded(args: Arguments, count: int) -> Arguments:
    """Arguments with None for those that are left out."""
    return (*args, *[None] * count)[: max(count, len(args))]


def _spindle(channel: SinumerikChannel, name: str, value: Any) -> int:
    number = arguments.spindle(value)
    if number is None:
        raise AlarmError("14020", text=name)
    return channel.memory.spindles.get(number).number


def _defined(channel: SinumerikChannel, name: str, args: Arguments) -> tuple[int, Pair]:
    """The following spindle of a call and its pair; 16796 where no such pair is defined."""
    following = _spindle(channel, name, args[0] if args else None)
    pair = SpindlePairs.of(channel).by_following.get(following)
    leading = arguments.spindle(args[1]) if len(args) > 1 else None
    if pair is None or not pair.is_synchronous or (leading is not None and leading != pair.leading):
        raise AlarmError("16796", axis=f"S{following}")
    return following, pair


def _angle(name: str, value: Any) -> float | None:
    """A position of 0 to 359.999 degrees."""
    if value is None:
        return None
    angle = arguments.real(value)
    if not 0.0 <= angle < TURN:
        raise AlarmError("14020", text=name)
    return angle


def _block_change(value: Any) -> str:
    text = str(value).upper()
    full = BLOCK_CHANGES.get(text[:2], "")
    if text not in (full, full[:2]):
        raise AlarmError("16795", text=text)
    return full


PROCEDURES: dict[str, Procedure] = {
    "COUPDEF": define,
    "COUPON": partial(switch_on, "COUPON", takes_over=False),
    "COUPONC": partial(switch_on, "COUPONC", takes_over=True),
    "COUPOF": partial(switch_off, "COUPOF", stops=False, most=4),
    "COUPOFS": partial(switch_off, "COUPOFS", stops=True, most=3),
    "COUPDEL": delete,
    "COUPRES": reset,
    "WAITC": wait,
}
