"""Single cycles G90, G92, G94: modal words, what runs a cycle and what clears it (0i-TF Plus II.4.1)."""

from __future__ import annotations

from polycnc.control.fanuc.code_calls import PROGRAM_M
from polycnc.control.fanuc.lathe.coordinates.systems import (
    feed_number,
    plane_axes,
    senses,
    without_rotation,
)
from polycnc.control.fanuc.lathe.cycles.drilling import is_series_15
from polycnc.control.fanuc.lathe.cycles.modal import CYCLES, GRINDING, GrindingState, SingleCycleState
from polycnc.control.fanuc.lathe.cycles.strokes import compensated_cycle, uncompensated_cycle
from polycnc.control.fanuc.lathe.motion.threads import (
    CORNER_WORDS,
    ThreadState,
    lead_in_force,
    plan_start_angle,
    refuse_corners,
)
from polycnc.control.word_address.motion.skip import signal_position
from polycnc.cycles.turning import single
from polycnc.cycles.turning.thread import Runout, thread_pass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.geometry.arcs import Point

#: Name of the feed hold input.
FEED_HOLD = "*SP"
#: Codes of group 00 that leave a cycle its words: the dwell, and the two that are not one-shot (II.2, 4.1.6).
_KEEPING = frozenset({"G4", "G10", "G11"})
#: Groups of codes that do not repeat a cycle where they stand without its words: one-shot codes, macro calls, G80.
_IDLE_GROUPS = frozenset({"", "macro", "cycle"})


def plan_single_cycle(builder: Builder, plan: Plan) -> Step | None:
    """A block in the mode of G90, G92 or G94: take over its words, and run the cycle (II.4.1.5)."""
    code = builder.mode["motion"]
    taper_letters = _taper_letters(builder, code)
    taper = next((letter for letter in taper_letters if builder.has(letter)), None)
    if taper is not None:
        builder.take(taper)
    if code == "G92":
        refuse_corners(builder, plan, tuple(a for a in CORNER_WORDS if a not in taper_letters))
    angle_of = plan_start_angle(builder) if code == "G92" else None
    inch_thread = _plan_inch_thread(builder) if code == "G92" else None
    names_corner = bool(plan.axis_words) or taper is not None
    idle = any(row.group in _IDLE_GROUPS for row in builder.codes)
    if not names_corner and (idle or PROGRAM_M.intersection(builder.m_codes)):
        return None
    taper_slot = builder.slot(taper) if taper is not None else None
    taper_of = builder.length(taper) if taper is not None else None
    words = plan.axis_words

    def run(channel: LatheChannel, values: list[float]) -> None:
        data = SingleCycleState.of(channel)
        axes = plane_axes(channel)
        for word in words:
            if word.axis not in axes:
                raise channel.control.fail("cycle_axis", address=word.address)
            value = values[word.slot]
            data.ends[word.axis] = (word.convert(value) if word.convert else value, word.incremental)
        if taper_slot is not None:
            data.taper = taper_of(values[taper_slot]) if taper_of else values[taper_slot]
        if inch_thread is not None:
            inch_thread(channel, values)
        if not data.has_words:
            return
        _run(channel, code, axes, 0.0 if angle_of is None else angle_of(channel, values))

    return run


def _run(channel: LatheChannel, code: str, axes: tuple[int, int], angle: float) -> None:
    data, c = SingleCycleState.of(channel), channel.coordinates
    if not channel.feed > 0.0 and data.lead is None:
        raise channel.control.fail("no_feed")
    corner_point = c.programmed[:]
    for axis in axes:
        if axis in data.ends:
            value, incremental = data.ends[axis]
            corner_point[axis] = corner_point[axis] + value if incremental else value
    target = c.to_position(corner_point)
    start: Point = (c.position[axes[0]], c.position[axes[1]])
    corner: Point = (target[axes[0]], target[axes[1]])
    taper = (data.taper or 0.0) * senses(channel)[0 if code == "G94" else 1]
    if code == "G92":
        lead = data.lead or lead_in_force(channel)
        begin = (start[0], corner[1] + taper)
        cut_pass(channel, (start, begin, corner), runout(channel, lead), lead, angle)
        return
    cycle = single.longitudinal if code == "G90" else single.facing
    compensated_cycle(channel, list(cycle(start, corner, taper)))


