"""The law of a course as phases, without numpy: room for the kernels, and their turn."""

from __future__ import annotations

from array import array
from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.motion.third_order.laws.compiled import kernels
from polycnc.motion.third_order.laws.courses import (
    BATCH,
    Course,
    Ends,
    Force,
    Known,
    Nodes,
    Phase,
    Shape,
    Stencil,
    Work,
)
from polycnc.motion.third_order.laws.newton import BANDS
from polycnc.motion.third_order.laws.phases import PAIR

if TYPE_CHECKING:
    from polycnc.kernels.layout import Floats
    from polycnc.motion.third_order.laws.courses import Axes

#: Room for nodes at first, by the places of the estimate and besides.
PER_PLACE, BESIDES = 1, 256
#: No array of a law is larger, bytes.
LARGEST = 1 << 23
#: Where a law begins by itself.
NONE = Known(array("d"), array("d"), array("d"), array("d"))


class NoLawError(ValueError):
    """From the given state the end cannot be reached within the limits."""


def course_of(way: Floats, first: Floats, second: Floats, cap2: Floats, ease: Floats) -> Course:
    """A bent path with room for its estimate."""
    m, n = len(cap2), len(first) // len(way)
    return Course(way, first, second, cap2, ease, numbers(m * n), numbers(m), numbers(m + 1))


class Found(NamedTuple):
    """A law: its phases, see `Phase`, some of which last no time, `PAIR` from each node to the next; and its nodes."""

    phases: array[float]
    nodes: Known


class Room:
    """Arrays in which laws are found, one after another: new memory costs as much as several steps of a law.

    What one has leaves to the next one when it is no longer used: the runs of a program are many, and some are short.
    """

    _left: ClassVar[list[dict[str, tuple[array[float], ...]]]] = []

    def __init__(self) -> None:
        _keep_memory()
        self._arrays = self._left.pop() if self._left else {}

    def __del__(self) -> None:
        if not self._left:
            self._left.append(self._arrays)

    def numbers(self, use: str, count: int, *sizes: int) -> tuple[array[float], ...]:
        """Arrays for a use, each so many times `count` numbers at least; they are what the law before has left."""
        found = self._arrays.get(use)
        if found is None or len(found[0]) < count * sizes[0]:
            found = self._arrays[use] = tuple(numbers(count * size) for size in sizes)
        return found


def quickest(
    course: Course, axes: Axes, ends: array[float], known: Known = NONE, room: Room | None = None
) -> Found | None:
    """The quickest law along a path.

    Args:
        course: The path; the caps of its speed become those of the axes, too.
        axes: Limits.
        ends: Speed and acceleration at both ends, see `Ends`.
        known: The first nodes, where the law goes on with another one; the first of them lies at the start.
        room: Where it is found; room of its own without.

    Returns:
        None where there is none within the limits from a motion, or to one.
    """
    given, n = room or Room(), len(axes.jerk)
    count = 3 * len(course.cap2) + 2
    places, squares, gaps, seconds = given.numbers("places", count, 1, 1, 1, 1)
    (way,) = given.numbers("ways", PER_PLACE * count + BESIDES, 1)
    count = kernels().place_nodes(course, axes, ends, places, squares, gaps, seconds, way)
    if count > len(way):
        (way,) = given.numbers("ways", count, 1)
        count = kernels().place_nodes(course, axes, ends, places, squares, gaps, seconds, way)
    if _rests_at_once(ends[Ends.START_SPEED], ends[Ends.START_PULL], way[1] - way[0]) or _rests_at_once(
        ends[Ends.END_SPEED], -ends[Ends.END_PULL], way[count - 1] - way[count - 2]
    ):
        return None
    if known.way:
        merged = numbers(len(known.way) + count)
        count, way = kernels().merge(known.way, way, count, merged), merged
    shape, stencil, most, bands = given.numbers(
        f"nodes of {n} axes", count, n * Shape.SIZE, Stencil.SIZE, 3 * PAIR, BANDS
    )
    moves, forces = given.numbers(f"{n} axes", 1, n, Force.SIZE * BATCH)
    nodes = Nodes(way[:count], numbers(count), numbers(count), numbers(count), shape, stencil)
    phases, work = numbers(PAIR * (count - 1) * Phase.SIZE), Work(moves, bands, forces)
    rounds = kernels().find_law(course, axes, ends, places, squares, nodes, known, work, phases, most)
    if rounds < 0:
        return None
    return Found(phases, Known(nodes.way, nodes.x, nodes.cap2, nodes.room))


def _rests_at_once(speed: float, pull: float, way: float) -> bool:
    """Whether a motion is at rest before the middle of the way to the next node: there is no law between the two."""
    return speed > 0.0 and speed * speed + 0.5 * pull * way <= 0.0


@cache
def _keep_memory() -> None:
    """Have the C library keep memory that is freed, for what is asked for next.

    That of Linux gets large blocks from the system and gives them back, page by page, which takes as long as all else
    that is done for a law in Python. It does so with blocks larger than the largest one so far that was given back
    (`man mallopt`, M_MMAP_THRESHOLD): here one that nobody has written to. Other systems do not mind.
    """
    bytes(LARGEST)


def numbers(count: int) -> array[float]:
    """Room for so many numbers."""
    return array("d", (0.0,)) * count
