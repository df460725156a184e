"""Multiple repetitive cycles G70 to G76: their words in the two formats (0i-TF Plus II.4.2, 6.4).

Normal format: two blocks; the first, without shape or end point, stores amounts that live on. Series 15 format
(0001#1): one block with D, I, K.
"""

from __future__ import annotations

from itertools import groupby
from math import copysign, nan

from polycnc.channel.stack import Level, LevelKind
from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes, senses, set_rotation, without_rotation
from polycnc.control.fanuc.lathe.cycles.drilling import is_series_15
from polycnc.control.fanuc.lathe.cycles.modal import FINISHING, GROUP, ThreadDepthState
from polycnc.control.fanuc.lathe.cycles.shape import (
    Section,
    contour_of,
    end_finishing,
    read_shape,
    refuse_open_end,
    section_steps,
)
from polycnc.control.fanuc.lathe.cycles.single import cut_pass, runout
from polycnc.control.fanuc.lathe.cycles.strokes import (
    emit,
    enter_compensation,
    is_compensated,
    leave_compensation,
    uncompensated_cycle,
)
from polycnc.control.fanuc.lathe.motion.threads import CHAMFERS, lead_in_force, refuse_corners, start_angle
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.word_address.tools.radius import RadiusState, active_compensation
from polycnc.cycles.turning.contour import points, reversal, swapped, swapped_stroke
from polycnc.cycles.turning.cuts import Roughing
from polycnc.cycles.turning.pattern import repeat_pattern as pattern_strokes
from polycnc.cycles.turning.peck import Pecks, peck_columns
from polycnc.cycles.turning.rough import rough
from polycnc.cycles.turning.thread import ThreadCuts, thread_passes
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.units import INCH_MM
from polycnc.language.word_address.functions import round_half_away
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from polycnc.control.fanuc.lathe.cycles.shape import Shape
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.parameters import Parameter
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.cycles.turning.contour import Contour
    from polycnc.cycles.turning.stroke import PlaneStroke
    from polycnc.geometry.arcs import Point

#: All words that a cycle block may hold beside axis words.
#: Words of the cycles.
WORDS = "P Q U V W R D I J K A E"
#: Increment words of the plane's first and second axis.
INCREMENTS = {"G18": ("W", "U"), "G17": ("U", "V"), "G19": ("V", "W")}
#: Centre words of the plane's first and second axis.
CENTERS = {"G18": ("K", "I"), "G17": ("I", "J"), "G19": ("J", "K")}
#: Parameters that keep their sign when the first block of a cycle writes them.
_SIGNED = frozenset(
    {LatheParameters.stroke_depth, LatheParameters.pattern_escape_x, LatheParameters.pattern_escape_z}
)
MAX_TIP_ANGLE = 120.0
#: A thread with more passes is taken for one that does not end.
MAX_PASSES = 10_000
TIP_ANGLES = (80, 60, 55, 30, 29, 0)
#: Cycles with a shape, and what calls a program.
SHAPE_CYCLES = frozenset({"G70", "G71", "G72", "G73"})
CALL_CODES, CALL_M_CODES = frozenset({"G65", "G66", "G66.1"}), frozenset({98, 198})


# ---- shape cycles ----------------------------------------------------------------------------------------------


def check_block(builder: Builder, plan: Plan) -> None:
    """G70 to G73 share their block with no call of a program (II.4.2.8), G76 as a thread with no corner (II.4.2.7)."""
    codes = {row.code for row in builder.codes}
    if "G76" in codes:
        refuse_corners(builder, plan, CHAMFERS)
    if codes & SHAPE_CYCLES and (codes & CALL_CODES or CALL_M_CODES.intersection(builder.m_codes)):
        raise builder.control.fail("cycle_block", address=builder.order[0])


