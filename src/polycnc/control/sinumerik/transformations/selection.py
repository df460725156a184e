"""TRAORI, TRANSMIT, TRACYL, TRAANG, TRACON, TRAFOOF: which transformation acts (job planning 6.8 to 6.12).

A change of transformation deselects the frames (6.10; MD10602 keeps them), the working area and protection zones.
"""

from __future__ import annotations

from math import nan

from polycnc.channel.failure import stand_at_last_row
from polycnc.compensation.corner import CornerStage
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings import switching
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames.memory import OF_PLANES
from polycnc.control.sinumerik.limits import protection, working_area
from polycnc.control.sinumerik.tables import TURN, length_factor
from polycnc.control.sinumerik.tools import selection as lengths_of_edge
from polycnc.control.sinumerik.tools import stages
from polycnc.control.sinumerik.tools.holders.active import ActiveCarrier
from polycnc.control.sinumerik.transformations import data_sets, seat
from polycnc.control.sinumerik.transformations.data_sets import Build
from polycnc.control.sinumerik.transformations.pole_sides import PoleSides, plane_of
from polycnc.control.sinumerik.transformations.seat import Transformations
from polycnc.control.sinumerik.transformations.walls import WallStage
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.names.frame import NEUTRAL
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind
from polycnc.transformation.chain import Chain

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.frames.memory import Frames

#: A working diameter of TRACYL is greater; an angle of TRAANG smaller, degrees.
LEAST_DIAMETER, SQUARE = 1.0, 90.0
#: Frames by which one sees that CYCLE800 has turned plane and tool.
OF_SWIVEL = ("$P_PARTFRAME", "$P_WPFRAME")


def orientation(channel: SinumerikChannel, args: Arguments) -> None:
    """TRAORI(n, X, Y, Z, A, B): the tip is programmed; basic direction of the tool and offsets of its axes."""
    number, *rest = _numbers(args, 6, "TRAORI")
    _select(channel, "TRAORI", number, lambda found: _oriented(channel, found, rest))


def _oriented(channel: SinumerikChannel, found: data_sets.DataSet, rest: list[float | None]) -> Build:
    x, y, z, a, b = (*rest, *[None] * 5)[:5]
    along = None if x is y is z is None else (x or 0.0, y or 0.0, z or 0.0)
    return data_sets.orientation(channel, found, along, (a or 0.0, b or 0.0))


def face(channel: SinumerikChannel, args: Arguments) -> None:
    """TRANSMIT(n): the end face of a turned part in Cartesian coordinates."""
    (number,) = _numbers(args, 1, "TRANSMIT")
    _select(channel, "TRANSMIT", number, lambda found: data_sets.polar(channel, found))


def surface(channel: SinumerikChannel, args: Arguments) -> None:
    """TRACYL(d, n, walls): the unrolled surface of a cylinder; 14404 for a diameter of 1 or less.

    PC0001 where words are inches: whether the diameter is then, too, is not known.
    """
    diameter, number, walls = _numbers(args, 3, "TRACYL")
    _select(channel, "TRACYL", number, lambda found: _unrolled(channel, found, diameter, walls))


def _unrolled(
    channel: SinumerikChannel,
    found: data_sets.DataSet,
    diameter: float | None,
    walls: float | None,
    infeed: int = -1,
) -> Build:
    if diameter is None or diameter <= LEAST_DIAMETER:
        raise AlarmError("14404", text="TRACYL")
    if walls not in (None, 0, 1) or (walls and found.type != data_sets.WALLS_BY_ARGUMENT):
        raise AlarmError("14404", text="TRACYL")
    if length_factor(channel.mode) != 1.0:
        raise not_supported("TRACYL: G70 G700")
    by_type = found.type == data_sets.WITH_WALLS
    if walls is None and found.type == data_sets.WALLS_BY_ARGUMENT:
        walls = data_sets.walls_of_machine(channel, found)
    return data_sets.cylinder(channel, found, diameter, walls=by_type or bool(walls), infeed=infeed)


