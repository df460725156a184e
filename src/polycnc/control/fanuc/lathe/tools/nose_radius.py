"""Nose radius compensation of the lathe: G40 to G42, G38, G39, and I, K vectors (0i-TF Plus II.5.2 to 5.4)."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.compensation.policy import Approach, Policy
from polycnc.control.fanuc.lathe.cycles.modal import is_reading
from polycnc.control.fanuc.lathe.motion import corners
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState
from polycnc.control.word_address.tools import look_ahead, radius
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.offset import Joint, Outer
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

#: 5003#0 SUP = 0, #1 SUV = 0 (0i-TF Plus 5.4.1), 19625 = 3.
TYPE_A = Policy(recommand_is_square=True)
#: Kind of the program level in which G70 runs a shape.


def policy(channel: LatheChannel) -> Policy:
    """The rules that the parameters choose."""
    parameters = channel.memory.parameters
    return replace(
        TYPE_A,
        approach=Approach.CORNER if parameters.SUP else Approach.SQUARE,
        bare_cancel_is_square=True,
        shifts_without_motion=parameters.SUV,
        outer=Outer(90.0, Joint.ARC) if parameters.CCC else TYPE_A.outer,
        read_blocks=min(max(parameters.read_blocks, 3), 8),
        least_move_mm=parameters.least_corner_move,
        checks_direction=not (parameters.CNV or parameters.CNC),
        checks_arcs=not parameters.CNV,
        avoids=parameters.CAV,
        dares=parameters.NAA,
    )


def left(channel: LatheChannel, words: Words) -> None:
    """G41: the nose is left of the contour."""
    _engage(channel, words, radius.compensate_left)


def right(channel: LatheChannel, words: Words) -> None:
    """G42: the nose is right of the contour."""
    _engage(channel, words, radius.compensate_right)


def _engage(channel: LatheChannel, words: Words, engage: Callable[[LatheChannel, Words], None]) -> None:
    memory = channel.memory
    if not _takes(channel, words, starts=True):
        return
    if channel.setup.switches.mode == "mdi" and memory.parameters.MCR:
        raise words.fail("comp_in_mdi", channel.mode["compensation"])
    RadiusState.of(channel).number = OffsetState.of(channel).number
    engage(channel, words)
    stage = radius.active_compensation(channel)
    if stage is not None and not RadiusState.of(channel).number:
        # Number 0 has no offset: start-up waits for another one.
        stage.cancel()


def cancel(channel: LatheChannel, words: Words) -> None:
    """G40, with the direction of the wall behind the last point in I, J, K; without motion by 5000#3 GNI only."""
    if not _takes(channel, words, starts=False):
        return
    takes_wall = bool(words.axes() or channel.memory.parameters.wall_without_travel)
    radius.cancel_compensation(channel, words, takes_wall=takes_wall)


def _takes(channel: LatheChannel, words: Words, *, starts: bool) -> bool:
    """Whether a G40 to G42 acts; in the shape of a cycle it depends (II.4.2.1).

    There it is an alarm as delivered. 5106#2 NT1: G71 to G73 pass over it. #3 NT2: they do so too, and G70 takes
    it, if G41 or G42 stands in the first block and compensation was off before.
    """
    parameters, level = channel.memory.parameters, channel.level
    finishing = not is_reading(channel)
    if finishing and level.kind is not LevelKind.SHAPE:
        return True
    if finishing and parameters.NT2:
        if starts and (level.current != level.entry or level.data["compensated"]):
            raise words.fail("shape_command", channel.mode["compensation"])
        return True
    if parameters.NT1 or (parameters.NT2 and not finishing):
        return False
    code = channel.mode["compensation"]
    raise channel.control.fail("shape_command", address=code, hint="hint.shape-compensation", code=code)


def hold_vector(channel: LatheChannel, _words: Words) -> None:
    """G38: the block in front ends square on itself, and this block keeps that vector."""
    stage = radius.active_compensation(channel)
    if stage is not None:
        stage.hold_vector()


def corner_arc(channel: LatheChannel, words: Words) -> None:
    """G39 [I K]: an arc about the corner; no motion in its block."""
    stage = radius.active_compensation(channel)
    if stage is not None:
        stage.corner_arc(radius.place_of_block(channel), radius.direction_of(channel, words))


def plan_travel(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A straight block without a way ends the block in front; one with G39 has no axis words at all (II.5.6)."""
    if plan.axis_words and any(row.code == "G39" for row in builder.codes):
        raise builder.control.fail("corner_arc_moves", address="G39")
    return look_ahead.plan_travel(builder, plan, step)


def plan_line_words(builder: Builder) -> Callable[[LatheChannel, list[float]], object] | None:
    """What I, J, K, R, C and the comma words of a G00 or G01 block ask for: a corner shape or a vector."""
    if builder.mode["motion"] not in look_ahead.LINES:
        return None
    parameters = builder.channel.memory.parameters
    # I, J, K are chamfers where that function is there and takes them (II.4.7).
    chamfers = parameters.CCR and not parameters.CRD and not parameters.chamfer_by_c
    if chamfers or builder.mode["compensation"] == "G40" or any(row.code == "G40" for row in builder.codes):
        return corners.plan_corner(builder)
    u, v, _ = PLANES[builder.mode["plane"]]
    letters = ("IJK"[u], "IJK"[v])
    if not any(builder.has(letter) for letter in letters):
        return corners.plan_corner(builder)
    builder.take(*letters)
    words = [(builder.slot(a), builder.length(a) if builder.has(a) else None) for a in letters]

    def force(channel: LatheChannel, values: list[float]) -> None:
        stage = radius.active_compensation(channel)
        if stage is not None:
            direction = [0.0 if s is None else (c(values[s]) if c else values[s]) for s, c in words]
            stage.forced_vector(radius.on_display(channel, direction[0], direction[1]))

    return force