def finish(channel: LatheChannel, words: Words) -> None:
    """G70 P Q: run the shape once as it is written, then back to where the cycle began."""
    _refuse_points(words)
    first, last = _shape_numbers(channel, words)
    code = channel.level.code
    begin, end = section_steps(channel, code, first, last)
    level = channel.level
    section = Level(
        Section(code, begin, end), begin, begin, level.program_number, 0, begin, LevelKind.SHAPE, level.locals
    )
    section.data["rotation"] = set_rotation(channel, IDENTITY)
    section.data["start"] = channel.coordinates.position
    section.data["compensated"] = bool(RadiusState.of(channel).side)
    if is_compensated(channel):
        leave_compensation(channel)
        enter_compensation(channel)
    channel.stack.append(section)
    channel.level = section
    channel.mode = channel.mode.with_code(GROUP, FINISHING)


def end_of_shape(channel: LatheChannel) -> None:
    """The shape of G70 is cut: back to the start in rapid, on with the block behind G70."""
    section = channel.pop()
    end_finishing(channel)
    refuse_open_end(channel)
    set_rotation(channel, section.data["rotation"])
    start: list[float] = section.data["start"]
    if RadiusState.of(channel).side and not section.data["compensated"]:
        raise channel.control.fail("shape_compensation_open", address="Q")
    stage = active_compensation(channel)
    if stage is None or not RadiusState.of(channel).side:
        channel.straight(Kind.RAPID, start, nan)
        return
    stage.cancel()
    channel.straight(Kind.RAPID, start, nan)
    enter_compensation(channel)


@without_rotation
def rough_turning(channel: LatheChannel, words: Words) -> None:
    """G71: strokes along the first axis of the plane."""
    _rough(channel, words, along=0)


@without_rotation
def rough_facing(channel: LatheChannel, words: Words) -> None:
    """G72: strokes along the second axis of the plane."""
    _rough(channel, words, along=1)


def _rough(channel: LatheChannel, words: Words, *, along: int) -> None:
    memory, plane = channel.memory, channel.mode["plane"]
    depth_word = INCREMENTS[plane][1 - along]
    series_15 = is_series_15(channel)
    _refuse_points(words, INCREMENTS[plane])
    _check_words(words, ("P", "Q", "R", *INCREMENTS[plane]), ("D", *CENTERS[plane]) if series_15 else ())
    if "P" not in words and "Q" not in words:
        stored = {depth_word: LatheParameters.stroke_depth, "R": LatheParameters.stroke_escape}
        _store(channel, words, stored)
        return
    depth = _series_15_depth(words) if series_15 and "D" in words else memory.parameters.stroke_depth
    if not depth > 0.0:
        raise words.fail("cycle_depth", "D" if series_15 else depth_word)
    shape, contour = _read(channel, words)
    axes = plane_axes(channel)
    _check_first_block(channel, shape, axes[1 - along])
    allowance, extra = _allowance(channel, words), _extra(channel, words, contour)
    _check_start(channel, shape, 1 - along, allowance[1 - along])
    pockets = axes[along] in (shape.first_axes or ())
    _check_monotone(channel, contour, along, pockets=pockets)
    parameters = memory.parameters
    cuts = Roughing(
        depth,
        parameters.stroke_escape,
        allowance=_turned(allowance, along),
        extra=_turned(extra, along),
        pockets=pockets,
        finishes=not (parameters.RF2 if pockets else parameters.RF1),
        infeed_rapid=shape.first_code == "G0",
        escape_rapid=parameters.CBR,
        clearance=parameters.pocket_clearance,
        returns_rapid=parameters.ASU,
        returns_merged=parameters.ASC and not pockets,
        returns_straight=parameters.RPA and parameters.LRP and not pockets,
        follows_flats=parameters.R16 or parameters.NSP,
        skips_bottoms=parameters.NSP,
        feeds_last=parameters.last_feed or 0.5 * parameters.stroke_escape,
    )
    if along:
        strokes: Iterable[PlaneStroke] = (swapped_stroke(stroke) for stroke in rough(swapped(contour), cuts))
    else:
        strokes = rough(contour, cuts)
    _cut(channel, strokes)
    _go_on_behind(channel, shape)