def oblique(channel: SinumerikChannel, args: Arguments) -> None:
    """TRAANG(angle, n): an oblique axis; without an angle the one programmed last, at first that of the machine data.

    14404 for an angle of 90 degrees or more.
    """
    angle, number = _numbers(args, 2, "TRAANG")
    _select(channel, "TRAANG", number, lambda found: _leaning(channel, found, angle))


def _leaning(channel: SinumerikChannel, found: data_sets.DataSet, angle: float | None) -> Build:
    angles = Transformations.of(channel).angles
    if angle is None:
        angle = angles.get(found.number, data_sets.angle_of_machine(channel, found))
    if not -SQUARE < angle < SQUARE:
        raise AlarmError("14404", text="TRAANG")
    angles[found.number] = angle
    return data_sets.inclined(channel, found, angle)


def chained(channel: SinumerikChannel, args: Arguments) -> None:
    """TRACON(n, …): two transformations one after the other, their parameters behind n; 14404 for n beyond 2."""
    number, *rest = _numbers(args, 8, "TRACON")
    if number not in (None, 0, 1, 2):
        raise AlarmError("14404", text="TRACON")
    _select(channel, "TRACON", number or 1, lambda found: _linked(channel, found, rest))


def _linked(channel: SinumerikChannel, found: data_sets.DataSet, rest: list[float | None]) -> Build:
    """MD24995 and its like name the links; 14404 where they are no transformation followed by TRAANG."""
    n = data_sets.order(channel, found)
    numbers = [int(data_sets.number_of(channel, f"$MC_TRACON_CHAIN_{n}", i, 0.0)) for i in range(2)]
    data = channel.memory.data
    links = []
    for each in numbers:
        name = f"$MC_TRAFO_TYPE_{each}"
        type_ = data.integer(name) if each and data.is_set(name) else 0
        kind = next((kind for kind, types in data_sets.TYPES.items() if type_ in types), "")
        links.append(data_sets.DataSet(kind, type_, each))
    if links[0].kind in ("", "TRACON") or links[1].kind != "TRAANG":
        raise AlarmError("14404", text="TRACON")
    for link in links:
        data_sets.check(channel, link)
    own = {"TRACYL": 1, "TRAANG": 1}.get(links[0].kind, 0)
    parameters = [*rest, *[None] * 2]
    first = _first_link(channel, links[0], parameters[0])
    second = _leaning(channel, links[1], parameters[own])
    inner = Chain((first.inner, second.inner))
    if any(second.in_front):
        raise data_sets.another_machine(f"$MC_TRAANG_BASE_TOOL_{data_sets.order(channel, links[1])}")
    return replace(first, inner=inner, used=first.used | second.used)


def _first_link(channel: SinumerikChannel, found: data_sets.DataSet, parameter: float | None) -> Build:
    if found.kind == "TRAORI":
        return _oriented(channel, found, [])
    infeed = data_sets.oblique_column(channel)
    if found.kind == "TRANSMIT":
        return data_sets.polar(channel, found, infeed)
    if found.kind == "TRACYL":
        return _unrolled(channel, found, parameter, None, infeed)
    return _leaning(channel, found, parameter)


def off(channel: SinumerikChannel, args: Arguments) -> None:
    """TRAFOOF: no transformation acts, the frames are deselected; nothing where none acted."""
    if args:
        raise AlarmError("14020", text="TRAFOOF")
    if Transformations.of(channel).build is not None:
        _check_change(channel)
        _change(channel, "", None)
    channel.memory.frames.system["$P_TRAFRAME"] = NEUTRAL


def _numbers(args: Arguments, most: int, name: str) -> list[float | None]:
    """The arguments of a call as numbers, None for those left out; 14020 for too many."""
    if len(args) > most:
        raise AlarmError("14020", text=name)
    given = [None if each is None else arguments.real(each) for each in args]
    return [*given, *[None] * (most - len(given))]


def _select(
    channel: SinumerikChannel,
    kind: str,
    number: float | None,
    build: Callable[[data_sets.DataSet], Build],
) -> None:
    """Let a transformation act in place of the one that acted.

    Raises:
        AlarmError: 14404 for a number that is no whole one, 14401 for a transformation that is not configured,
            PC0019 for machine data beside the machine file, and what `_check_change` finds.
    """
    if number is not None and number != int(number):
        raise AlarmError("14404", text=kind)
    found = data_sets.find(channel, kind, 1 if number is None else int(number))
    data_sets.check(channel, found)
    made = build(found)
    _check_change(channel)
    _change(channel, kind, made)


