"""Words of electronic gears, of axes and of spindles that follow (job planning 9.4).

A following spindle is a pair of spindles (`spindle_pairs.py`): it turns with its leading one times the ratio.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings import gears, spindle_pairs, synchronous
from polycnc.control.sinumerik.couplings.gears import BLOCK_CHANGES, Gear, Gears, key_of, name_of
from polycnc.control.sinumerik.couplings.spindle_pairs import Pair, SpindlePairs, turns
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel


def _define(channel: SinumerikChannel, args: Arguments) -> None:
    """EGDEF(spindle,leading spindle,type).

    Raises:
        AlarmError: 16785 and 16778 for a spindle that would lead itself, 16797 for one that follows already, PC0001 for
            a leading axis, or several leading spindles.
    """
    if (
        len(args) < 3
        or not len(args) % 2
        or None in args
        or any(arguments.whole(type_) not in (0, 1) for type_ in args[2::2])
    ):
        raise AlarmError("14020", text="EGDEF")
    following, *leading = (key_of(channel, value) for value in (args[0], *args[1::2]))
    if len(leading) != 1 or leading[0] >= 0:
        raise not_supported(f"EGDEF {name_of(channel, following)}")
    spindle_pairs.refuse_ring(channel, -following, -leading[0])
    if following in Gears.of(channel).defined or -following in SpindlePairs.of(channel).by_following:
        raise AlarmError("16797", axis=name_of(channel, following))
    gears.stop(channel, "EGDEF")
    Gears.of(channel).defined[following] = Gear({leading[0]: arguments.whole(args[2])})


def _switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """EGON(spindle,block change,leading spindle,numerator,denominator).

    Raises:
        AlarmError: 16796 without a definition, 16797 where it is on, 16795 for a block change, PC0001 for a table.
    """
    if len(args) != 5 or None in args:
        raise AlarmError("14020", text="EGON")
    following = key_of(channel, args[0])
    gear, change = Gears.of(channel).defined.get(following), str(args[1]).upper()
    if change not in BLOCK_CHANGES:
        raise AlarmError("16795", text=str(args[1]))
    if gear is None:
        raise AlarmError("16796", axis=name_of(channel, following))
    if gear.beside or -following in SpindlePairs.of(channel).by_following:
        raise AlarmError("16797", axis=name_of(channel, following))
    (wheel,) = gears.wheels_of(channel, "EGON", following, args[2:], width=3)
    if not wheel.denominator or not wheel.numerator:
        raise not_supported(f"EGON {name_of(channel, following)}: {wheel.numerator:g}, {wheel.denominator:g}")
    spindle_pairs.refuse_ring(channel, -following, -wheel.leading)
    pair = Pair(-wheel.leading, wheel.numerator, wheel.denominator, change, is_gear=True)
    before, pair.offset = turns(channel, -following), spindle_pairs.offset_of(channel, -following, pair)
    pair.acts = True
    SpindlePairs.of(channel).by_following[-following] = pair
    gear.beside, gear.block_change, gear.wheels = True, change, {wheel.leading: wheel}
    synchronous.settles(channel, pair, spindle_pairs.seconds_to(channel, -following, before))
    if change != "NOC":
        synchronous.await_synchronism(channel, -following, pair)
    channel.context_changed()


def _switch_off(name: str, channel: SinumerikChannel, args: Arguments, *, stops: bool) -> None:
    """EGOFS(spindle[,leading spindle]): it stops; EGOFC(spindle): it goes on with the speed that it has."""
    following = key_of(channel, args[0])
    gear = Gears.of(channel).defined.get(following)
    if len(args) > (2 if stops else 1):
        raise AlarmError("14020", text=name)
    gears.stop(channel, name)
    if gear is None or not gear.beside or (len(args) > 1 and key_of(channel, args[1]) not in gear.wheels):
        return
    pair = SpindlePairs.of(channel).by_following[-following]
    synchronous.leave(channel, -following, pair, stops=stops)
    del SpindlePairs.of(channel).by_following[-following]
    gear.beside = False


def _delete(channel: SinumerikChannel, args: Arguments) -> None:
    """EGDEL(spindle): its definition is no more; 16797 while it is on."""
    following = key_of(channel, args[0])
    gear = Gears.of(channel).defined.get(following)
    if len(args) > 1:
        raise AlarmError("14020", text="EGDEL")
    if gear is not None and gear.beside:
        raise AlarmError("16797", axis=name_of(channel, following))
    gears.stop(channel, "EGDEL")
    Gears.of(channel).defined.pop(following, None)


def _in_place(name: str, channel: SinumerikChannel, args: Arguments) -> None:
    """EGONSYN and EGONSYNE of a spindle: PC0001."""
    raise not_supported(f"{name} {name_of(channel, key_of(channel, args[0]))}")


def _of_spindle_or_axis(of_spindle: Procedure, of_axis: Procedure) -> Procedure:
    """What a word does: by whether a spindle follows."""

    def run(channel: SinumerikChannel, args: Arguments) -> None:
        named = args[0] if args else None
        follows = isinstance(named, Axis) and spindle_number(named) is not None
        (of_spindle if follows else of_axis)(channel, args)

    return run


PROCEDURES: dict[str, Procedure] = {
    name: _of_spindle_or_axis(of_spindle, of_axis)
    for name, of_spindle, of_axis in (
        ("EGDEF", _define, gears.define),
        ("EGDEL", _delete, gears.delete),
        ("EGON", _switch_on, gears.switch_on),
        ("EGONSYN", partial(_in_place, "EGONSYN"), gears.switch_on_in_place),
        ("EGONSYNE", partial(_in_place, "EGONSYNE"), gears.switch_on_by_approach),
        ("EGOFS", partial(_switch_off, "EGOFS", stops=True), gears.switch_off),
        ("EGOFC", partial(_switch_off, "EGOFC", stops=False), gears.leave_turning),
    )
}
