"""Radius compensation in space on the FANUC machining centre.

Three-dimensional cutter compensation G41.2, G42.2 (the tool as the rotary axes stand it), G41.6, G42.6 (by I J K) and
the forms of FANUC 16i for machines with a table (G41.4, G42.4) and with table and head (G41.5, G42.5) are general
knowledge of FANUC 30i and of the manuals of 15i (B-63324EN, 14.14, page 559) and 16i (A-78438E); the manuals at hand
have none of it. Without tip control words name the axes, and a corner is that of the work as the table has turned it.
What nobody here knows for sure is PC0001.
"""

from __future__ import annotations

from polycnc.compensation.spatial.rules import INTERSECTION_FIRST, Corners, Rules
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.systems import ZeroState
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.states import TiltState
from polycnc.control.word_address.tools import radius, spatial
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tool_center_point import plan_with_direction
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.kinematics import Kinematics

STRAIGHT, ARCS = ("G0", "G1"), ("G2", "G3")
#: Codes that go with the compensation, beside its own, arcs, and those of no group that do not touch coordinates.
ALLOWED = frozenset((*STRAIGHT, *ARCS, "G4", "G9", "G40", "G61", "G64", "G80", "G90", "G91", "G93", "G94"))
#: The forms of FANUC 16i, which lead no axis, for machines with rotary axes in the table alone, and in both.
FOR_TABLES, FOR_MIXED = ("G41.4", "G42.4"), ("G41.5", "G42.5")
#: Codes that may take turns while the compensation is on.
FORMS = (("G41.2", "G42.2"), radius.BY_VECTOR, FOR_TABLES, FOR_MIXED)
RULES = Rules(
    no_corner="PS0033",
    square_start=True,
    no_room="PS0041",
    reverses="PS0041",
    slanted="PS5460",
    rounds_ends=True,
    crosses=True,
)
#: Sharper corners of the work are not passed by the intersection of the parallels.
SHARP_DEG = 90.0


def compensate(channel: WordAddressChannel, words: Words) -> None:
    """G41.2, G41.4 to G41.6, G42.2, G42.4 to G42.6 [D]: left or right of the path, across path and tool."""
    code, parameters = channel.mode["compensation"], _parameters(channel)
    begins = spatial.stage_of(channel) is None
    if RadiusState.of(channel).side:
        raise words.fail("five_axis_mode", code)
    led = channel.mode["length"] in TIP_CODES
    if begins:
        _check_machine(channel, words, code)
        if not led:
            check_axes(channel, code)
    corners = Corners(INTERSECTION_FIRST, SHARP_DEG, cut_off=not parameters.CCC)
    spatial.engage(channel, words, corners, replace(RULES, corner_ends=parameters.SUP, follows_turns=led))
    stage = spatial.stage_of(channel)
    if begins and stage is not None and parameters.SUV and not words.axes():
        stage.shift_at(radius.place_of_block(channel))


def _check_machine(channel: WordAddressChannel, words: Words, code: str) -> None:
    """PS5460 for a form that is not for this machine; those of FANUC 16i do not go with tip control."""
    length, kinematics = channel.mode["length"], channel.control.kinematics(channel)
    if code in radius.BY_VECTOR and length == "G43.4":
        raise words.fail("spatial_motion", code)
    if code in radius.BY_VECTOR and length not in TIP_CODES and kinematics.work:
        parameters = _parameters(channel)
        if not parameters.TBP or parameters.WKP:
            raise words.fail(
                "tip_direction", code
            )  # directions are those of a system that the table takes along
        if any(letter in words for letter in "IJK"):
            raise not_yet(f"{code} I J K: 19746#4")  # there is no such system yet
    if code in (*FOR_TABLES, *FOR_MIXED) and length in TIP_CODES:
        raise words.fail("tip_company", code)
    fits = {
        **dict.fromkeys(FOR_TABLES, bool(kinematics.work and not kinematics.tool)),
        **dict.fromkeys(FOR_MIXED, bool(kinematics.work and kinematics.tool)),
    }
    if not kinematics.axes or -1 in channel.coordinates.geometry or not fits.get(code, True):
        raise words.fail("spatial_motion", code)


