"""How a block acts in a modal state: worked out once, kept in `mode.plans[block]`, run many times.

Order within a block: modal functions; words in the order typed (F, S, T, D, M …); side of the tool and
corners; motion, or what a function of group 2 or 3 does; stops. A program end comes last of all.
"""

from __future__ import annotations

from functools import partial
from math import nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.machine_words import asking, move_words, plc_of
from polycnc.control.sinumerik import auxiliary, gcodes, replaced, tables
from polycnc.control.sinumerik.actions import overlay
from polycnc.control.sinumerik.block import words
from polycnc.control.sinumerik.block.draft import Draft, Plan, Step
from polycnc.control.sinumerik.block.positions import (
    DIAMETER_OF_AXIS,
    diameter_of_channel,
    own_diameter,
    whole,
)
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import spindle_speed
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.motion import circles, moves
from polycnc.control.sinumerik.punching import block as punching
from polycnc.control.sinumerik.signals import measuring, sections
from polycnc.control.sinumerik.tools import selection
from polycnc.control.sinumerik.transformations import seat, smoothing
from polycnc.control.sinumerik.transformations.words import SECOND, SINGLE, TRIPLES
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Enter, Idle, Note, declare
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.feed import feed_words
    from polycnc.control.sinumerik.frames import codes as frame_codes
    from polycnc.control.sinumerik.frames import tool_frames
    from polycnc.control.sinumerik.motion import involutes, repositioning, splines, threads
    from polycnc.control.sinumerik.oscillation import words as oscillation
    from polycnc.control.sinumerik.tangential import definitions as tangential
    from polycnc.control.sinumerik.tools import online, smooth_approach, stages
    from polycnc.control.sinumerik.tools.holders import active as carriers
    from polycnc.control.sinumerik.transformations import history, oblique, orientation, point_to_point

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.bulk import Condition
    from polycnc.language.sinumerik.words import Block

#: Path motion by the function of group 1.
MOTIONS: dict[str, Callable[[Draft], Step | None]] = {
    "G0": moves.rapid,
    "G1": moves.linear,
    "G2": circles.circle,
    "G3": circles.circle,
    "CIP": circles.through_point,
    "ASPLINE": splines.through_points,
    "BSPLINE": splines.control_points,
    "CSPLINE": splines.through_points,
    "POLY": splines.polynomial,
    "CT": circles.tangential,
    "INVCW": involutes.wind,
    "INVCCW": involutes.wind,
    "G33": threads.thread,
    "G34": threads.thread,
    "G35": threads.thread,
    "G331": threads.tap,
    "G332": threads.tap,
}
#: Functions of group 2.
BLOCK_MOTIONS: dict[str, Callable[[Draft], Step | None]] = {
    "G4": moves.dwell,
    "G63": threads.tap_with_chuck,
    "G74": moves.reference_point,
    "G75": moves.fixed_point,
    "G751": moves.fixed_point,
    "G5": oblique.plunge,
    "G7": oblique.plunge,
    **dict.fromkeys(tables.REPOSITIONING, repositioning.reposition),
    **dict.fromkeys(tables.APPROACHES, smooth_approach.approach),
    **dict.fromkeys(tables.RETRACTIONS, smooth_approach.retract),
}
LINEAR = frozenset(("G0", "G1"))
#: Addresses that need a transformation; PO stands for polynomials of the direction as well.
OF_TRANSFORMATIONS = frozenset((*TRIPLES, *SINGLE, *SECOND, "PO", "STAT", "TU"))


@dataclass(slots=True)
class ExactStop(State, lifetime=Lifetime.BLOCK):
    """G9 holds for the running block."""

    block: bool = False


