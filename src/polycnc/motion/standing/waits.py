"""Time that passes while the axes stand: tool changes, the spindle's ramps, auxiliary functions, dwells."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from math import pi, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.motion.kernels.columns import Form, PieceRecord
from polycnc.motion.standing.beside import Awaits, Begins, Indexing, Search, Turning
from polycnc.motion.standing.zero_mark import Mark, SpindleAngle, Turns
from polycnc.toolpath import Kind
from polycnc.toolpath.events import (
    Auxiliary,
    BuilderCode,
    Deed,
    HFunction,
    Raised,
    SpindleSpeed,
    SpindleWait,
    Stop,
    Stroke,
    ToolSelection,
)
from polycnc.toolpath.kinds import CURVE_WIDTH, RAPID_KINDS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.machine import Machine, Spindle
    from polycnc.motion.standing.beside import Step, Work
    from polycnc.motion.standing.positioning import PositionedAxes
    from polycnc.toolpath import Context, Event, Toolpath
    from polycnc.toolpath.motion_settings import SpindleWaitFor
    from polycnc.toolpath.table import Chunk

#: Events that the control puts out between two blocks and waits for: the axes stand still.
STANDING = (Auxiliary, BuilderCode, SpindleSpeed, SpindleWait, ToolSelection, HFunction, Stop, Stroke, Raised)
#: M19 turns the spindle to its angle, for which the axes stand whatever the machine file says.
ORIENT = 19
#: M03 and M04 have a spindle turn.
TURNING = (3, 4)
#: In the order of the steps of a chunk: an event, or a thread that begins, not the number of a context.
EVENT, THREAD = -1, -2
#: Moves that lead nowhere where they end at their start.
STRAIGHT = frozenset((Kind.RAPID, Kind.FEED, Kind.REF))


class Parallel(NamedTuple):
    """An auxiliary function that runs beside the motion of its block, the rows `row` to `last`."""

    row: int
    last: int
    context: int
    seconds: float


def least_seconds(pieces: Sequence[float], first: int, last: int, width: int) -> float:
    """The least time of the pieces from one to before another one: at their highest speeds, which are open yet."""
    seconds = 0.0
    for at in range(first * width, last * width, width):
        if pieces[at + PieceRecord.FORM] == Form.TIMED:
            seconds += pieces[at + PieceRecord.PULL]
        else:
            rises = max(pieces[at + PieceRecord.RISE], 0.0) * pieces[at + PieceRecord.LENGTH]
            seconds += pieces[at + PieceRecord.LENGTH] / sqrt(pieces[at + PieceRecord.CAP2] + rises)
    return seconds


def rpm_at(context: Context, radius_mm: float, spindle: Spindle | None) -> float:
    """Spindle speed of a context at a turning radius, as far as the spindle and the program's limit allow."""
    highest = spindle.max_rpm if spindle else context.spindle_rpm
    if context.spindle_limit_rpm > 0.0:
        highest = min(highest, context.spindle_limit_rpm)
    if not context.surface_speed:
        return min(context.spindle_rpm, highest)
    around_m = 2.0 * pi * radius_mm / 1000.0
    speed = context.surface_m_min
    if speed <= 0.0:
        return 0.0
    return highest if around_m * highest <= speed else speed / around_m