def cut_pass(
    channel: LatheChannel, way: tuple[Point, Point, Point], out: Runout, lead: float, angle: float
) -> None:
    """One pass of G92 or G76: from the start to where it begins, to its end, and back.

    Feed hold breaks it off (II.4.1.2, 4.2.7): the tool runs out where the signal comes, goes back to the start and
    halts; the next start cuts the pass again.
    """
    start, begin, end = way
    held = None if ThreadState.of(channel).held else _held_end(channel, begin, end, out)
    if held is not None:
        ThreadState.of(channel).held = True
        uncompensated_cycle(channel, thread_pass(start, begin, held, out, angle), lead=lead)
        channel.stop(FEED_HOLD)
    uncompensated_cycle(channel, thread_pass(start, begin, end, out, angle), lead=lead)


def _held_end(channel: LatheChannel, begin: Point, end: Point, out: Runout) -> Point | None:
    """Where a thread ends that feed hold breaks off; None where it does not come in the thread."""
    axes = plane_axes(channel)
    at = channel.setup.switches.signals_at.get(FEED_HOLD)
    here = channel.coordinates.position
    first, last = here[:], here[:]
    first[axes[0]], first[axes[1]] = begin
    last[axes[0]], last[axes[1]] = end
    reached = signal_position(channel, first, last, at)
    if reached is None or begin[0] == end[0]:
        return None
    way = end[0] - begin[0]
    part = (reached[axes[0]] - begin[0]) / way + out.length / abs(way)
    if part >= 1.0:
        return None
    return (begin[0] + part * way, begin[1] + part * (end[1] - begin[1]))


def _plan_inch_thread(builder: Builder) -> Step | None:
    """E of G92 in the Series 15 format: threads an inch, until F gives a lead again (II.6.3.2)."""
    if not is_series_15(builder.channel):
        return None
    builder.take("E")
    slot, names_lead = builder.slot("E"), builder.has("F")

    def choose(channel: LatheChannel, values: list[float]) -> None:
        data = SingleCycleState.of(channel)
        if slot is None:
            if names_lead:
                data.lead = None
            return
        if not values[slot] > 0.0:
            raise channel.control.fail("thread_lead", address="E")
        data.lead = INCH_MM / values[slot]

    return choose


def runout(channel: LatheChannel, lead: float | None = None) -> Runout:
    """Chamfer at the end of a thread: the machine's input, 5130 (0.1 leads), 5131 (0 for 45 degrees).

    Args:
        channel: The channel.
        lead: Lead of the thread, mm; without it the number of F.
    """
    switch = channel.setup.switches.thread_chamfer
    if switch is False:
        return Runout()
    memory = channel.memory
    tenths = memory.parameters.thread_chamfer
    return Runout(
        tenths * 0.1 * (lead or feed_number(channel)), memory.parameters.thread_chamfer_angle or 45.0
    )


def _taper_letters(builder: Builder, code: str) -> tuple[str, ...]:
    """R; in the Series 15 format the centre word of the axis along which the taper is measured (II.6.3)."""
    if not is_series_15(builder.channel):
        return ("R",)
    u, v, _ = PLANES[builder.mode["plane"]]
    return ("R", "IJK"[u if code == "G94" else v])


def plan_clearing(builder: Builder, _plan: Plan) -> Step | None:
    """A one-shot code, but for G04, or another motion code, makes the control forget the cycle's words."""
    forgets: tuple[tuple[frozenset[str], Step], ...] = (
        (CYCLES, lambda channel, _values: SingleCycleState.of(channel).forget()),
        (GRINDING, lambda channel, _values: GrindingState.of(channel).words.clear()),
    )
    for codes, forget in forgets:
        if builder.before["motion"] not in codes:
            continue
        leaves = builder.mode["motion"] not in codes
        if leaves or any(not row.group and row.code not in _KEEPING for row in builder.codes):
            return forget
    return None


def unrotated(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """Coordinate rotation has no effect in a single cycle."""
    return step if step is None or builder.mode["motion"] not in CYCLES else without_rotation(step)