def make_plan(channel: SinumerikChannel, block: Block) -> Plan:
    """Work out a block in the present modal state.

    Raises:
        AlarmError: 12060 for two functions of one group, 12120 for one that stands alone (group 4), 12470 for an
            unknown one, PC0001 for one that is not executed, and what the functions find wrong with their words.
    """
    codes = _codes(block)
    if "fifo" in codes and (block.words or len(codes) > 1):
        raise AlarmError("12120", text=codes["fifo"])
    modal = [(name, code) for name, code in codes.items() if name in gcodes.START_CODES]
    mode = _axis_diameters(channel, block, _mode_after(channel.mode, modal), codes)
    draft = Draft(channel, block, mode, codes)
    if mode is not channel.mode or any(name in IN_CONTEXT for name, _ in modal):
        draft.steps.append(_enter(mode, modal, before=channel.mode))
    draft.steps += _early_effects(draft, modal)
    if punching.GROUP in codes:
        draft.steps += punching.select(draft)
    transforms = "frame" not in codes and _concerns_transformation(draft)
    if transforms:
        orientation.plan(draft)
        point_to_point.plan(draft)
    follows = tangential.plan_words(draft) if mode["tangential"] and not _has_function(codes) else None
    own = _own_function(draft)
    strokes = punching.begin(draft) if own is None and _concerns_press(draft) else None
    moving = _motion(draft) if own is None and not _has_function(codes) else None
    if transforms:
        orientation.check(draft)
    shapes = _shapes_feed(draft)
    draft.steps += [feed_words.before] if shapes else []
    ends = _words(draft)
    draft.steps += [feed_words.tell] if shapes else []
    draft.steps += _late_effects(draft, modal)
    measures = measuring.measure(draft) if draft.has(*measuring.WORDS) else None
    if measures is not None:
        draft.steps.append(measures[0])
    in_spline = mode["motion"] in tables.SPLINES
    check = splines.positioned(draft) if in_spline else None
    draft.steps += [check] if check is not None else []
    swings = oscillation.oscillate(draft) if draft.has("OSCILL") else None
    draft.steps += [swings] if swings is not None else []
    started, awaited = moves.positioning(draft)
    draft.steps += started
    draft.steps += _asked_moves(draft, moves=own is not None or moving is not None)
    for step in (own, moving):
        if step is not None:
            draft.steps += _around(draft, step, strokes)
    draft.steps += [follows] if follows is not None else []
    draft.steps += awaited + draft.behind_motion
    if measures is not None:
        draft.steps.append(measures[1])
    draft.steps += [orientation.finish] if draft.lead is not None else []
    _check_open_words(draft)
    draft.steps += [_stop(position) for position in ends]
    if in_spline:
        draft.steps.append(splines.count_blocks(draft, is_point=moving is not None))
    if any(word.address == "T" for word in block.words):
        draft.steps.append(_call_for_tool(words.m_places(draft)))
    calls = moving is not None or (mode["motion"] in LINEAR and _is_bare_motion(block, codes))
    acts = bool(block.words) and "frame" not in codes
    return Plan(tuple(draft.steps), acts, calls and own is None, tuple(ends), _shared(draft))


def _check_open_words(draft: Draft) -> None:
    """Nobody has taken a word: the alarm that it is."""
    for position, word in draft.open_words():
        if word.address in AXIS_DIAMETERS:
            continue
        seat.check_named(draft.channel, word.address)
        beside_m = any(each.address == "M" for each in draft.block.words)
        is_axis = word.address in draft.channel.memory.columns
        raise words.misplaced(word, position, beside_m=beside_m, is_axis=is_axis)


def _has_function(codes: dict[str, str]) -> bool:
    """Whether a function of group 2 or 3 takes the axis words of a block."""
    return "frame" in codes or "block_motion" in codes


def _early_effects(draft: Draft, modal: list[tuple[str, str]]) -> list[Step]:
    """What modal functions do in front of the words; T, D and TCARR of the block work the toolholder out themselves."""
    selects = draft.has("TCARR", "T", "D")
    early = [(n, code) for n, code in modal if n in EFFECTS and not (selects and n == "tool_carrier")]
    return [_effect(EFFECTS, draft.channel.mode, name, code) for name, code in early]


def _late_effects(draft: Draft, modal: list[tuple[str, str]]) -> list[Step]:
    """What modal functions do behind the words; a retraction ends compensation itself, behind its line or arc."""
    codes = draft.codes
    leaves = codes.get("block_motion") in tables.RETRACTIONS and codes.get("compensation") == "G40"
    late = [(n, code) for n, code in modal if n in LATE_EFFECTS and not (leaves and n == "compensation")]
    return [_effect(LATE_EFFECTS, draft.channel.mode, name, code) for name, code in late]


def _shapes_feed(draft: Draft) -> bool:
    """Whether the feed of a block is not constant: FPO, or FLIN and FCUB where they act."""
    by_code = draft.mode["feed_profile"] != tables.CONSTANT and draft.mode["feed"] in tables.PROFILED
    return by_code or any(word.modifier == tables.POLYNOMIAL for word in draft.block.words)


