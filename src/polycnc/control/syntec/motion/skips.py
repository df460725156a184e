"""Moves that signals end beside G31: G31.10 with G31.11 and G28.1 (manual 2.77, 2.82)."""

from __future__ import annotations

from math import copysign

from polycnc.control.syntec.motion.moves import SkipGroup, SkipState, skip_source
from polycnc.control.word_address.motion import path, skip
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

MAX_GROUPS = 6


def define_group(channel: SyntecChannel, words: Words) -> None:
    """G31.10 X Y Z F Q P: a group of axes with its own signal, feed and deceleration."""
    state = SkipState.of(channel)
    deceleration = words.typed("P")
    if deceleration is not None and (deceleration < 0 or deceleration != int(deceleration)):
        raise words.fail("number", "P")
    target = path.reach(channel, words.plan.axis_words, words.values)
    axes = [word.axis for word in words.plan.axis_words]
    taken = {axis for group in state.groups for axis in group.ends}
    follows = not state.groups or _follows(channel)
    if not axes or taken & set(axes) or len(state.groups) >= MAX_GROUPS or not follows:
        raise words.fail("skip_groups", "G31.10")
    group = SkipGroup({axis: target[axis] for axis in axes}, skip_source(channel, words))
    state.groups.append(group)
    state.groups_end = channel.level.index


def _follows(channel: SyntecChannel) -> bool:
    """Whether nothing but empty lines stands between the last G31.10 and this block."""
    level = channel.level
    first, last = SkipState.of(channel).groups_end, level.current
    lines = level.code.program.lines
    start, end = level.code.line(first), level.code.line(last)
    between = lines[start - level.code.program.first_line : end - level.code.program.first_line]
    return first == last or (first < last and not any(line.strip() for line in between))


def move_groups(channel: SyntecChannel, words: Words) -> None:
    """G31.11: all groups start together, each ends at its signal; #1608 names the axes that skipped."""
    state = SkipState.of(channel)
    groups, state.groups = state.groups, []
    if not groups or not _follows(channel):
        raise words.fail("skip_groups", "G31.11")
    c = channel.coordinates
    end = c.position[:]
    state.forget(channel)
    flags = 0
    for group in groups:
        own = c.programmed[:]
        for axis, value in group.ends.items():
            own[axis] = value
        target = c.to_position(own)
        stopped = skip.signal_position(channel, c.position, target, group.signal)
        for axis in group.ends:
            end[axis] = target[axis] if stopped is None else stopped[axis]
            flags |= 0 if stopped is None else 1 << (axis + 1)
    channel.straight(Kind.SKIP, end, channel.feed)
    state.note(channel, flags)


def position_at_sensor(channel: SyntecChannel, words: Words) -> None:
    """G28.1 X Q R F1= F2=: to X at F1, then Q further at F2; a signal on the way stops R behind it."""
    named = words.plan.axis_words
    if words.typed("R") is None or not named:
        return
    word = min(named, key=lambda each: each.axis)
    c = channel.coordinates
    axis, begin = word.axis, c.programmed[word.axis]
    first = path.reach(channel, (word,), words.values)
    stroke = words.length("Q")
    stroke = first[axis] - begin if stroke is None else stroke
    SkipState.of(channel).forget(channel)
    channel.straight(Kind.FEED, c.to_position(first), _speed(channel, words, "F1"), first)
    second = first[:]
    second[axis] += stroke
    start, end = c.position, c.to_position(second)
    stopped = skip.signal_position(channel, start, end, channel.setup.switches.skip_input)
    if stopped is not None:
        second[axis] = c.programmed[axis] + copysign(abs(stopped[axis] - start[axis]), stroke)
        second[axis] += words.length("R") or 0.0
        end = c.to_position(second)
    channel.straight(Kind.SKIP, end, _speed(channel, words, "F2"), second)


def _speed(channel: SyntecChannel, words: Words, address: str) -> float:
    value = words.typed(address)
    return channel.feed if value is None else value * (INCH_MM if words.plan.inch else 1.0) / 60.0
