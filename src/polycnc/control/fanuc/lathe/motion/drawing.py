"""Direct drawing dimensions: lines by angle, corners chamfered or rounded wherever they lie (0i-TF Plus II.4.9).

`,A` is the angle of a line from the plane's first axis, counter-clockwise, in true (radius) geometry. A block with an
angle only is a line whose end lies where it meets the line of the next block; it waits for that block.
"""

from __future__ import annotations

from math import nan, radians, sin, tan

from polycnc.compensation.corner import Shape
from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes
from polycnc.control.fanuc.lathe.motion.corners import LEAST_ANGLE_DEG, corner_stage, corner_waits
from polycnc.control.fanuc.lathe.states import DrawingState
from polycnc.control.word_address.block.numbers import Convert, angle_converter
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.line_by_angle import leaves_line
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.frames import cos_sin_deg
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import GCode, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.geometry.arcs import Point

#: Sine of the angle between lines up to which they have no intersection; the limit itself counts.
_LEAST_SINE = sin(radians(LEAST_ANGLE_DEG)) + 1e-12
_MAX_IDLE_BLOCKS = 1
#: One-shot codes and groups by what may stand between the blocks of a figure (II.4.9, note 2).
_ALLOWED = frozenset({"G4"})
_LINES = ("G0", "G1")
_FORBIDDEN_GROUPS = frozenset({"cycle", "plane", "stroke"})
_SHAPES = {"R": Shape.ROUNDING, "C": Shape.CHAMFER}


@dataclass(slots=True)
class OpenLine:
    """A line that is known by its start and angle only.

    Attributes:
        angle_deg: Its angle.
        step: Number of its block, for the line of its row.
        corner: Shape and size at its end, None for a sharp corner.
        idle: Blocks without motion since then.
        behind: Dwells that follow the line: number of their block, and what they do.
    """

    angle_deg: float
    step: int
    corner: tuple[Shape, float] | None
    idle: int = 0
    behind: list[tuple[int, Callable[[], None]]] = field(default_factory=list)


def is_on(builder: Builder) -> bool:
    """Whether drawing dimensions are chosen (3453#0 CRD); they need memory operation (II.4.9, note 1)."""
    channel = builder.channel
    return not _rests(channel) and channel.setup.switches.mode != "mdi"


def _rests(channel: LatheChannel) -> bool:
    return not channel.memory.parameters.CRD


def plan_end(builder: Builder, plan: Plan) -> Callable[[LatheChannel, list[float]], list[float]]:
    """The end point of a thread block: ,A completes it where drawing dimensions are chosen (G33 of note 2)."""
    if not (is_on(builder) and builder.has(",A")):
        return lambda channel, values: path.reach(channel, plan.axis_words, values)
    words = _DrawingWords(builder, plan)
    return lambda channel, values: words.completed(channel, words.angle(values) or 0.0, values)


def plan_line(builder: Builder, plan: Plan) -> Step | None:
    """G00 and G01 with the words of drawing dimensions."""
    if builder.mode["motion"] not in _LINES or not is_on(builder):
        return None
    words = _DrawingWords(builder, plan)
    vector = builder.corner()
    if not words.any and not plan.axis_words:
        return vector

    def run(channel: LatheChannel, values: list[float]) -> None:
        line = DrawingState.of(channel).open_line
        angle, corner = words.angle(values), words.corner(values)
        if vector is not None:
            vector(channel, values)
        if line is None and angle is None:
            _move(channel, path.reach(channel, plan.axis_words, values), corner)
        elif line is not None:
            _close(channel, words, line, angle, corner, values)
        elif not plan.axis_words:
            DrawingState.of(channel).open_line = OpenLine(angle or 0.0, channel.level.current, corner)
        else:
            _move(channel, words.completed(channel, angle or 0.0, values), corner)

    return run