def _concerns_transformation(draft: Draft) -> bool:
    """Whether a transformation acts on a block, or it has words that only one can mean."""
    return bool(draft.mode[seat.GROUP]) or any(
        word.address in OF_TRANSFORMATIONS for word in draft.block.words
    )


def _concerns_press(draft: Draft) -> bool:
    """Whether a block is punched, or its path may be cut into segments."""
    mode = draft.mode
    return mode[punching.GROUP] != punching.OFF or mode["segments"] != "" or draft.has("SPP", "SPN")


def _shared(draft: Draft) -> tuple[int, ...]:
    """Columns of the axes that a block moves, where other channels can use them as well."""
    return _moved(draft) if draft.memory.shares_axes else ()


def _asked_moves(draft: Draft, *, moves: bool) -> list[Step]:
    """What asks the machine in front of a move whether its axes may move, where it may refuse that."""
    if not moves or not draft.memory.machine_refuses_moves:
        return []
    plc = plc_of(draft.channel)
    words_of_moves = move_words(draft.channel, _moved(draft))
    return [asking(None, words_of_moves, plc)] if plc.moves.intersection(words_of_moves) else []


def _moved(draft: Draft) -> tuple[int, ...]:
    """Columns of the axes that a block moves."""
    if "frame" in draft.codes:
        return ()
    names = (str(w.index) if w.address in ("POS", "POSA") else w.address for w in draft.block.words)
    tables_of_names = (draft.memory.columns, draft.memory.machine_columns)
    return tuple({table[name] for name in names for table in tables_of_names if name in table})


#: Words that choose a diameter function for one axis; empty: that of the channel again.
AXIS_DIAMETERS = {
    "DIAMONA": "DIAMON",
    "DIAMOFA": "DIAMOF",
    "DIAM90A": "DIAM90",
    "DIACYCOFA": "DIAMOF",
    "DIAMCHANA": "",
}


def _mode_after(before: Mode, modal: list[tuple[str, str]]) -> Mode:
    """The mode with the modal functions of a block, and with what G962, G972, G942 and G952 keep."""
    changes = [(name, code) for name, code in modal if before[name] != code]
    if not changes:
        return before
    mode = before.with_codes(changes)
    if mode["feed"] in tables.KEEP_SPEED:
        surface = tables.feed_type(before).surface_speed
        mode = mode.with_code("speed_kept", "G96" if surface else "")
    if mode["feed"] in tables.KEEP_FEED and before["feed"] not in tables.KEEP_FEED:
        return mode.with_code("feed_kept", before["feed"])
    return mode


def _axis_diameters(channel: SinumerikChannel, block: Block, mode: Mode, codes: dict[str, str]) -> Mode:
    """The mode after DIAMONA[axis] and the like; a function of the channel takes the transverse axis back."""
    memory = channel.memory
    chosen = {memory.transverse: ""} if "diameter" in codes else {}
    for word in block.words:
        if word.address in AXIS_DIAMETERS:
            column = memory.column(str(word.index))
            chosen[column] = AXIS_DIAMETERS[word.address] or diameter_of_channel(
                mode, column, memory.transverse
            )
    for column, function in chosen.items():
        if own_diameter(mode, column) != function:
            mode = mode.with_code(DIAMETER_OF_AXIS[column], function)
    return mode


def _codes(block: Block) -> dict[str, str]:
    """The functions of a block by group."""
    codes: dict[str, str] = {}
    for code in block.codes:
        group = gcodes.GROUP_OF.get(code)
        if group is None:
            raise AlarmError("12470", text=code)
        if code in gcodes.NOT_EXECUTED:
            raise not_supported(code)
        if group.name in codes:
            raise AlarmError("12060", text=code)
        codes[group.name] = code
    return codes


def _is_bare_motion(block: Block, codes: dict[str, str]) -> bool:
    """G0 or G1 without axes, or S or F alone: MCALL acts on them too (job planning 1.25.3.4)."""
    return codes.get("motion") in LINEAR or bool(block.words and all(w.address in "SF" for w in block.words))


