"""T on a lathe: turret and offset in one word, and how an offset acts (0i-TF Plus II.5.1).

An offset has two parts, geometry and wear. Each acts in one of two ways, as parameter 5002 says: it *moves* the
programmed point (the display then holds it), or it *shifts* the coordinate system (the display changes, the axes stay).
"""

from __future__ import annotations

from math import nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.compensation.tips import tip_direction
from polycnc.control.fanuc.lathe.cycles.modal import is_reading
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory, y_offset_axis
from polycnc.control.word_address.auxiliary.functions import bring_to_change
from polycnc.control.word_address.block.plan import NOT_YET
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.macro_b.code_calls import calls_by_tool
from polycnc.control.word_address.tools.radius import RadiusState, compensation_stage, side_on_display
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import ToolSelection

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

THREADS = frozenset({"G32", "G34", "G35", "G36"})
_ARCS = frozenset({"G2", "G3"})
#: One-shot codes beside which a T is allowed.
_BESIDE_T = frozenset({"G50", "G71", "G72", "G73"})
_MEASURING = frozenset({"G36", "G37", "G37.1", "G37.2"})
MAX_OFFSETS = 999


@dataclass(slots=True)
class OffsetState(State, lifetime=Lifetime.POWER):
    """The offset that is active.

    Attributes:
        number: Its number, 0 for none; `geometry_number` the same for geometry.
        shift: The part of it that shifts the coordinate system, all axes; `geometry_shift` what of that is geometry.
        tool_word: T as it was written last, turret position and offset number in one.
    """

    number: int = 0
    geometry_number: int = 0
    shift: list[float] = field(default_factory=list)
    geometry_shift: list[float] = field(default_factory=list)
    tool_word: int = 0

    @classmethod
    def first(cls, channel: LatheChannel) -> OffsetState:
        """No offset."""
        count = len(channel.axes)
        return cls(shift=[0.0] * count, geometry_shift=[0.0] * count)


def plan_tool(builder: Builder) -> Step | None:
    """T: turret position and offset number in one word; the offset acts with the block's motion.

    None where T calls a program instead (6001#5).
    """
    if calls_by_tool(builder):
        return None
    control, mode = builder.control, builder.mode
    slot = builder.slots["T"][0]
    if any(row.code == "G10" for row in builder.codes):
        raise control.fail("g10_format", address="T")
    if any(row.code == "G50.9" for row in builder.codes):
        raise control.fail("moving_output", address="T")
    if any(row.code in _MEASURING for row in builder.codes):
        raise control.fail("measure_h", address="T")
    if any(row.group == "" and row.code not in _BESIDE_T for row in builder.codes):
        raise control.fail("tool_with_one_shot", address="T")
    named = bool(builder.axis_words())
    one_shot = named and any(row.axis_words for row in builder.codes)
    moves = named and not one_shot
    arc = mode["motion"] in _ARCS and moves
    starts_or_ends = arc and mode["compensation"] != "G40"
    third = builder.channel.coordinates.geometry[PLANES[mode["plane"]][2]]
    helix = arc and any(word.axis == third for word in builder.axis_words())

    def select(channel: LatheChannel, values: list[float]) -> None:
        if is_reading(channel):
            return
        memory, active = channel.memory, OffsetState.of(channel)
        tool, number = split_tool_word(channel, values[slot])
        if tool != memory.tool.number:
            bring_to_change(channel)
        memory.tool.number = memory.tool.next = tool
        active.tool_word = int(values[slot])
        channel.context_changed()
        channel.event(ToolSelection(tool))
        if number is None:
            return
        if helix:
            raise control.fail("offset_in_thread", address="T")
        if starts_or_ends and (number == 0) != (active.number == 0):
            raise control.fail("comp_arc_start", address="T")
        select_offset(channel, number, tool)
        if not moves and not one_shot:
            move_by_offset(channel)

    return select


def _plan_signals(builder: Builder, _plan: Plan) -> Step:
    """T: the block waits for the signals of its second geometry before it has done anything."""
    slot = builder.slots["T"][0]

    def ask(channel: LatheChannel, values: list[float]) -> None:
        if OffsetMemory.of(channel).has_second:
            tool, number = split_tool_word(channel, values[slot])
            _second_geometry(channel, _geometry_number(channel, number or 0, tool))

    return ask


#: T may have to wait for signals.
WAITING_RULE = Rule("second geometry", words=("T",), before=_plan_signals)


def split_tool_word(channel: LatheChannel, value: float) -> tuple[int, int | None]:
    """The code sent to the turret and the offset number; None where the tool has no offset in it (5040#3)."""
    parameters = channel.memory.parameters
    number = int(value)
    if number != value or number < 0:
        raise channel.control.fail("point" if number != value else "minus", address="T")
    longest = parameters.t_digits
    if longest and len(str(number)) > longest:
        raise channel.control.fail("too_many_digits", address="T")
    if parameters.TCT:
        return number, None
    tool, offset = divmod(number, 10 ** offset_digits(channel))
    return tool, offset


