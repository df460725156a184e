"""Frames of the ISO dialect: scale, mirror, rotation, shift, the position that G92 sets, work offsets by G10.

Scale, mirror and rotation are system frames behind the programmable one, in which G52 shifts; G92 is a shift in
`$P_SETFRAME`. A scale goes
into a rotation, as the dialect has it; a mirror beside either of them is refused, for dialects differ in their order.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.frames import active
from polycnc.control.sinumerik.frames.memory import ISO_MIRROR, ISO_ROTATION, ISO_SCALE
from polycnc.control.sinumerik.iso import holes
from polycnc.control.sinumerik.tools import stages
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.names.frame import (
    GEOMETRY_AXES,
    NEUTRAL,
    NcFrame,
    cmirror,
    crpl,
    cscale,
    ctrans,
)

if TYPE_CHECKING:
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord

#: Factors of a scale are thousandths.
THOUSANDTH = 0.001
#: Which factor belongs to which axis where each has its own.
FACTORS = {"I": "X", "J": "Y", "K": "Z"}
_SET = "$P_SETFRAME"


def _put(running: IsoRun, name: str, frame: NcFrame) -> None:
    """A system frame acts from here on."""
    running.channel.memory.frames.system[name] = frame
    _follow(running)


def _follow(running: IsoRun) -> None:
    """The frames act as they are now; incremental words do not travel the change, nor does a cycle's initial level."""
    channel, cycle = running.channel, running.state.cycle
    coordinates, column = channel.coordinates, holes.drilling_axis(channel)
    level = list(coordinates.position)
    if cycle is not None and cycle.initial is not None:
        level[column] = cycle.initial
    place = coordinates.to_machine(level)
    active.apply(channel)
    if cycle is not None and cycle.initial is not None:
        cycle.initial = coordinates.from_machine(place)[column]
    if channel.path.head is not None:
        stages.changed_frame(channel)


def _clear(running: IsoRun, name: str) -> None:
    if running.channel.memory.frames.system[name] != NEUTRAL:
        _put(running, name, NEUTRAL)


def _begin(running: IsoRun, word: IsoWord, others: tuple[str, ...]) -> None:
    """What functions that set a frame have in common: points are absolute; others of the frames rest."""
    running.positions = True
    codes = running.block.codes
    if "G91" in codes or (running.channel.mode["distance"] == "G91" and "G90" not in codes):
        raise running.refused(word)
    running.before.append(partial(_check_rest, running, word, others))


def _check_rest(running: IsoRun, word: IsoWord, names: tuple[str, ...]) -> None:
    """PC0001 where one of these frames acts; functions in front of this one in the block have ended theirs."""
    system = running.channel.memory.frames.system
    if any(system[name] != NEUTRAL for name in names):
        raise running.refused(word)


def _position(running: IsoRun) -> dict[str, float]:
    """Where the tool stands, by geometry axis, mm."""
    coordinates = running.channel.coordinates
    places = zip(GEOMETRY_AXES, coordinates.geometry, strict=True)
    return {name: coordinates.position[column] for name, column in places if column >= 0}


# ---- scale


def unscale(running: IsoRun, _word: IsoWord) -> None:
    """G50: no scale."""
    running.before.append(partial(_clear, running, ISO_SCALE))


def scale(running: IsoRun, word: IsoWord) -> None:
    """G51: scale about a point by P, or by I, J, K for each axis, in thousandths.

    Raises:
        AlarmError: PC0001 without a factor, for one that is no whole number above 0 or is written with a decimal
            point, and behind G68 or G51.1.
    """
    _begin(running, word, (ISO_ROTATION, ISO_MIRROR))
    factors: dict[str, float] = {}
    for letter in "PIJK":
        found = running.take(letter)
        if found is None:
            continue
        if "." in found.number or found.value <= 0.0:
            raise running.refused(found)
        factor = found.value * THOUSANDTH
        factors |= dict.fromkeys(GEOMETRY_AXES, factor) if letter == "P" else {FACTORS[letter]: factor}
    if not factors:
        raise running.refused(word)
    running.before.append(partial(_clear, running, ISO_SCALE))
    running.after.append(partial(_scale, running, _words(running), factors))


def _scale(running: IsoRun, words: list[IsoWord], factors: dict[str, float]) -> None:
    center = _position(running) | _lengths(running, words)
    frame = ctrans(center) @ cscale(factors) @ ctrans({name: -value for name, value in center.items()})
    _put(running, ISO_SCALE, frame)


def _words(running: IsoRun) -> list[IsoWord]:
    """The words of geometry axes of a block, which are no move; PC0001 for others."""
    words = running.axis_words()
    for word in words:
        if word.letter not in GEOMETRY_AXES:
            raise running.refused(word)
    running.taken += words
    return words


def _lengths(running: IsoRun, words: list[IsoWord]) -> dict[str, float]:
    return {word.letter: running.length(word) for word in words}


# ---- mirror


def mirror(running: IsoRun, word: IsoWord) -> None:
    """G51.1: mirror at a point of each named axis; PC0001 without axes, behind G51 or G68."""
    _begin(running, word, (ISO_ROTATION, ISO_SCALE))
    words = _words(running)
    if not words:
        raise running.refused(word)
    running.after.append(partial(_mirror, running, words))


def _mirror(running: IsoRun, words: list[IsoWord]) -> None:
    running.state.mirrors |= _lengths(running, words)
    _put_mirrors(running)


def unmirror(running: IsoRun, word: IsoWord) -> None:
    """G50.1: the named axes are mirrored no more; PC0001 without axes."""
    running.positions = True
    words = _words(running)
    if not words:
        raise running.refused(word)
    running.before.append(partial(_unmirror, running, words))