def _enter(mode: Mode, modal: list[tuple[str, str]], *, before: Mode) -> Step:
    """A step that brings the modal state about, behind another one."""
    changes, taps = mode is not before, not sections.RIGID_TAPS.isdisjoint((mode["motion"], before["motion"]))
    compresses = mode["compressor"] != "COMPOF" and any(name == "motion" for name, _ in modal)
    shows = any(mode.codes.get(name) != before.codes.get(name) for name in DIAMETER_OF_AXIS.values())
    matters = not modal or compresses or taps or shows or any(name in IN_CONTEXT for name, _ in modal)

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        channel.mode = mode
        if matters:
            channel.context_changed()

    if not changes:
        return declare(run, Idle())
    return declare(run, (Enter(mode), Note()) if matters else Enter(mode))


def _effect(effects: Mapping[str, Step], before: Mode, name: str, code: str) -> Step:
    """What a modal function does beside being active; one that is in force already may change nothing."""
    if before[name] != code or name not in REPEATED:
        return effects[name]
    return declare(partial(effects[name]), Idle(REPEATED[name]))


def _own_function(draft: Draft) -> Step | None:
    """The step of a function of group 2 or 3, which takes its words before all others."""
    if "frame" in draft.codes:
        if "block_motion" in draft.codes:
            raise AlarmError("12120", text=draft.codes["frame"])
        return frame_codes.plan(draft, draft.codes["frame"])
    code = draft.codes.get("block_motion")
    return BLOCK_MOTIONS[code](draft) if code is not None else None


def _motion(draft: Draft) -> Step | None:
    """The path motion of a block, if it has any."""
    maker = MOTIONS.get(draft.mode["motion"])
    if maker is None:
        raise not_supported(draft.mode["motion"])
    _check_side(draft)
    if draft.mode["open_line"] and _may_move(draft) and not draft.has("ANG"):
        raise AlarmError("12080", text="ANG")
    if draft.mode["motion"] not in LINEAR and not _may_move(draft):
        return None
    if draft.mode["motion"] in LINEAR and any("PO" in (w.address, w.modifier) for _, w in draft.open_words()):
        return splines.straight_to_ends(draft)
    return maker(draft)


def _may_move(draft: Draft) -> bool:
    """Whether a block has any word of which motion could be made; without one, no axis need exist."""
    return any(
        word.address in draft.memory.columns or word.address in words.COMPANIONS
        for _, word in draft.open_words()
    )


def _check_side(draft: Draft) -> None:
    """G41, G42 and G40 stand in blocks with G0 or G1 (10753, 10754), if the block moves at all."""
    side = draft.codes.get("compensation")
    if side is None or draft.mode["motion"] in LINEAR or not _may_move(draft):
        return
    active = draft.channel.mode["compensation"] != "G40"
    if side != "G40" and not active:
        raise AlarmError("10753")
    if side == "G40" and active:
        raise AlarmError("10754")


def _words(draft: Draft) -> list[int]:
    """Make steps of the words beside motion; gives the places of the M words."""
    ends = []
    for position, word in draft.open_words():
        if word.address in words.WORDS and draft.is_open(position):
            draft.close(position)
            draft.steps.append(words.make(draft, position, word))
            if word.address == "M" and word.index is None:
                ends.append(position)
    own_feed = None if {"frame", "block_motion"} & draft.codes.keys() else draft.take("FRC")
    if own_feed is not None:
        draft.steps.append(words.own_corner_feed(draft, own_feed))
    return ends


def _stop(position: int) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:
        auxiliary.after_motion(channel, whole(values, position))

    return run