def offset_digits(channel: LatheChannel) -> int:
    """How many last digits of T are the offset number (5028; 0: as many as the offset sets need)."""
    parameters = channel.memory.parameters
    digits = parameters.offset_digits
    if 1 <= digits <= 3:
        return digits
    sets = parameters.offset_sets or 99
    return 1 if sets < 10 else 2 if sets < 100 else 3


def select_offset(channel: LatheChannel, number: int, tool: int) -> None:
    """Make an offset number the active one; number 0 cancels. Not in a thread (II.3.1)."""
    if channel.mode["motion"] in THREADS:
        raise channel.control.fail("offset_in_thread", address="T")
    if not 0 <= number <= (channel.memory.parameters.offset_sets or MAX_OFFSETS):
        raise channel.control.fail("offset_number", address="T")
    _refuse_rotation(channel)
    active = OffsetState.of(channel)
    active.number = number
    active.geometry_number = _geometry_number(channel, number, tool)
    apply_offset(channel, cancels=number == 0)
    renew_nose(channel)


def _geometry_number(channel: LatheChannel, number: int, tool: int) -> int:
    """The number of the geometry: that of the offset, or of the tool (LGN); 0 where the offset is cancelled."""
    parameters = channel.memory.parameters
    by_tool = parameters.LGN and not parameters.NGW
    return 0 if not number else tool if by_tool else number


def _refuse_rotation(channel: LatheChannel) -> None:
    """No offset within a rotation, and none that shifts within a mirror or 3-D conversion (II.5.1.5, 5.9)."""
    memory = channel.memory
    if not memory.frames.rotates and not memory.frames.conversions:
        return
    parameters = memory.parameters
    shifts = not memory.parameters.NGW and (parameters.LWT or not parameters.LGT)
    if shifts:
        raise channel.control.fail("offset_in_thread", address="T")
    if not memory.frames.rotation.is_identity:
        raise channel.control.fail("in_rotation", address="T")


def apply_offset(channel: LatheChannel, *, cancels: bool = False) -> None:
    """Let the active offset act: a shift at once, a movement with the next motion."""
    memory, active = channel.memory, OffsetState.of(channel)
    moves, shifts = offset_parts(channel, cancels=cancels)
    active.shift = shifts
    refresh(channel)
    memory.frames.offset = moves
    c = channel.coordinates
    if not memory.parameters.LWM:
        if c.owes:
            # A suspended offset is not in the position: there is nothing of it to take back.
            c.programmed = _sum(c.programmed, c.pending)
            c.pending, c.owes = [0.0] * len(channel.axes), False
        c.set_programming(memory.frames.product(), memory.frames.shift, stays=False)
        return
    before = c.programmed
    c.set_programming(memory.frames.product(), memory.frames.shift)
    c.pending = [p + old - new for p, old, new in zip(c.pending, before, c.programmed, strict=True)]
    c.owes = any(c.pending)


def offset_parts(channel: LatheChannel, *, cancels: bool = False) -> tuple[list[float], list[float]]:
    """The active offset as movement and as shift of each axis, by 5002#2 (wear) and #4 (geometry)."""
    memory, active = channel.memory, OffsetState.of(channel)
    parameters = memory.parameters
    wear = OffsetMemory.of(channel).at(active.number).wear if active.number else {}
    geometry = geometry_values(channel) if active.geometry_number else {}
    wear_part = _by_axis(channel, wear)
    geometry_part = _by_axis(channel, geometry)
    nothing = [0.0] * len(channel.axes)
    geometry_moves = parameters.LGT
    if not geometry_moves:
        if cancels and not parameters.LGC:
            # LGC = 0: offset number 0 leaves a shift by geometry as it is.
            geometry_part = active.geometry_shift
        active.geometry_shift = geometry_part
    wear_moves = memory.parameters.NGW or not parameters.LWT
    moves = _sum(wear_part if wear_moves else nothing, geometry_part if geometry_moves else nothing)
    shifts = _sum(nothing if wear_moves else wear_part, nothing if geometry_moves else geometry_part)
    return moves, shifts


def _by_axis(channel: LatheChannel, values: dict[str, float]) -> list[float]:
    """The offsets of all axes; that of Y where the function is there (8132#1 YOF), on the axis that 5043 names."""
    parameters = channel.memory.parameters
    offsets = [0.0 if axis == "Y" else values.get(axis, 0.0) for axis in channel.axes]
    named = y_offset_axis(channel)
    if named >= 0:
        offsets[named] = values.get("Y", 0.0) if parameters.YOF else 0.0
    return offsets


def _sum(a: list[float], b: list[float]) -> list[float]:
    return [x + y for x, y in zip(a, b, strict=True)]


