"""PTP, CP, STAT, TU: straight blocks that go with the axes of the machine, not with the tip (6.9)."""

from __future__ import annotations

from math import inf

from polycnc.control.sinumerik.block.positions import Dimension, number
from polycnc.control.sinumerik.couplings.links import Couplings, bare
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.states import PointToPoint
from polycnc.control.sinumerik.tables import APPROACHES, RETRACTIONS
from polycnc.control.sinumerik.tools import stages
from polycnc.control.sinumerik.transformations import data_sets, seat
from polycnc.control.sinumerik.transformations.orientation import is_point_to_point
from polycnc.control.sinumerik.transformations.pole_sides import plane_of, stand
from polycnc.control.sinumerik.transformations.posture import Orienting, Posture
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.transformation.orientation.choice import is_within
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.toolpath import Kind
    from polycnc.transformation.contract import Transformation

#: TU says something of so many rotary axes, and STAT and TU have so many bits.
MOST_AXES, BITS = 3, 8
TURN = 360.0
#: Words by which a block moves that names no end: a full circle, an arc of an angle, a polynomial.
WITHOUT_END = ("I", "J", "K", "AR", "PO")
#: A turn that is shorter than half a round by less goes forward, degrees.
HALF_TURN = 1e-6


def plan(draft: Draft) -> None:
    """Take STAT and TU; a straight block under PTP goes with the axes.

    Raises:
        AlarmError: 14140 for STAT and TU without a transformation, 14144 for PTP under radius compensation, for all but
            straight blocks, smooth approach and retraction, and for positioning axes of the transformation.
    """
    words = [(address, draft.take(address)) for address in ("STAT", "TU")]
    given = [(address, place) for address, place in words if place is not None]
    if given and not draft.mode[seat.GROUP]:
        raise AlarmError("14140")
    if given:
        draft.steps.append(_noted(dict(given)))
    if not draft.mode[seat.GROUP]:
        return
    is_smooth = draft.codes.get("block_motion") in (*APPROACHES, *RETRACTIONS)
    if draft.mode["point_to_point"] == "PTP" and (is_smooth or draft.mode["compensation"] != "G40"):
        raise AlarmError("14144")
    moves = draft.lead is not None or bool(draft.axis_terms()) or draft.has(*WITHOUT_END)
    if draft.mode["point_to_point"] == "PTP" and moves and draft.mode["motion"] not in ("G0", "G1"):
        raise AlarmError("14144")
    if "TU" in dict(given):
        draft.behind_motion.append(finish)
    if is_point_to_point(draft.mode):
        draft.by_axes = True
        places = (Dimension.ABSOLUTE, Dimension.MODULO)
        draft.steps.append(_placed(frozenset(t.column for t in draft.axis_terms() if t.way in places)))


def _placed(columns: frozenset[int]) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        PointToPoint.of(channel).placed = columns

    return run


def _noted(places: dict[str, int]) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:
        for address, place in places.items():
            value = number(values, place)
            if value != int(value) or not 0 <= value < 1 << BITS:
                raise WordAlarm("12560", place, text=address)
            if address == "STAT":
                Orienting.of(channel).stat = int(value)
                PointToPoint.of(channel).across = bool(int(value) & 1)
            else:
                PointToPoint.of(channel).turns = int(value)

    return run


