"""Words beside motion: F, S, T, D, M, H and the addresses that set something for later blocks.

A maker takes one word of a draft and gives the step that it is. `WORDS` says which address has which maker.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import nan, pi

from polycnc.control.machine_words import asking, plc_of
from polycnc.control.sinumerik import auxiliary, replaced, tables
from polycnc.control.sinumerik.block import outside_feeds, plain
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import ModuloRange, number, whole
from polycnc.control.sinumerik.couplings import synchronous
from polycnc.control.sinumerik.couplings.spindle_pairs import turns
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import spindle_speed, thread_ramps, tolerances, tooth_feed, wheels
from polycnc.control.sinumerik.feed.pace import Overrides, real_column
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.punching import block as punching
from polycnc.control.sinumerik.signals import fixed_stop
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Note, declare
from polycnc.language.sinumerik.names.spindles import spindle_number as named_spindle
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath.events import HFunction, SpindleSpeed, ToolSelection

with loaded_when_called():
    from polycnc.control.sinumerik.axes import spindles as spindle_axes
    from polycnc.control.sinumerik.block import offset_words
    from polycnc.control.sinumerik.feed import axis_settings
    from polycnc.control.sinumerik.feed.profiles import ProgrammedFeed
    from polycnc.control.sinumerik.oscillation import words as oscillation
    from polycnc.control.sinumerik.signals import retraction
    from polycnc.control.sinumerik.tools import master_holder, stages
    from polycnc.control.sinumerik.tools.management import lists
    from polycnc.control.sinumerik.transformations.posture import Orienting

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

Maker = Callable[["Draft", int, "WordShape"], "Step"]


# ---- feed


#: Values of FPO: at the end, quadratic, cubic.
_MOST_FEEDS = 3


def feed(draft: Draft, position: int, shape: WordShape) -> Step:
    """F: path feed in the units of the feed type; F0 is no feed. F2= to F7= are feeds that inputs choose."""
    if shape.index is not None:
        return outside_feeds.chosen_by_input(draft, position, shape)
    if draft.mode["feed"] == "G931":
        return _travel_time(position)
    factor = moves.feed_factor(draft)
    polynomial = shape.modifier == "FPO"

    def run(channel: SinumerikChannel, values: Values) -> None:
        if polynomial:
            value = _end_of_polynomial(channel, position, values[position], factor)
        else:
            value = number(values, position)
        if value < 0.0:
            raise WordAlarm("14800", position)
        channel.feed = value * factor or nan

    return run if polynomial else declare(run, plain.feed(position, factor))


def _end_of_polynomial(channel: SinumerikChannel, position: int, listed: Values, factor: float) -> float:
    """FPO(end, quadratic, cubic): the feed at the end of the block is the modal one; what is left out is 0.

    Raises:
        WordAlarm: 12340 for more than three values.
    """
    if len(listed) > _MOST_FEEDS:
        raise WordAlarm("12340", position, text="FPO")
    quadratic, cubic = (
        number(listed, i) if i < len(listed) and listed[i] is not None else 0.0 for i in (1, 2)
    )
    ProgrammedFeed.of(channel).coefficients = (quadratic * factor, cubic * factor)
    return number(listed, 0)


def _travel_time(position: int) -> Step:
    """F under G931: seconds for the block; the toolpath keeps the inverse."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        channel.feed = 1.0 / value if value > 0.0 else nan

    return run


def _positioning_speed(number_of: int, position: int, channel: SinumerikChannel, values: Values) -> None:
    value = number(values, position)
    if value < 0.0:
        raise WordAlarm("14810", position, axis=f"S{number_of}")
    channel.memory.spindles.get(number_of).positioning = value / tables.MINUTE


def axis_feed(draft: Draft, position: int, shape: WordShape) -> Step:
    """FA[axis]: feed of a positioning axis, modal; alarm 10861 for zero, 14810 below.

    FA[Sn] is the positioning speed of a spindle, degrees/min, 0 for that of the machine data.
    """
    spindle = named_spindle(shape.index) if isinstance(shape.index, Axis) else None
    if spindle is not None:
        return partial(_positioning_speed, spindle, position)
    column = axis_column(draft, position, shape)
    factors = [tables.axis_feed_factor(draft.mode, rotary=rotary) for rotary in (False, True)]

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factors[channel.axis_data[column].rotary]
        if value <= 0.0:
            raise WordAlarm("14810" if value < 0.0 else "10861", position, axis=channel.axes[column])
        PathFeed.of(channel).of_axes[column] = value
        oscillation.take_feed(channel, column)

    return run