class _DrawingWords:
    """The words ,A ,C ,R of a block; without comma by 3405#4 where no axis has the name."""

    def __init__(self, builder: Builder, plan: Plan) -> None:
        self.control = builder.control
        self.plan = plan
        parameters = builder.channel.memory.parameters
        self._supplement = parameters.DDP
        self._absolute_size = parameters.unsigned_corners
        bare = parameters.chamfer_by_c
        self._angle = self._find(builder, "A", bare=bare)
        self._angle_of: Convert | None = None
        if self._angle is not None:
            self._angle_of = angle_converter(builder.slots[self._angle][1], builder.rules)
        self._shape = next((a for a in "RC" if self._find(builder, a, bare=bare)), None)
        self._corner = self._find(builder, self._shape, bare=bare) if self._shape else None
        self._corner_of = builder.length(self._corner) if self._corner else None
        builder.take(*(address for address in (self._angle, self._corner) if address))
        self._slots = builder.slots
        self.any = self._angle is not None or self._corner is not None

    @staticmethod
    def _find(builder: Builder, letter: str, *, bare: bool) -> str | None:
        if builder.has("," + letter):
            return "," + letter
        return letter if bare and builder.has(letter) and letter not in builder.channel.axes else None

    def angle(self, values: list[float]) -> float | None:
        """The angle, degrees."""
        if self._angle is None:
            return None
        value = values[self._slots[self._angle][0]]
        value = self._angle_of(value) if self._angle_of else value
        return 180.0 - value if self._supplement else value

    def corner(self, values: list[float]) -> tuple[Shape, float] | None:
        """What stands at the end of the line."""
        if self._corner is None or self._shape is None:
            return None
        value = values[self._slots[self._corner][0]]
        size = self._corner_of(value) if self._corner_of else value
        if size < 0.0 and not self._absolute_size:
            raise self.control.fail("corner_too_short", address=self._corner)
        return (_SHAPES[self._shape], abs(size)) if size else None

    def completed(self, channel: LatheChannel, angle_deg: float, values: list[float]) -> list[float]:
        """The end point of a line with an angle: the axis that is not named is worked out."""
        end = path.reach(channel, self.plan.axis_words, values)
        first, second = plane_axes(channel)
        start = channel.coordinates.programmed
        named = {word.axis for word in self.plan.axis_words}
        if first in named and second in named:
            if leaves_line(end[first] - start[first], end[second] - start[second], angle_deg):
                raise self.control.fail("drawing_increment", address=self._angle or "")
            return end
        slope = radians(angle_deg)
        if first in named:
            self._check_runs_along(angle_deg - 90.0)
            end[second] = start[second] + (end[first] - start[first]) * tan(slope)
        else:
            self._check_runs_along(angle_deg)
            end[first] = start[first] + (end[second] - start[second]) / tan(slope)
        return end

    def _check_runs_along(self, angle_deg: float) -> None:
        if abs(sin(radians(angle_deg))) < _LEAST_SINE:
            raise self.control.fail("drawing_end", address=self._angle or "")


def _close(
    channel: LatheChannel,
    words: _DrawingWords,
    line: OpenLine,
    angle: float | None,
    corner: tuple[Shape, float] | None,
    values: list[float],
) -> None:
    """The block behind a line with an angle only: both lines meet where the first one ends."""
    control, c = words.control, channel.coordinates
    DrawingState.of(channel).open_line = None
    axes = plane_axes(channel)
    plane_words = [word for word in words.plan.axis_words if word.axis in axes]
    if angle is None or len({word.axis for word in plane_words}) < 2:
        raise control.fail("drawing_next")
    if any(word.incremental for word in plane_words):
        raise control.fail("drawing_increment", address=plane_words[0].address)
    end = path.reach(channel, words.plan.axis_words, values)
    start: Point = (c.programmed[axes[0]], c.programmed[axes[1]])
    last: Point = (end[axes[0]], end[axes[1]])
    between = radians(angle - line.angle_deg)
    if abs(sin(between)) < _LEAST_SINE:
        raise control.fail("drawing_parallel")
    meeting = offset.meet(
        offset.ray(start, cos_sin_deg(line.angle_deg)), offset.ray(last, cos_sin_deg(angle)), 0.0, 0.0
    )
    if meeting is None:
        raise control.fail("drawing_parallel")
    middle = c.programmed[:]
    middle[axes[0]], middle[axes[1]] = meeting
    level, current = channel.level, channel.level.current
    level.current = line.step
    _move(channel, middle, line.corner)
    for level.current, dwell in line.behind:
        dwell()
    level.current = current
    _move(channel, end, corner)


def _move(channel: LatheChannel, programmed: list[float], corner: tuple[Shape, float] | None) -> None:
    """One line, with what stands at its end: at the feed in force, or at rapid."""
    is_rapid = channel.mode["motion"] == "G0"
    if not is_rapid and not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    if corner is not None:
        stage = corner_stage(channel)
        stage.draw()
        stage.insert(*corner)
    end = channel.coordinates.to_position(programmed)
    channel.straight(
        Kind.RAPID if is_rapid else Kind.FEED, end, nan if is_rapid else channel.feed, programmed
    )


def plan_check(builder: Builder, plan: Plan) -> Step | None:
    """What may stand between the blocks of a figure: neither other motion, nor codes that end it, nor much else."""
    if not is_on(builder):
        return None
    idle = False
    if any(_is_forbidden(row) for row in builder.codes):
        mistake = "drawing_increment"
    elif not plan.axis_words:
        mistake, idle = "drawing_increment", True
    elif builder.mode["motion"] in _LINES:
        return None
    else:
        mistake = "drawing_next"

    def check(channel: LatheChannel, _values: list[float]) -> None:
        line = DrawingState.of(channel).open_line
        if line is None or line.step == channel.level.current:
            if mistake == "drawing_increment" and not idle and corner_waits(channel):
                raise builder.control.fail(mistake)
            return
        line.idle += 1
        if not idle or line.idle > _MAX_IDLE_BLOCKS:
            DrawingState.of(channel).open_line = None
            raise builder.control.fail(mistake)

    return check


def _is_forbidden(row: GCode) -> bool:
    """Codes that may not stand in a figure (II.4.9, note 2): one-shot ones but G04, planes, cycles, G22 and G23."""
    return row.code not in _ALLOWED if not row.group else row.group in _FORBIDDEN_GROUPS


def is_word(address: str) -> bool:
    """Whether an address is a word of drawing dimensions."""
    return address in (",A", ",C", ",R")
