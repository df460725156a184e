"""Shapes of G70 to G73: the blocks from P to Q, read ahead by running them with the tool held (II.4.2.8).

The control reads a shape by interpreting its blocks, macro statements included. So does polycnc: they run in a
modal state of their own (`shape` = `reading`), in which F, S, T and M do nothing, and their moves are caught before
they reach the toolpath. Then everything is put back, and the cycle cuts along the moves.
"""

from __future__ import annotations

from polycnc.channel.moves.path import Recorder
from polycnc.channel.stack import LevelKind
from polycnc.channel.states.snapshot import Snapshot
from polycnc.channel.states.state import Lifetime, State
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.control.fanuc.code_calls import PROGRAM_M
from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes
from polycnc.control.fanuc.lathe.cycles.modal import FINISHING, GROUP, READING
from polycnc.control.fanuc.lathe.motion.corners import corner_waits
from polycnc.control.fanuc.lathe.states import DrawingState
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import nose_radius, nose_tip
from polycnc.control.word_address.macro_b import interruption
from polycnc.control.word_address.tools.radius import RadiusState, side_on_display, violation_codes
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.word_address.executable import WordAddressProgram
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step as BlockStep
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

MAX_SHAPE_BLOCKS = 10_000
_INFEED_CODES = ("G0", "G1")
_ALLOWED = frozenset({"G0", "G1", "G2", "G3"})
#: One-shot codes and macro calls.
_REFUSED_GROUPS = frozenset({"", "macro"})


@dataclass(slots=True)
class Shape:
    """What was read.

    Attributes:
        moves: Its moves, the infeed first.
        start: Programmed point in front of it.
        first_axes: Axes that the first block names, and `first_ways` those that it moves.
        first_code: G0 or G1 of the first block; empty where it has none.
        end: Step of the last block.
    """

    moves: list[Move] = field(default_factory=list)
    start: list[float] = field(default_factory=list)
    first_axes: frozenset[int] | None = None
    first_ways: frozenset[int] = frozenset()
    first_code: str = ""
    end: int = 0


@dataclass(slots=True)
class ShapeState(State, lifetime=Lifetime.RESET):
    """The shape that is being read; None for none."""

    shape: Shape | None = None


def is_within(builder: Builder) -> bool:
    """Whether a block belongs to a shape that is being read, or that G70 runs."""
    return builder.mode.codes.get(GROUP) in (READING, FINISHING)


def plan_note(builder: Builder, plan: Plan) -> Step | None:
    """A step that tells the reader about a block; only in the plans of shapes that are being read.

    A block of a shape, read or run by G70, holds nothing but lines, arcs, dwells and macro statements (II.4.2.8).
    """
    if not is_within(builder):
        return None
    if builder.mode["motion"] not in _ALLOWED:
        raise builder.control.fail("shape_command", address=builder.mode["motion"])
    refused = next((r for r in builder.codes if r.group in _REFUSED_GROUPS and r.code != "G4"), None)
    if refused is not None:
        raise builder.control.fail("shape_command", address=refused.code)
    if PROGRAM_M.intersection(builder.m_codes):
        raise builder.control.fail("shape_command", address="M")
    if builder.mode.codes[GROUP] != READING:
        return None
    codes = [row.code for row in builder.codes if row.group == "motion"]
    axes = frozenset(word.axis for word in plan.axis_words)
    code = codes[-1] if codes and codes[-1] in _INFEED_CODES else ""

    def note(channel: LatheChannel, _values: list[float]) -> None:
        shape = ShapeState.of(channel).shape
        if shape is not None and shape.first_axes is None:
            shape.first_axes, shape.first_code = axes, code
            ends = channel.coordinates.programmed
            shape.first_ways = frozenset(
                axis for axis in axes if abs(ends[axis] - shape.start[axis]) > NO_WAY
            )

    return note


def section_steps(channel: LatheChannel, code: WordAddressProgram, first: int, last: int) -> tuple[int, int]:
    """First and last step of a shape. No other block of the program may have its numbers (II.4.2.8).

    A shape holds no further cycle: its blocks might lead back into it without end.
    """
    if channel.level.kind is LevelKind.SHAPE:
        raise channel.control.fail("shape_command", address="P")
    begin = code.find_sequence(first, channel.level.current, "no_shape_start")
    end = code.find_sequence(last, begin - 1, "no_shape_end")
    for number, address in ((first, "P"), (last, "Q")):
        if len(code.sequence_places(number)) > 1:
            raise channel.control.fail("shape_number_twice", address=address, number=number)
    return begin, end


def read_shape(channel: LatheChannel, first: int, last: int) -> Shape:
    """Read the blocks from sequence number `first` to `last` of the running program."""
    level = channel.level
    code = level.code
    begin, end = section_steps(channel, code, first, last)
    shape, recorder = Shape(start=channel.coordinates.programmed[:], end=end), Recorder()
    state = ShapeState.of(channel)
    before = Snapshot(channel, beside=_not_put_back(channel))
    channel.mode, state.shape = channel.mode.with_code(GROUP, READING), shape
    try:
        with channel.path.diverted(recorder):
            _run_blocks(channel, level, begin, end)
    finally:
        before.restore()
    shape.moves = [m for m in recorder.moves if m.kind is not Kind.DWELL and (m.center or m.start != m.end)]
    return shape