# ---- spindle


def spindle_number(shape: WordShape, position: int) -> int | None:
    """The spindle that an extension names; None for the master spindle."""
    index = shape.index
    if index is None or isinstance(index, int):
        return index
    number = named_spindle(index) if isinstance(index, Axis) else None
    if number is not None:
        return number
    raise WordAlarm("12030", position, text=str(index))


def speed(draft: Draft, position: int, shape: WordShape) -> Step:
    """S: rpm, m/min under constant cutting speed (feet/min under G700), m/s of a wheel; alarm 16763 below zero."""
    wanted = spindle_number(shape, position)
    surface, metres = tables.feed_type(draft.mode).surface_speed, tables.metres_of_cutting_speed(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        spindle = channel.memory.spindles.get(wanted)
        value = number(values, position)
        if value < 0.0:
            raise WordAlarm("16763", position, axis=f"S{spindle.number}")
        if spindle.has_wheel_speed:
            wheels.set_wheel_speed(channel, spindle, value * metres)
        elif surface and spindle.number == channel.memory.spindles.master:
            spindle.cutting_speed = value * metres
        else:
            before = turns(channel, spindle.number)
            spindle.speed = value
            synchronous.overlay(channel, spindle, before)
        channel.context_changed()
        channel.event(SpindleSpeed(speed=value, spindle=spindle.number))
        wheels.check(channel)

    return declare(run, Note(position, lowest=0.0, condition=_has_master)) if wanted is None else run


def _has_master(channel: SinumerikChannel) -> bool:
    return channel.memory.spindles.master in channel.memory.spindles.all


def speed_limit(_draft: Draft, position: int, shape: WordShape) -> Step:
    """LIMS: highest speed under G96, G961 and G97; alarm 14820 below zero."""
    wanted = spindle_number(shape, position)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value < 0.0:
            raise WordAlarm("14820", position)
        spindle = channel.memory.spindles.get(wanted)
        spindle_speed.set_limit(channel, spindle_speed.SURFACE_LIMIT, spindle, value)

    return run


def spindle_position(_draft: Draft, position: int, shape: WordShape) -> Step:
    """SPOS, SPOSA: the spindle turns to an angle and stays in position control."""
    wanted = spindle_number(shape, position)

    def run(channel: SinumerikChannel, values: Values) -> None:
        spindle = channel.memory.spindles.get(wanted)
        seat.check_spindle(channel, spindle.number)
        value, awaited = number(values, position), shape.address == "SPOS"
        modulo = ModuloRange.of(channel.memory.data, f"S{spindle.number}")
        if shape.modifier != "IC":
            value = modulo.within(value, position)
        spindle_axes.follow_axis(channel, spindle)
        synchronous.position(channel, spindle, value, shape.modifier, awaited=awaited)
        spindle_axes.stand(channel, spindle, awaited=awaited)

    return run


def spindle_as_axis(draft: Draft, position: int, shape: WordShape) -> Step:
    """AX[SPI(n)]: a position of a spindle that is no axis of the channel; 14092 where it is under speed control.

    The frames shift it as they shift axes (job planning 14.1).
    """
    wanted = spindle_number(shape, position)
    incremental = shape.modifier == "IC" or (draft.mode["distance"] == "G91" and not shape.modifier)

    def run(channel: SinumerikChannel, values: Values) -> None:
        spindle = channel.memory.spindles.get(wanted)
        name = f"S{spindle.number}"
        if not spindle.controlled:
            raise WordAlarm("14092", position, text=name)
        value = number(values, position)
        shift = channel.memory.frames.total().others.get(name)
        if incremental:
            value += spindle.position
        elif shift is not None:
            value += shift.coarse + shift.fine
        modulo = ModuloRange.of(channel.memory.data, name)
        synchronous.position(channel, spindle, modulo.shown(value), "", awaited=True)

    return run


# ---- tool


def m_places(draft: Draft) -> tuple[int, ...]:
    """The places of the M functions of a block."""
    words = enumerate(draft.block.words)
    return tuple(place for place, word in words if word.address == "M" and word.index is None)


def tool(draft: Draft, position: int, shape: WordShape) -> Step:
    """T: the tool of a number or a name; MD22550 says whether it is loaded now or with M6."""
    holder = spindle_number(shape, position)
    places = m_places(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        memory = channel.memory
        wanted = values[position]
        if not isinstance(wanted, str):
            wanted = number(values, position)
            if wanted != int(wanted) or wanted < 0:
                raise WordAlarm("17190", position, tool=f"{wanted:g}")
        if replaced.takes(channel, [values[place] for place in places], beside_tool=True):
            replaced.hand(channel, "T", wanted if isinstance(wanted, str) else int(wanted))
            return
        selected = 0 if wanted == 0 else lists.chosen(channel, wanted).number
        channel.event(ToolSelection(wanted if isinstance(wanted, str) else int(wanted)))
        if holder is not None and master_holder.is_other(channel, holder):
            master_holder.select(channel, holder, selected)
            return
        memory.tools.selected = selected
        if memory.data.integer("$MC_TOOL_CHANGE_MODE") == 0:
            auxiliary.load_tool(channel)

    return run


def edge(draft: Draft, position: int, _shape: WordShape) -> Step:
    """D: the cutting edge; D0 takes all tool offsets away."""
    places = m_places(draft)
    beside_tool = any(word.address == "T" for word in draft.block.words)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value != int(value) or not 0 <= value <= 32000:
            raise WordAlarm("14090", position)
        if replaced.takes(channel, [values[place] for place in places], beside_tool=beside_tool):
            replaced.hand(channel, "D", int(value))
            return
        memory = channel.memory
        if memory.data.integer("$MC_TOOL_CHANGE_MODE") and memory.tools.selected != memory.tools.active:
            memory.tools.next_edge = int(value)
            return
        before = memory.tools.additive
        memory.tools.select_edge(int(value))
        auxiliary.first_location(channel, before)
        auxiliary.edge_selected(channel)

    return run


def turning_rate(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """ORIS: degrees that the tool turns along a millimetre of the way under OSS and OSSE; 0 for all along the block."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        Orienting.of(channel).rate = max(number(values, position), 0.0)

    return run


# ---- corners


def corner(shape_of_corner: str) -> Maker:
    """CHF, CHR, RND: what is put between this block and the next one, by its name as a `Shape`; FRC is its feed."""

    def make(draft: Draft, position: int, _shape: WordShape) -> Step:
        own_feed = draft.take("FRC")
        opens_line = draft.opens_line
        factor = length_factor(draft.mode)
        feed_factor = moves.feed_factor(draft)

        def run(channel: SinumerikChannel, values: Values) -> None:
            inserted = (
                PathFeed.of(channel).of_corners
                if own_feed is None
                else number(values, own_feed) * feed_factor
            )
            size = number(values, position) * factor
            if opens_line:
                insert = partial(stages.insert, channel, shape_of_corner, size, inserted)
                moves.OpenLine.of(channel).corners.append(insert)
            else:
                stages.insert(channel, shape_of_corner, size, inserted)

        return run

    return make


def modal_rounding(draft: Draft, position: int, _shape: WordShape) -> Step:
    """RNDM: round every corner, 0 ends it."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        stages.round_all(channel, number(values, position) * factor, PathFeed.of(channel).of_corners)

    return run


def modal_corner_feed(draft: Draft, position: int, _shape: WordShape) -> Step:
    """FRCM: feed of every chamfer and rounding, 0 for the path feed."""
    factor = moves.feed_factor(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        PathFeed.of(channel).of_corners = feed = number(values, position) * factor or nan
        stages.feed_all(channel, feed)

    return run


def own_corner_feed(draft: Draft, position: int) -> Step:
    """FRC beside no CHF, CHR or RND: the feed of a rounding by RNDM behind this block (Fundamentals)."""
    factor, opens_line = moves.feed_factor(draft), draft.opens_line

    def run(channel: SinumerikChannel, values: Values) -> None:
        step = partial(stages.feed_once, channel, number(values, position) * factor)
        if opens_line:
            moves.OpenLine.of(channel).corners.append(step)
        else:
            step()

    return run


# ---- settings


def rounding_distance(draft: Draft, position: int, shape: WordShape) -> Step:
    """ADIS, ADISPOS: distance before and after a corner in which G641 rounds."""
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factor
        if value < 0.0:
            raise WordAlarm("12560", position, text=shape.address)
        tolerances.Smoothing.of(channel).distance_mm[shape.address] = value
        channel.context_changed()

    return run


#: Per cent of VELOLIM and JERKLIM (job planning 8.7).
LIMITS_OF_PERCENT = {
    "VELOLIM": (1.0, 100.0), "JERKLIM": (1.0, 200.0), "VELOLIMA": (1.0, 100.0), "JERKLIMA": (1.0, 200.0)
}  # fmt: skip
#: Per cent of the path as a whole.
OF_PATH = frozenset(("OVR", "OVRRAP"))


def percentage(_draft: Draft, position: int, shape: WordShape) -> Step:
    """OVR, OVRRAP, OVRA[axis], ACC[axis], VELOLIM[axis] …: per cent, for the motion planner (`pace.py`).

    Raises:
        AlarmError: 12040 without the axis or spindle that the others need, 12560 beyond the range, PC0001 for an axis
            that a transformation makes: limits are for axes of the machine (8.7).
    """
    if shape.address not in OF_PATH and not isinstance(shape.index, Axis):
        raise WordAlarm("12040", position, text=str(shape.index or shape.address))
    name = str(shape.index) if shape.index is not None else ""
    least, most = LIMITS_OF_PERCENT.get(shape.address, (0.0, 200.0))

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if not (least <= value <= most and value > 0.0):
            raise WordAlarm("12560", position, text=shape.address)
        if shape.address == "JERKLIMA" and value != 100.0:
            raise not_supported("JERKLIMA")
        if (
            isinstance(shape.index, Axis)
            and named_spindle(shape.index) is None
            and real_column(channel, name) is None
        ):
            raise not_supported(f"{shape.address}[{name}]")
        Overrides.of(channel).percent[shape.address, name] = value
        if shape.address == "OVRA" and isinstance(shape.index, Axis):
            _override(channel, shape.index, value / 100.0)
        channel.context_changed()

    return run


def _override(channel: SinumerikChannel, index: Axis, factor: float) -> None:
    """OVRA: of a spindle, or of an axis where it is positioned."""
    spindle = named_spindle(index)
    if spindle is not None:
        channel.memory.spindles.get(spindle).override = factor
    else:
        PathFeed.of(channel).overrides[channel.memory.column(index.name)] = factor


def cutting_rate(draft: Draft, position: int, _shape: WordShape) -> Step:
    """SVC: cutting rate of the tool, m/min (feet/min under G700); 10750 without a radius of the tool."""
    per_value = tables.metres_of_cutting_speed(draft.mode) * tables.MM_PER_M

    def run(channel: SinumerikChannel, values: Values) -> None:
        memory = channel.memory
        radius = memory.tools.radius
        if radius <= 0.0:
            raise AlarmError("10750")
        spindle = memory.spindles.get()
        spindle.speed = number(values, position) * per_value / (2.0 * pi * radius)
        channel.context_changed()
        channel.event(SpindleSpeed(speed=spindle.speed, spindle=spindle.number))

    return run


def path_feed_of_axis(draft: Draft, position: int, shape: WordShape) -> Step:
    """FGREF, FL: reference radius of a rotary axis, limit of a synchronous axis; for the motion planner (`pace.py`).

    The limit is mm, inches or degrees a minute, whatever F is.
    """
    column = axis_column(draft, position, shape)
    factors = (
        [length_factor(draft.mode)] * 2
        if shape.address == "FGREF"
        else [tables.axis_feed_factor(draft.mode, rotary=rotary) for rotary in (False, True)]
    )

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factors[channel.axis_data[column].rotary]
        if value <= 0.0:
            raise WordAlarm("12560", position, text=shape.address)
        overrides = Overrides.of(channel)
        (overrides.radii if shape.address == "FGREF" else overrides.tops)[column] = value
        channel.context_changed()

    return run


def auxiliary_h(_draft: Draft, position: int, shape: WordShape) -> Step:
    """H, H2=, H[n]=: auxiliary function to the PLC."""
    if isinstance(shape.index, Axis):
        raise WordAlarm("12400", position, text="H")

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        channel.event(HFunction(int(value) if value == int(value) else value))

    return run


def m_function(draft: Draft, position: int, shape: WordShape) -> Step:
    """M: what acts before the motion of its block."""
    spindle = spindle_number(shape, position)
    beside = frozenset(word.address for word in draft.block.words)

    def run(channel: SinumerikChannel, values: Values) -> None:
        auxiliary.before_motion(channel, whole(values, position), spindle, beside)

    return run


_PERCENT = ("OVR", "OVRRAP", "OVRA", "ACC", "ACCLIMA", "VELOLIM", "VELOLIMA", "JERKLIM", "JERKLIMA")
WORDS: dict[str, Maker] = {
    "F": feed,
    "FZ": tooth_feed.tooth_feed,
    "FA": axis_feed,
    **dict.fromkeys(("OSP1", "OSP2", "OSE", "OSB", "OST1", "OST2", "OSNSC"), oscillation.datum),
    "OSCTRL": oscillation.options,
    "OS": oscillation.switch,
    "S": speed,
    "LIMS": speed_limit,
    "SPOS": spindle_position,
    "SPOSA": spindle_position,
    "AX": spindle_as_axis,
    "T": tool,
    "D": edge,
    "M": m_function,
    "H": auxiliary_h,
    "TOFFL": offset_words.added_length,
    "TOFF": offset_words.added_on_axis,
    "TOFFR": offset_words.added_radius,
    "OFFN": offset_words.allowance,
    "DISC": offset_words.disc,
    "ISD": offset_words.depth,
    "ORIS": turning_rate,
    "CHF": corner("CHAMFER_LENGTH"),
    "CHR": corner("CHAMFER"),
    "RND": corner("ROUNDING"),
    "RNDM": modal_rounding,
    "FRCM": modal_corner_feed,
    "ADIS": rounding_distance,
    "ADISPOS": rounding_distance,
    "TCARR": offset_words.tool_carrier,
    "CUTMOD": offset_words.cutting_data,
    "SVC": cutting_rate,
    "FGREF": path_feed_of_axis,
    "FL": path_feed_of_axis,
    "DL": offset_words.additive_offset,
    "SCPARA": axis_settings.parameter_set,
    "ADISPOSA": axis_settings.end_window,
    "CTOL": tolerances.tolerance,
    "OTOL": tolerances.tolerance,
    "ATOL": tolerances.tolerance,
    "ALF": retraction.direction_code,
    "DILF": retraction.length,
    "POLF": retraction.retraction_position,
    "SPP": punching.longest_segment,
    **dict.fromkeys(thread_ramps.RAMPS, thread_ramps.ramp),
    "SF": thread_ramps.start_angle,
    **outside_feeds.WORDS,
    **fixed_stop.WORDS,
    **dict.fromkeys(_PERCENT, percentage),
}
#: Addresses that take an extension or an index, and those that take something round their value.
_EXTENDED = """
S M H T D F FA LIMS SPOS SPOSA AX TOFFL TOFF OVRA ACC ACCLIMA VELOLIM VELOLIMA JERKLIM JERKLIMA SCPARA ATOL
FGREF FL POLF ADISPOSA OSP1 OSP2 OSE OSB OST1 OST2 OSNSC OSCTRL OS
"""
EXTENDED = frozenset((*_EXTENDED.split(), *outside_feeds.WORDS, *fixed_stop.WORDS))
MODIFIED = {
    **dict.fromkeys(("SPOS", "SPOSA", "AX"), frozenset(("AC", "IC", "DC", "ACP", "ACN"))),
    **dict.fromkeys(("M", "H"), frozenset(("QU",))),
    "F": frozenset(("FPO",)),
    "POLF": frozenset(("AC", "IC")),
    **dict.fromkeys(("OSP1", "OSP2", "OSE", "OSB"), frozenset(("AC", "IC"))),
}
#: What the machine's own controller may refuse.
ASKED = {"S": "S_CODE", "T": "T_CODE"}
#: How often a program is called; it stands beside a call alone.
PASSES = "P"
#: Words that only mean something together with others; alone they are a mistake of the block.
COMPANIONS = frozenset(
    "I J K I1 J1 K1 IP CR AR TURN AP RP RPL ANG FB FD FRC FP DISR DISCL FAD DISPR PO PW SD PL".split()  # noqa: SIM905 - a table
)


def make(draft: Draft, position: int, shape: WordShape) -> Step:
    """The step of a word; 12400 for an index that its address does not take, 12020 for what stands round its value."""
    if shape.index is not None and shape.address not in EXTENDED:
        raise WordAlarm("12400", position, text=shape.address)
    if shape.modifier and shape.modifier not in MODIFIED.get(shape.address, ()):
        raise WordAlarm("12020", position, text=shape.modifier)
    step = WORDS[shape.address](draft, position, shape)
    word = ASKED.get(shape.address)
    return asking(step, (word,), plc_of(draft.channel)) if word is not None else step


def misplaced(shape: WordShape, position: int, *, beside_m: bool, is_axis: bool) -> AlarmError:
    """The alarm for a word that nothing in its block takes; `beside_m`: an M function stands there."""
    if shape.address == PASSES:
        hint = "hint.words-of-m" if beside_m else ""
        return WordAlarm("12080", position, text=shape.address, hint=hint)
    if shape.address in COMPANIONS or is_axis:
        return WordAlarm("12080", position, text=shape.address)
    return not_supported(shape.address)