def _call_for_tool(places: tuple[int, ...]) -> Step:
    """A program may stand for T: it is called at the end of the block."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        replaced.call_for_tool(channel, [whole(values, place) for place in places])

    return run


def _around(draft: Draft, step: Step, strokes: Step | None) -> list[Step]:
    """The motion with what holds for this block alone: suppressed frames, exact stop, strokes and segments."""
    suppression = draft.codes.get("suppression")
    steps = [step] if strokes is None else [strokes, step, punching.end]
    if suppression is not None:
        steps = [_suppress(suppression), *steps, _suppress("")]
    if "block_exact_stop" in draft.codes:
        steps = [_exact_stop(True), *steps, _exact_stop(False)]
    return steps


def _suppress(code: str) -> Step:
    """Frames off for a block, and back; what incremental words are still owed does not change."""

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        if code == "SUPA":
            overlay.refuse_suppression(channel)
        frames.apply(channel, code)

    return run


def _exact_stop(on: bool) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        ExactStop.of(channel).block = on
        channel.context_changed()

    return run


# ---- what modal functions do beside being active


def _zero_offset(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """G500, G54 …: the stored frame becomes active."""
    memory = channel.memory
    number = gcodes.number_of(channel.mode["wcs"]) - 1
    if number >= len(memory.frames.settable):
        raise AlarmError("12470", text=channel.mode["wcs"])
    memory.frames.select(number)
    frames.changed(channel)


def _plane(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """G17, G18, G19: tool lengths change their axes."""
    if channel.path.head is not None:
        stages.change_plane(channel)
    auxiliary.tool_changed(channel)


def _tool_carrier(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """TCOABS, TCOFR …: the toolholder that is active is worked out anew."""
    if carriers.ActiveCarrier.of(channel).number:
        auxiliary.edge_selected(channel)


def _feed_type(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """Group 15: another kind of feed needs a new F; G97 keeps the speed that G96 had."""
    feed = tables.feed_type(channel.mode)
    spindle_speed.change_of_feed_type(channel, feed.surface_speed, channel.mode["feed"])
    path_feed = PathFeed.of(channel)
    if feed.mode != path_feed.mode:
        channel.feed = nan
        path_feed.mode = feed.mode


def _diameter(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """DIAMON, DIAM90: only with a transverse axis (16510)."""
    if channel.mode["diameter"] in ("DIAMON", "DIAM90") and channel.memory.transverse < 0:
        raise AlarmError("16510")


def _side(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    if channel.mode["compensation"] == "G40":
        stages.leave_contour(channel)
    else:
        stages.select_side(channel)
    channel.context_changed()


def _working_area(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    working_area.refresh(channel)


def _constant_side(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    stages.suspend(channel)


def _rules(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    stages.changed_rules(channel)


def _tool_plane(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    stages.changed_frame(channel)


def _lengths_are_in_force(channel: SinumerikChannel) -> bool:
    """The plane gives the tool the lengths that it has."""
    tools = channel.memory.tools
    before, apart = tools.lengths, tools.apart
    selection.follow(channel)
    after, tools.lengths, tools.apart = tools.lengths, before, apart
    return bool(after == before) and frames.is_in_force(channel)


def _feed_is_in_force(channel: SinumerikChannel) -> bool:
    """The kind of feed is the one in force, its spindle has what it needs and no speed to keep from G96."""
    code = channel.mode["feed"]
    feed = tables.feed_type(channel.mode)
    in_force = feed.mode is PathFeed.of(channel).mode
    return in_force and spindle_speed.is_in_force(channel, feed.surface_speed, code)


def _contour_is_in_force(channel: SinumerikChannel) -> bool:
    """No compensation is active."""
    return channel.path.head is None or stages.active_cutter(channel) is None


#: When functions of a group that are in force already change nothing.
REPEATED: dict[str, Condition] = {
    "wcs": frames.is_in_force,
    "plane": _lengths_are_in_force,
    "feed": _feed_is_in_force,
    **dict.fromkeys(("approach", "corner", "compensation"), _contour_is_in_force),
}
#: Right after the modal state has changed.
EFFECTS: dict[str, Step] = {
    "wcs": _zero_offset,
    "plane": _plane,
    "tool_carrier": _tool_carrier,
    "workpiece_frame": tool_frames.by_table,
    "feed": _feed_type,
    "diameter": _diameter,
    "orientation_profile": history.select,
    "compressor": smoothing.select,
    "working_area": _working_area,
    "working_area_wcs": _working_area,
}
#: After the words of the block: the tool is that of the block's own T and D.
LATE_EFFECTS: dict[str, Step] = {
    "approach": _rules,
    "corner": _rules,
    "corner_orientation": _rules,
    "tool_offset": _tool_plane,
    "compensation": _side,
    "constant_side": _constant_side,
    "fine_tool_offset": online.select_fine,
    "tool_frame": tool_frames.by_tool,
}
#: Groups that a context of the toolpath tells of.
IN_CONTEXT = frozenset(
    (
        "plane",
        "wcs",
        "unit",
        "feed",
        "diameter",
        "path",
        "exact_stop",
        "compensation",
        "dynamics",
        "acceleration",
        "rapid",
        "curve_feed",
        *smoothing.GROUPS,
        "punching",
    )
)
