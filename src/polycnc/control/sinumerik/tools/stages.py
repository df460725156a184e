"""The stages of the plane: splines, smooth approach, chamfers and roundings, cutter radius compensation.

A stage stands in the channel's path only while it has something to do: what commands it puts it there, and behind
every block `Path.relax` takes out those that are through. Source: Fundamentals (CHF, CHR, RND,
RNDM, G40 to G42, NORM, KONT, KONTT, KONTC, G450, G451).
"""

from __future__ import annotations

from functools import partial
from math import hypot, nan

from polycnc.channel.moves.knots import Motions, join
from polycnc.compensation.contour_tool import ContourTool, CuttingEdge
from polycnc.compensation.corner import CornerPolicy, CornerStage, CornerViolation, Shape
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.policy import Approach, Policy, Violation
from polycnc.compensation.tips import tip_direction
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion.spline_stage import SplineStage
from polycnc.control.sinumerik.tools import spatial
from polycnc.control.sinumerik.tools.edges import DP_LARGEST_ANGLE, DP_LEAST_ANGLE, DP_TIP
from polycnc.control.sinumerik.tools.lengths import Rules, along_axes
from polycnc.control.sinumerik.tools.sides import FACES, SIDES, Contour
from polycnc.control.sinumerik.tools.smooth_stage import SmoothApproach
from polycnc.control.sinumerik.tools.tool_plane import lead, tool_plane
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.walls import WallStage
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, NoReturn
from polycnc.geometry.arcs import EVEN
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.offset import Joint, Outer
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import minus, times
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.compensation.plane import Plane
    from polycnc.control.sinumerik.tools import cutting_data, faces

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector

#: MD20250 = 5 blocks without motion are bridged by compensation.
BRIDGED_BLOCKS = 5
_G450 = Policy(
    outer=Outer(0.0, Joint.ARC), read_blocks=BRIDGED_BLOCKS + 2, avoids=True, leaves_out_arcs=True,
    approaches_behind_stops=True, sign_is_side=False, side_change_is_square=True,
)  # fmt: skip
#: MD20210 = 100 degrees.
_G451 = replace(_G450, outer=Outer(100.0, Joint.ARC, extend_as_circles=True))
_APPROACHES = {
    "NORM": Approach.SQUARE, "KONT": Approach.TANGENT, "KONTT": Approach.BENT, "KONTC": Approach.CURVED
}  # fmt: skip
POLICIES = {
    (code, corner): replace(rules, approach=approach)
    for code, approach in _APPROACHES.items()
    for corner, rules in (("G450", _G450), ("G451", _G451))
}
VIOLATIONS = {
    Violation.ARC_START: "10753",
    Violation.ARC_CANCEL: "10754",
    Violation.INNER_RADIUS_TOO_SMALL: "10751",
    Violation.NO_AVOIDANCE: "10751",
    Violation.AVOIDANCE_DANGEROUS: "10751",
    Violation.AVOIDANCE_INTERFERES: "10751",
}
#: As delivered: MD20200 = 1. Too large a size is reduced.
CORNERS = CornerPolicy(idle_blocks=1, shrinks=True, at_rapids=True)
CORNER_VIOLATIONS = {CornerViolation.TOO_MANY_BLOCKS: "10880"}
#: Bit of MD20201: what stands between the two moves of a corner comes behind the chamfer or rounding, which has the
#: feed of the second move; without it that of the first. FRC and FRCM do not count at rapid (Fundamentals).
BEHIND_SHAPE = 1
#: Stages that work in one plane.
PlaneStage = SplineStage | SmoothApproach | CornerStage | CutterCompensation
OF_PLANE: tuple[type[PlaneStage], ...] = (SplineStage, SmoothApproach, CornerStage, CutterCompensation)


def cutter(channel: SinumerikChannel) -> CutterCompensation:
    """The stage of cutter radius compensation, in the path."""
    change_plane(channel)
    stage = channel.path.find(CutterCompensation)
    if stage is None:
        stage = channel.path.put(CutterCompensation(plane(channel), _G450, VIOLATIONS, Motions(channel)))
        suspend(channel)
    return stage


def active_cutter(channel: SinumerikChannel) -> CutterCompensation | None:
    """The stage that compensates; None while none does."""
    stage = channel.path.find(CutterCompensation)
    return stage if stage is not None and stage.active else None


