"""CYCLE800: swivel the working plane, and stand the rotary axes square on it.

A point p of the swivelled plane lies at `p0 + R·(p1 + p)` of the system before: that is the frame `$P_WPFRAME`. What
the table turns goes into `$P_PARTFRAME`, what the head turns acts on the tool's lengths; so p stays where it is on
the work whichever axes move.

Under TRAORI the transformation does both: there the cycle sets the frame alone, and where it turns the rotary axes they
take the tool about its tip, as the call must ask for.

`swivel_record` finds the record: the rotary axes of the machine, or a toolholder that is stored.
"""

from __future__ import annotations

from math import atan2, degrees, inf, nan

from polycnc.control.sinumerik import auxiliary
from polycnc.control.sinumerik.cycles.swivel_record import Record, record_of
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames.active import changed
from polycnc.control.sinumerik.frames.codes import crots
from polycnc.control.sinumerik.frames.memory import chain
from polycnc.control.sinumerik.motion import moves as motion
from polycnc.control.sinumerik.tools.holders import active as carriers
from polycnc.control.sinumerik.tools.selection import unscaled
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, rotation
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES, NEUTRAL, NcFrame
from polycnc.machine.kinematics import Kinematics
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.orientation import choice
from polycnc.transformation.orientation.solutions import solutions_for
from polycnc.transformation.planes import tilted

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel

#: _TC that takes the swivel away.
DESELECT = "0"
#: Ways of retracting (_FR): by axis of the machine in this order, along the tool to its limit, along it by a way.
BY_AXES = {1: ((2,),), 2: ((2,), (0, 1))}
TO_LIMIT, BY_WAY = 4, 5
#: Retractions that are programs of the machine builder (CUST_800).
OF_THE_BUILDER = frozenset((3, 6, 7, 8))
#: Ways of telling the plane (_MODE, bits 7 and 6).
AXIS_BY_AXIS, SOLID, PROJECTION, DIRECT = range(4)
#: Order of rotations where _MODE names none: X, Y, Z.
DEFAULT_ORDER = 57
#: Plane whose third axis the tool stands on, by _DMODE; else that of the caller.
PLANE_OF_DMODE = {1: "G17", 2: "G18", 3: "G19"}


def swivel(moves: Moves, a: Arguments) -> None:
    """CYCLE800; without arguments, or with the record "0", it takes the swivel away.

    Raises:
        AlarmError: 61815 under radius compensation; what `_check` finds.
    """
    channel = moves.channel
    if channel.mode["compensation"] != "G40":
        raise AlarmError("61815", text="CYCLE800")  # its corner would lie between two planes
    if not a.any_given or a.text("_TC").strip() == DESELECT:
        if a.any_given and a.integer("_FR"):
            _retract(moves, a, Kinematics.of(channel.machine), {})
        moves.act(deselect, channel)
        return
    record = record_of(channel, a.text("_TC").strip())
    _check(a, leads=seat.centre_point(channel) is not None)
    _retract(moves, a, record.kinematics, record.places)
    state = moves.memory.frames
    adds = a.digit("_ST", 0) == 1
    base = state.system["$P_WPFRAME"] @ state.programmable if adds else NEUTRAL
    turned = _plane_frame(a, record, _outer(channel) @ base)
    frame = base @ NcFrame(matrix=turned.m, coarse=turned.t)
    angles = _angles(channel, a, record, frame)
    if not record.meets_teeth(angles):
        raise not_supported("CYCLE800 $TC_CARR28")
    if a.integer("_DIR"):
        moves.act(_turn, channel, record, angles)
        moves.end_block()
        if -1 in record.columns:
            _ask(moves, record, angles)
    moves.act(_take, channel, record, frame, angles)


def _ask(moves: Moves, record: Record, angles: dict[str, float]) -> None:
    """Axes that are set by hand: a message says where to, and the program waits."""
    by_hand = [axis for axis, column in zip(record.axes, record.columns, strict=True) if column < 0]
    text = ", ".join(f"{axis} {angles[axis] + record.zero(axis):.3f}" for axis in by_hand)
    moves.note("62180" if len(by_hand) == 1 else "62181", text)
    moves.stop()
    moves.end_block()


def _take(channel: SinumerikChannel, record: Record, frame: NcFrame, angles: dict[str, float]) -> None:
    """The plane is the swivelled one."""
    memory = channel.memory
    memory.frames.system["$P_WPFRAME"] = frame
    memory.frames.programmable = NEUTRAL
    if seat.centre_point(channel) is None:
        _carry(channel, record, angles)
    else:
        changed(channel)


