"""3D radius compensation G41.2, G42.2, G41.6, G42.6 under tool tip control (manual 2.87)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.compensation.spatial.rules import ARC_FIRST, INTERSECTION, Corners, Rules
from polycnc.control.syntec.coordinates.turns import PostureState
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.states import LengthState, PolarState
from polycnc.control.word_address.tools import radius, spatial
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.normal_stage import NormalStage
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words

WORK_SYSTEMS = (*(f"G{i}" for i in range(54, 60)), *(f"G59.{i}" for i in range(1, 10)))
#: What each code is called in the table of mistakes while the compensation is on.
FORBIDDEN = {
    **dict.fromkeys(
        ("G2", "G3", "G2.4", "G3.4", "G6.2", "G12.1", "G13.1", "G16", "G28", "G29", "G30", "G28.1", "G31", "G31.10",
         "G31.11", "G33", "G41.1", "G42.1", "G53", "G63", "G95", "G96"),
        "spatial_motion",
    ),
    **dict.fromkeys(("G49", "G52", *WORK_SYSTEMS, "G54.4", "G68", "G68.2", "G68.3", "G92", "G92.1"), "spatial_frame"),
    **dict.fromkeys(("G17", "G18", "G19"), "spatial_plane"),
    **dict.fromkeys(("G41", "G42"), "spatial_mixed"),
}  # fmt: skip

#: Eight blocks in a row may not be computable once the first one has moved.
RULES = Rules(no_corner="COR-607", idle="COR-609", most_idle=8)


@dataclass(slots=True)
class SpatialState(State, lifetime=Lifetime.POWER):
    """P of G10 L450: how corners are led round."""

    corner_way: int = 0


def start(channel: SyntecChannel, words: Words) -> None:
    """G41.2, G42.2, G41.6, G42.6 [D]: left or right of the path, across the tool; also changes sides."""
    if spatial.stage_of(channel) is None:
        _check_start(channel, words, channel.mode["compensation"])
    spatial.engage(channel, words, _corners(channel), RULES)


def _check_start(channel: SyntecChannel, words: Words, code: str) -> None:
    mode = channel.mode
    if RadiusState.of(channel).side:
        raise words.fail("spatial_mixed", code)
    if channel.path.find(NormalStage) is not None:
        raise words.fail("normal_spatial", code)
    if mode["length"] not in TIP_CODES:
        raise words.fail("spatial_without_tip", code)
    frames = (
        mode["rotation"] != "G69" or mode["polar"] == "G16" or LengthState.of(channel).direction is not None
    )
    speeds = mode["path"] == "G63" or mode["feed"] == "G95" or mode["surface_speed"] == "G96"
    if frames or speeds or PolarState.of(channel).plane is not None or PostureState.of(channel).in_work:
        raise words.fail("spatial_mode", code)


def _corners(channel: SyntecChannel) -> Corners:
    memory = channel.memory
    unit: float = memory.least_angle
    least, most = memory.parameters.least_intersection, memory.parameters.largest_arc
    return Corners(SpatialState.of(channel).corner_way, least * unit, most * unit if most else 180.0)


def choose_corners(channel: SyntecChannel, words: Words) -> None:
    """G10 L450 P: 0 intersections, 1 intersections first, 2 arcs first."""
    way = words.typed("P")
    if way is None or not INTERSECTION <= way <= ARC_FIRST or way != int(way):
        raise words.fail("argument", "P" if way is not None else "G10")
    SpatialState.of(channel).corner_way = int(way)


def check_block(builder: Builder) -> None:
    """Refuse what the compensation does not allow."""
    before, after = builder.before["compensation"], builder.mode["compensation"]
    fail = builder.control.fail
    if before in radius.SIDES:
        for row in builder.codes:
            if row.code in FORBIDDEN and row.code != builder.before["plane"]:
                raise fail(FORBIDDEN[row.code], address=row.code)
            if row.code in spatial.SHAPES:
                raise _not_yet(row.code, before)
        if builder.has("D") and not any(row.code in radius.SIDES for row in builder.codes):
            raise _not_yet("D", before)
        if builder.mode["length"] not in TIP_CODES:
            raise fail("spatial_frame", address=builder.mode["length"])
    if after in radius.BY_VECTOR:
        for address in builder.slots:
            target = builder.control.axis_of_address(builder.channel, address, builder)
            if target is not None and builder.channel.axis_data[target[0]].rotary:
                raise fail("tip_rotary_word", address=address)


def _not_yet(address: str, code: str) -> AlarmError:
    return AlarmError("PC0001", hint="hint.not-supported", address=address, code=f"{code} {address}")
