"""REPOSL, REPOSA, REPOSQ, REPOSH …: back to the contour at the end of an interrupt routine (job planning 8.6).

The point of the contour is that of RMI (where it was interrupted), RMB (start of the block), RME (its end) or RMN
(nearest to the tool), moved by DISPR backwards along the contour, forwards where it is negative. The way there is a
straight line, or a straight line and a quarter or half circle in the working plane that touches the contour on the side
on which the tool is. After it the routine ends and the rest of the interrupted block is made from that point on.
"""

from __future__ import annotations

from math import hypot, isnan, nan

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion import circles, moves
from polycnc.control.sinumerik.signals import interrupts
from polycnc.control.sinumerik.tables import HALVES, LINES, length_factor
from polycnc.control.sinumerik.tools import stages
from polycnc.control.sinumerik.tools.sides import SIDES
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.statements.sections import end_of_subprogram
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.moves.move_path import MovePath
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: Of the G functions of group 26, in the order of `$AC_REPOS_PATH_MODE` from 1.
POINTS = ("RMB", "RMI", "RME", "RMN")
#: Bits of `$AC_ASUP` (general knowledge: the list of system variables).
BLSYNC, CUTS = 1, 2
Plane = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Arc:
    """A quarter or half circle that leads to the contour; plane points are those of its first and second axis."""

    columns: tuple[int, int, int]
    plane: Plane
    begin: Point
    center: Point
    ccw: bool


@dataclass(slots=True)
class Repositioning(State, lifetime=Lifetime.POWER):
    """Point of the last REPOS (`$AC_REPOS_PATH_MODE`), 0 before."""

    point: int = 0


def reposition(draft: Draft) -> Step:
    """A block with REPOS: the approach, then the end of the routine. Axes are only named: their values do not count."""
    code = draft.codes["block_motion"]
    along, size = draft.take("DISPR"), draft.take("DISR")
    factor = length_factor(draft.mode)
    named = {term.column for term in draft.take_axes()}
    point = draft.mode["repos_point"]
    plane = PLANES[draft.mode["plane"]]
    rapid = draft.mode["motion"] == "G0" and not draft.has("F")
    if code.endswith("A"):
        named = set(range(len(draft.channel.axes)))

    def run(channel: SinumerikChannel, values: Values) -> None:
        interrupted = interrupts.running(channel)
        if interrupted is None or interrupted.way is None:
            if interrupted is None and not _in_routine(channel):
                raise AlarmError("16020", text=code)
            end_of_subprogram(channel)
            return
        stages.begin_anew(channel)
        way = interrupted.way
        part = _part(way, point, interrupted.part, channel.coordinates.position)
        if along is not None and way.length:
            part -= number(values, along) * factor / way.length
        part = min(max(part, 0.0), 1.0)
        radius = number(values, size) * factor if size is not None and code not in LINES else 0.0
        feed = nan if rapid else moves.checked_feed(channel.feed)
        arc = _touching_arc(channel, way, part, plane, radius, half=code in HALVES)
        _approach(channel, way.at(part), named, feed, arc)
        interrupted.resume_at = part
        interrupted.left = frozenset(range(len(way.move.end))) - _moved(channel, named)
        Repositioning.of(channel).point = POINTS.index(point) + 1
        end_of_subprogram(channel)

    return run


def _in_routine(channel: SinumerikChannel) -> bool:
    return any(level.kind is LevelKind.INTERRUPT for level in channel.stack)


def _part(way: MovePath, point: str, interrupted_at: float, position: list[float]) -> float:
    """The part of the way that RMB, RMI, RME or RMN chooses."""
    if point == "RMN":
        return way.nearest(position)
    return {"RMB": 0.0, "RME": 1.0}.get(point, interrupted_at)