def _go_on_behind(channel: LatheChannel, shape: Shape) -> None:
    """Behind the shape; behind the cycle itself where the shape stands in front of it, or it would never end."""
    level = channel.level
    level.index = max(level.current, shape.end) + 1


def _turned(pair: tuple[float, float], along: int) -> tuple[float, float]:
    return (pair[1], pair[0]) if along else pair


@without_rotation
def repeat_pattern(channel: LatheChannel, words: Words) -> None:
    """G73: the shape itself, pass by pass nearer to the finished part."""
    memory, plane = channel.memory, channel.mode["plane"]
    first_word, second_word = INCREMENTS[plane]
    _refuse_points(words, INCREMENTS[plane])
    _check_words(
        words, ("P", "Q", "R", *INCREMENTS[plane]), ("D", *CENTERS[plane]) if is_series_15(channel) else ()
    )
    if "P" not in words and "Q" not in words:
        _store(
            channel,
            words,
            {first_word: LatheParameters.pattern_escape_z, second_word: LatheParameters.pattern_escape_x},
        )
        if "R" in words:
            passes = round_half_away(words.typed("R") or 0.0)
            memory.set_cycle_parameter(LatheParameters.pattern_passes, passes)
        return
    if is_series_15(channel) and "D" in words:
        first_center, second_center = CENTERS[plane]
        escape = (words.length(first_center) or 0.0, words.length(second_center) or 0.0)
        passes = _count(words, "D")
    else:
        escape = (memory.parameters.pattern_escape_z, memory.parameters.pattern_escape_x)
        passes = memory.parameters.pattern_passes
    if passes < 1:
        raise words.fail("pattern_passes", "D" if "D" in words else "R")
    shape, contour = _read(channel, words)
    if not shape.first_code:
        raise channel.control.fail("shape_first_block", address="P")
    _halt_in_passes(channel, shape, passes)
    first_sense, second_sense = senses(channel)
    escape = (escape[0] * first_sense, escape[1] * second_sense)
    _cut(channel, pattern_strokes(contour, escape, passes, _allowance(channel, words)))
    _go_on_behind(channel, shape)


def _halt_in_passes(channel: LatheChannel, shape: Shape, passes: int) -> None:
    """Single block halts behind every block of every pass; by 5125#2 PRS behind the way off A and every pass."""
    if channel.memory.parameters.PRS:
        lines = [0] * (passes + 1)
    else:
        lines = [line for line, _ in groupby(move.line for move in shape.moves)] * passes
    for line in lines:
        channel.halt_inside(line)


def _read(channel: LatheChannel, words: Words) -> tuple[Shape, Contour]:
    if "S" in words and channel.memory.parameters.MPP:
        raise words.fail("spindle_choice", "S")
    first, last = _shape_numbers(channel, words)
    shape = read_shape(channel, first, last)
    contour = contour_of(channel, shape)
    if not contour:
        raise channel.control.fail("shape_command", address="P")
    return shape, contour


def _refuse_points(words: Words, amounts: tuple[str, ...] = ()) -> None:
    """G70 to G73 go to no point: axis words but for their own amounts have no meaning in them."""
    for word in words.plan.axis_words:
        if word.address not in amounts:
            raise words.fail("cycle_block", word.address)


def _shape_numbers(channel: LatheChannel, words: Words) -> tuple[int, int]:
    """P and Q. The program that holds the cycle must be stored: MDI may only call one that has it (II.4.2.8)."""
    first, last = words.integer("P"), words.integer("Q")
    if first is None or last is None:
        raise words.fail("no_shape_numbers", "P" if first is None else "Q")
    if channel.setup.switches.mode == "mdi" and channel.level.kind in (LevelKind.MAIN, LevelKind.TYPED_IN):
        raise words.fail("cycle_in_mdi", "P")
    return first, last


def _check_first_block(channel: LatheChannel, shape: Shape, infeed: int) -> None:
    """The first block says G00 or G01, and moves the axis of infeed."""
    if not shape.first_code:
        raise channel.control.fail("shape_first_block", address="P")
    if infeed not in shape.first_ways:
        raise channel.control.fail("shape_command", address="P")