def _not_put_back(channel: LatheChannel) -> tuple[object, ...]:
    """What macro statements of a shape write stays: variables, offsets, outputs. No move reaches the toolpath."""
    memory = channel.memory
    variables = (memory.locals, memory.common, memory.kept, memory.signals)
    return (channel.toolpath, *variables, memory.work_offsets, OffsetMemory.of(channel))


def _run_blocks(channel: LatheChannel, level: Level[WordAddressProgram], begin: int, end: int) -> None:
    code = level.code
    level.index = begin
    for _ in range(MAX_SHAPE_BLOCKS):
        index = level.index
        if index >= len(code.lines):
            break
        step = code.compile(code.lines[index], index)
        level.current, level.index = index, index + 1
        step(channel)
        if channel.path.head is not None:
            channel.path.head.block()
        if channel.level is not level or channel.finished or len(channel.stack) == 0:
            raise channel.control.fail("shape_command", address="P")
        if index == end:
            refuse_open_end(channel)
            return
    raise channel.control.fail("no_shape_end", address="Q")


def refuse_open_end(channel: LatheChannel) -> None:
    """The last block of a shape may not need the next one for its corner or its end (II.4.7, 4.9)."""
    state = DrawingState.of(channel)
    line, state.open_line = state.open_line, None
    if line is not None:
        raise channel.control.fail("drawing_increment", address="Q")
    if corner_waits(channel):
        raise channel.control.fail("shape_ends_in_corner", address="Q")


def contour_of(channel: LatheChannel, shape: Shape, *, as_written: bool = False) -> Contour:
    """The shape as edges of the plane, after nose radius compensation where that is active, or `as_written`."""
    first, second = plane_axes(channel)
    u, v, w = PLANES[channel.mode["plane"]]
    plane = Plane(u, v, w, channel.coordinates.geometry)
    for move in shape.moves:
        if any(
            s != e
            for i, (s, e) in enumerate(zip(move.start, move.end, strict=True))
            if i not in (first, second)
        ):
            raise channel.control.fail("shape_command", address="P")
    is_compensated = RadiusState.of(channel).side and not as_written
    moves = _compensated(channel, shape.moves, plane) if is_compensated else shape.moves
    contour: Contour = []
    for move in moves:
        edge = plane.edge(move)
        if edge is not None and (edge.length > 0.0):
            contour.append(Piece(edge, move.kind is Kind.RAPID))
    return contour


def _compensated(channel: LatheChannel, moves: list[Move], plane: Plane) -> list[Move]:
    """The moves off the contour by the nose: start-up in the first one, square at the end (II.4.2.1)."""
    recorder = Recorder()
    codes = violation_codes(channel.control.alarms)
    stage = CutterCompensation(plane, channel.control.compensation_policy(channel), codes)
    stage.after = recorder
    stage.engage(side_on_display(channel), nose_radius(channel), nose_tip(channel))
    for move in moves:
        stage.move(replace(move))
        stage.block()
    stage.flush()
    return recorder.moves


class Section(WordAddressProgram):
    """The blocks of a shape as a program of its own: G70 runs them once, as they are written.

    Args:
        whole: The program that they stand in; places of sequence numbers and loops are found once for both.
        begin: First step.
        end: Last step.
    """

    def __init__(self, whole: WordAddressProgram, begin: int, end: int) -> None:
        self.__dict__.update(whole.__dict__)
        self.begin, self.end = begin, end
        self.steps = []

    def step(self, index: int, *, alone: bool = False) -> BlockStep | None:  # noqa: ARG002 - each is alone
        """The step of a block; None behind the last one of the shape, an alarm where a jump has left it."""
        if index == self.end + 1:
            return None
        if not self.begin <= index <= self.end:
            return _outside
        return self.compile(self.lines[index], index)


def _outside(channel: LatheChannel) -> None:
    raise channel.control.fail("shape_command", address="P")


def end_finishing(channel: LatheChannel) -> None:
    """Behind the last block of the shape that G70 runs any command is allowed again."""
    codes = dict(channel.mode.codes)
    codes.pop(GROUP, None)
    channel.mode = channel.modes.mode(codes)


def interruptible(builder: Builder, plan: Plan, motion: Step | None) -> Step | None:
    """A motion that an interruption macro may cut, where it belongs to no shape of G70 to G73 (II.4.2.8)."""
    if motion is None or builder.mode.codes.get(GROUP) == READING:
        return motion
    cut = interruption.interruptible(builder, plan, motion)
    if cut is None or cut is motion:
        return motion

    def move(channel: LatheChannel, values: list[float]) -> None:
        (motion if channel.level.kind is LevelKind.SHAPE else cut)(channel, values)

    return move
