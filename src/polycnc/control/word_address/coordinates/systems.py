"""Coordinate systems and reference points: G52 to G59, G54.1, G92, G53, G27 to G30, planes, units."""

from __future__ import annotations

from math import nan

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.word_address.auxiliary.interlocks import note_reference_return
from polycnc.control.word_address.coordinates import tip
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.tools.radius import suspended
from polycnc.deferred.contexts import nullcontext
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, translation
from polycnc.geometry.vectors import cross, dot, minus
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.deferred.typing import Self
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.planes.misplaced import Misplaced


@dataclass(slots=True)
class ZeroState(State, lifetime=Lifetime.POWER):
    """What lies between display and machine, beside the table of work offsets; a number for each axis.

    Attributes:
        system: Name of the active work coordinate system.
        local: G52.
        preset: G92.
        length: The active tool length.
        turn: How the work system is turned, in which G52 and G92 shift; identity on most controls.
        frame: The same with what else turns coordinates within it.
        table: How the table has turned since the tilted plane was told, machine coordinates.
        plane: The tilted plane within the work.
        fixture: Of the fixture on a rotary table; X, Y, Z, mm.
        misplaced: How the workpiece lies on the table, beside where it should; None for there.
        carried: What makes good how far the head has taken the tool away while it stands on that plane; X, Y, Z, mm.
    """

    system: str = lasting(Lifetime.RESET, "G54")
    local: list[float] = field(default_factory=list)
    preset: list[float] = field(default_factory=list)
    length: list[float] = lasting(Lifetime.RESET, factory=list)
    turn: Frame = lasting(Lifetime.RESET, IDENTITY)
    frame: Frame = lasting(Lifetime.RESET, IDENTITY)
    table: Frame = lasting(Lifetime.RESET, IDENTITY)
    plane: Frame = lasting(Lifetime.RESET, IDENTITY)
    fixture: Vector = lasting(Lifetime.RESET, (0.0, 0.0, 0.0))
    misplaced: Misplaced | None = lasting(Lifetime.RESET, None)
    carried: Vector = lasting(Lifetime.RESET, (0.0, 0.0, 0.0))

    @classmethod
    def first(cls, channel: Channel) -> Self:
        """No shift of any axis."""
        count = len(channel.axes)
        return cls(local=[0.0] * count, preset=[0.0] * count, length=[0.0] * count)


def refresh_zero(channel: WordAddressChannel, *, travelled: bool = False) -> None:
    """Work out the shift from display to machine anew: external + work + local + G92 offset + tool length."""
    offsets, leading = zero_offsets(channel), tip.TipState.of(channel)
    leads = leading.active is not None and leading.is_leading(channel)
    frame = frame_on_table(channel, offsets) if leads else work_frame(channel, offsets)
    if leading.active is not None and leads:
        # Or the way to the machine and back would leave rounding noise.
        if not leading.lies_at(frame, offsets):
            tip.lead(channel, leading.active, frame, offsets, frame_as_told(channel, offsets))
    else:
        channel.coordinates.set_zero(frame, offsets, travelled=travelled)
    channel.context_changed()


def work_frame(channel: WordAddressChannel, offsets: list[float]) -> Frame:
    """From the display to axes counted from a work zero: turn of the work, table and tilted plane.

    The table turns about axes of the machine, so a plane goes another way with it where the work zero lies elsewhere.
    The work system goes with it too, however that is turned.
    """
    zero = ZeroState.of(channel)
    if not zero.table.is_identity:
        shift = translation(*work_zero(channel, offsets))
        frame = shift.inverse() @ zero.table @ shift @ plane_on_table(channel, offsets)
    elif zero.misplaced is not None:
        frame = zero.frame @ zero.misplaced.seen(work_zero(channel, offsets)) @ zero.plane
    else:
        frame = zero.frame @ zero.plane
    return IDENTITY if frame.is_identity else frame


def frame_on_table(channel: WordAddressChannel, offsets: list[float]) -> Frame:
    """From the display to axes counted from a work zero with the table at zero: tip control turns it by itself."""
    frame = ZeroState.of(channel).frame @ lies(channel, offsets) @ _begun_on_table(channel, offsets)
    return IDENTITY if frame.is_identity else frame


def frame_as_told(channel: WordAddressChannel, offsets: list[float]) -> Frame | None:
    """The same on a work that lies where it should; None where it does."""
    zero = ZeroState.of(channel)
    return None if zero.misplaced is None else zero.frame @ _begun_on_table(channel, offsets)


