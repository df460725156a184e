"""Chamfer and corner R between two G01 blocks of one axis each (0i-TF Plus II.4.7)."""

from __future__ import annotations

from polycnc.compensation.corner import CornerPolicy, CornerStage, CornerViolation, Shape
from polycnc.compensation.plane import Plane
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Move
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.control import WordAddressControl

#: Words of the plane's first and second axis that give a chamfer towards that axis.
_CENTERS = "IJK"
#: Angle between lines, degrees, up to which drawing dimensions find no intersection and put in no corner.
LEAST_ANGLE_DEG = 1.0
#: Corners that a block commands.
_COMMANDED = CornerPolicy(start_up_between=True)
#: Corners of drawing dimensions: one block without motion may stand between the two moves.
_DRAWN = CornerPolicy(idle_blocks=1, least_turn_deg=LEAST_ANGLE_DEG, start_up_between=True)
#: Moves that a figure of drawing dimensions is made of.
_LINES = frozenset({Kind.RAPID, Kind.FEED, Kind.THREAD})


@dataclass(frozen=True, slots=True)
class Expected:
    """What the block behind a chamfer must do: move this axis only, in this direction (1, -1; 0 for either)."""

    axis: int
    direction: float
    line: int


class TurningCorner(CornerStage):
    """The corner stage of the lathe: it also checks that the next block is the one that the corner needs."""

    def __init__(self, channel: LatheChannel) -> None:
        control = channel.control
        u, v, w = PLANES[channel.mode["plane"]]
        codes = {
            CornerViolation.NO_NEXT_MOVE: control.alarms["corner_no_move"],
            CornerViolation.RAPID: control.alarms["corner_no_move"],
            CornerViolation.TOO_SHORT: control.alarms["corner_too_short"],
        }
        super().__init__(Plane(u, v, w, channel.coordinates.geometry), _COMMANDED, codes)
        self._control: WordAddressControl = control
        self._coordinates = channel.coordinates
        self._codes = codes
        self._expected: Expected | None = None
        self._first = False
        self._is_drawn = False

    def draw(self) -> None:
        """The corner belongs to a figure of drawing dimensions, which only lines and one idle block continue."""
        self.policy, self._is_drawn = _DRAWN, True
        self._codes[CornerViolation.NO_NEXT_MOVE] = self._control.alarms["drawing_increment"]

    def expect(self, expected: Expected) -> None:
        """The move of this block gets a corner; then comes what is expected."""
        self._expected, self._first = expected, True

    def move(self, move: Move) -> None:
        """Take the next move; see `Stage`."""
        expected = self._expected
        if self._is_drawn and self._held is not None and move.kind not in _LINES and self.plane.moves(move):
            raise AlarmError(self._control.alarms["drawing_increment"], line=move.line)
        if expected is not None and not self._first:
            self._expected = None
            self._check(move, expected)
        self._first = False
        super().move(move)

    def _check(self, move: Move, expected: Expected) -> None:
        if move.kind is not Kind.FEED:
            raise self._fail("corner_next_block", expected)
        begin, last = (self._coordinates.to_programmed(list(place)) for place in (move.start, move.end))
        way = [end - start for start, end in zip(begin, last, strict=True)]
        others = any(abs(value) > 1e-9 for i, value in enumerate(way) if i != expected.axis)
        if others or way[expected.axis] == 0.0 or way[expected.axis] * expected.direction < 0.0:
            raise self._fail("corner_no_move", expected)

    def _fail(self, mistake: str, expected: Expected) -> AlarmError:
        return AlarmError(self._control.alarms[mistake], line=expected.line)

    def block(self) -> None:
        """A block has been read; a corner asked for in a block without way is longer than the way."""
        if self._wanted is not None:
            self._wanted = None
            self._violate(CornerViolation.TOO_SHORT, 0)
        super().block()

    @property
    def waits(self) -> bool:
        """Whether a corner still waits for its second move."""
        return self._expected is not None or self.active


def corner_waits(channel: LatheChannel) -> bool:
    """Whether a corner waits for its second move."""
    stage = channel.path.find(TurningCorner)
    return stage is not None and stage.waits


def corner_stage(channel: LatheChannel) -> TurningCorner:
    """The corner stage of the path: the one that waits for its second move, or a new one."""
    stage = channel.path.find(TurningCorner)
    return stage if stage is not None and stage.waits else channel.path.put(TurningCorner(channel))


def plan_corner(builder: Builder) -> Callable[[LatheChannel, list[float]], object] | None:
    """I, J, K (or C by 3405#4) and R of a G01 block; not with drawing dimensions (3453#0)."""
    parameters = builder.channel.memory.parameters
    if builder.mode["motion"] != "G1" or parameters.CRD or not parameters.CCR:
        return None
    by_c = parameters.chamfer_by_c
    letters = "C" if by_c and "C" not in builder.channel.axes else "" if by_c else _CENTERS
    # A letter that a code of the block takes is that code's: I K of G40, R of G68.1.
    taken = {letter for row in builder.codes for letter in row.takes.split()}
    named = [letter for letter in (*letters, "R") if builder.has(letter) and letter not in taken]
    if not named:
        return None
    control = builder.control
    if len(named) > 1:
        raise control.fail("corner_words", address=named[1])
    letter = named[0]
    builder.take(letter)
    axes = builder.axis_words()
    if len({word.axis for word in axes}) != 1:
        raise control.fail("corner_taper", address=letter)
    u, v, _ = PLANES[builder.mode["plane"]]
    geometry = builder.channel.coordinates.geometry
    plane = (geometry[u], geometry[v])
    if axes[0].axis not in plane:
        raise control.fail("corner_axis", address=axes[0].address)
    is_first = axes[0].axis == plane[0]
    other = plane[1] if is_first else plane[0]
    if letter in _CENTERS and letter != _CENTERS[v if is_first else u]:
        raise control.fail("corner_axis", address=letter)
    slot, convert = builder.slots[letter][0], builder.length(letter)
    shape = Shape.ROUNDING if letter == "R" else Shape.CHAMFER

    def insert(channel: LatheChannel, values: list[float]) -> None:
        value = convert(values[slot]) if convert else values[slot]
        if value:
            stage = corner_stage(channel)
            stage.expect(Expected(other, value, channel.line))
            stage.insert(shape, abs(value))
            if channel.memory.parameters.SBC:
                # SBC: single block halts in front of the inserted block as well as behind it.
                channel.halt_inside()

    return insert