def check_axes(channel: WordAddressChannel, code: str) -> None:
    """Without tip control: PC0001 where the work system is turned or goes with the table."""
    zero = ZeroState.of(channel)
    turned = TiltState.of(channel).plane is not None or not zero.frame.is_identity
    if turned or OnTable.of(channel).acts or channel.coordinates.transformation is not None:
        raise not_yet(f"{code}: {channel.mode['rotation']}")


def cancel(channel: WordAddressChannel, words: Words) -> None:
    """G40: ends radius compensation of the plane and in space, as its start-up type says (5003#0, #1)."""
    stage, moves = spatial.stage_of(channel), bool(words.axes())
    if stage is not None and not moves and _parameters(channel).SUV:
        stage.return_at(radius.place_of_block(channel))
    elif stage is not None and moves and stage.rules.corner_ends:
        stage.lead_back()
    spatial.end(channel)
    radius.cancel_compensation(channel, words)


def check_block(builder: Builder) -> None:
    """Refuse what nobody here knows the control to do between the first block and G40."""
    before = builder.before["compensation"]
    if before not in radius.SIDES:
        return
    kinematics: Kinematics = builder.channel.control.kinematics(builder.channel)
    form = next(codes for codes in FORMS if before in codes)
    for row in builder.codes:
        if row.group == "motion" and row.code not in STRAIGHT and (kinematics.work or row.code not in ARCS):
            raise builder.control.fail("spatial_motion", address=row.code)
        if row.group == "wcs":
            raise builder.control.fail("spatial_motion", address=row.code)
        if row.code not in ALLOWED and row.code not in form:
            raise not_yet(f"{row.code}: {before}")
    if builder.mode["cycle"] != "G80":
        raise not_yet(f"{builder.mode['cycle']}: {before}")
    if builder.has("H"):
        raise not_yet(f"H: {before}")
    if kinematics.work and builder.mode["length"] not in TIP_CODES:
        _check_turn(builder, before)


def _check_turn(builder: Builder, code: str) -> None:
    """Refuse a block that only turns axes which nothing leads: whether it is one of the path is not known here."""
    channel, moves, turns = builder.channel, False, ""
    for address in builder.slots:
        target = builder.control.axis_of_address(channel, address, builder)
        if target is not None and target[0] in channel.coordinates.geometry:
            moves = True
        elif target is not None:
            turns = address
    if turns and not moves and not any(row.code == "G40" for row in builder.codes):
        raise not_yet(f"{turns}: {code}")


def relax_behind(builder: Builder, _plan: Plan) -> Step | None:
    """Behind G40 the stage that has led back has nothing to do."""
    if builder.mode["compensation"] in radius.SIDES:
        return None
    return lambda channel, _values: channel.path.relax()


def _parameters(channel: Channel) -> FanucMillingParameters:
    return FanucMillingParameters.naming(channel.setup.parameters)


def not_yet(code: str) -> AlarmError:
    """PC0001 for something that polycnc knows and does not execute."""
    return AlarmError("PC0001", hint="hint.not-supported", code=code)


def plan_direction(builder: Builder, plan: Plan) -> Step | None:
    """I J K of G41.6, G42.6 without tip control, on machines whose tool turns: the tool stands so at the end."""
    if builder.mode["length"] in TIP_CODES:
        return None
    refuse_two_directions(builder, plan)
    return plan_with_direction(builder, plan)


def refuse_two_directions(builder: Builder, plan: Plan) -> None:
    """PS5421 for rotary words beside I J K, as under G43.5: both say how the tool stands."""
    rotary = [word for word in plan.axis_words if builder.channel.axis_data[word.axis].rotary]
    if rotary and any(builder.has(letter) and builder.is_free(letter) for letter in "IJK"):
        raise builder.control.fail("tip_company", address=rotary[0].address)