def _begun_on_table(channel: WordAddressChannel, offsets: list[float]) -> Frame:
    """From a tilted plane to the table at zero, which had turned when tip control began."""
    plane, begun = ZeroState.of(channel).plane, tip.TipState.of(channel).begun
    if begun.is_identity:
        return plane
    shift = translation(*work_zero(channel, offsets))
    return shift.inverse() @ begun.inverse() @ shift @ plane


def plane_on_table(channel: WordAddressChannel, offsets: list[float]) -> Frame:
    """The tilted plane on the work as that lies on the table, with the table at zero."""
    zero = ZeroState.of(channel)
    return zero.frame @ lies(channel, offsets) @ zero.plane


def lies(channel: WordAddressChannel, offsets: list[float]) -> Frame:
    """From where the work should lie to where it lies, with the table at zero."""
    misplaced = ZeroState.of(channel).misplaced
    return IDENTITY if misplaced is None else misplaced.on_table(work_zero(channel, offsets))


def work_zero(channel: WordAddressChannel, offsets: list[float]) -> Vector:
    """The work zero on the machine, without the tool, mm."""
    zero = ZeroState.of(channel)
    x, y, z = (
        offsets[axis] - zero.length[axis] - carried if axis >= 0 else 0.0
        for axis, carried in zip(channel.coordinates.geometry, zero.carried, strict=True)
    )
    return (x, y, z)


def zero_offsets(channel: WordAddressChannel) -> list[float]:
    """What lies between display and machine now, for every axis."""
    memory, zero = channel.memory, ZeroState.of(channel)
    local, preset = (_directed(channel, zero.turn, shifts) for shifts in (zero.local, zero.preset))
    parts = zip(
        memory.work_offset(EXTERNAL),
        memory.work_offset(zero.system),
        local,
        preset,
        zero.length,
        strict=True,
    )
    offsets = [sum(values) for values in parts]
    for axis, *shifts in zip(channel.coordinates.geometry, zero.fixture, zero.carried, strict=True):
        if axis >= 0:
            offsets[axis] += sum(shifts)
    return offsets


def _directed(channel: WordAddressChannel, frame: Frame, shifts: list[float]) -> list[float]:
    """Shifts of all axes, those of X, Y and Z along others."""
    if frame.is_identity:
        return shifts
    geometry, directed = channel.coordinates.geometry, list(shifts)
    x, y, z = (shifts[axis] if axis >= 0 else 0.0 for axis in geometry)
    for axis, part in zip(geometry, frame.direct(x, y, z), strict=True):
        if axis >= 0:
            directed[axis] = part
    return directed


def on_work(channel: WordAddressChannel) -> Frame:
    """From the display to the system of the work offset: G52, turns of the work, planes.

    In that system, with the table at zero, a program with several planes is one picture. G92 shifts all work systems.
    """
    zero, leading = ZeroState.of(channel), tip.TipState.of(channel)
    frame, offsets = IDENTITY, channel.coordinates.offsets
    if leading.active is not None and leading.is_leading(channel):
        frame = frame_on_table(channel, offsets)
    elif zero.misplaced is not None or not (zero.frame.is_identity and zero.plane.is_identity):
        frame = plane_on_table(channel, offsets)
    if not any(zero.local):
        return frame
    shift = _directed(channel, zero.turn, zero.local)
    moved = translation(*(shift[axis] if axis >= 0 else 0.0 for axis in channel.coordinates.geometry))
    return moved if frame.is_identity else moved @ frame


def select_work_offset(channel: MacroChannel, words: Words) -> None:
    """G54 to G59, G54.1 P1 … (also `G54 P1`): the work coordinate system; no motion by itself."""
    state = ZeroState.of(channel)
    code = channel.mode["wcs"]
    number = words.integer("P") if "P" in words else None
    if number is not None and not 0 <= number <= channel.control.EXTENDED_WORK_SYSTEMS:
        raise words.fail("offset_number", "P")
    if number:
        state.system = f"G54.1 P{number}"
    else:
        state.system = "G54" if code == "G54.1" else code
    refresh_zero(channel)


def set_local_system(channel: WordAddressChannel, words: Words) -> None:
    """G52: zero of a local system within every work coordinate system; no motion."""
    for axis, value, _ in words.axes():
        ZeroState.of(channel).local[axis] = value
    refresh_zero(channel)


