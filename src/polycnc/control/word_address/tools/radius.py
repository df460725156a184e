"""G40, G41, G42 and the D word: cutter radius compensation as a stage of the channel's path."""

from __future__ import annotations

from polycnc.channel.moves.path import Move
from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.word_address.motion import arcs, corners

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.compensation.policy import Violation
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point

#: Codes of compensation in space (`spatial`) that every control with it has, by the side of the path on which the tool
#: stands.
COMMON_SIDES = {"G41.2": 1, "G42.2": -1, "G41.6": 1, "G42.6": -1}
#: All codes by that side; G41.4 to G42.5 are the forms of FANUC 16i.
SIDES = {**COMMON_SIDES, "G41.4": 1, "G42.4": -1, "G41.5": 1, "G42.5": -1}
#: Codes that name the tool's direction by I J K.
BY_VECTOR = ("G41.6", "G42.6")
#: What each `Violation` is called in a control's table of mistakes.
MISTAKES = {
    "ARC_START": "comp_arc_start",
    "ARC_CANCEL": "comp_arc_start",
    "INNER_RADIUS_TOO_SMALL": "comp_interference",
    "NO_INTERSECTION": "comp_no_intersection",
    "INTERFERENCE": "comp_interference",
    "NO_AVOIDANCE": "comp_no_avoidance",
    "AVOIDANCE_DANGEROUS": "comp_avoidance_dangerous",
    "AVOIDANCE_INTERFERES": "comp_avoidance_interferes",
}


@dataclass(slots=True)
class RadiusState(State, lifetime=Lifetime.RESET):
    """Cutter radius compensation as blocks ask for it.

    Attributes:
        number: Number of the active radius offset (D).
        side: Side that G41/G42 ask for: 1, -1, 0 off.
        engaged_side: Side that the stage of the path was last told.
    """

    number: int = 0
    side: int = 0
    engaged_side: int = 0


def violation_codes(alarms: Mapping[str, str]) -> dict[Violation, str]:
    """The control's alarm code of every violation; that of an interference where it has none of its own."""
    from polycnc.compensation.policy import Violation

    return {
        Violation[name]: alarms.get(mistake, alarms["comp_interference"])
        for name, mistake in MISTAKES.items()
    }


def compensate_left(channel: WordAddressChannel, words: Words) -> None:
    """G41: the tool is left of the contour, seen in the direction of travel."""
    _engage(channel, words, 1)


def compensate_right(channel: WordAddressChannel, words: Words) -> None:
    """G42: the tool is right of the contour."""
    _engage(channel, words, -1)


def _engage(channel: WordAddressChannel, words: Words, side: int) -> None:
    state = RadiusState.of(channel)
    number = words.integer("D")
    if number is not None:
        state.number = number
    _refuse_arc(channel, words)
    stage = compensation_stage(channel)
    state.side = side
    stage.policy = channel.control.compensation_policy(channel)
    control = channel.control
    shown, value, tip = (
        side_on_display(channel),
        control.radius_value(channel, state.number),
        control.nose_tip(channel),
    )
    if stage.active and state.engaged_side != side:
        corners.refuse_change(channel)
        stage.change_side(shown)
        stage.change_radius(value, tip)
    else:
        stage.engage(shown, value, tip, place_of_block(channel))
    state.engaged_side = side
    channel.context_changed()


def cancel_compensation(channel: WordAddressChannel, words: Words, *, takes_wall: bool = True) -> None:
    """G40: the next plane motion leads back to the programmed path.

    Args:
        channel: The channel.
        words: Words of the block; I J K give the wall behind the last point.
        takes_wall: Whether I J K count.
    """
    state = RadiusState.of(channel)
    stage = active_compensation(channel)
    if stage is None:
        return
    _refuse_arc(channel, words)
    corners.refuse_change(channel)
    state.side = state.engaged_side = 0
    stage.cancel(direction_of(channel, words) if takes_wall else None, place=place_of_block(channel))
    channel.context_changed()


def _refuse_arc(channel: WordAddressChannel, words: Words) -> None:
    """Compensation begins and ends in straight blocks only."""
    if channel.mode["motion"] in ("G2", "G3") and words.axes():
        raise words.fail("comp_arc_start", channel.mode["compensation"])


def plan_radius_number(builder: Builder) -> Step:
    """D: number of the radius offset, modal; within compensation the new radius holds from the end of the block."""
    slot = builder.slots["D"][0]

    def change(channel: WordAddressChannel, values: list[float]) -> None:
        state = RadiusState.of(channel)
        state.number = int(values[slot])
        stage = active_compensation(channel)
        if stage is not None and state.side:
            corners.refuse_change(channel)
            stage.change_radius(channel.control.radius_value(channel, state.number))

    return change