def _check_change(channel: SinumerikChannel) -> None:
    """6.10: 14400 under radius compensation, 14402 under a spline, PC0014 at an open corner or under FTOCON."""
    mode = channel.mode
    if mode["compensation"] != "G40":
        raise AlarmError("14400")
    if mode["motion"] in tables.SPLINES:
        raise AlarmError("14402")
    if mode["fine_tool_offset"] == "FTOCON":
        raise AlarmError("PC0014", text="FTOCON")
    end_contour(channel)


def end_contour(channel: SinumerikChannel) -> None:
    """Nothing is held back for a contour any more; PC0014 at an open corner."""
    corner = channel.path.find(CornerStage)
    if corner is not None and not corner.settle():
        raise AlarmError("PC0014", text="CHF CHR RND")
    channel.flush()
    if stages.active_cutter(channel) is not None:  # G40 has not led back: the tool stands beside the path
        stand_at_last_row(channel)
        channel.path.take(*stages.OF_PLANE)


def _change(channel: SinumerikChannel, kind: str, build: Build | None) -> None:
    """A transformation acts, or none: frames, working area and protection zones are deselected, nothing moves."""
    state, memory = Transformations.of(channel), channel.memory
    channel.path.take(WallStage, PoleSides)
    switching.check_change(channel, build)
    if state.build is None:
        _begin_where_axes_stand(channel)
    state.kind, state.build = kind, build
    seat.regroup(channel, None)  # a transformation has geometry axes of its own
    swivelled = any(memory.frames.system[name] != NEUTRAL for name in OF_SWIVEL)
    if swivelled and not ActiveCarrier.of(channel).number:
        memory.tools.carrier = None  # the transformation turns the tool now
    if not memory.data.integer("$MN_FRAME_GEOAX_CHANGE_MODE"):
        deselect_frames(channel)
    if build is not None:
        channel.mode = channel.mode.with_code("working_area", "WALIMOF")
        protection.deselect(channel)
    channel.mode = channel.mode.with_code(seat.GROUP, kind)
    switching.refuse_transformed(channel, Couplings.of(channel).links)
    lengths_of_edge.follow(channel)
    seat.stand(channel, memory.frames.total())
    working_area.refresh(channel)
    channel.context_changed()
    if plane_of(channel) is not None:
        channel.path.put(PoleSides(channel))


def _begin_where_axes_stand(channel: SinumerikChannel) -> None:
    """Axes that SPOS or POS has moved beside the path get a row: the path of the transformation begins behind it."""
    coordinates, toolpath = channel.coordinates, channel.toolpath
    context, end, here = toolpath.last_context(), toolpath.last_end(), coordinates.machine
    last = toolpath.to_machine(end, context, coordinates.geometry) if end and context else channel.stands_at
    ways = [
        (a - b + 0.5 * TURN) % TURN - 0.5 * TURN if axis.rotary else a - b
        for axis, a, b in zip(channel.axis_data, here, last, strict=True)
    ]
    if any(abs(way) > NO_WAY for way in ways):
        coordinates.arrive_machine(list(last))
        channel.straight(Kind.RAPID, coordinates.from_machine(here), nan)
        channel.flush()
        coordinates.arrive_machine(here)


def deselect_frames(channel: SinumerikChannel) -> None:
    """No frame is active, but for the base frames."""
    frames: Frames = channel.memory.frames
    channel.mode = channel.mode.with_code("wcs", "G500")
    frames.select(0)
    frames.programmable = NEUTRAL
    frames.system.update(dict.fromkeys(("$P_PARTFRAME", *OF_PLANES), NEUTRAL))


PROCEDURES: dict[str, Procedure] = {
    "TRAORI": orientation,
    "TRANSMIT": face,
    "TRACYL": surface,
    "TRAANG": oblique,
    "TRACON": chained,
    "TRAFOOF": off,
}