def corner(channel: SinumerikChannel) -> CornerStage:
    """The stage of chamfers and roundings, in the path."""
    change_plane(channel)
    stage = channel.path.find(CornerStage)
    motions = None if channel.path.is_diverted else Motions(channel)  # a contour that is read takes no time
    return stage or channel.path.put(
        CornerStage(plane(channel), _corners(channel), CORNER_VIOLATIONS, motions)
    )


def _corners(channel: SinumerikChannel) -> CornerPolicy:
    """Too large a size is reduced; MD20200 says how many blocks without a way in the plane may stand between."""
    data = channel.memory.data
    behind = bool(data.integer("$MC_CHFRND_MODE_MASK") & BEHIND_SHAPE)
    idle = data.integer("$MC_CHFRND_MAXNUM_DUMMY_BLOCKS")
    return replace(CORNERS, idle_blocks=idle, waits_at_shape=not behind, belongs_to_next=behind)


def approach(channel: SinumerikChannel) -> SmoothApproach:
    """The stage that holds a smooth approach back, in the path."""
    change_plane(channel)
    return channel.path.find(SmoothApproach) or channel.path.put(SmoothApproach(plane(channel)))


def spline(channel: SinumerikChannel) -> SplineStage:
    """The stage that collects control points, in the path."""
    change_plane(channel)
    return channel.path.find(SplineStage) or channel.path.put(
        SplineStage(plane(channel), partial(join, channel, shows=True))
    )


def plane(channel: SinumerikChannel) -> Plane:
    """The active plane."""
    return Plane(*PLANES[channel.mode["plane"]], channel.coordinates.geometry)


def change_plane(channel: SinumerikChannel) -> None:
    """G17 to G19: stages of another plane end what they hold; alarm 10757 while compensation is active."""
    first = PLANES[channel.mode["plane"]][0]
    found = [stage for kind in OF_PLANE if (stage := channel.path.find(kind)) and stage.plane.u != first]
    if not found:
        return
    refuse_open_change(channel, "G17 G18 G19")
    if active_cutter(channel) is not None:
        raise AlarmError("10757")
    if any(stage.active for stage in found):
        channel.flush()
    channel.path.take(*OF_PLANE)


def insert(channel: SinumerikChannel, name: str, size: float, feed: float = nan) -> None:
    """CHF, CHR, RND: the `Shape` of a name after the move of this block; alarm 16500 for a negative size.

    Of both in one block the rounding counts, in whichever order they stand (Fundamentals).
    """
    if size < 0.0:
        raise AlarmError("16500")
    shape = Shape[name]
    if size > 0.0 and (shape is Shape.ROUNDING or not corner(channel).rounds):
        corner(channel).insert(shape, size, feed)


def round_all(channel: SinumerikChannel, radius: float, feed: float = nan) -> None:
    """RNDM: round every corner from now on; 0 ends it."""
    if radius < 0.0:
        raise AlarmError("16500")
    corner(channel).round_all(radius, feed)


def feed_all(channel: SinumerikChannel, feed: float) -> None:
    """FRCM: the feed of all roundings from now on, whatever stands first in the block."""
    stage = channel.path.find(CornerStage)
    if stage is not None:
        stage.feed_all(feed)


def feed_once(channel: SinumerikChannel, feed: float) -> None:
    """FRC in a block without a shape of its own: the feed of its rounding by RNDM; nothing without one."""
    stage = channel.path.find(CornerStage)
    if stage is not None:
        stage.feed_once(feed)


# ---- cutter radius compensation


def policy(channel: SinumerikChannel) -> Policy:
    """The rules that hold now: approach, corner, and the limits of the machine data."""
    mode, data = channel.mode, channel.memory.data
    rules = POLICIES[mode["approach"], mode["corner"]]
    outer = replace(rules.outer, disc_percent=Contour.of(channel).disc)
    if mode["corner"] == "G451":
        outer = replace(outer, intersection_limit_deg=data.number("$MC_CUTCOM_CORNER_LIMIT"))
    idle = data.integer("$MC_CUTCOM_MAXNUM_DUMMY_BLOCKS")
    return replace(rules, outer=outer, read_blocks=idle + 2)


def _settle_corner(channel: SinumerikChannel, what: str = "G40 G41 G42") -> None:
    """PC0001 between the two moves of a chamfer or rounding, which have to be of one kind; one of RNDM is left out."""
    stage = channel.path.find(CornerStage)
    if stage is not None and not stage.settle():
        raise not_supported(f"CHF CHR RND: {what}")


