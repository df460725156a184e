"""The window of radius compensation as columns: taken apart for the kernel, put together behind it."""

from __future__ import annotations

from array import array
from itertools import pairwise

from polycnc.channel.moves.path import END_OF_BLOCK, Move
from polycnc.compensation.runs.compiled import lead
from polycnc.compensation.runs.kernels import Offset
from polycnc.compensation.step import Role, Step
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.offset import Corner
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.moves.path import Run
    from polycnc.compensation.plane import Plane
    from polycnc.geometry.arcs import Point

_KINDS = tuple(Kind)


class Window:
    """Steps that wait, with the moves of a run behind them.

    Args:
        plane: The plane of compensation.
        steps: The steps: `fits` says which may be given here.
        run: The moves.
        beside: How far the tool stands beside the start of the first step.

    Attributes:
        run: Moves of the steps and of the run; the rows of those that are passed on once `lead` has been called.
    """

    def __init__(self, plane: Plane, steps: Sequence[Step], run: Run, beside: Point) -> None:
        self._plane = plane
        self._steps = steps
        first = steps[0]
        axes = len(run.start)
        self._ends = array("d", [number for step in steps for number in step.move.end]) + run.ends
        self.run = run.behind([step.move for step in steps])
        count = len(self.run.kinds)
        self._vectors = array("d", bytes(16 * count))
        for i, step in enumerate(steps[:-1]):
            if step.corner is not None:
                self._vectors[2 * i], self._vectors[2 * i + 1] = step.corner.vectors[0]
        u, v = (plane.columns[axis] for axis in (plane.u, plane.v))
        policy, start = first.policy, plane.point(first.move.start)
        self._offset = Offset(
            axes, u, v, len(steps), first.distance, *first.shift, *start, *beside,
            policy.outer.intersection_limit_deg, policy.checks_direction,
        )  # fmt: skip

    def lead(self) -> int:
        """Read as many moves of the run as are ordinary; each passes on a row."""
        run = self.run
        ways = array("d", bytes(24 * len(run.kinds)))
        return lead()(self._offset, run.kinds, self._ends, ways, self._vectors, run.ends)

    def vector(self, i: int) -> Point:
        """The vector at the end of a move."""
        return self._vectors[2 * i], self._vectors[2 * i + 1]

    def steps(self, read: int, block: int) -> list[Step]:
        """The steps that wait when so many moves of the run have been read.

        Args:
            read: How many.
            block: Number of the block behind them.
        """
        count = len(self._steps)
        found = [self._step(i, block - count - read + i) for i in range(read, read + count)]
        for i, (step, following) in enumerate(pairwise(found), read):
            step.corner = Corner([self.vector(i)])
            step.lead_to(following)
        return found

    def _step(self, i: int, block: int) -> Step:
        if i < len(self._steps):
            return self._steps[i]
        run, template = self.run, self._steps[0]
        start, end = self._end(i - 1), self._end(i)
        move = Move(_KINDS[run.kinds[i]], start, end, run.feeds[i], run.program, run.lines[i], run.context)
        edge = offset.line(self._plane.point(start), self._plane.point(end))
        return Step(
            move, edge, edge, Role.CONTOUR, template.distance, template.shift, template.policy, block,
            self.vector(i - 1), template.side, after=[END_OF_BLOCK],
        )  # fmt: skip

    def _end(self, i: int) -> list[float]:
        axes = self._offset.axes
        return self._ends[i * axes : (i + 1) * axes].tolist()


def fits(steps: Sequence[Step], run: Run, block: int) -> bool:
    """Whether steps are ordinary ones, a block each, which the moves of a run follow.

    Args:
        steps: The window.
        run: The moves.
        block: Number of the block of the first move.
    """
    first = steps[0]
    policy = first.policy
    if policy.avoids or not len(steps) == policy.read_blocks - 1 > 1:
        return False
    if steps[-1].corner is not None or steps[-1].move.end != run.start:
        return False
    return all(
        _is_ordinary(step, first) and step.read == block - len(steps) + i and run.continues(step.move)
        for i, step in enumerate(steps)
    ) and all(
        one.move.end == two.move.start and one.corner is not None and len(one.corner.vectors) == 1
        for one, two in pairwise(steps)
    )


def _is_ordinary(step: Step, first: Step) -> bool:
    """Whether a step is a line of the contour, compensated as another one, and the program says no more of it."""
    return (
        step.role is Role.CONTOUR
        and step.move.kind in (Kind.FEED, Kind.RAPID)
        and step.move.turning is None
        and not step.move.parameters
        and (step.distance, step.shift, step.policy) == (first.distance, first.shift, first.policy)
        and step.after == [END_OF_BLOCK]
        and not (step.is_commanded or step.suspended or step.starts_square)
        and not (step.straight or step.is_chord or step.altered)
    )
