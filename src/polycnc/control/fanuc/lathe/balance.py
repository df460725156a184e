"""Balance cutting G68 and G69: the turrets of several paths cut from both sides at once (0i-TF Plus II.7.1).

Paths wait for each other at G68 and at G69, and between them at every block that cuts: they start it together. With
the program O0001 of the first path, path 2 starts O0001.P-2 (as files of several paths are named), or PATH2/O0001.
A path without a program is not waited for: so the program of one turret can be proved alone.
"""

from __future__ import annotations

from polycnc.channel.waits import PreprocessingStop
from polycnc.control.fanuc.lathe.cycles.modal import CYCLES
from polycnc.control.fanuc.lathe.states import BalanceState
from polycnc.control.word_address.motion.path import target
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

GROUP = "turret_mirror"
#: Wait marks: where the paths switch balance cutting on and off, and where they cut.
ON, OFF, CUT = 68, 69, 1
RAPID, LINE = "G0", "G1"


def is_available(channel: LatheChannel) -> bool:
    """Whether G68 is balance cutting here: several paths and 8137#0 NVC = 0; else it mirrors a turret."""
    return len(channel.machine.channels) > 1 and not channel.memory.parameters.NVC


def start_paths(channel: LatheChannel) -> None:
    """Cycle start: with the first path the others start their programs of the same name."""
    group = channel.group
    if group is None or channel is not group.first:
        return
    for other in channel.machine.channels:
        if other.number == channel.number:
            continue
        store, name = channel.store, channel.level.code.program.name
        program = store.find_name(f"{name}.P-{other.number}") or store.find_name(f"PATH{other.number}/{name}")
        if program is not None and not group.is_running(other.number):
            group.select(other.number, program)
            group.start(other.number)


def begin(channel: LatheChannel, words: Words) -> None:
    """G68 [P]: wait for G68 of the other paths; from here on they cut together. Without P: paths 1 and 2."""
    _check_alone(words, "P")
    state = BalanceState.of(channel)
    if state.paths:
        return
    state.paths = _paths(channel, words)
    _meet(channel, ON, state.paths)


def end(channel: LatheChannel, words: Words) -> None:
    """G69: wait for G69 of the other paths; every path cuts by itself again."""
    _check_alone(words, "")
    state = BalanceState.of(channel)
    paths, state.paths = state.paths, frozenset()
    if paths:
        _meet(channel, OFF, paths)


def together(builder: Builder, plan: Plan, move: Step | None) -> Step | None:
    """The step of a cutting block: balanced paths start it together. Rapids and blocks without travel do not wait."""
    motion = builder.mode["motion"]
    if move is None or builder.mode[GROUP] != "G68" or not is_available(builder.channel):
        return move
    if (motion == RAPID and builder.mode["cycle"] == "G80") or not (plan.axis_words or motion in CYCLES):
        return move

    def cut(channel: LatheChannel, values: list[float]) -> None:
        state = BalanceState.of(channel)
        travels = motion != LINE or target(channel, plan.axis_words, values) != channel.coordinates.programmed
        if travels and not state.has_met:
            _meet(channel, CUT, state.paths)
            if channel.wait is not None:
                state.has_met = True
                raise PreprocessingStop
        state.has_met = False
        move(channel, values)

    return cut


def _paths(channel: LatheChannel, words: Words) -> frozenset[int]:
    """The paths that P names: as a sum of 2^(n-1), or as digits (8103#1 MWP); PS0163 for a wrong one."""
    value = words.integer("P")
    if value is None:
        return frozenset({1, 2})
    if channel.memory.parameters.MWP:
        digits = [int(digit) for digit in str(abs(value))]
    else:
        digits = [n + 1 for n in range(abs(value).bit_length()) if abs(value) >> n & 1]
    paths = frozenset(digits)
    known = {each.number for each in channel.machine.channels}
    if value < 0 or len(paths) < max(len(digits), 2) or not paths <= known or channel.number not in paths:
        raise words.fail("turret_form", "P")
    return paths


def _check_alone(words: Words, allowed: str) -> None:
    """G68 and G69 stand alone in their block (PS0163)."""
    plan = words.plan
    foreign = [address for address in plan.slots if address not in allowed]
    if foreign or len(plan.order) > 1 + len(plan.slots):
        raise words.fail("turret_form", foreign[0] if foreign else plan.order[0])


def _meet(channel: LatheChannel, mark: int, paths: Iterable[int]) -> None:
    group = channel.group
    if group is None:
        return
    others = [number for number in paths if number != channel.number and group.is_selected(number)]
    if others:
        channel.flush()
        channel.synchronise()  # they meet when their axes are there, not when the block is prepared
        group.meet(channel, mark, others)