def _touching_arc(
    channel: SinumerikChannel, way: MovePath, part: float, plane: Plane, radius: float, *, half: bool
) -> Arc | None:
    """The quarter or half circle that touches the contour; None without DISR or a direction in the plane.

    `radius` is DISR: the diameter of a half circle.
    """
    columns = tuple(channel.coordinates.geometry[axis] for axis in plane)
    u, v = columns[:2]
    direction = way.direction(part)
    along = (direction[plane[0]], direction[plane[1]])
    size = hypot(*along)
    if radius <= 0.0 or size < NO_WAY or min(u, v) < 0:
        return None
    along = (along[0] / size, along[1] / size)
    position, target = channel.coordinates.position, way.at(part)
    is_left = along[0] * (position[v] - target[v]) - along[1] * (position[u] - target[u]) >= 0.0
    side = 1.0 if is_left else -1.0
    across = (-along[1] * side, along[0] * side)
    reach = (0.5 * radius if half else radius) + _beside(channel, side)
    center = (target[u] + reach * across[0], target[v] + reach * across[1])
    lead = across if half else (-along[0], -along[1])
    begin = (center[0] + reach * lead[0], center[1] + reach * lead[1])
    return Arc((u, v, columns[2]), plane, begin, center, ccw=is_left)


def _moved(channel: SinumerikChannel, named: set[int]) -> set[int]:
    """Columns of the axes that REPOS leads back: geometry axes and named ones."""
    return named.union(column for column in channel.coordinates.geometry if column >= 0)


def _beside(channel: SinumerikChannel, side: float) -> float:
    """How much wider the circle is on the contour than on the tool's middle, which goes inside of it.

    Raises:
        AlarmError: PC0001 where compensation begins otherwise than square to the circle, or on its other side.
    """
    compensation = channel.mode["compensation"]
    if compensation == "G40":
        return 0.0
    stage, radius = stages.active_cutter(channel), stages.radius(channel)
    if stage is None or channel.mode["approach"] != "NORM" or SIDES[compensation] * radius * side < 0.0:
        raise not_supported(f"REPOSQ REPOSH {compensation}")
    return abs(radius)


def _approach(
    channel: SinumerikChannel, target: list[float], named: set[int], feed: float, arc: Arc | None
) -> None:
    """Go to a point of the contour: geometry axes and named ones; the others stay."""
    position, moved = channel.coordinates.position, _moved(channel, named)
    end = [target[i] if i in moved else value for i, value in enumerate(position)]
    kind = Kind.RAPID if isnan(feed) else Kind.FEED
    if arc is None:
        moves.line(channel, kind, end, feed)
        return
    begin = position.copy()
    begin[arc.columns[0]], begin[arc.columns[1]] = arc.begin
    moves.line(channel, kind, begin, feed)
    on_arc = moves.checked_feed(channel.feed)
    circles.arc(channel, arc.columns, arc.plane, end, arc.center, on_arc, arc.ccw)


# ---- system variables


def _return_point(channel: SinumerikChannel, indices: tuple[Any, ...]) -> float:
    """$AC_RETPOINT[axis]: where the contour was left, in work coordinates."""
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AC_RETPOINT")
    column = channel.memory.column(indices[0].name)
    interrupted = interrupts.running(channel)
    if interrupted is None or interrupted.way is None:
        return float(channel.coordinates.position[column])
    return float(interrupted.way.at(interrupted.part)[column])


def _cause(channel: SinumerikChannel, _indices: tuple[Any, ...]) -> int:
    """$AC_ASUP: why an interrupt routine runs: bit 0 an input with BLSYNC, bit 1 one that has cut a block; else 0."""
    interrupted = interrupts.running(channel)
    if interrupted is None:
        return 0
    return BLSYNC if interrupted.waited else CUTS


def _is_possible(channel: SinumerikChannel, _indices: tuple[Any, ...]) -> int:
    """$P_REPINF: 1 where REPOS leads back to a contour."""
    return int(interrupts.running(channel) is not None)


REPOS_VARIABLES: dict[str, RowWithStop] = {
    "$AC_REPOS_PATH_MODE": (Type.INT, lambda channel, _indices: Repositioning.of(channel).point, None, True),
    "$AC_ASUP": (Type.INT, _cause, None, True),
    "$AC_RETPOINT": (Type.REAL, _return_point, None, True),
    "$P_REPINF": (Type.INT, _is_possible, None, False),
}