def _unmirror(running: IsoRun, words: list[IsoWord]) -> None:
    for word in words:
        running.state.mirrors.pop(word.letter, None)
    _put_mirrors(running)


def _put_mirrors(running: IsoRun) -> None:
    mirrors = running.state.mirrors
    frame = NEUTRAL
    if mirrors:
        frame = ctrans({name: 2.0 * value for name, value in mirrors.items()}) @ cmirror(mirrors)
    _put(running, ISO_MIRROR, frame)


# ---- rotation


def unrotate(running: IsoRun, _word: IsoWord) -> None:
    """G69: no rotation."""
    running.before.append(partial(_clear, running, ISO_ROTATION))


def rotate(running: IsoRun, word: IsoWord) -> None:
    """G68: turn the plane about a point by R degrees.

    Raises:
        AlarmError: PC0001 without R, with I, J, K, with the third axis, without a point where a scale acts, and behind
            G51.1.
    """
    _begin(running, word, (ISO_MIRROR,))
    angle = running.take("R")
    if angle is None or any(running.block.find(letter) for letter in "IJK"):
        raise running.refused(word)
    words = _words(running)
    if len(words) < len(PLANES["G17"]) - 1:
        running.before.append(partial(_check_rest, running, word, (ISO_SCALE,)))
    running.before.append(partial(_clear, running, ISO_ROTATION))
    running.after.append(partial(_rotate, running, word, words, angle.value))


def _rotate(running: IsoRun, word: IsoWord, words: list[IsoWord], angle_deg: float) -> None:
    third = PLANES[running.channel.mode["plane"]][2]
    center = _position(running) | _lengths(running, words)
    if GEOMETRY_AXES[third] in {each.letter for each in words}:
        raise running.refused(word)
    back = ctrans({name: -value for name, value in center.items()})
    _put(running, ISO_ROTATION, ctrans(center) @ crpl(third, angle_deg) @ back)


# ---- position and shift


def shift(running: IsoRun, word: IsoWord) -> None:
    """G52: the zero point lies there in the work system; other axes keep theirs, 0 takes the shift back.

    Raises:
        AlarmError: PC0001 without axes, behind G51, G51.1 and G68, and where the programmable frame is more than that.
    """
    _begin(running, word, (ISO_MIRROR, ISO_ROTATION, ISO_SCALE))
    words = running.axis_words()
    running.taken += words
    if not words or running.channel.memory.frames.programmable.matrix != IDENTITY.m:
        raise running.refused(word)
    running.after.append(partial(_shift, running, words))


def _shift(running: IsoRun, words: list[IsoWord]) -> None:
    frames = running.channel.memory.frames
    frame = frames.programmable
    for name, _, value in _named(running, words):
        frame = frame.with_component(name, "TR", value)
    frames.programmable = frame
    _follow(running)


def _named(running: IsoRun, words: list[IsoWord]) -> list[tuple[str, int, float]]:
    """Name in frames, column and value, mm or degrees, of words of axes."""
    channel = running.channel
    geometry = dict(zip(channel.coordinates.geometry, GEOMETRY_AXES, strict=True))
    found = []
    for word in words:
        column = channel.memory.column(word.letter)
        value = word.value if channel.axis_data[column].rotary else running.length(word)
        found.append((geometry.get(column, channel.axes[column]), column, value))
    return found


def set_position(running: IsoRun, word: IsoWord) -> None:
    """G92: the position has these values from here on, by a shift; S is the spindle's highest speed.

    Raises:
        AlarmError: PC0001 without words, and where a frame turns, scales or mirrors.
    """
    running.positions = True
    speed = running.take("S")
    if speed is not None:
        running.extra.append(f"LIMS={speed.number}")
    elif not running.axis_words():
        raise running.refused(word)
    if running.axis_words():
        words = running.axis_words()
        running.taken += words
        running.after.append(partial(_set_position, running, word, words))


def _set_position(running: IsoRun, word: IsoWord, words: list[IsoWord]) -> None:
    channel = running.channel
    frames, coordinates = channel.memory.frames, channel.coordinates
    if frames.total().matrix != IDENTITY.m or coordinates.transformation is not None:
        raise running.refused(word)
    shifts = {name: coordinates.position[column] - value for name, column, value in _named(running, words)}
    _put(running, _SET, ctrans(shifts) @ frames.system[_SET])


# ---- data

#: P of G10 L2: G54 to G57, G58 and G59, which are settable frames of these numbers.
OFFSETS = range(1, 7)


def set_offset(running: IsoRun, word: IsoWord) -> None:
    """G10 L2 P1 to P6: the work offset G54 to G59 of the named axes has these values, or under G91 so much more.

    Raises:
        AlarmError: PC0001 for another L or P, without axes, and for the offset that is active: it is not known when
            that acts.
    """
    running.positions = True
    kind, number = running.take("L"), running.take("P")
    words = running.axis_words()
    running.taken += words
    if kind is None or kind.value != 2.0 or number is None or number.value not in OFFSETS or not words:
        raise running.refused(word)
    codes = running.block.codes
    adds = "G91" in codes or (running.channel.mode["distance"] == "G91" and "G90" not in codes)
    running.after.append(partial(_set_offset, running, word, words, int(number.value), adds=adds))


def _set_offset(running: IsoRun, word: IsoWord, words: list[IsoWord], number: int, *, adds: bool) -> None:
    frames = running.channel.memory.frames
    if frames.number == number:
        raise running.refused(word)
    frame = frames.settable[number]
    for name, _, value in _named(running, words):
        before = frame.component(name, "TR") if adds else 0.0
        frame = frame.with_component(name, "TR", before + value)
    frames.settable[number] = frame