def _behind_corner(channel: SinumerikChannel, change: Callable[[], None]) -> None:
    """Compensation changes: behind the chamfer or rounding that waits for its second move, at once where none does.

    The shape lies in the programmed contour, whatever is compensated of it. Edges of a contour tool are chosen for the
    contour to come: PC0001.
    """
    stage = channel.path.find(CornerStage)
    if stage is None or channel.path.find(ContourTool) is not None:
        _settle_corner(channel)
        change()
    else:
        stage.change(change)


def refuse_open_change(channel: SinumerikChannel, what: str) -> None:
    """PC0001 where compensation changes behind a chamfer or rounding that still waits for its second move."""
    stage = channel.path.find(CornerStage)
    if stage is not None and stage.changes_later:
        raise not_supported(f"CHF CHR RND G40 G41 G42: {what}")


def end_blocks(channel: SinumerikChannel) -> None:
    """Preprocessing stops: the blocks in front end.

    Raises:
        AlarmError: PC0001 between the two moves of a chamfer or rounding, 10746 where a smooth approach still waits for
            its contour.
    """
    waiting = channel.path.find(SmoothApproach)
    if waiting is not None and waiting.active:
        raise AlarmError("10746")
    _settle_corner(channel, "STOPRE $A POS")
    channel.flush()


def turned_frame(channel: SinumerikChannel) -> None:
    """The work is turned, scaled or mirrored otherwise: the two moves of a corner would lie in two directions."""
    _settle_corner(channel, "ROT SCALE MIRROR")


def select_side(channel: SinumerikChannel) -> None:
    """G41, G42: the contour begins with the next move; alarm 10750 without a tool edge."""
    if channel.memory.tools.edge is None:
        raise AlarmError("10750")
    _check_shape(channel)
    _lead_walls(channel)
    Contour.of(channel).linear = seat.frame_in_front(channel).m
    if channel.mode["tool_offset"] in (*spatial.CODES, *FACES):
        _check_size(channel)
    if channel.mode["tool_offset"] in (*spatial.CODES, *FACES):
        _settle_corner(channel)
        select = spatial.select_side if channel.mode["tool_offset"] in spatial.CODES else faces.select
        select(channel)
        return
    if _cuts_with_edges(channel):
        _settle_corner(channel)
    rules, frame = policy(channel), tool_plane(channel).frame
    side, offset = SIDES[channel.mode["compensation"]], _offset(channel)

    def engage() -> None:
        stage = cutter(channel)
        stage.policy = rules
        lead(channel, stage, frame)
        _release_edge(channel)
        channel.path.take(ContourTool)
        stage.engage(side, *offset)
        _choose_edges(channel, stage)

    _behind_corner(channel, engage)


def _cuts_with_edges(channel: SinumerikChannel) -> bool:
    """Whether the tool is a contour tool (7.1), where MD28290 says so."""
    active, enabled = channel.memory.tools.edge, channel.memory.data.integer("$MC_MM_SHAPED_TOOLS_ENABLE")
    return active is not None and active.has_angle_limits and bool(enabled)


def _choose_edges(channel: SinumerikChannel, stage: CutterCompensation) -> None:
    """A contour tool cuts with those of its edges that touch the contour.

    PC0001 where a toolholder, mirror or scale would change its angles, and where its edges cannot cut (`ContourTool`).
    """
    tools, led = channel.memory.tools, tool_plane(channel)
    active = tools.edge
    if active is None or not _cuts_with_edges(channel):
        return
    linear = Frame(seat.frame_in_front(channel).m)
    is_even = led.frame is IDENTITY and abs(led.scale - 1.0) < EVEN and not linear.mirrors
    if not is_even or tools.carrier is not None:
        _refuse_edges()
    others = (edge for edge in tools.edges.values() if edge is not active and edge.has_angle_limits)
    edges = tuple(_cutting_edge(channel, active, edge, linear.inverse()) for edge in (active, *others))
    side = SIDES[channel.mode["compensation"]]
    channel.path.put(ContourTool(stage, side, edges, partial(_counted, channel), _refuse_edges))