def _check_start(channel: LatheChannel, shape: Shape, infeed: int, allowance: float) -> None:
    """With a positive allowance no point of the shape lies higher than the start, with a negative one none lower."""
    contour = contour_of(channel, shape, as_written=True)
    outwards = copysign(1.0, allowance)
    highest = max(outwards * point[infeed] for piece in contour for point in points(piece.edge))
    if allowance and highest > outwards * contour[0].edge.start[infeed] + 1e-6:
        raise channel.control.fail("shape_beyond_start", address="P")


def _check_monotone(channel: LatheChannel, contour: Contour, along: int, *, pockets: bool) -> None:
    """Type I: both axes go one way only; type II: that of the strokes. Small reversals are allowed (5145, 5146)."""
    shape = contour[1:]
    if not shape:
        return
    parameters = channel.memory.parameters
    allowed = (
        (parameters.reversal_first_axis, "shape_first_axis"),
        (parameters.reversal_second_axis, "shape_second_axis"),
    )
    for axis, (limit, mistake) in enumerate(allowed):
        if pockets and axis != along:
            continue
        begin, end = shape[0].edge.start[axis], shape[-1].edge.end[axis]
        direction = 1.0 if end >= begin else -1.0
        if reversal(shape, axis, direction) > limit + 1e-6:
            raise channel.control.fail(mistake, address="P")


def _allowance(channel: LatheChannel, words: Words) -> tuple[float, float]:
    """Finishing allowances along the first and second axis, mm of radius; the words follow their axis."""
    found = []
    named = zip(plane_axes(channel), INCREMENTS[channel.mode["plane"]], senses(channel), strict=True)
    for axis, address, sense in named:
        amount = words.length(address, diameter=channel.control.is_diameter(channel, axis)) or 0.0
        found.append(sense * amount)
    return found[0], found[1]


def _extra(channel: LatheChannel, words: Words, contour: Contour) -> tuple[float, float]:
    """Rough-finishing allowances of the Series 15 format (II.6.4.1).

    They have no sign: they lie on the side of the finishing allowance, or without one on that of the start point.
    """
    if not is_series_15(channel):
        return (0.0, 0.0)
    start, infeed, last = contour[0].edge.start, contour[0].edge.end, contour[-1].edge.end
    sides = [s - i or s - e for s, i, e in zip(start, infeed, last, strict=True)]
    extra = []
    for amount, side, address in zip(
        _allowance(channel, words), sides, CENTERS[channel.mode["plane"]], strict=True
    ):
        extra.append(copysign(words.length(address) or 0.0, amount or side))
    return extra[0], extra[1]


def _cut(channel: LatheChannel, strokes: Iterable[PlaneStroke]) -> None:
    """Make the strokes; compensation is in the shape already, so the path's own one rests meanwhile."""
    compensated = is_compensated(channel)
    if compensated:
        leave_compensation(channel)
    emit(channel, strokes)
    if compensated:
        enter_compensation(channel)


# ---- pecking -----------------------------------------------------------------------------------------------------


@without_rotation
def peck_facing(channel: LatheChannel, words: Words) -> None:
    """G74: pecks along the first axis of the plane, columns along the second."""
    _peck(channel, words, along=0)


@without_rotation
def groove(channel: LatheChannel, words: Words) -> None:
    """G75: pecks along the second axis of the plane, columns along the first."""
    _peck(channel, words, along=1)


