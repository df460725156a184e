"""19746#4 TBP = 1: in radius compensation without tip control words name points of the table.

FANUC 30i, B-63944EN/02, page 776. The system is the work system as the table has turned at the end of the block in
which the compensation begins. Rows hold where the axes go, which is straight; displays show the points of the table.
I J K of G41.6 name directions in it. With 19696#5 WKP = 1 words name points of the work system, which does not turn.
"""

from __future__ import annotations

from math import nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.milling import five_axes, leading_edge
from polycnc.control.fanuc.milling.five_axes import not_yet
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.coordinates.systems import work_zero
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.tools import radius, spatial
from polycnc.control.word_address.transformations.tilted_plane import turn_to
from polycnc.control.word_address.transformations.tool_center_point import angles_named
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import translation
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.transformation.seated import Seated

NOWHERE = (0.0, 0.0, 0.0)
#: Modal group: "table" while words name points of the table.
SYSTEM = "point_system"
STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}


@dataclass(slots=True)
class TableState(State, lifetime=Lifetime.RESET):
    """From points of the table to positions along the axes; None while words name those."""

    led: Seated | None = None


def compensate(channel: WordAddressChannel, words: Words) -> None:
    """G41.2, G41.4 to G41.6, G42.2, G42.4 to G42.6: compensation in space, in the system that 19746#4 chooses."""
    begins, parameters = (
        spatial.stage_of(channel) is None,
        FanucMillingParameters.naming(channel.setup.parameters),
    )
    five_axes.compensate(channel, words)
    turns = bool(channel.control.kinematics(channel).work) and channel.mode["length"] not in TIP_CODES
    if begins and turns and parameters.TBP and not parameters.WKP:
        _begin(channel, words)


def cancel(channel: WordAddressChannel, words: Words) -> None:
    """G40: ends every radius compensation; words name the axes again."""
    leading_edge.cancel(channel, words)
    if TableState.of(channel).led is not None:
        TableState.of(channel).led = None
        channel.coordinates.name(None)
        channel.mode = channel.mode.with_code(SYSTEM, "")
        channel.context_changed()


def _begin(channel: WordAddressChannel, words: Words) -> None:
    """From the next block on words name points of the table, which has turned as this block says."""
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
    from polycnc.transformation.seated import Seated

    c = channel.coordinates
    table = replace(channel.control.kinematics(channel), tool=(), nose=NOWHERE, to_nose=NOWHERE)
    zero, offsets = work_zero(channel, c.offsets), c.offsets.copy()
    for axis, place in zip(c.geometry, zero, strict=True):
        offsets[axis] = place
    shift = translation(*zero)
    begun = table.work_turn(angles_named(channel, words)).inverse()
    led = ToolCentrePoint(table, channel.axes, c.geometry, tuple(offsets), (0.0, 0.0, 0.0))
    TableState.of(channel).led = Seated(led, shift.inverse() @ begun @ shift)
    channel.mode = channel.mode.with_code(SYSTEM, "table")
    channel.context_changed()


def name_behind(builder: Builder, _plan: Plan) -> Step | None:
    """From the block behind the first one on words name points of the table."""
    if builder.mode["compensation"] not in radius.SIDES:
        return None

    def name(channel: WordAddressChannel, _values: list[float]) -> None:
        led = TableState.of(channel).led
        if led is not channel.coordinates.naming and led is not None:
            channel.coordinates.name(led)
            channel.context_changed()

    return name


def plan_direction(builder: Builder, plan: Plan) -> Step | None:
    """A straight block whose I J K name the direction of the tool on the table."""
    words, motion = plan.axis_words, builder.mode["motion"]
    side = builder.mode["compensation"]
    letters = [letter for letter in "IJK" if side in radius.BY_VECTOR and builder.has(letter)]
    if not letters or motion not in STRAIGHT:
        return None
    five_axes.refuse_two_directions(builder, plan)
    builder.take(*letters)
    kind, names_feed = STRAIGHT[motion], builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        c, led = channel.coordinates, TableState.of(channel).led
        feed = channel.feed if kind == Kind.FEED or names_feed else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        point = path.reach(channel, words, values)
        if led is not None:
            _turn(channel, led, Words(plan, values), point)
        channel.straight(kind, c.to_position(point), feed, point)

    return move


def _turn(channel: WordAddressChannel, led: Seated, words: Words, point: list[float]) -> None:
    """Let the rotary axes of a point of the table stand the tool along I J K there."""
    i, j, k = (words.part(letter) or 0.0 for letter in "IJK")
    x, y, z = channel.memory.frames.directions.direct(i, j, k)
    if not (x or y or z) or not turn_to(channel, led.frame.direct(x, y, z), _here(channel), point):
        raise words.fail("tip_direction", "I")


def _here(channel: WordAddressChannel) -> dict[str, float]:
    return dict(zip(channel.axes, channel.coordinates.machine, strict=True))


def refuse_apart(builder: Builder, plan: Plan) -> Step | None:
    """Which system words beside G40 name is not known for sure: they are refused where the two are not the same."""
    if builder.mode["compensation"] in radius.SIDES or not plan.axis_words:
        return None
    turns = any(builder.has(joint.axis) for joint in builder.channel.control.kinematics(builder.channel).work)

    def check(channel: WordAddressChannel, _values: list[float]) -> None:
        led, here = TableState.of(channel).led, channel.coordinates.position
        apart = led is not None and any(
            abs(a - b) > SAME_MM for a, b in zip(led.to_work(here), here, strict=True)
        )
        if apart or turns:
            raise not_yet("G40: 19746#4")

    return check


#: Points nearer to each other (mm) are the same.
SAME_MM = 1e-6