def _cutting_edge(channel: SinumerikChannel, active: Edge, edge: Edge, back: Frame) -> CuttingEdge:
    """An edge of a contour tool, as the reference point of the active one sees it in the program (`back`).

    Base dimensions move all edges alike (7.1). PC0001 for one without a reference direction (positions 0 and 9).
    """
    tools, (u, v, w) = channel.memory.tools, PLANES[channel.mode["plane"]]
    inverts = tools.rules is not None and tools.rules.inverts_wear
    nose = edge.radius(tools.additive, inverts=inverts) + tools.added_radius
    size = nose + Contour.of(channel).allowance_mm
    tip = cutting_data.in_space(channel.mode["plane"], tip_direction(int(edge.values[DP_TIP])))
    beside = minus(_measured(channel, active), _measured(channel, edge))
    if not any(tip) or min(nose, size) <= NO_WAY or abs(beside[w]) > NO_WAY:
        _refuse_edges()
    reference, shift = back.direct(*tip), back.direct(*minus(times(tip, nose), beside))
    least, largest = (edge.total(n) for n in (DP_LEAST_ANGLE, DP_LARGEST_ANGLE))
    return CuttingEdge((reference[u], reference[v]), least, largest, size, (shift[u], shift[v]))


def _measured(channel: SinumerikChannel, edge: Edge) -> Vector:
    """Lengths of an edge along X, Y, Z without base dimensions."""
    tools = channel.memory.tools
    rules, none = tools.rules or Rules(), (0.0, 0.0, 0.0)
    found = along_axes(edge.without_base, rules, channel.mode["plane"], tools.additive, none)
    return minus(found.turning, times(found.fixed, -1.0))


def _counted(channel: SinumerikChannel, context: int, radius_mm: float) -> int:
    """The context of a move that another edge makes: the feed of an arc counts with its radius."""
    toolpath = channel.toolpath
    return toolpath.context_number(replace(toolpath.contexts[context], radius_mm=radius_mm))


def _refuse_edges() -> NoReturn:
    raise not_supported("$TC_DP10 $TC_DP11: G41 G42")


def _release_edge(channel: SinumerikChannel) -> None:
    """What holds for compensation changes: a move that waits for its corner goes on as it is."""
    stage = channel.path.find(ContourTool)
    if stage is not None:
        stage.release()


def _check_shape(channel: SinumerikChannel) -> None:
    """PC0001 for tools that are not led along a contour.

    A tool whose direction ($TC_DPV) comes from behind the plane, or a turning tool with one that is not square on it:
    which side is left then, and where its edge position lies, is not known.
    """
    memory = channel.memory
    edge, plane = memory.tools.edge, channel.mode["plane"]
    own = memory.tools.own_direction(plane)
    if edge is not None and own is not None:
        least = 1.0 - EVEN if edge.is_turning else -EVEN
        if own[PLANES[plane][2]] < least:
            raise not_supported("$TC_DPV: G41 G42")


def _lead_walls(channel: SinumerikChannel) -> None:
    """In grooves of TRACYL with walls a stage behind compensation leads their axis; PC0001 but in G19."""
    column = seat.wall_column(channel)
    if column >= 0 and channel.path.find(WallStage) is None:
        if channel.mode["plane"] != "G19":
            raise not_supported("TRACYL: G17 G18 G41 G42")
        position = channel.coordinates.position.copy()
        channel.path.put(WallStage(channel, column, position[column]))
        position[column] = 0.0  # the stage leads it from here on, and off the walls to the centre line
        channel.coordinates.arrive(position)


def leave_contour(channel: SinumerikChannel) -> None:
    """G40: the next move leads back to the programmed path."""
    if spatial.stage_of(channel) is not None or faces.stage_of(channel) is not None:
        _settle_corner(channel)
    spatial.leave(channel)
    faces.leave(channel)

    def leave() -> None:
        stage = active_cutter(channel)
        if stage is not None:
            _release_edge(channel)
            stage.cancel()

    _behind_corner(channel, leave)


def begin_anew(channel: SinumerikChannel) -> None:
    """The next move leads from where the tool stands beside a contour to another one (REPOS)."""
    stage = active_cutter(channel)
    if stage is None or channel.mode["compensation"] == "G40" or not stage.holds_vector:
        return
    channel.flush()
    stands = stage.beside(channel.coordinates.position)
    stage.discard()
    channel.coordinates.arrive(stands)
    select_side(channel)