def _check(a: Arguments, *, leads: bool) -> None:
    """Alarms for what the call asks for; `leads`: TRAORI holds the tip while rotary axes turn."""
    if a.digit("_ST", 1) == 1 and not leads:
        raise AlarmError("61191")
    if a.digit("_ST", 2):
        raise not_supported("CYCLE800 _ST")
    if a.integer("_DIR") not in (-1, 0, 1):
        raise AlarmError("61189")
    if leads and a.integer("_DIR") and a.digit("_ST", 1) != 1:
        raise not_supported("CYCLE800 _ST: TRAORI")  # the linear axes would follow unasked


def deselect(channel: SinumerikChannel) -> None:
    """The frames of the swivel and the tool carrier are gone; nothing moves."""
    memory = channel.memory
    for name in ("$P_WPFRAME", "$P_TOOLFRAME", "$P_PARTFRAME"):
        memory.frames.system[name] = NEUTRAL
    carriers.ActiveCarrier.of(channel).number = 0
    memory.tools.carrier = None
    auxiliary.tool_changed(channel)


# ---- the plane


def _outer(channel: SinumerikChannel) -> NcFrame:
    """The frames in front of which the plane is turned."""
    state = channel.memory.frames
    return chain([state.system["$P_SETFRAME"], state.actual_base(), state.active_settable])


def _plane_frame(a: Arguments, record: Record, outer: NcFrame) -> Frame:
    """`p0 + R·(p1 + p)` as a frame, behind `outer`."""
    before = Frame(IDENTITY.m, (a["_X0"], a["_Y0"], a["_Z0"]))
    after = Frame(IDENTITY.m, (a["_X1"], a["_Y1"], a["_Z1"]))
    return before @ _rotation(a, record, outer) @ after


def _rotation(a: Arguments, record: Record, outer: NcFrame) -> Frame:
    """R by the way in which _MODE tells the plane, behind `outer`."""
    mode = a.integer("_MODE")
    order = [(mode or DEFAULT_ORDER) >> 2 * i & 3 for i in range(3)]
    angles = [a["_A"], a["_B"], a["_C"]]
    match mode >> 6 & 3:
        case 1:  # solid angle
            return tilted.by_solid_angle(angles[0], angles[1])
        case 2:  # projection angles
            letters = [GEOMETRY_AXES[axis - 1] if axis else "XY"[i] for i, axis in enumerate(order[:2])]
            return crots(dict(zip(letters, angles, strict=False))).frame @ rotation(2, angles[2])
        case 3:  # rotary axes direct
            return _square_on_tool(tilted.by_rotary_axes(record.kinematics, _told(a, record)), outer)
    if any(angle and not axis for axis, angle in zip(order, angles, strict=True)):
        raise not_supported("CYCLE800 _MODE")
    return tilted.by_own_axes((axis - 1, angle) for axis, angle in zip(order, angles, strict=True) if axis)


def _square_on_tool(turned: Frame, outer: NcFrame) -> Frame:
    """R whose Z is that of `turned`, which the basic system sees, behind a frame; X lies as the frame turns it about Z.

    Raises:
        AlarmError: PC0001 behind a mirror.
    """
    if any(outer.mirrored):
        raise not_supported("CYCLE800 _MODE: MIRROR")
    before = unscaled(outer.frame)
    x, y, _ = before.direct(1.0, 0.0, 0.0)
    return before.inverse() @ turned @ rotation(2, degrees(atan2(y, x)))


# ---- the rotary axes


def _told(a: Arguments, record: Record) -> dict[str, float]:
    """Angles of the joints where _A and _B are positions of the rotary axes."""
    return {
        axis: position - record.zero(axis)
        for axis, position in zip(record.axes, (a["_A"], a["_B"]), strict=False)
    }


def _angles(channel: SinumerikChannel, a: Arguments, record: Record, frame: NcFrame) -> dict[str, float]:
    """Positions of the rotary axes for the plane: of two solutions that which _DIR asks for; 61184 for none."""
    if a.integer("_MODE") >> 6 & 3 == DIRECT:
        return _told(a, record)
    plane = PLANE_OF_DMODE.get(a.digit("_DMODE", 0), channel.mode["plane"])
    index = PLANES[plane][2]
    square = [1.0 if i == index else 0.0 for i in range(3)]
    normal = (_outer(channel) @ frame).frame.direct(square[0], square[1], square[2])
    found = [
        _in_range(channel, record, angles)
        for angles in solutions_for(record.kinematics, normal, dict.fromkeys(record.axes, 0.0))
    ]
    allowed = [angles for angles in found if angles is not None]
    if not allowed:
        raise AlarmError("61184")
    if a.integer("_DIR") == 0:
        machine = channel.coordinates.machine
        near = {
            name: (machine[c] if c >= 0 else 0.0) - record.zero(name)
            for name, c in zip(record.axes, record.columns, strict=True)
        }
        return min(allowed, key=lambda solution: choice.way(solution, near))
    choose = max if a.integer("_DIR") > 0 else min
    # Axes that count turns have a smaller and a greater solution as well.
    return choose(allowed, key=lambda solution: choice.signed(solution[record.tilting]))


