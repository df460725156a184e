"""What a block asks of punching and nibbling: SON, PON, SONS, PONS, SPOF, SPP, SPN, PUNCHACC, and old M functions (12).

The press comes with MD26012; without it the words are unknown (12550). What MD26014 says decides whether SPP and SPN
cut paths without strokes too.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.punching.strokes import Acceleration, Begin, End, SegmentStage
from polycnc.control.sinumerik.signals import measuring
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Stroke

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

GROUP, OFF = "punching", "SPOF"
NIBBLES = frozenset(("SON", "SONS"))
LEADS = frozenset(("SONS", "PONS"))
ACTIVATION, CODES, SPLITTING = "$MC_PUNCHNIB_ACTIVATION", "$MC_NIBBLE_PUNCH_CODE", "$MC_PUNCH_PATH_SPLITTING"
AXES, DIVISION, DELAY = "$MC_PUNCHNIB_AXIS_MASK", "$MC_PUNCH_PARTITION_TYPE", "$SC_PUNCH_DWELLTIME"
#: MD26012: M functions stand for the words; which ones, by the places of MD26008.
BY_M_FUNCTIONS = 2
WORDS_OF_M = ("SPOF", "SPOF", "SON", "PON", "PDELAYON", "SONS", "PONS", "PDELAYOF")
#: MD26014: segments with strokes alone; with and without; never.
WITH_STROKES, ALWAYS, NEVER = range(3)
#: Paths that can be cut into segments.
CUT = frozenset(("G0", "G1", "G2", "G3", "CIP", "CT"))
#: Words of motion in the plane beside those of the axes.
IN_PLANE = ("AP", "RP", "ANG", "CR", "AR", "I", "J", "K", "I1", "J1", "K1")


@dataclass(slots=True)
class Punching(State, lifetime=Lifetime.RESET):
    """What holds beside the modal functions.

    Attributes:
        longest: SPP, mm; 0 for none.
        suspended: SPOF has ended the segments of SPP, until strokes or SPP begin again.
        begins: Nibbling begins: the next block with a stroke has one at its start as well.
        acceleration: PUNCHACC; None for that of the axes.
    """

    longest: float = 0.0
    suspended: bool = False
    begins: bool = False
    acceleration: Acceleration | None = None


def macros(channel: Channel) -> dict[str, str]:
    """M functions that stand for the words of punching, where MD26012 says so."""
    data = MachineData.of(channel)
    if data.integer(ACTIVATION) != BY_M_FUNCTIONS:
        return {}
    delivered = (20, 23, 22, 25, 26, 122, 125, 27)
    codes = (
        data.integer(CODES, place) if data.is_set(CODES, place) else code
        for place, code in enumerate(delivered)
    )
    return {f"M{code}": word for code, word in zip(codes, WORDS_OF_M, strict=True) if code > 0}


# ---- words


def select(draft: Draft) -> list[Step]:
    """What a function of group 35 does when it is programmed: 12550 without a press, nibbling begins, SPP rests."""
    code = draft.codes[GROUP]
    if code != OFF and not draft.memory.data.integer(ACTIVATION):
        raise AlarmError("12550", text=code)
    anew = code in NIBBLES and draft.channel.mode[GROUP] not in NIBBLES

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        state = Punching.of(channel)
        state.suspended = code == OFF
        state.begins = anew or (state.begins and code in NIBBLES)

    return [run]


def longest_segment(draft: Draft, position: int, _shape: WordShape) -> Step:
    """SPP: longest segment from now on, 0 for none; beside SPOF it waits for the next strokes."""
    factor = length_factor(draft.mode)
    rests = draft.codes.get(GROUP) == OFF

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factor
        if value < 0.0:
            raise WordAlarm("12560", position, text="SPP")
        state = Punching.of(channel)
        state.longest, state.suspended = value, rests
        channel.mode = channel.mode.with_code("segments", "SPP" if value else "")

    return run


def acceleration(channel: SinumerikChannel, args: Arguments) -> None:
    """PUNCHACC(Smin,Amin,Smax,Amax): accelerations in per cent by the distance of two strokes."""
    if len(args) != 4 or None in args:
        raise AlarmError("14020", text="PUNCHACC")
    if not channel.memory.data.integer(ACTIVATION):
        raise AlarmError("12550", text="PUNCHACC")
    shortest, first, longest, last = (arguments.real(value) for value in args)
    if not 0.0 <= shortest <= longest or not 0.0 < first <= 100.0 or not 0.0 < last <= 100.0:
        raise AlarmError("12560", text="PUNCHACC")
    factor = length_factor(channel.mode)
    Punching.of(channel).acceleration = Acceleration(
        shortest * factor, first / 100.0, longest * factor, last / 100.0
    )


PROCEDURES = {"PUNCHACC": acceleration}


# ---- blocks


def begin(draft: Draft) -> Step:
    """The mark in front of the moves of a block, made of its words before anybody takes them."""
    parts, mode = draft.take("SPN"), draft.mode
    strikes = mode[GROUP] != OFF
    if mode[GROUP] in LEADS and draft.has(*measuring.WORDS):
        raise not_supported(f"MEAS {mode[GROUP]}")
    axes = stroke_axes(draft)
    names = draft.has(*IN_PLANE) or any(term.column in axes for term in draft.axis_terms())
    data, single = draft.memory.data, _declared(draft)
    splitting, ends = data.integer(SPLITTING), draft.codes.get(GROUP) == OFF
    cuts = not ends and (splitting == ALWAYS or (splitting == WITH_STROKES and strikes))

    def run(channel: SinumerikChannel, values: Values) -> None:
        state = Punching.of(channel)
        count = _count(values, parts) if parts is not None else 0
        count, longest = (count, 0.0 if state.suspended else state.longest) if cuts else (0, 0.0)
        stroke = _stroke(channel) if strikes and names else None
        if (stroke is not None or count or longest) and mode["motion"] not in CUT:
            raise not_supported(f"{mode['motion']} {mode[GROUP] if strikes else 'SPP SPN'}")
        stage = channel.path.find(SegmentStage) or channel.path.put(SegmentStage(channel))
        stage.awaited += 1
        first = state.begins and stroke is not None
        division = data.integer(DIVISION)
        mark = Begin(stroke, first, count, longest, axes, single, division, state.acceleration)
        state.begins = state.begins and not first
        channel.event(mark)

    return run


def end(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """The mark behind the moves of a block."""
    channel.event(End())


def _count(values: Values, position: int) -> int:
    """SPN: a whole number of segments, 12150 for a fraction, 12560 for less than one."""
    value = number(values, position)
    if value != int(value):
        raise WordAlarm("12150", position, text=f"{value:g}")
    if value < 1.0:
        raise WordAlarm("12560", position, text="SPN")
    return int(value)


def _stroke(channel: SinumerikChannel) -> Stroke:
    """The stroke that the modal functions ask for."""
    mode = channel.mode
    punches = mode[GROUP] not in NIBBLES
    delay = channel.memory.data.number(DELAY) if punches and mode["punching_delay"] == "PDELAYON" else 0.0
    interface = 2 if mode["punching_byte"] == "SPIF2" else 1
    return Stroke(interface, delay or None, True if mode[GROUP] in LEADS else None)


def stroke_axes(draft: Draft) -> frozenset[int]:
    """Columns of the axes whose words make a stroke: those of the plane, and others that MD26010 names."""
    geometry = draft.channel.coordinates.geometry
    plane = (geometry[i] for i in PLANES[draft.mode["plane"]][:2])
    return frozenset(column for column in plane if column >= 0) | _declared(draft)


def _declared(draft: Draft) -> frozenset[int]:
    """Axes beside the geometry that MD26010 names."""
    geometry, mask = draft.channel.coordinates.geometry, draft.memory.data.integer(AXES)
    count = len(draft.channel.axes)
    return frozenset(i for i in range(count) if mask >> i & 1 and i not in geometry)