def finish(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """TU holds for its block alone."""
    PointToPoint.of(channel).turns = None


def ends_contour(channel: SinumerikChannel) -> bool:
    """Whether a block under PTPG0 leads the tool back from a compensated contour: it goes with the tip (6.9.1)."""
    return channel.mode["point_to_point"] == "PTPG0" and stages.active_cutter(channel) is not None


def go(channel: SinumerikChannel, kind: Kind, end: list[float], feed: float) -> None:
    """Go to a point of the work with all axes at once, straight for each of them; its row holds their positions."""
    coordinates, state = channel.coordinates, PointToPoint.of(channel)
    transformation = coordinates.transformation
    assert isinstance(transformation, Seated)
    leading = {law.leading for laws in Couplings.of(channel).laws().values() for law in laws}
    if leading & seat.transformed(channel):
        raise not_supported("PTP: TRAILON LEADON EGON")
    stages.refuse_open_change(channel, "PTP")
    if stages.active_cutter(channel) is not None:
        raise AlarmError("14144")
    machine = _configured(channel, transformation, end)
    channel.flush()
    plane, across = plane_of(channel), _goes_across(channel)
    geometry, width = coordinates.geometry, len(channel.axes)
    coordinates.transform(None, data_sets.native(channel), (IDENTITY, [0.0] * width))
    state.shown_by = bare(transformation)
    channel.context_changed()
    try:
        channel.straight(kind, machine, feed)
        channel.flush()  # no chamfer or rounding leads from here to a block that goes by the tip (6.9.1)
    finally:
        coordinates.transformation, coordinates.geometry = transformation, geometry
        state.shown_by = None
        channel.context_changed()
    back = transformation.to_work(machine)
    same = all(abs(a - b) < 1e-6 for a, b in zip(back, end, strict=True))
    coordinates.arrive(end if same else back)
    if plane is not None:
        side, at = -plane.side if across else plane.side, machine[plane.rotary]
        stand(channel, side, at)
        # The way may have led past half a turn: the path goes on from the turn on which the axis stands.
        stand(channel, side, at, TURN * round((at - coordinates.machine[plane.rotary]) / TURN))
    state.across = False


def _configured(channel: SinumerikChannel, transformation: Transformation, end: list[float]) -> list[float]:
    """Positions of the axes: by STAT of two solutions, by TU on the turn that it names, else the shortest way.

    So they go whatever TU says where more turns are within their travel. What a block says of the way itself (IC,
    G91, DC, ACP, ACN) holds.
    """
    here, machine = channel.coordinates.machine, transformation.to_machine(end)
    if _goes_across(channel):
        machine = transformation.solutions(end)[1]
    turns = PointToPoint.of(channel).turns
    rotary = [i for i, axis in enumerate(channel.axis_data) if axis.rotary and i in seat.transformed(channel)]
    is_polar = seat.centre_point(channel) is None
    for bit, column in enumerate(rotary[:MOST_AXES]):
        if turns is not None and not is_polar and _is_told_by_turns(channel, column):
            angle = machine[column] % TURN
            machine[column] = angle - TURN if turns >> bit & 1 and angle > 0.0 else angle
        elif is_polar or column in PointToPoint.of(channel).placed:
            near = _shortest(machine[column], here[column])
            places = (near, machine[column], near - TURN, near + TURN)
            within = (angle for angle in places if is_polar or _reaches(channel, column, angle))
            machine[column] = next(within, machine[column])
    # Digits of the transformation are no way on which F would count.
    return [b if abs(a - b) < NO_WAY else a for a, b in zip(machine, here, strict=True)]


def _is_told_by_turns(channel: SinumerikChannel, column: int) -> bool:
    """Whether TU says where an axis goes: no more than a turn each way is within its travel, or no limit is told."""
    axis = channel.axis_data[column]
    low, high = Posture.of(channel, channel.mode).travel(axis.name)
    within = low >= -TURN or low == -inf, high <= TURN or high == inf
    return not axis.modulo and all(within)


def _goes_across(channel: SinumerikChannel) -> bool:
    """Whether the infeed axis of TRANSMIT goes to the other side of the centre: STAT asks, MD24911 allows it.

    It does so once for each STAT: blocks that follow stay there, while STAT holds.
    """
    build = seat.Transformations.of(channel).build
    return build is not None and build.changes_sides and PointToPoint.of(channel).across


def _shortest(angle: float, here: float) -> float:
    """The same direction on the turn that is nearest; half a turn goes forward, however its digits fall."""
    forward = TURN / 2.0 - HALF_TURN
    return here + (angle - here + forward) % TURN - forward


def _reaches(channel: SinumerikChannel, column: int, angle: float) -> bool:
    """Whether the travel of an orientation axis has a position."""
    return is_within(angle, *Posture.of(channel, channel.mode).travel(channel.axis_data[column].name))