def _peck(channel: LatheChannel, words: Words, *, along: int) -> None:
    memory, plane = channel.memory, channel.mode["plane"]
    forms = ("D", *CENTERS[plane]) if is_series_15(channel) else ("P", "Q", "R")
    _check_words(words, ("R",), forms)
    if not words.axes():
        _store(channel, words, {"R": LatheParameters.groove_return})
        return
    axes = plane_axes(channel)
    start, end = _corner(channel, words, axes)
    if is_series_15(channel):
        amounts = [abs(words.length(letter) or 0.0) for letter in CENTERS[channel.mode["plane"]]]
        relief = _series_15_depth(words) if "D" in words else 0.0
    else:
        # P is the amount along the second axis, Q along the first, in G74 and G75 alike.
        amounts = [_increments(words, "Q"), _increments(words, "P")]
        if min(amounts) < 0.0:
            raise words.fail("peck_amount", "Q" if amounts[0] < 0.0 else "P")
        relief = words.length("R") or 0.0
    start, end = _turned(start, along), _turned(end, along)
    pecks = Pecks(amounts[along], memory.parameters.groove_return, amounts[1 - along], relief)
    _check_pecks(words, start, end, pecks)
    if start[1] == end[1]:
        pecks = replace(pecks, relief=relief * senses(channel)[1 - along])
    strokes = peck_columns(start, end, pecks)
    uncompensated_cycle(channel, (swapped_stroke(stroke) for stroke in strokes) if along else strokes)


def _check_pecks(words: Words, start: Point, end: Point, pecks: Pecks) -> None:
    """A way needs its amount; the relief has a sign only where the way across is missing (II.4.2.5)."""
    for way, amount in ((end[0] - start[0], pecks.peck), (end[1] - start[1], pecks.step)):
        if way and not amount:
            raise words.fail("peck_end", words.plan.axis_words[0].address)
    if pecks.relief < 0.0 and pecks.step:
        raise words.fail("peck_relief", "R" if "R" in words else "D")


