"""The words of oscillation: OS, OSP1, OSP2, OST1, OST2, OSNSC, OSE, OSB, OSCTRL, OSCILL with POSP (11.1, 11.2).

Their values go into setting data along with the path, when the axes are there (11.1).
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import Dimension, axis_term, is_diameter, number, of_display
from polycnc.control.sinumerik.oscillation import strokes
from polycnc.control.sinumerik.oscillation.infeed import Infeed, PartialInfeeds
from polycnc.control.sinumerik.oscillation.strokes import Oscillations
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

#: Setting data of positions and of numbers, by their words.
POSITIONS = {
    "OSP1": strokes.REVERSAL[0],
    "OSP2": strokes.REVERSAL[1],
    "OSE": strokes.END,
    "OSB": strokes.START,
}
NUMBERS = {"OST1": strokes.DWELL[0], "OST2": strokes.DWELL[1], "OSNSC": strokes.SPARKS}
#: Axes that OSCILL feeds in at most.
MOST_INFEEDS = 3
#: Times at reversal points that are none: without a stop, with a coarse one.
NO_STOP, COARSE_STOP = -2.0, -1.0


def datum(draft: Draft, position: int, shape: WordShape) -> Step:
    """A position or a number of an oscillating axis: its setting datum; OSE asks for the end position too."""
    column = axis_column(draft, position, shape)
    name = POSITIONS.get(shape.address) or NUMBERS[shape.address]
    factor, adds = 1.0, shape.modifier == "IC"
    if shape.address in POSITIONS:
        term = axis_term(draft.channel, draft.mode, position, column, shape.modifier)
        factor, adds = term.factor, term.way is Dimension.INCREMENTAL

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factor
        if name in strokes.DWELL and value < 0.0 and value not in (NO_STOP, COARSE_STOP):
            raise WordAlarm("12560", position, text=shape.address)

        before = _ahead(channel, name, column) if adds else 0.0
        _along_with_the_path(channel, shape.address, name, column, before + value)
        if shape.address == "OSE":
            mask = int(_ahead(channel, strokes.OPTIONS, column)) | strokes.TO_END
            _along_with_the_path(channel, shape.address, strokes.OPTIONS, column, mask)

    return run


def _ahead(channel: SinumerikChannel, name: str, column: int) -> float:
    """The datum of an axis as blocks have said it so far."""
    value = channel.memory.data.read_ahead(name, Axis(channel.axes[column]))
    return float(value) if isinstance(value, int | float) else 0.0


def _along_with_the_path(channel: SinumerikChannel, word: str, name: str, column: int, value: float) -> None:
    """Write a datum when the axes are there: `$SA_…` of prepared blocks has it now, as in the manual's examples.

    At once where nothing runs on the clock yet, so that nothing looks.
    """
    data, place = channel.memory.data, (Axis(channel.axes[column]),)
    if channel.actual.clocked is None:
        data.write(name, place, value)
    else:
        data.say_ahead(name, place, value)
        channel.event(Deed(word, None, lambda: data.write_as_said(name, place, value)))


def options(draft: Draft, position: int, shape: WordShape) -> Step:
    """OSCTRL[axis]=(set,reset): bits of the options."""
    column = axis_column(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        listed = list(values[position]) if isinstance(values[position], tuple) else [values[position]]
        if not 1 <= len(listed) <= 2 or any(value not in strokes.ALL_OPTIONS for value in listed):
            raise WordAlarm("12560", position, text="OSCTRL")
        on, off = (int(value) for value in (*listed, 0)[:2])

        mask = int(_ahead(channel, strokes.OPTIONS, column)) & ~off | on
        _along_with_the_path(channel, "OSCTRL", strokes.OPTIONS, column, mask)

    return run


def switch(draft: Draft, position: int, shape: WordShape) -> Step:
    """OS[axis]=1, 0: when the axes are there, oscillation begins or ends; the program goes on."""
    column = axis_column(draft, position, shape)
    name = shape.index.name if isinstance(shape.index, Axis) else draft.channel.axes[column]
    seat.check_positioning(draft.channel, name, column, by_axes=False)
    draft.channel.on_clock()

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value not in (0.0, 1.0):
            raise WordAlarm("12560", position, text="OS")
        if value:
            _check_travel(channel, column)
        keep_speed = _begin(channel, column)
        oscillations = Oscillations.of(channel)

        def do() -> None:
            keep_speed()
            (oscillations.switch_on if value else oscillations.switch_off)(column)

        channel.event(Deed("OS", None, do, is_silent=False))

    return run


def _check_travel(channel: SinumerikChannel, column: int) -> None:
    """Both reversal points lie within the travel of the axis, and within its working area by setting data."""
    if channel.memory.axes[column].modulo:
        return
    place = list(channel.coordinates.position)
    for name in strokes.REVERSAL:
        place[column] = _ahead(channel, name, column)
        action_axes.check_target(channel, column, channel.coordinates.to_machine(place)[column])


def take_feed(channel: SinumerikChannel, column: int) -> None:
    """FA of an axis that may oscillate: SD43740 has it when the axes are there (11.1)."""
    if channel.actual.clocked is None or column not in ActionAxes.of(channel).may_move:
        return
    speed = action_axes.speed_of(channel, column) * tables.MINUTE
    _along_with_the_path(channel, "FA", strokes.VELOCITY, column, speed)


def _begin(channel: SinumerikChannel, column: int) -> Callable[[], None]:
    """An axis is about to leave the path; gives what makes FA its velocity then."""
    oscillations = Oscillations.of(channel)
    channel.on_clock().watch(oscillations)
    action_axes.expect(channel, (column,))
    name = channel.axes[column]
    speed = action_axes.speed_of(channel, column) * tables.MINUTE
    return partial(channel.memory.data.write, strokes.VELOCITY, (Axis(name),), speed)


def oscillate(draft: Draft) -> Step | None:
    """`OSCILL[axis]=(in1,in2,in3) POSP[in1]=(end,partial,mode)`: the block ends when all is fed in."""
    found = draft.take_shape("OSCILL")
    if found is None:
        return None
    position, shape = found
    column = axis_column(draft, position, shape)
    feeds = [(place, word) for place, word in draft.open_words() if word.address == "POSP"]
    infeeds = {axis_column(draft, place, word): place for place, word in feeds}
    for place, _ in feeds:
        draft.close(place)
    draft.channel.on_clock()

    def run(channel: SinumerikChannel, values: Values) -> None:
        listed = values[position] if isinstance(values[position], tuple) else (values[position],)
        if not 1 <= len(listed) <= MOST_INFEEDS or not all(isinstance(axis, Axis) for axis in listed):
            raise WordAlarm("12560", position, text="OSCILL")
        if {channel.memory.column(axis.name) for axis in listed} != set(infeeds):
            raise WordAlarm("12560", position, text="POSP")
        if column in infeeds:
            raise WordAlarm("12560", position, text="OSCILL")
        keep_speed = _begin(channel, column)
        action_axes.expect(channel, infeeds)
        action_axes.give_back(channel, infeeds)
        made, ends = _infeeds(channel, infeeds, values)
        oscillations = Oscillations.of(channel)

        def do() -> None:
            for infeed in made:
                channel.on_clock().shift_path(infeed.column, ends[infeed.column])
            oscillations.infeeds.extend(made)
            keep_speed()
            oscillations.switch_on(column)

        places = tuple(ends.items())
        awaits = partial(_is_fed_in, oscillations)
        channel.event(Deed("OSCILL", None, do, is_silent=False, awaits=awaits, places=places))
        machine = channel.coordinates.machine
        for each, end in ends.items():
            machine[each] = end
        channel.coordinates.arrive_machine(machine)

    return run


def _is_fed_in(oscillations: Oscillations) -> bool:
    """Whether something is still to be fed in."""
    return bool(oscillations.infeeds)


def _infeeds(
    channel: SinumerikChannel, infeeds: dict[int, int], values: Values
) -> tuple[list[Infeed], dict[int, float]]:
    """The infeeds with their targets on the machine, and where each ends."""
    made, ends = [], {}
    machine, work = channel.coordinates.machine, channel.coordinates.position
    factor = length_factor(channel.mode)
    for column, place in infeeds.items():
        listed = values[place]
        right = isinstance(listed, tuple) and 2 <= len(listed) <= 3 and listed[1] > 0
        if not right or (len(listed) == 3 and listed[2] not in (0, 1)):
            raise WordAlarm("12560", place, text="POSP")
        way = of_display(channel, column, float(listed[0]) * factor) - work[column]
        halves = is_diameter(channel.mode, Dimension.INCREMENTAL, column, channel.memory.transverse)
        partial = float(listed[1]) * factor * (0.5 if halves else 1.0)
        mode = int(listed[2]) if len(listed) == 3 else 0
        made.append(
            Infeed(
                column,
                action_axes.speed_of(channel, column),
                PartialInfeeds(machine[column], way, partial, mode),
            )
        )
        ends[column] = machine[column] + way
    return made, ends