def changed_radius(channel: SinumerikChannel) -> None:
    """Another edge, TOFFR, OFFN or ISD while compensation is active."""
    spatial.follow(channel)
    waits = channel.path.find(CornerStage)
    is_active = active_cutter(channel) is not None or (waits is not None and waits.changes_later)
    if is_active and channel.mode["compensation"] != "G40":
        _check_shape(channel)
        if _cuts_with_edges(channel):
            _settle_corner(channel)
        offset = _offset(channel)

        def follow() -> None:
            stage = cutter(channel)
            _release_edge(channel)
            channel.path.take(ContourTool)
            stage.change_radius(*offset)
            _choose_edges(channel, stage)

        _behind_corner(channel, follow)
        channel.context_changed()  # rows tell the distance from the contour


def changed_frame(channel: SinumerikChannel) -> None:
    """A frame, or CUT2D for CUT2DF, while compensation is active: another scale is another radius in the program."""
    held_in_space = spatial.stage_of(channel) or faces.stage_of(channel)
    stage = held_in_space or active_cutter(channel)
    if stage is None or channel.mode["compensation"] == "G40":
        return
    contour, linear = Contour.of(channel), seat.frame_in_front(channel).m
    if linear != contour.linear and stage.holds_vector:
        raise not_supported("ROT SCALE MIRROR: G41 G42")
    contour.linear = linear
    if isinstance(stage, CutterCompensation):
        lead(channel, stage, tool_plane(channel).frame)
        stage.change_radius(*_offset(channel))
    else:
        _check_size(channel)
        spatial.follow(channel)
        faces.follow(channel)


def _check_size(channel: SinumerikChannel) -> None:
    """PC0001 for frames that scale the contour of CUT3DC and its like."""
    columns = zip(*seat.frame_in_front(channel).m, strict=True)
    if any(abs(hypot(*column) - 1.0) > EVEN for column in columns):
        raise not_supported(f"SCALE: {channel.mode['tool_offset']}")


def changed_rules(channel: SinumerikChannel) -> None:
    """NORM, KONT, G450, G451, ORIC, ORID while compensation is active."""
    spatial.follow(channel)
    stage = active_cutter(channel)
    if stage is not None:
        _release_edge(channel)
        stage.policy = policy(channel)


def suspend(channel: SinumerikChannel) -> None:
    """CUTCONON, CUTCONOF: blocks keep the vector of the last one, or are compensated themselves again."""
    suspended = channel.mode["constant_side"] == "CUTCONON"

    def change() -> None:
        stage = channel.path.find(CutterCompensation)
        if stage is not None:
            _release_edge(channel)
            stage.suspended = suspended

    _behind_corner(channel, change)


def distance(channel: SinumerikChannel) -> float:
    """True distance of the tool centre from the contour, mm.

    In a groove with walls (TRACYL, type 513) the contour is its centre line, OFFN half its width: OFFN - R (6.8.2).
    """
    radius, allowance = channel.memory.tools.radius, Contour.of(channel).allowance_mm
    return allowance - radius if seat.wall_column(channel) >= 0 else radius + allowance


def radius(channel: SinumerikChannel) -> float:
    """The same in units of the programmed contour, which frames may scale."""
    return distance(channel) / tool_plane(channel).scale


def _offset(channel: SinumerikChannel) -> tuple[float, Point]:
    """Radius and tip as compensation takes them: an allowance (OFFN) is no part of the way from nose to tip.

    PC0001 where an allowance takes the whole radius of a turning tool away, of which the tip would be a part.
    """
    size, (u, v) = radius(channel), tip(channel)
    if (u, v) == (0.0, 0.0) or not Contour.of(channel).allowance_mm:
        return size, (u, v)
    whole = distance(channel)
    if abs(whole) < NO_WAY:
        raise not_supported("OFFN: $TC_DP2 G41 G42")
    part = abs(channel.memory.tools.radius / whole)
    return size, (part * u, part * v)


def tip(channel: SinumerikChannel) -> Point:
    """From the nose centre to the programmed tip, as compensation sees it, in units of the radius; zero for mills."""
    vector: Vector = channel.memory.tools.tip(channel.mode["plane"])
    if not any(vector):
        return (0.0, 0.0)
    u, v, _ = PLANES[channel.mode["plane"]]
    linear = Frame(seat.frame_in_front(channel).m)
    if not linear.is_identity:
        led = tool_plane(channel)
        vector = led.frame.direct(*times(linear.inverse().direct(*vector), led.scale))
    return (vector[u], vector[v])