def geometry_values(channel: LatheChannel) -> dict[str, float]:
    """Geometry of the active number, with the second geometry where the machine's signals ask for it (II.5.1.4)."""
    active = OffsetState.of(channel)
    offset = OffsetMemory.of(channel).at(active.geometry_number)
    values = dict(offset.geometry)
    for axis, value in _second_geometry(channel, active.geometry_number).items():
        values[axis] = values.get(axis, 0.0) + value
    return values


def _second_geometry(channel: LatheChannel, number: int) -> dict[str, float]:
    """What the machine's signals G2SLC and G2X … add to a geometry; where nothing is stored nobody waits for them."""
    signals, offset = channel.memory.signals, OffsetMemory.of(channel).numbers.get(number)
    stored = {} if offset is None else {axis: value for axis, value in offset.second.items() if value}
    if not stored or not signals.get("G2SLC"):
        return {}
    return {axis: value for axis, value in stored.items() if signals.get(f"G2{axis}")}


def move_by_offset(channel: LatheChannel) -> None:
    """A T block without motion moves the axes by the change of the offset (5002#6 = 0)."""
    c = channel.coordinates
    if channel.memory.parameters.LWM:
        return
    end = c.to_position(c.programmed)
    if end == c.position:
        return
    rapid = channel.mode["motion"] == "G0"
    if not rapid and not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    channel.straight(Kind.RAPID if rapid else Kind.FEED, end, nan if rapid else channel.feed, c.programmed)
    c.set_programming(c.programming, c.shift)


def refresh(channel: LatheChannel) -> None:
    """Work out the zero of the display anew: work offsets, shifts, tool."""
    active = OffsetState.of(channel)
    ZeroState.of(channel).length = _sum(active.shift, OffsetMemory.of(channel).work_shift)
    refresh_zero(channel)


def renew_nose(channel: LatheChannel) -> None:
    """Another offset number under G41 or G42: the next block has its radius and tip; 0 cancels (II.5.3, 5.4.1)."""
    state = RadiusState.of(channel)
    active = OffsetState.of(channel)
    before, state.number = state.number, active.number
    if not state.side:
        return
    stage = compensation_stage(channel)
    if not state.number:
        stage.cancel()
    elif before and stage.active:
        stage.change_radius(nose_radius(channel), nose_tip(channel))
    else:
        stage.policy = channel.control.compensation_policy(channel)
        stage.engage(side_on_display(channel), nose_radius(channel), nose_tip(channel))


def nose_radius(channel: LatheChannel) -> float:
    """Nose radius of the active offset: geometry and wear, mm."""
    active = OffsetState.of(channel)
    if not active.number:
        return 0.0
    wear: float = OffsetMemory.of(channel).at(active.number).radius_wear
    geometry: float = (
        OffsetMemory.of(channel).at(active.geometry_number).radius if active.geometry_number else 0.0
    )
    return wear + geometry


def nose_tip(channel: LatheChannel) -> tuple[float, float]:
    """Way from the nose centre to the imaginary tip in units of the radius (5002#7: whose tip number)."""
    memory, active = channel.memory, OffsetState.of(channel)
    by_wear = memory.parameters.NGW or memory.parameters.WNP
    number = active.number if by_wear else active.geometry_number
    return tip_direction(OffsetMemory.of(channel).at(number).tip if number else 0)


def offset_changed(channel: LatheChannel) -> None:
    """A written offset acts from the next T, or from the next move (5002#4, #6; III.2.1.1), or now (5001#6)."""
    memory = channel.memory
    parameters = memory.parameters
    at_next_move = parameters.LWM and (memory.parameters.NGW or parameters.LGT)
    if parameters.EVO or at_next_move:
        _refuse_rotation(channel)
        apply_offset(channel)


def select_by_code(channel: LatheChannel, words: Words) -> None:
    """G43.7 D: the offset of an ATC-type lathe (5040#3 TCT = 1; II.5.7)."""
    _select_by_code(channel, words, "G43.7", is_length=channel.memory.parameters.TLG)


def select_by_length_code(channel: LatheChannel, words: Words) -> None:
    """G43, G44: what G43.7 is where 5040#4 TLG exchanges their meaning; else tool length offset."""
    _select_by_code(channel, words, "G43", is_length=not channel.memory.parameters.TLG)


def _select_by_code(channel: LatheChannel, words: Words, code: str, *, is_length: bool) -> None:
    if not channel.memory.parameters.TCT:
        raise words.fail("atc_not_chosen", code)
    if is_length:
        raise AlarmError(NOT_YET, address=code, hint="hint.not-supported", code=code)
    number = words.integer("D")
    if number is None:
        return
    select_offset(channel, number, number)
    if not words.axes():
        move_by_offset(channel)


def cancel_by_code(channel: LatheChannel, words: Words) -> None:
    """G49: the offset of an ATC-type lathe ends."""
    if not channel.memory.parameters.TCT:
        return
    select_offset(channel, 0, 0)
    if not words.axes():
        move_by_offset(channel)
