"""How the path is driven: exact stop G09, look-ahead and high-speed modes G05, G05.1, G08. Its points stay the same."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from polycnc.toolpath.motion_settings import MotionSettings

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.toolpath import Context


@dataclass(slots=True)
class PathModeState(State, lifetime=Lifetime.RESET):
    """How the path is driven beside the modal codes.

    Attributes:
        contour_control: A high-speed mode is on.
        exact_stop: G09 stands in the running block.
    """

    contour_control: bool = False
    exact_stop: bool = lasting(Lifetime.BLOCK, default=False)


#: What the codes of group 15 make of corners; under all others the path is continuous. So it is under G61.1 of MELDAS,
#: which plans ahead and brakes for corners as far as they need it (M700 programming manual, high-accuracy control).
CORNER_MODES = {"G61": CornerMode.EXACT_STOP}
HIGH_ACCURACY = "G61.1"
#: How the axes are led: with limited jerk, by a law where cuts are planned ahead.
BELL_SHAPED = MotionSettings(
    bends_by_way=True, keeps_corners=False, acceleration=AccelerationMode.JERK_LIMITED
)


def corner_mode(channel: WordAddressChannel) -> CornerMode:
    """How the path goes through the end of the running block: G09, G61, or on."""
    if PathModeState.of(channel).exact_stop:
        return CornerMode.EXACT_STOP
    return CORNER_MODES.get(channel.mode.codes.get("path", ""), CornerMode.CONTINUOUS)


def looks_ahead(channel: WordAddressChannel, context: Context) -> Context:
    """G05, G05.1, G08 and G61.1: cuts are accelerated before the interpolation, which is planned ahead."""
    if PathModeState.of(channel).contour_control or channel.mode.codes.get("path") == HIGH_ACCURACY:
        return replace(context, acceleration=AccelerationMode.JERK_LIMITED)
    return context


def exact_stop_block(channel: WordAddressChannel, _words: Words) -> None:
    """G09: exact stop at the end of this block."""
    PathModeState.of(channel).exact_stop = True
    channel.context_changed()


def end_of_exact_stop(channel: WordAddressChannel, _values: list[float]) -> None:
    """The block of a G09 ends."""
    PathModeState.of(channel).exact_stop = False
    channel.context_changed()


def _refuse_company(words: Words, *own: str) -> None:
    """Alarm for any other word in the block."""
    for key in words.plan.order:
        if key not in own:
            raise words.fail("address", key)


def high_speed_machining(channel: WordAddressChannel, words: Words) -> None:
    """G05 P10000 / P0, alone in its block: the path is unchanged; the planner looks further ahead."""
    _refuse_company(words, "G5", "P")
    if words.integer("P") not in (0, 10000):
        raise words.fail("address", "P")
    PathModeState.of(channel).contour_control = words.integer("P") == 10000
    channel.context_changed()


def high_speed_mode(channel: WordAddressChannel, words: Words) -> None:
    """G05 P0, P1, P2, P10000 of MELDAS: high-speed modes, alone in their block (M700); the path is unchanged."""
    for key in words.plan.order:
        if key not in ("G5", "P"):
            raise words.fail("high_speed_company", key)
    number = words.integer("P")
    if number not in (0, 1, 2, 10000):
        raise words.fail("address", "P")
    PathModeState.of(channel).contour_control = number != 0
    channel.context_changed()


def contour_control(channel: WordAddressChannel, words: Words) -> None:
    """G05.1 Q1 [R1 … R10] / Q0, alone in its block: AI contour control; R chooses a level of precision."""
    _refuse_company(words, "G5.1", "Q", "R")
    level = words.integer("R") if "R" in words else None
    if words.integer("Q") not in (0, 1) or (level is not None and not 1 <= level <= 10):
        raise words.fail("address", "Q")
    PathModeState.of(channel).contour_control = words.integer("Q") == 1
    channel.context_changed()


def advance_preview(channel: WordAddressChannel, words: Words) -> None:
    """G08 P1 / P0, alone in its block."""
    _refuse_company(words, "G8", "P")
    if words.integer("P") not in (0, 1):
        raise words.fail("preview_value", "P")
    PathModeState.of(channel).contour_control = words.integer("P") == 1
    channel.context_changed()


def select_current_loop(_channel: WordAddressChannel, words: Words) -> None:
    """G05.4 Q1, Q0 of FANUC, alone in its block: another current loop of the drives (HRV3); the path is unchanged."""
    _refuse_company(words, "G5.4", "Q")
    if words.integer("Q") not in (0, 1):
        raise words.fail("preview_value", "Q")