def set_position(channel: WordAddressChannel, words: Words) -> None:
    """G92: the present position gets these coordinates; every work coordinate system shifts with it (Hartford 3.2).

    A local system (G52) of these axes ends with it (macro B 10.3).
    """
    state, position = ZeroState.of(channel), channel.coordinates.named(channel.coordinates.position)
    way = [0.0] * len(channel.axes)
    for axis, value, _ in words.axes():
        way[axis] = position[axis] - value
    shift = shift_of_zero(channel, way, "G92")
    for axis, _, _ in words.axes():
        shift[axis] += state.local[axis]
        state.local[axis] = 0.0
    state.preset[:] = [before + further for before, further in zip(state.preset, shift, strict=True)]
    refresh_zero(channel)


def shift_of_zero(channel: WordAddressChannel, way: list[float], code: str) -> list[float]:
    """How far the work zero goes so that all coordinates become smaller by a way; a number for each axis.

    Where coordinates are turned within the work system, or a plane in it is tilted, X, Y and Z of the way lie along
    other axes of it. The work zero lies on the table, so what that has turned since does not count.
    """
    zero, offsets = ZeroState.of(channel), channel.coordinates.offsets
    if zero.misplaced is not None:
        return _shift_beside_error(channel, way, code)
    stands = tip.TipState.of(channel).stands
    seen = IDENTITY if stands else frame_on_table(channel, offsets)
    return list(_directed(channel, zero.turn.inverse() @ seen, way))


def _shift_beside_error(channel: WordAddressChannel, way: list[float], code: str) -> list[float]:
    """The same where the work lies beside its place: how it lies goes with the zero, which the table may have turned.

    Positions change evenly with the zero, so three trials say how.

    Raises:
        AlarmError: PC0001 where a zero can be told by no position.
    """
    geometry, offsets = channel.coordinates.geometry, channel.coordinates.offsets
    here, changes = _position_by(channel, offsets), []
    for axis in geometry:
        tried = list(offsets)
        tried[axis] += 1.0
        changes.append(minus(_position_by(channel, tried), here))
    x, y, z = changes
    size = dot(x, cross(y, z))
    if abs(size) < NO_TELLING or -1 in geometry:
        raise AlarmError("PC0001", hint="hint.not-supported", code=f"G54.4: {code}")
    wanted = [-way[axis] for axis in geometry]
    shift = list(way)
    for axis, pair in zip(geometry, (cross(y, z), cross(z, x), cross(x, y)), strict=True):
        shift[axis] = dot(wanted, pair) / size
    return shift


#: Trials that change positions by less (mm cubed) tell no zero.
NO_TELLING = 1e-6


def _position_by(channel: WordAddressChannel, offsets: list[float]) -> Vector:
    """X, Y and Z of the display where the machine stands, with other offsets."""
    from polycnc.transformation.seated import Seated

    c, leading = channel.coordinates, tip.TipState.of(channel)
    inner = [value - shift for value, shift in zip(c.machine, offsets, strict=True)]
    if leading.active is not None and leading.is_leading(channel):
        active = replace(leading.active, zero=tuple(offsets))
        inner = Seated(active, frame_on_table(channel, offsets)).to_work(inner)
        if leading.stands:
            told = Seated(active, frame_as_told(channel, offsets) or IDENTITY)
            inner = tip.standing_before(active, told, leading.beside).to_work(inner)
    else:
        inner = c.image(work_frame(channel, offsets).inverse(), inner)
    x, y, z = (inner[axis] for axis in c.geometry)
    return (x, y, z)


def set_position_or_limit(channel: WordAddressChannel, words: Words) -> None:
    """G92: sets the position; with S the highest speed under constant surface speed."""
    if words.axes():
        set_position(channel, words)
    limit = words.typed("S")
    if limit is not None:
        channel.memory.spindle.limit_rpm = limit
        channel.context_changed()


def preset_system(channel: WordAddressChannel, words: Words) -> None:
    """G92.1: shifts by G92 and G52 of the named axes vanish."""
    state = ZeroState.of(channel)
    for axis, _, _ in words.axes():
        state.preset[axis] = 0.0
        state.local[axis] = 0.0
    refresh_zero(channel)


def move_in_machine_system(channel: WordAddressChannel, words: Words) -> None:
    """G53: rapid to machine coordinates, offsets and tool length left out; absolute only."""
    c = channel.coordinates
    machine = c.machine
    for axis, value, incremental in words.axes():
        machine[axis] = machine[axis] + value if incremental else value
    axes = [axis for axis, _, _ in words.axes()]
    with suspended(channel, axes):
        channel.straight(Kind.RAPID, c.from_machine(machine), nan)
    channel.control.leave_length(channel, axes, to_reference=False)