def _corner(
    channel: LatheChannel, words: Words, axes: tuple[int, int]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Start and corner of a cycle in the plane, on the display."""
    c = channel.coordinates
    point = c.programmed[:]
    for axis, value, incremental in words.axes():
        if axis not in axes:
            raise words.fail("cycle_axis", words.plan.axis_words[0].address)
        point[axis] = point[axis] + value if incremental else value
    end = c.to_position(point)
    return (c.position[axes[0]], c.position[axes[1]]), (end[axes[0]], end[axes[1]])


# ---- threading ---------------------------------------------------------------------------------------------------


@without_rotation
def thread(channel: LatheChannel, words: Words) -> None:
    """G76: a whole thread, pass by pass."""
    memory = channel.memory
    if not words.axes():
        _store_thread(channel, words)
        return
    axes = plane_axes(channel)
    start, end = _corner(channel, words, axes)
    series_15 = is_series_15(channel)
    forms = ("A", "D", "E", *CENTERS[channel.mode["plane"]]) if series_15 else ("R",)
    _check_words(words, ("P", "Q"), forms)
    if series_15:
        taper = words.length(CENTERS[channel.mode["plane"]][1]) or 0.0
        height = abs(words.length(CENTERS[channel.mode["plane"]][0]) or 0.0)
        first, angle = _series_15_depth(words), words.typed("A") or 0.0
        method = words.integer("P") or 0 if "P" in words else 0
        if method not in range(5):
            raise words.fail("thread_words", "P")
        if not 0.0 <= angle <= MAX_TIP_ANGLE:
            raise words.fail("thread_angle", "A")
        if "Q" in words and words.form("Q") not in ("", "#"):
            raise words.fail("point", "Q")
        turn = start_angle(words.typed("Q") or 0.0)
        finishing = max(memory.parameters.thread_finishing_passes, 1)
    else:
        taper = words.length("R") or 0.0
        height, first = _modal_depth(channel, words, "P"), _modal_depth(channel, words, "Q")
        angle, method, turn = memory.parameters.thread_angle, 1, 0.0
        finishing = max(memory.parameters.thread_finishing_passes, 1)
    lead = INCH_MM / _threads_per_inch(words) if "E" in words else lead_in_force(channel)
    if not height > 0.0 or not first > 0.0:
        raise words.fail("thread_words", "P" if not height > 0.0 else "Q")
    cuts = ThreadCuts(
        height,
        min(first, height),
        memory.parameters.thread_least_depth if method in (0, 1, 2) else 0.0,
        memory.parameters.thread_allowance,
        finishing,
        constant_depth=method in (3, 4),
    )
    if cuts.allowance >= height:
        raise words.fail("thread_words", "R")
    if cuts.least > height:
        raise words.fail("thread_least", "Q")
    out = runout(channel, lead)
    taper *= senses(channel)[1]
    passes = thread_passes(start, end, taper, cuts, half_angle_deg=angle / 2.0, zigzag=method in (2, 4))
    for number, (begin, last) in enumerate(passes):
        if number >= MAX_PASSES:
            raise channel.control.block_limit()
        cut_pass(channel, (start, begin, last), out, lead, turn)


def _store_thread(channel: LatheChannel, words: Words) -> None:
    """The first block of G76: P packs finishing passes, chamfer in 0.1 leads and tip angle; Q and R are depths."""
    _check_words(words, ("P", "Q"), ("R",))
    store = channel.memory.set_cycle_parameter
    packed = words.integer("P") if "P" in words else None
    if packed is not None:
        passes, rest = divmod(abs(packed), 10_000)
        chamfer, angle = divmod(rest, 100)
        if angle not in TIP_ANGLES or passes > 99:
            raise words.fail("thread_angle" if passes <= 99 else "thread_words", "P")
        store(LatheParameters.thread_chamfer, chamfer)
        store(LatheParameters.thread_angle, angle)
        if passes:
            store(LatheParameters.thread_finishing_passes, passes)
    if "Q" in words:
        store(LatheParameters.thread_least_depth, abs(_increments(words, "Q")))
    if "R" in words:
        store(LatheParameters.thread_allowance, abs(words.length("R") or 0.0))


def _threads_per_inch(words: Words) -> float:
    """E of an inch thread in the Series 15 format."""
    count = words.typed("E") or 0.0
    if not count > 0.0:
        raise words.fail("thread_lead", "E")
    return count


def _check_words(words: Words, common: tuple[str, ...], of_format: tuple[str, ...]) -> None:
    """Refuse words that the cycle does not have in the chosen format; D, I and K belong to the Series 15 format."""
    for address in WORDS.split():
        if (
            address in words
            and address not in common
            and address not in of_format
            and not words.names_axis(address)
        ):
            hint = "hint.series-15" if address in "DIK" else ""
            raise words.plan.control.fail("address", address=address, word=address, hint=hint)


# ---- words -------------------------------------------------------------------------------------------------------


def _store(channel: LatheChannel, words: Words, parameters: Mapping[str, Parameter[float]]) -> None:
    """The first block of the two: its words overwrite the parameters, as radius values."""
    for address, parameter in parameters.items():
        value = words.length(address)
        if value is not None:
            channel.memory.set_cycle_parameter(parameter, value if parameter in _SIGNED else abs(value))


def _increments(words: Words, address: str) -> float:
    """A depth in least increments, without a decimal point, mm."""
    if address not in words:
        return 0.0
    if words.form(address) not in ("", "#"):
        raise words.fail("point", address)
    return _least_increments(words, address)


def _modal_depth(channel: LatheChannel, words: Words, address: str) -> float:
    """P or Q of G76; without the word that of the thread before (II.4.2.7 note 3)."""
    kept = ThreadDepthState.of(channel).depths
    if address in words:
        kept[address] = _increments(words, address)
    return kept.get(address, 0.0)


def _least_increments(words: Words, address: str) -> float:
    value = words.integer(address) or 0
    rules = words.plan.rules
    if words.plan.inch:
        return value * INCH_MM / 10.0**rules.decimals_inch
    return float(value / 10.0**rules.decimals)


def _series_15_depth(words: Words) -> float:
    """D: least increments even under calculator input; a decimal point is an alarm (II.6.4)."""
    if "D" not in words:
        return 0.0
    if words.form("D") not in ("", "#"):
        raise words.fail("point", "D")
    return _least_increments(words, "D")


def _count(words: Words, address: str) -> int:
    if words.form(address) not in ("", "#"):
        raise words.fail("point", address)
    return abs(words.integer(address) or 0)