class Waits:
    """Follows tool and spindles through the rows of a toolpath and says what each row waits for.

    Args:
        machine: Spindle ramps, change time and auxiliary functions come from here.
        toolpath: Whose rows they are.
        tool: Number or name of the tool in the spindle at the start; 0 for none.
        wait: Called with row number, share (a field of `Times`), context number and seconds.

    Attributes:
        rapid_stops: Rapids end with an exact stop.
        spindle_wait: What waits for a spindle, where parameters of the control say it; empty for the machine file.
        step: Called with what begins beside the axes, what waits for it, and what spindles and threads do; in the order
            of the rows, but for threads and taps, which come behind all else of a chunk.
        angles: Of the spindles that have cut a thread, by their number.
        positioned: Follows axes that are positioned beside the path; None where a main run does.
    """

    def __init__(
        self,
        machine: Machine,
        toolpath: Toolpath,
        tool: int | str,
        wait: Callable[[int, str, int, float], None],
    ) -> None:
        self.machine = machine
        self.contexts, self._block_starts = toolpath.contexts, toolpath.block_starts
        self._say, self._waited = wait, (-1, 0.0)
        self.parallel: list[Parallel] = []
        self.step: Callable[[Step], None] = _nobody
        self.spindle_wait: SpindleWaitFor | Literal[""] = ""
        self._turning: dict[int, Turning] = {}
        self.angles: dict[int, SpindleAngle] = {}
        self.positioned: PositionedAxes | None = None
        self._before_thread: dict[int, float] = {}  # what rows that begin a thread wait for besides
        self._indexing: dict[int, Indexing] = {}
        self._open: Turning | None = None  # the next cut waits for it
        self._looked = 0
        self._search, self._pockets = Search(machine.magazine), dict[int, int]()
        self.stand_in(tool)
        self._rpm: dict[int, float] = {}
        self._resting: dict[int, tuple[object, ...]] = {}
        self._context = -1
        self._radius: float | None = None
        self._has_followed = False  # the spindle has followed the radius of a cut since it was told a speed
        self._leads_on = False  # the last row is of a thread, which the next one may go on with
        self.rapid_stops = False
        self._windows = {"fine": machine.settle_fine_s, "coarse": machine.settle_coarse_s}
        self._settling: tuple[str, int, float] | None = None
        self._place: tuple[int, list[float]] = (-1, [])

    def wait(self, row: int, share: str, number: int, seconds: float) -> None:
        """A row waits; how long it has so far is kept."""
        self._waited = row, seconds + (self._waited[1] if row == self._waited[0] else 0.0)
        if row in self._before_thread:
            self._before_thread[row] += seconds
        self._say(row, share, number, seconds)

    def stand_in(self, tool: int | str) -> None:
        """Say which tool is in the spindle, by its number or name; 0 for none."""
        self._tool = (tool, "") if isinstance(tool, int) else (0, tool)
        self._aim = self._search.place = self._place_of(self._tool[0]) or 1
        self._at_start = tool if isinstance(tool, int) else tool.upper()

    def spindle(self, context: Context) -> Spindle | None:
        """The spindle that a context speaks of."""
        spindles = self.machine.spindle
        return spindles.get(context.spindle) or next(iter(spindles.values()), None)

    def stands_for(self, event: Event) -> bool:
        """Whether the axes stand still for an event."""
        if isinstance(event, Auxiliary):
            function = self.machine.m_functions.get(event.code)
            return function is None or function.timing != "with" or event.code == ORIENT
        if isinstance(event, Deed):
            return event.stands or not event.is_silent
        return isinstance(event, STANDING)

    def stands_at(self, chunk: Chunk, row: int) -> bool:
        """Whether the axes stand still for the event of a row, also for a function whose block has no motion."""
        event = chunk.events[chunk.curve[row]]
        if self.stands_for(event):
            return True
        if not isinstance(event, Auxiliary) or not self.machine.goes_beside(event.code):
            return False
        return not _moves(chunk, *self._block_of(chunk, row))

    def stops(self, chunk: Chunk) -> array[int]:
        """For each event of a chunk whether the axes stand still for it."""
        stops = array("B", map(self.stands_for, chunk.events))
        if not all(stops):
            for row in _places(chunk.kind.tobytes(), Kind.EVENT):
                stops[chunk.curve[row]] = self.stands_at(chunk, row)
        return stops

    def take(self, chunk: Chunk, facing: int) -> None:
        """Note the waits of a chunk's rows; `facing` is the column of X, -1 for none."""

        def radius(row: int) -> float:
            return abs(chunk.end[row * chunk.axes + facing]) if facing >= 0 else 0.0

        kinds, self._looked = chunk.kind.tobytes(), 0
        self._before_thread = dict.fromkeys(self._thread_starts(chunk, kinds), 0.0)
        runs = chunk.context_runs()
        changes = [(row, number) for number, row, _ in runs if number != self._context or row]
        events = [(row, EVENT) for row in _places(kinds, Kind.EVENT)]
        threads = [(row - chunk.first, THREAD) for row in self._before_thread]
        for row, number in sorted([*changes, *events, *threads], key=lambda step: (step[0], step[1] < 0)):
            if number == THREAD:
                self._angle_of(self.contexts[chunk.context[row]])
                continue
            self._rows(chunk, kinds, row, radius)
            if number == EVENT:
                self._event(chunk, row)
                continue
            here = radius(row - 1) if row else self._radius
            here = radius(row) if here is None else here
            ahead = radius(row) if kinds[row] in RAPID_KINDS else here
            self._new_context(chunk.first + row, number, here, ahead)
            self._context = number
        self._rows(chunk, kinds, len(chunk), radius)
        if len(chunk):
            self._radius = radius(len(chunk) - 1)
        for row in _places(kinds, Kind.DWELL):
            self._dwell(chunk, row, radius(row))
        if any(self._windows.values()):
            self._exact_stops(chunk, kinds)
        self._threads(chunk, kinds, radius)

    def settle(self, row: int) -> None:
        """What the exact stop before a row waits for; at the end of the toolpath, that before a row still to come."""
        if self._settling is not None:
            self.wait(row, *self._settling)
            self._settling = None

    def _new_context(self, row: int, number: int, here: float, ahead: float) -> None:
        """What a change of context waits for: the spindle goes to its speed at the turning radius `ahead`.

        Under constant surface speed it has followed the cuts so far, to the radius `here`, and follows those to come.
        """
        context = self.contexts[number]
        last = self.contexts[self._context] if self._context >= 0 else None
        self._take_tool(row, number)
        spindle, self._has_followed = self.spindle(context), False
        if spindle is None or self._resting.get(spindle.number) == _command(context):
            return
        self._resting.pop(spindle.number, None)
        if last is not None and last.surface_speed and self.spindle(last) is spindle:
            self._rpm[spindle.number] = last.spindle_direction * self.rpm(last, here)
        self._to_speed(row, number, spindle, ahead, follows=last is not None and last.surface_speed)

    def _to_speed(self, row: int, number: int, spindle: Spindle, ahead: float, *, follows: bool) -> None:
        """A spindle goes to the speed of a context at a radius; `follows`: it has followed another one so far."""
        context = self.contexts[number]
        target = context.spindle_direction * self.rpm(context, ahead)
        change = abs(target - self._rpm.get(spindle.number, 0.0))
        stands = self.stands_for_speed(spindle)
        self._turn(row, spindle, target, change, is_even=stands and not context.surface_speed)
        if change > 0.0 and spindle.acceleration_rpm_s > 0.0:
            if stands:
                self.wait(row, "spindle_s", number, change / spindle.acceleration_rpm_s)
            else:
                self._run_up(row, spindle, target, self._rpm.get(spindle.number, 0.0) if follows else None)
        self._rpm[spindle.number] = target

    def _take_tool(self, row: int, number: int) -> None:
        """The tool of a context, which is changed if it is another one. No tool is no place of a turret: it stays."""
        context = self.contexts[number]
        tool = (context.tool, context.tool_name)
        if self._at_start and self._at_start in (tool[0], tool[1].upper()):
            self._tool = tool  # contexts know number and name, the start knows one of them
        self._at_start = 0
        if not any(tool) and self.machine.magazine.kind == "turret":
            return
        if tool != self._tool and (any(tool) or any(self._tool)):
            self._change(row, number, self._tool[0], tool[0])
        self._tool = tool

    def stands_for_speed(self, spindle: Spindle) -> bool:
        """Whether a block that asks for another speed of a spindle waits for it."""
        return (self.spindle_wait or spindle.speed_wait) == "block"

    def _turn(self, row: int, spindle: Spindle, target: float, change: float, *, is_even: bool) -> None:
        """A spindle with a known angle goes to a speed; it is lost unless it goes there evenly, while the axes wait."""
        if spindle.number in self.angles and (change > 0.0 or not is_even):
            pull = spindle.acceleration_rpm_s
            ramp_s, after_s = change / pull if pull > 0.0 else 0.0, self._waits_of(row)
            angle = self.angles[spindle.number]
            self.step(Turns(row, angle, target if is_even else None, ramp_s, after_s))

    def _angle_of(self, context: Context) -> SpindleAngle:
        """The angle of the spindle that a thread follows; from now on it counts."""
        spindle = self.spindle(context)
        number = spindle.number if spindle is not None else context.spindle
        return self.angles.setdefault(number, SpindleAngle())

    def _lose(self, row: int, number: int) -> None:
        """The spindle of a context follows something else: nobody knows its angle any more."""
        spindle = self.spindle(self.contexts[number])
        if spindle is not None and spindle.number in self.angles:
            self.step(Turns(row, self.angles[spindle.number], None))

    def _waits_of(self, row: int) -> float:
        """How long a row has waited so far, of which it is the last."""
        return self._waited[1] if row == self._waited[0] else 0.0

    def _run_up(self, row: int, spindle: Spindle, target: float, since: float | None) -> None:
        """A spindle goes to a speed beside the axes; the next cut waits for it, unless nothing does."""
        turning = self._turning.get(spindle.number)
        if turning is None:
            turning = self._turning[spindle.number] = Turning(spindle.acceleration_rpm_s)
        self._begin(row, turning, target, since)
        cuts_wait = target != 0.0 and (self.spindle_wait or spindle.speed_wait) == "cut"
        self._open = turning if cuts_wait else None

    def _begin(self, row: int, work: Work, aim: float, since: float | None = None) -> None:
        """Some work begins, behind what the row has waited for already."""
        self.step(Begins(row, work, aim, self._waits_of(row), since))

    def _rows(self, chunk: Chunk, kinds: bytes, before: int, radius: Callable[[int], float]) -> None:
        """Rows up to one: the first cut waits for the spindle, which goes to other speeds in rapids under G96."""
        follows = self._following_spindle()
        if self._open is None and follows is None:
            self._looked = before
            return
        for row in range(self._looked, before):
            if kinds[row] in RAPID_KINDS and follows is not None:
                here = radius(row - 1) if row else self._radius
                self._to_radius(chunk.first + row, follows, radius(row), here)
            elif kinds[row] < Kind.DWELL and kinds[row] not in RAPID_KINDS:
                if self._open is not None:
                    self.step(Awaits(chunk.first + row, self._open, chunk.context[row], rests=True))
                    self._open = None
                self._has_followed = follows is not None
                if follows is None:
                    break
        self._looked = before

    def _following_spindle(self) -> Spindle | None:
        """The spindle, where it follows the turning radius and cuts behind a rapid wait for it; else None."""
        context = self.contexts[self._context] if self._context >= 0 else None
        if context is None or not context.surface_speed:
            return None
        spindle = self.spindle(context)
        waits = spindle is not None and (self.spindle_wait or spindle.speed_wait) == "cut"
        return spindle if waits and spindle is not None and spindle.acceleration_rpm_s > 0.0 else None

    def _to_radius(self, row: int, spindle: Spindle, radius_mm: float, before: float | None) -> None:
        """In a rapid under constant surface speed the spindle goes to the speed at its end, for which a cut waits."""
        context, since = self.contexts[self._context], None
        if self._has_followed and before is not None:
            since = context.spindle_direction * self.rpm(context, before)
        target = context.spindle_direction * self.rpm(context, radius_mm)
        if target != (self._rpm.get(spindle.number, 0.0) if since is None else since):
            self._run_up(row, spindle, target, since)
        self._rpm[spindle.number], self._has_followed = target, False

    def _change(self, row: int, number: int, before: int, after: int) -> None:
        """The tool is changed, once its spindle stands.

        Without an arm the magazine first takes the old tool back to its place. With one it has turned to the new tool
        since its T; the old tool gets the place of the new one.
        """
        self._stop_tool(row, number)
        for spindle, turning in self._turning.items():
            if self._rpm[spindle] == 0.0:  # it comes to rest
                self.step(Awaits(row, turning, number))
        magazine, seconds = self.machine.magazine, self.machine.magazine.change_time_s
        if magazine.kind == "turret":
            seconds += magazine.index_s(before, after)
        elif magazine.place_time_s > 0.0 and magazine.pockets == "fixed":
            for place in (self._place_of(before), self._place_of(after)):
                if place:
                    seconds += magazine.turn_s(self._search.place, place)
                    self._search.place = place
        elif magazine.place_time_s > 0.0:
            place = self._place_of(after)
            self._turn_to(row, place)
            self.step(Awaits(row, self._search, number))
            if before > 0:
                self._pockets[before] = place or before
            self._pockets[after] = 0
        self.wait(row, "tool_change_s", number, seconds)

    def stops_for_change(self, spindle: Spindle | None) -> bool:
        """Whether a spindle comes to rest for a change of the tool: it carries one, out of a magazine."""
        kind = self.machine.magazine.kind
        return kind == "magazine" and spindle is not None and spindle.carries == "tool"

    def _stop_tool(self, row: int, number: int) -> None:
        """A spindle that turns the tool comes to rest for its change, and stands until the program tells it to turn."""
        spindle = self.spindle(self.contexts[number])
        if spindle is not None and self.stops_for_change(spindle) and self._rpm.get(spindle.number):
            self._bring_to_rest(row, number, spindle, "tool_change_s")
            self._resting[spindle.number] = _command(self.contexts[self._context])

    def _bring_to_rest(self, row: int, number: int, spindle: Spindle, share: str) -> None:
        """A row waits until a spindle stands; `share` is the field of `Times` that this counts for."""
        rpm, pull = abs(self._rpm.get(spindle.number, 0.0)), spindle.acceleration_rpm_s
        if rpm > 0.0 and pull > 0.0 and self.stands_for_speed(spindle):
            self._turn(row, spindle, 0.0, rpm, is_even=True)
            self.wait(row, share, number, rpm / pull)
        elif rpm > 0.0 and pull > 0.0:
            self._run_up(row, spindle, 0.0, None)
        if spindle.number in self._turning:
            self.step(Awaits(row, self._turning[spindle.number], number, share=share))
        self._rpm[spindle.number] = 0.0

    def _start_again(self, row: int, number: int, spindle: Spindle | None) -> None:
        """A spindle that rests since a change of its tool is told to turn, whatever its speed."""
        if spindle is not None and self._resting.pop(spindle.number, None) is not None:
            self._to_speed(row, number, spindle, self._radius or 0.0, follows=False)

    def _select(self, row: int, tool: str | float) -> None:
        """T: a magazine with an arm turns to the tool beside what comes."""
        magazine = self.machine.magazine
        if magazine.kind == "magazine" and magazine.place_time_s > 0.0 and magazine.pockets == "random":
            self._turn_to(row, 0 if isinstance(tool, str) else self._place_of(int(tool)))

    def _turn_to(self, row: int, place: int) -> None:
        """The magazine turns to a place, 0 for one that is not known, unless it goes there already."""
        if place and place != self._aim:
            self._begin(row, self._search, place)
            self._aim = place

    def _place_of(self, tool: int) -> int:
        """The place of a tool; 0 for one in the spindle, or without a place that its number says."""
        own = tool if 0 < tool <= self.machine.magazine.places else 0
        return self._pockets.get(tool, own)

    def rpm(self, context: Context, radius_mm: float) -> float:
        """Spindle speed of a context at a turning radius."""
        return rpm_at(context, radius_mm, self.spindle(context))

    def _event(self, chunk: Chunk, row: int) -> None:
        event = chunk.events[chunk.curve[row]]
        if self.positioned is not None and isinstance(event, Deed):
            for step in self.positioned.steps(event, chunk.first + row, chunk.context[row]):
                self.step(step)
        if isinstance(event, ToolSelection):
            self._select(chunk.first + row, event.tool)
        if isinstance(event, BuilderCode) and event.index_s > 0.0:
            work = self._indexing[event.spindle] = Indexing()
            self._begin(chunk.first + row, work, event.index_s)
        elif isinstance(event, BuilderCode):
            g_function = self.machine.g_functions.get(event.code)
            if g_function is not None and g_function.seconds > 0.0:
                self.wait(chunk.first + row, "auxiliary_s", chunk.context[row], g_function.seconds)
        if isinstance(event, SpindleWait):
            self._lose(chunk.first + row, chunk.context[row])
            if event.spindle in self._indexing:
                self.step(Awaits(chunk.first + row, self._indexing.pop(event.spindle), chunk.context[row]))
            else:
                self.wait(chunk.first + row, "spindle_s", chunk.context[row], event.seconds)
        if isinstance(event, Stroke) and event.delay:
            self.wait(chunk.first + row, "auxiliary_s", chunk.context[row], event.delay)
        if not isinstance(event, Auxiliary):
            return
        code, context = event.code, chunk.context[row]
        function = self.machine.m_functions.get(code)
        spindle = self._spindle_of(event, context)
        if code in TURNING or (function is not None and function.does.startswith("spindle_")):
            self._start_again(chunk.first + row, context, spindle)
        if function is not None and function.seconds > 0.0:
            first, last = self._block_of(chunk, row)
            if code != ORIENT and self.machine.goes_beside(code) and _moves(chunk, first, last):
                self.parallel.append(
                    Parallel(chunk.first + row, chunk.first + last, context, function.seconds)
                )
            else:
                self.wait(chunk.first + row, "auxiliary_s", context, function.seconds)
        if code == ORIENT and spindle is not None:
            self._lose(chunk.first + row, context)
            self._bring_to_rest(chunk.first + row, context, spindle, "spindle_s")
            self.wait(chunk.first + row, "spindle_s", context, spindle.orient_s)

    def _spindle_of(self, event: Auxiliary, number: int) -> Spindle | None:
        """The spindle that a function is for: the one that it names, else that of the context."""
        named = self.machine.spindle.get(event.spindle) if event.spindle is not None else None
        return named or self.spindle(self.contexts[number])

    def _block_of(self, chunk: Chunk, row: int) -> tuple[int, int]:
        """The first and the last row that the block of a row made."""
        starts, number = self._block_starts, chunk.first + row
        behind = bisect_right(starts, number)
        least = max(starts[behind - 1] - chunk.first, 0) if behind else 0
        most = min(starts[behind] - chunk.first, len(chunk)) if behind < len(starts) else len(chunk)
        place = chunk.line[row], chunk.program[row]
        first, last = row, row + 1
        while first > least and (chunk.line[first - 1], chunk.program[first - 1]) == place:
            first -= 1
        while last < most and (chunk.line[last], chunk.program[last]) == place:
            last += 1
        return first, last - 1

    def _dwell(self, chunk: Chunk, row: int, radius_mm: float) -> None:
        number, at = chunk.context[row], chunk.curve[row] * CURVE_WIDTH
        seconds, turns = chunk.curves[at : at + 2] if at >= 0 else (0.0, 0.0)
        if turns > 0.0:
            rpm = self.rpm(self.contexts[number], radius_mm)
            seconds += turns * 60.0 / rpm if rpm > 0.0 else 0.0
        self.wait(chunk.first + row, "dwell_s", number, seconds)

    def _thread_starts(self, chunk: Chunk, kinds: bytes) -> Iterator[int]:
        """Rows that begin a thread: no thread leads into them, and their spindle turns."""
        before = -1
        for row in _places(kinds, Kind.THREAD):
            leads_on = self._leads_on if before < 0 else not self._exact(chunk.context[before])
            between = range(before + 1, row)
            if any(kinds[k] != Kind.EVENT or self.stands_at(chunk, k) for k in between):
                leads_on = False
            if not leads_on or (before >= 0 and self._differ(chunk.context[before], chunk.context[row])):
                yield chunk.first + row
            before = row
        behind = range(before + 1, len(kinds)) if before >= 0 or self._leads_on else ()
        if before >= 0:
            self._leads_on = not self._exact(chunk.context[before])
        if any(kinds[k] != Kind.EVENT or self.stands_at(chunk, k) for k in behind):
            self._leads_on = False

    def _differ(self, one: int, other: int) -> bool:
        """Whether the spindle turns otherwise in another context: the axes rest in between."""
        if one == other:
            return False
        a, b = self.contexts[one], self.contexts[other]
        return (a.spindle, a.spindle_rpm, a.spindle_direction) != (
            b.spindle,
            b.spindle_rpm,
            b.spindle_direction,
        )

    def _threads(self, chunk: Chunk, kinds: bytes, radius: Callable[[int], float]) -> None:
        """A thread starts at the spindle's zero mark. A tap leads its spindle, whose angle is lost."""
        for row in _places(kinds, Kind.TAP) if self.angles else ():
            self._lose(chunk.first + row, chunk.context[row])
        for row, waits in self._before_thread.items():
            here = row - chunk.first
            number, at = chunk.context[here], chunk.curve[here] * CURVE_WIDTH
            context = self.contexts[number]
            rpm = self.rpm(context, radius(here))
            if rpm <= 0.0:
                continue
            angle = self._angle_of(context)
            start_deg = chunk.curves[at + 1] if at >= 0 else 0.0
            if context.surface_speed:
                self.step(Turns(row, angle, None))
            self.step(Mark(row, angle, (context.spindle_direction or 1) * rpm, start_deg, number, waits))
        self._before_thread.clear()

    def _exact_stops(self, chunk: Chunk, kinds: bytes) -> None:
        """The row behind an exact stop waits until the axes are within the window."""
        for row, (kind, number) in enumerate(zip(kinds, chunk.context, strict=True)):
            if self._overlaps(kind, number):
                self._settling = None
            self.settle(chunk.first + row)
            rapid = kind in (Kind.RAPID, Kind.REF)
            place = (number, list(chunk.end[row * chunk.axes : (row + 1) * chunk.axes]))
            still, self._place = place == self._place and kind in STRAIGHT, place
            if still or kind >= Kind.DWELL or not (self._exact(number) or (rapid and self.rapid_stops)):
                continue
            seconds = self._windows.get(self.contexts[number].stop_window, 0.0)
            if seconds > 0.0:
                self._settling = ("rapid_s" if rapid else "cutting_s", number, seconds)

    def _overlaps(self, kind: int, number: int) -> bool:
        """Whether a row begins before the axes rest behind the last one."""
        if self._settling is None or kind >= Kind.DWELL:
            return False
        why, before, _ = self._settling
        rapid = why == "rapid_s" and kind in (Kind.RAPID, Kind.REF)
        return self.contexts[number].begins_early(self.contexts[before], rapid=rapid)

    def _exact(self, number: int) -> bool:
        return self.contexts[number].stops


def _command(context: Context) -> tuple[object, ...]:
    """What a context asks of its spindle."""
    speed = context.surface_m_min if context.surface_speed else context.spindle_rpm
    return context.spindle_direction, context.surface_speed, speed


def _nobody(_step: Step) -> None:
    """Nobody follows what goes on beside the axes."""


def _places(kinds: bytes, kind: Kind) -> Iterator[int]:
    """Rows of a kind, in order."""
    at = kinds.find(kind)
    while at >= 0:
        yield at
        at = kinds.find(kind, at + 1)


def _moves(chunk: Chunk, first: int, last: int) -> bool:
    """Whether rows move an axis."""
    return any(kind < Kind.DWELL for kind in chunk.kind[first : last + 1])