def move_in_machine_system_absolute(channel: WordAddressChannel, words: Words) -> None:
    """G53 of FANUC: as above, but an increment is ignored by the control."""
    if channel.mode["distance"] == "G90":
        move_in_machine_system(channel, words)


@dataclass(slots=True)
class ReferenceState(State, lifetime=Lifetime.RESET):
    """The intermediate point of the last G28 or G30, programmed coordinates, for G29; None before the first."""

    intermediate: list[float] | None = None


def intermediate_point(channel: WordAddressChannel, words: Words) -> list[float]:
    """The intermediate point that a reference return names, programmed coordinates; kept by axis for G29."""
    c = channel.coordinates
    point = c.programmed[:]
    named = set()
    for axis, value, incremental in words.axes():
        point[axis] = point[axis] + value if incremental else value
        named.add(axis)
    state = ReferenceState.of(channel)
    kept = state.intermediate or point
    state.intermediate = [
        value if axis in named else old for axis, (value, old) in enumerate(zip(point, kept, strict=True))
    ]
    return point


def go_to_reference(channel: WordAddressChannel, words: Words, number: int) -> None:
    """Rapid over the intermediate point to a reference point, with the named axes only.

    Within radius compensation its vector vanishes on the way to the intermediate point, or behind it.
    """
    c = channel.coordinates
    point = intermediate_point(channel, words)
    axes = [axis for axis, _, _ in words.axes()]
    compensated = channel.control.compensates_to_intermediate(channel)
    with nullcontext() if compensated else suspended(channel, axes):
        channel.straight(Kind.RAPID, c.to_position(point), nan, point)
    machine = c.machine
    for axis in axes:
        machine[axis] = channel.control.reference_point(channel, axis, number)
    with suspended(channel, axes):
        channel.straight(Kind.REF, c.from_machine(machine), nan)
    channel.control.leave_length(channel, axes, to_reference=True)
    channel.control.reached_reference(channel)
    note_reference_return(channel, [channel.axes[axis] for axis in axes])


def return_to_reference(channel: WordAddressChannel, words: Words) -> None:
    """G28: over the intermediate point to the first reference point."""
    go_to_reference(channel, words, 1)


def return_to_further_reference(channel: MacroChannel, words: Words) -> None:
    """G30 [P2 … P4]: over the intermediate point to another reference point."""
    number = words.integer("P")
    number = 2 if number is None else number
    if number not in channel.control.FURTHER_REFERENCES:
        raise words.fail("reference_number", "P")
    go_to_reference(channel, words, number)


def return_from_reference(channel: WordAddressChannel, words: Words) -> None:
    """G29: rapid to the intermediate point of the last G28/G30, then to the target (an increment counts from there)."""
    c = channel.coordinates
    middle = ReferenceState.of(channel).intermediate
    if middle is None:
        raise words.fail("no_intermediate", "G29")
    named = words.axes()
    via = c.programmed[:]
    for axis, _, _ in named:
        via[axis] = middle[axis]
    channel.straight(Kind.RAPID, c.to_position(via), nan, via)
    end = via[:]
    for axis, value, incremental in named:
        end[axis] = via[axis] + value if incremental else value
    channel.straight(Kind.RAPID, c.to_position(end), nan, end)


def check_reference(channel: WordAddressChannel, words: Words) -> None:
    """G27: rapid to the point, which must be the reference point of the named axes."""
    c = channel.coordinates
    end = c.programmed[:]
    for axis, value, incremental in words.axes():
        end[axis] = end[axis] + value if incremental else value
    channel.straight(Kind.RAPID, c.to_position(end), nan, end)
    channel.keep_rows()
    machine = c.machine
    for axis, _, _ in words.axes():
        if abs(machine[axis] - channel.control.reference_point(channel, axis, 1)) > REFERENCE_WINDOW_MM:
            raise words.fail("not_at_reference", "G27")
    channel.control.reached_reference(channel)


#: How close to the reference point an axis must stand to count as there.
REFERENCE_WINDOW_MM = 0.0015


def forget_feed(channel: WordAddressChannel, words: Words) -> None:
    """G93 to G95: another feed mode asks for a new F, which the block may bring with it."""
    if "F" not in words:
        channel.feed = nan
    channel.context_changed()


def note_context(channel: WordAddressChannel, _words: Words) -> None:
    """G17 to G21, G61 to G64, G70, G71, G96, G97: a modal code that only shows in the context."""
    channel.context_changed()
