"""What a program reads of its couplings (job planning 9.1, 9.3, 9.4)."""

from __future__ import annotations

from polycnc.control.sinumerik.actions.couplings import waits_for_place
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import shown
from polycnc.control.sinumerik.couplings import generated, masters
from polycnc.control.sinumerik.couplings.gears import Gears, key_of, name_of
from polycnc.control.sinumerik.couplings.links import Couplings, Kind
from polycnc.control.sinumerik.couplings.spindle_pairs import SYNCHRONOUS, SpindlePairs
from polycnc.control.sinumerik.tables import MINUTE
from polycnc.control.sinumerik.tangential.definitions import coupling_state
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.couplings.gears import Gear
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, RowWithStop


def _acts(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_COUP_ACT[following]`: 4 synchronous spindle, 8 coupled motion, 16 master value, 32 gear; 0 none.

    Tangential control adds what `coupling_state` says.
    """
    named = indices[0] if indices else None
    number = spindle_number(named) if isinstance(named, Axis) else None
    if number is not None:
        pair = SpindlePairs.of(channel).acting(channel.memory.spindles.get(number).number)
        if pair is None or pair.is_slave:
            return 0
        return Kind.GEAR if pair.is_gear else SYNCHRONOUS
    column = arguments.column(channel, named)
    kinds = {link.kind for link in Couplings.of(channel).links.get(column, ())}
    clocked, gear = channel.actual.clocked, Gears.of(channel).defined.get(column)
    if gear is not None and gear.beside:
        kinds.add(Kind.GEAR)
    elif column in generated.MasterValues.of(channel).led:
        kinds.add(Kind.LEAD)
    elif clocked is not None:
        kinds |= {Kind.LEAD if isinstance(law, ByCurve) else Kind.TRAIL for law in clocked.led_by(column)}
        kinds |= {Kind.LEAD} if waits_for_place(channel, column) else set()
    return sum(max(kind, 0) for kind in kinds) + coupling_state(channel, column)


def _master_place(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_LEAD_P[leading]`: the place of a leading axis by which others are led."""
    column = arguments.column(channel, indices[0] if indices else None)
    if generated.is_generated(channel, column):
        return generated.place(channel, column)
    return shown(channel, column, channel.actual.machine[column], work=False)


def _master_speed(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_LEAD_V[leading]`: its speed, mm/min or degrees/min; a program that reads it has waited for the axis."""
    column = arguments.column(channel, indices[0] if indices else None)
    if generated.is_generated(channel, column):
        return generated.speed(channel, column)
    clocked = channel.actual.clocked
    return 0.0 if clocked is None else clocked.speed(column) * MINUTE


def _generated(read: Callable[[SinumerikChannel, int], float]) -> Reader:
    """What has been written as the master value of an axis."""
    return lambda channel, indices: read(channel, arguments.column(channel, indices[0] if indices else None))


def _offset(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_COUP_OFFS[spindle]` and the like: from its leading spindle, degrees; 0 without a coupling."""
    number = arguments.spindle(indices[0]) if indices else None
    pair = SpindlePairs.of(channel).acting(channel.memory.spindles.get(number).number)
    return 0.0 if pair is None else pair.offset


def _master(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_MASL_STAT[slave]`: number of the machine axis or spindle that leads it now, 0 for none."""
    return masters.master_of(channel, indices[0] if indices else None)


# ---- electronic gears: `$AA_EG_…[following, leading]`


def _gear(channel: SinumerikChannel, indices: Indices) -> Gear | None:
    """The gear of the following axis that a variable names."""
    return Gears.of(channel).defined.get(key_of(channel, indices[0] if indices else None))


def _of_wheel(attribute: str) -> Reader:
    """What a gear was switched on with for one leading axis; 0 for one that it has not."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        gear, leading = _gear(channel, indices), key_of(channel, indices[1])
        wheel = gear.wheels.get(leading) if gear is not None else None
        return 0.0 if wheel is None else getattr(wheel, attribute) or 0.0

    return _with_leading(read)


def _with_leading(read: Reader) -> Reader:
    """Readers of two axes; 12400 where one is missing."""

    def checked(channel: SinumerikChannel, indices: Indices) -> Any:
        if len(indices) != 2:
            raise AlarmError("12400", text="$AA_EG")
        return read(channel, indices)

    return checked


def _leading_acts(channel: SinumerikChannel, indices: Indices) -> bool:
    """`$AA_EG_ACTIVE[following, leading]`: the leading axis moves the following one now."""
    following, leading = (key_of(channel, index) for index in indices)
    gear = Gears.of(channel).defined.get(following)
    if gear is not None and gear.beside:
        return leading in gear.wheels
    return any(link.law.leading == leading for link in Couplings.of(channel).of_kind(following, Kind.GEAR))


def _leading_type(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_EG_TYPE[following, leading]`: 0 actual value, 1 setpoint."""
    gear = _gear(channel, indices)
    return gear.types.get(key_of(channel, indices[1]), 0) if gear is not None else 0


def _leading_axis(channel: SinumerikChannel, indices: Indices) -> Axis:
    """`$AA_EG_AX[n, following]`: the leading axis n, counted from 0."""
    if len(indices) != 2:
        raise AlarmError("12400", text="$AA_EG_AX")
    gear, n = _gear(channel, indices[1:]), arguments.whole(indices[0])
    columns = list(gear.types) if gear is not None else []
    if not 0 <= n < len(columns):
        raise AlarmError("17020", text="$AA_EG_AX", index=n)
    return Axis(name_of(channel, columns[n]))


def _leading_count(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_EG_NUM_LA[following]`: leading axes that EGDEF names."""
    gear = _gear(channel, indices)
    return 0 if gear is None else len(gear.types)


def _synchronous_place(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_EG_SYNFA[following]`: its synchronous place."""
    gear = _gear(channel, indices)
    return 0.0 if gear is None else gear.place


def _block_change(channel: SinumerikChannel, indices: Indices) -> str:
    """`$P_EG_BC[following]`: when the block that switches the gear on ends."""
    gear = _gear(channel, indices)
    return "" if gear is None else gear.block_change


def _difference(channel: SinumerikChannel, indices: Indices) -> float:
    """`$VA_EG_SYNCDIFF[following]`: how far it is from its place, which is nothing where no axis lags."""
    arguments.column(channel, indices[0] if indices else None)
    return 0.0


GEAR_VARIABLES: dict[str, RowWithStop] = {
    "$AA_EG_ACTIVE": (Type.BOOL, _with_leading(_leading_acts), None, True),
    "$AA_EG_AX": (Type.AXIS, _leading_axis, None, True),
    "$AA_EG_DENOM": (Type.REAL, _of_wheel("denominator"), None, True),
    "$AA_EG_NUMERA": (Type.REAL, _of_wheel("numerator"), None, True),
    "$AA_EG_NUM_LA": (Type.INT, _leading_count, None, True),
    "$AA_EG_SYN": (Type.REAL, _of_wheel("synchronous"), None, True),
    "$AA_EG_SYNFA": (Type.REAL, _synchronous_place, None, True),
    "$AA_EG_TYPE": (Type.INT, _with_leading(_leading_type), None, True),
    "$P_EG_BC": (Type.STRING, _block_change, None, False),
    "$VA_EG_SYNCDIFF": (Type.REAL, _difference, None, True),
}

COUPLING_VARIABLES: dict[str, RowWithStop] = {
    **GEAR_VARIABLES,
    "$AA_COUP_ACT": (Type.INT, _acts, None, True),
    "$AA_COUP_OFFS": (Type.REAL, _offset, None, True),
    "$VA_COUP_OFFS": (Type.REAL, _offset, None, True),
    "$AA_MASL_STAT": (Type.INT, _master, None, True),
    "$AA_LEAD_P": (Type.REAL, _master_place, None, True),
    "$AA_LEAD_SP": (Type.REAL, _generated(generated.place), generated.write("places"), True),
    "$AA_LEAD_SV": (Type.REAL, _generated(generated.speed), generated.write("speeds"), True),
    "$AA_LEAD_V": (Type.REAL, _master_speed, None, True),
}
