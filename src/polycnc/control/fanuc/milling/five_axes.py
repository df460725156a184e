"""Five axes of the FANUC machining centre: how tip control begins, and radius compensation in space under it.

Three-dimensional cutter compensation G41.2, G42.2 (the tool as the rotary axes stand it) and G41.6, G42.6 (by I J K) is
general knowledge of FANUC 30i; the manuals at hand have none of it. What nobody here knows for sure is PC0001: without
tip control, start-up type C, a G40 alone with type B, arcs on machines with a swivel head alone, a second code or D in
between, blocks that turn the tool alone, and codes that change coordinates.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.compensation.spatial import INTERSECTION_FIRST, Corners, Rules
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.tools import radius, spatial
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations import tool_center_point
from polycnc.control.word_address.transformations.tool_center_point import TIP_CODES
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel

#: Codes that go with the compensation, beside its own and those of no group that do not touch coordinates.
STRAIGHT = ("G0", "G1")
ALLOWED = frozenset((*STRAIGHT, "G4", "G9", "G40", "G61", "G64", "G80", "G90", "G91", "G93", "G94"))
RULES = Rules(no_corner="PS0033", square_start=True, reverses="PS0041")
#: Sharper corners of the work are not passed by the intersection of the parallels.
SHARP_DEG = 90.0


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: words name the tip on the table; PC0001 where 19696#5 WKP has them in a system that stands."""
    if _parameters(channel).WKP:
        raise _not_yet("19696#5")
    tool_center_point.start_following(channel, words)


def compensate(channel: WordAddressChannel, words: Words) -> None:
    """G41.2, G42.2, G41.6, G42.6 [D]: left or right of the path, across path and tool."""
    code, parameters = channel.mode["compensation"], _parameters(channel)
    length = channel.mode["length"]
    by_vector = code in spatial.BY_VECTOR
    if length not in TIP_CODES or (by_vector and length != "G43.5"):
        raise _not_yet(f"{code}: {length}")
    if parameters.SUV:
        raise _not_yet(f"{code}: 5003#1")
    if RadiusState.of(channel).side:
        raise words.fail("tip_mode", code)
    corners = Corners(INTERSECTION_FIRST, SHARP_DEG, cut_off=not parameters.CCC)
    spatial.engage(channel, words, corners, replace(RULES, corner_ends=parameters.SUP))


def cancel(channel: WordAddressChannel, words: Words) -> None:
    """G40: ends radius compensation of the plane and in space; its own motion leads back by start-up type B."""
    stage = spatial.stage_of(channel)
    if stage is not None and stage.rules.corner_ends:
        if not words.axes():
            raise _not_yet("5003#0: G40")
        stage.lead_back()
    spatial.end(channel)
    radius.cancel_compensation(channel, words)


def _check_block(builder: Builder) -> None:
    """Refuse arcs, and what nobody here knows the control to do between the first block and G40."""
    before = builder.before["compensation"]
    if before not in spatial.SIDES:
        return
    for row in builder.codes:
        if (
            row.group == "motion"
            and row.code not in STRAIGHT
            and builder.channel.control.kinematics(builder.channel).work
        ):
            raise builder.control.fail("spatial_motion", address=row.code)
        if row.code not in ALLOWED:
            raise _not_yet(f"{row.code}: {before}")
    if builder.mode["motion"] not in STRAIGHT or builder.mode["cycle"] != "G80":
        raise _not_yet(f"{builder.mode['motion']}: {before}")
    for address in ("D", "H"):
        if builder.has(address):
            raise _not_yet(f"{address}: {before}")
    _check_turn(builder, before)


def _check_turn(builder: Builder, code: str) -> None:
    """Refuse a block that only turns the tool: on which side of it the work lies meanwhile is not known here."""
    channel, moves, turns = builder.channel, False, ""
    for address in builder.slots:
        target = builder.control.axis_of_address(channel, address, builder)
        if target is not None and target[0] in channel.coordinates.geometry:
            moves = True
        elif target is not None or address in "IJK":
            turns = address
    if turns and not moves and not any(row.code == "G40" for row in builder.codes):
        raise _not_yet(f"{turns}: {code}")


def _behind(builder: Builder, _plan: Plan) -> Step | None:
    """Behind G40 the stage that has led back has nothing to do."""
    if builder.mode["compensation"] in spatial.SIDES:
        return None
    return lambda channel, _values: channel.path.relax()


def _parameters(channel: Channel) -> FanucMillingParameters:
    return FanucMillingParameters.naming(channel.setup.parameters)


def _not_yet(code: str) -> AlarmError:
    return AlarmError("PC0001", hint="hint.not-supported", code=code)


#: What must not come during radius compensation in space.
RULE = Rule(
    "radius compensation in space", modes={"compensation": spatial.SIDES}, check=_check_block, after=_behind
)
