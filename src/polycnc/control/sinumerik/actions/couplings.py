"""TRAILON, TRAILOF, LEADON, LEADOF of actions: axes that follow others beside the path (job planning 10.4.21, 10.4.22).

The main run adds what leading axes do to where the following axis stands, whatever moves them: path, action or overlay.
Its dynamic limits are not looked at. The program has the axis again behind TRAILOF or LEADOF.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.curve_tables.memory import table_of
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.variables import in_force
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.graph import CircularCouplingError
from polycnc.transformation.couplings.laws import ByCurve, Ratio

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.actions.run import Running
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.transformation.couplings.laws import Law

MOST_LEADING = 2
#: How far an axis may be from its place when it begins to follow.
_TOLERANCE = "$MA_COUPLE_POS_TOL_COARSE"


def _pair(run: Running, name: str, args: Arguments, least: int, most: int) -> tuple[int, int]:
    if not least <= len(args) <= most or None in args[:least]:
        raise AlarmError("14020", text=name)
    following, leading = (arguments.column(run.channel, axis) for axis in args[:2])
    if following == leading:
        raise AlarmError("16785", axis=run.channel.axes[following])
    if name == "LEADON" and run.channel.memory.data.integer("$SA_LEAD_TYPE", run.channel.axes[leading]) == 2:
        raise not_supported("DO LEADON: $SA_LEAD_TYPE=2")
    if Couplings.of(run.channel).links:
        raise not_supported(f"DO {name}: TRAILON LEADON EGON")
    return following, leading


def _follow(run: Running, following: int, laws: Sequence[Law]) -> None:
    states = ActionAxes.of(run.channel).states
    try:
        run.clocked.follow(following, laws)
    except CircularCouplingError as error:
        raise AlarmError("16778", axis=run.channel.axes[error.column]) from None
    states[following] = action_axes.COMMANDED
    in_force.refresh(run.channel)
    run.changed = True


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
    _follow(run, following, [*others, Ratio(leading, factor, run.clocked.machine(leading))])


def lead(run: Running, args: Arguments) -> None:
    """LEADON(following,leading,n[,overwrite]): the axis goes to its place as fast as it can, and follows from there.

    Overwrite 1 lets another table act at once (10.4.22); else an axis that follows already stays with its table.

    Raises:
        AlarmError: PC0001 for an axis that is farther from its place than MD37200 says, without overwrite.
    """
    following, leading = _pair(run, "LEADON", args, 3, 4)
    table = table_of(run.channel, arguments.whole(args[2]))
    overwrites = len(args) > 3 and args[3] is not None and bool(arguments.whole(args[3]))
    curves = [law for law in run.clocked.led_by(following) if isinstance(law, ByCurve)]
    if curves and not overwrites:
        return
    wanted = table.followed(run.clocked.machine(leading)).place
    if any(law.leading == leading and law.curve is table for law in curves):
        return
    off = abs(wanted - run.clocked.machine(following))
    if off > run.channel.memory.data.number(_TOLERANCE, run.channel.axes[following]) and not overwrites:
        raise not_supported(f"DO LEADON({run.channel.axes[following]}): CTAB")
    _follow(run, following, [ByCurve(leading, table, wanted)])
    if off > NO_WAY:
        speed = run.channel.axis_data[following].rapid
        run.clocked.commanded(following).move_to(wanted, speed)


def _end(kind: type, name: str) -> Callable[[Running, Arguments], None]:
    """TRAILOF, LEADOF(following[,leading[,leading 2]]): the axis stays where it is."""

    def end(run: Running, args: Arguments) -> None:
        if not 1 <= len(args) <= 3 or args[0] is None:
            raise AlarmError("14020", text=name)
        following, *leading = (arguments.column(run.channel, axis) for axis in args if axis is not None)
        laws = run.clocked.led_by(following)
        stay = [law for law in laws if not isinstance(law, kind) or (leading and law.leading not in leading)]
        if len(stay) != len(laws):
            _follow(run, following, stay)

    return end


PROCEDURES = {
    "TRAILON": trail,
    "TRAILOF": _end(Ratio, "TRAILOF"),
    "LEADON": lead,
    "LEADOF": _end(ByCurve, "LEADOF"),
}