def _in_range(channel: SinumerikChannel, record: Record, angles: dict[str, float]) -> dict[str, float] | None:
    """A solution on the turns that the axes can reach, modulo axes the short way; None where one cannot reach it."""
    placed = {}
    machine = channel.coordinates.machine
    for name, column, (first, last) in zip(record.axes, record.columns, record.limits_deg, strict=True):
        low, high = _range(channel, column) if column >= 0 else (-inf, inf)
        low, high, zero = max(low, first), min(high, last), record.zero(name)
        wanted = angles[name] + zero
        if column >= 0 and channel.axis_data[column].modulo:
            near = machine[column] + choice.signed(wanted - machine[column])
            position = near if choice.is_within(near, low, high) else None
        else:
            position = choice.on_reachable_turn(wanted, low, high)
        if position is None:
            return None
        placed[name] = position - zero
    return placed


def _turn(channel: SinumerikChannel, record: Record, angles: dict[str, float]) -> None:
    """The rotary axes go to their positions together, at rapid."""
    coordinates = channel.coordinates
    machine = coordinates.machine
    end = coordinates.position.copy()
    for name, column in zip(record.axes, record.columns, strict=True):
        if column >= 0:
            end[column] += angles[name] + record.zero(name) - machine[column]
    motion.line(channel, Kind.RAPID, end, nan)


def _carry(channel: SinumerikChannel, record: Record, angles: dict[str, float]) -> None:
    """What the rotary axes do to the work and to the tool's lengths at these positions."""
    memory = channel.memory
    work = record.table(angles)
    memory.frames.system["$P_PARTFRAME"] = NcFrame(matrix=work.m, coarse=work.t)
    carriers.ActiveCarrier.of(channel).number = 0
    memory.tools.carrier = record.head(angles)
    auxiliary.tool_changed(channel)


# ---- retraction


def _retract(moves: Moves, a: Arguments, kinematics: Kinematics, places: Mapping[int, float]) -> None:
    """_FR: away from the work before anything turns; a way whose end is not known is not gone.

    Raises:
        AlarmError: 61183 for a way that does not exist.
    """
    way = a.integer("_FR")
    if way in OF_THE_BUILDER:
        raise not_supported("CYCLE800 _FR")
    if way not in (0, TO_LIMIT, BY_WAY, *BY_AXES):
        raise AlarmError("61183")
    for axes in BY_AXES.get(way, ()):
        moves.act(_to_limits, moves.channel, axes, places)
        moves.end_block()
    if way in (TO_LIMIT, BY_WAY):
        moves.act(_along_tool, moves.channel, kinematics, abs(a["_FR_I"]) if way == BY_WAY else None)
        moves.end_block()


def _to_limits(channel: SinumerikChannel, axes: tuple[int, ...], places: Mapping[int, float]) -> None:
    """Machine axes to the positions of the record ($TC_CARR38 to 40), else to their upper limits."""
    coordinates = channel.coordinates
    machine = coordinates.machine
    for axis in axes:
        column = coordinates.geometry[axis]
        if column < 0:
            continue
        limit = places.get(axis, _range(channel, column)[1])
        if limit < inf:
            machine[column] = limit
    motion.line(channel, Kind.RAPID, coordinates.from_machine(machine), nan)


def _range(channel: SinumerikChannel, column: int) -> tuple[float, float]:
    """Software limits of an axis: of the machine, and of machine data 36100 and 36110."""
    memory = channel.memory
    axis, name = channel.axis_data[column], channel.axes[column]
    low, high = axis.limit_minus, axis.limit_plus
    if memory.data.is_set("$MA_POS_LIMIT_MINUS", name):
        low = max(low, memory.data.number("$MA_POS_LIMIT_MINUS", name))
    if memory.data.is_set("$MA_POS_LIMIT_PLUS", name):
        high = min(high, memory.data.number("$MA_POS_LIMIT_PLUS", name))
    return low, high


def _along_tool(channel: SinumerikChannel, kinematics: Kinematics, way: float | None) -> None:
    """Along the tool, as it stands, by a way or to the first limit."""
    coordinates = channel.coordinates
    machine = coordinates.machine
    names = {axis.name: machine[i] for i, axis in enumerate(channel.axis_data)}
    direction = kinematics.tool_on_machine(names)
    if way is None:
        rooms = [
            (_range(channel, column)[1] - machine[column]) / part
            for column, part in zip(coordinates.geometry, direction, strict=True)
            if column >= 0 and part > 1e-9
        ]
        way = min(rooms, default=inf)
    if way < inf:
        for column, part in zip(coordinates.geometry, direction, strict=True):
            if column >= 0:
                machine[column] += way * part
        motion.line(channel, Kind.RAPID, coordinates.from_machine(machine), nan)