@contextmanager
def suspended(channel: WordAddressChannel, axes: Collection[int] | None = None) -> Iterator[None]:
    """Motion without compensation in between.

    The block in front ends square on itself. The vector vanishes on the way, and the next plane motion starts up
    again. Where no axis of the plane moves, the vector stays, and compensation goes on behind.

    Args:
        channel: The channel.
        axes: Axes that move; None for all.
    """
    state = RadiusState.of(channel)
    stage = active_compensation(channel)
    if stage is None:
        yield
        return
    stage.end_square()
    if axes is not None and not any(stage.plane.compensates(axis) for axis in axes):
        yield
        return
    position = channel.coordinates.position
    # The tool stands beside the programmed point: the first move leads from there, a move to that point as well.
    beside = channel.coordinates.position = stage.beside(position)
    stage.discard()
    yield
    if channel.coordinates.position is beside:
        channel.coordinates.position = position
    if state.side:
        control = channel.control
        tip = control.nose_tip(channel)
        stage.engage(side_on_display(channel), control.radius_value(channel, state.number), tip)


def tool_position(channel: WordAddressChannel) -> list[float]:
    """Where the tool stands (absolute display, all axes), beside the programmed point by the vector of compensation.

    Who asks for it waits for the motion, so nothing is read behind: the last move ends square.
    """
    stage, position = active_compensation(channel), channel.coordinates.position
    if stage is None:
        return position
    stage.end_square()
    return stage.beside(position)


def side_on_display(channel: WordAddressChannel) -> int:
    """Side in display coordinates: a mirror of one plane axis changes left and right."""
    side: int = RadiusState.of(channel).side
    plane = PLANES[channel.mode["plane"]]
    return -side if arcs.mirrors_plane(channel.coordinates.programming, plane) else side


def direction_of(channel: WordAddressChannel, words: Words) -> Point | None:
    """The direction that I, J, K give in the plane, as it lies on the display; None without."""
    u, v, _ = PLANES[channel.mode["plane"]]
    first, second = words.length("IJK"[u]) or 0.0, words.length("IJK"[v]) or 0.0
    return on_display(channel, first, second) if first or second else None


def on_display(channel: WordAddressChannel, first: float, second: float) -> Point:
    """A direction of the plane as the program sees it, by mirror and rotation on the display."""
    u, v, _ = PLANES[channel.mode["plane"]]
    typed = [0.0, 0.0, 0.0]
    typed[u], typed[v] = first, second
    shown = channel.coordinates.programming.direct(typed[0], typed[1], typed[2])
    return shown[u], shown[v]


def active_compensation(channel: WordAddressChannel) -> CutterCompensation | None:
    """The stage of the path that compensates; None while none does."""
    stage = idle_or_active(channel)
    return stage if stage is not None and stage.active else None


def idle_or_active(channel: WordAddressChannel) -> CutterCompensation | None:
    """The stage of the path that compensates now or has done so; None where there is none."""
    if channel.path.head is None:
        return None
    from polycnc.compensation.cutter import CutterCompensation  # for programs that compensate

    return channel.path.find(CutterCompensation)


def compensation_stage(channel: WordAddressChannel) -> CutterCompensation:
    """The channel's compensation stage, put into its path when it is first needed."""
    u, v, w = PLANES[channel.mode["plane"]]
    geometry = channel.coordinates.geometry
    if geometry[u] < 0 or geometry[v] < 0:
        raise channel.control.fail("plane")
    stage = idle_or_active(channel)
    if stage is not None and stage.active:
        return stage
    if stage is not None:
        stage.flush()
    from polycnc.channel.moves.knots import Motions
    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.compensation.plane import Plane

    policy = channel.control.compensation_policy(channel)
    plane = Plane(u, v, w, geometry)
    corners.refuse_start_up(channel)
    return channel.path.put(
        CutterCompensation(plane, policy, violation_codes(channel.control.alarms), Motions(channel))
    )


def place_of_block(channel: WordAddressChannel) -> Move:
    """A move without way that stands for the running block."""
    position = channel.coordinates.position
    level = channel.level
    kind = Kind.RAPID if channel.mode["motion"] == "G0" else Kind.FEED
    return Move(
        kind, position, position, channel.feed, level.program_number, channel.line, channel.context_number()
    )
