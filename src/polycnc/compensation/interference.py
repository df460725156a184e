"""The interference check: vectors that have changed places are left out, led round, or an alarm (0i-TF Plus 5.4.6)."""

from __future__ import annotations

from collections import deque
from itertools import pairwise
from math import pi

from polycnc.compensation.avoidance import (
    PATHS,
    Detour,
    crosses,
    cuts,
    detours,
    least_harmful,
    leave_out_crossing_vectors,
)
from polycnc.compensation.policy import Violation
from polycnc.compensation.step import Role
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Corner
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.channel.moves.path import Move
    from polycnc.compensation.rows import RowWriter
    from polycnc.compensation.step import Step
    from polycnc.geometry.arcs import Point

#: Steps passed on that a detour must still keep off.
_REMEMBERED = 16


class Objections:
    """What a control objects to: its alarm code for each violation that it checks; one without a code is let pass."""

    def __init__(self, codes: Mapping[Violation, str]) -> None:
        self._codes = codes

    def __contains__(self, violation: Violation) -> bool:
        return violation in self._codes

    def object(self, violation: Violation, move: Move) -> None:
        """Raise the control's alarm at the line of a move, unless the control does not check this."""
        code = self._codes.get(violation)
        if code is not None:
            raise AlarmError(code, line=move.line, program=move.program)


class InterferenceCheck:
    """The check of the steps in a window.

    Args:
        window: The steps that are not passed on yet, in order; avoidance leaves steps out of it.
        rows: Where the steps go.
        violations: What the control objects to.
        release_before: Passes on the steps in front of one, which an alarm does not concern.
    """

    def __init__(
        self,
        window: list[Step],
        rows: RowWriter,
        violations: Objections,
        release_before: Callable[[Step], None],
    ) -> None:
        self._window = window
        self._rows = rows
        self._passed: deque[Step] = deque(maxlen=_REMEMBERED)
        self.violations = violations
        self._release_before = release_before

    def forget(self) -> None:
        """Compensation is over: what was passed on does not matter any more."""
        self._passed.clear()

    # ---- when a corner has been closed ---------------------------------------------------------------------

    def check(self, step: Step) -> None:
        """Look for vectors that have changed places with those just found (FANUC 0i-TF Plus 5.4.6)."""
        if step.corner is None or step.policy.avoids:
            # Ways round are chosen when the block in front is passed on: then most is known.
            return
        self._check_far_pairs(step, step.corner.vectors[0])
        previous = self._window[-2] if len(self._window) > 1 else None
        if (
            previous is None
            or previous.corner is None
            or previous.forced is not None
            or not _is_checked(step)
        ):
            return
        if not leave_out_crossing_vectors(previous, step):
            self._refuse(step, previous)

    def _check_far_pairs(self, step: Step, vector: Point) -> None:
        if not step.policy.checks_direction:
            return
        for earlier in self._window[:-2]:
            if earlier.corner is None or earlier.forced is not None:
                continue
            if crosses(earlier.edge, earlier.corner.vectors[-1], step.edge, vector):
                self._refuse(step, earlier)

    def _refuse(self, step: Step, other: Step) -> None:
        """The alarm: the tool stops at the start of the other block (5.4.6.2)."""
        if Violation.INTERFERENCE in self.violations:
            self._release_before(other)
        self.violations.object(Violation.INTERFERENCE, step.move)

    # ---- before a block is passed on -----------------------------------------------------------------------

    def keep_clear(self) -> None:
        """Compare the end of the first block with those of the blocks read, the farthest first (5.4.6)."""
        first = self._window[0]
        if not first.policy.avoids or first.corner is None or first.is_commanded:
            return
        bent = self._bent()
        numbers = [
            number
            for number in range(len(self._window) - 2, 0, -1)
            if self._interferes(number) or (number + 1 >= bent and self._cut_each_other(number + 1))
        ]
        only_rounding = not numbers and self._runs_back_by_rounding()
        if only_rounding:
            numbers = [1]
        if not numbers:
            return
        last = self._window[numbers[0]]
        # A way round that would do harm gives way to one past fewer blocks.
        every = (detour for number in numbers for detour in detours(self._window, number))
        found = least_harmful(every, self._known(first))
        if only_rounding and (found is None or found[1] is not None):
            return
        if found is None:
            self.violations.object(Violation.NO_AVOIDANCE, last.move)
            return
        detour, harm = found
        if harm is Violation.AVOIDANCE_DANGEROUS and not first.policy.dares:
            self.violations.object(harm, last.move)
        self._take(detour)

    def leave_out(self, before: Step, steps: Sequence[Step], following: Step, point: Point) -> None:
        """Leave out the last steps of the window, where the way by a point past them does no harm."""
        corner = Corner([arcs.minus(point, before.edge.end)])
        one, two = replace(before, corner=corner, altered=True), replace(following, altered=True)
        one.lead_to(two)
        if Detour(one, [], two, steps).harm(self._known(before)) is None:
            before.corner, before.altered, following.altered = corner, True, True
            self._pass_over(before, steps)
            self._passed.extend(steps)
            del self._window[-len(steps) :]

    def _take(self, detour: Detour) -> None:
        self._pass_over(detour.first, detour.left_out)
        self._passed.extend(detour.replaced)
        self._window[: len(detour.replaced) + 2] = [detour.first, *detour.between, detour.following]

    def _pass_over(self, step: Step, left_out: Sequence[Step]) -> None:
        """What came after the steps left out comes after the one in front of them."""
        for other in left_out:
            step.after.append(other)
            step.after.extend(other.after)

    def admit(self, step: Step) -> None:
        """A step is about to be passed on: one that a detour has changed, or one behind it, must do no harm."""
        policy = step.policy
        if not policy.avoids:
            return
        changed = step.altered or any(other.altered for other in self._passed)
        if changed and not (policy.dares or step.is_commanded):
            if step.role is Role.CONTOUR and not step.straight and step.runs_back:
                self.violations.object(Violation.AVOIDANCE_INTERFERES, step.move)
            if step.role in PATHS and cuts(step, self._known(step)):
                self.violations.object(Violation.AVOIDANCE_DANGEROUS, step.move)
        self._passed.append(step)

    def _known(self, step: Step) -> list[Step]:
        """The steps passed on last and those read, as far as the tool is on their side."""
        return [other for other in (*self._passed, *self._window) if other.distance * step.distance > 0.0]

    # ---- what interferes with the first block of the window ------------------------------------------------

    def _bent(self) -> int:
        """The first block behind turns of 90 degrees in all: only from there on can the tool come near the first again.

        The window's length where there is none.
        """
        total = self._window[0].contour.sweep
        for number, (one, two) in enumerate(pairwise(self._window), 1):
            total += abs(offset.turn(one.edge, two.edge)) + two.contour.sweep
            if total >= 0.5 * pi:
                return number
        return len(self._window)

    def _cut_each_other(self, number: int) -> bool:
        """Whether the tool cuts one of two blocks on the way along the other, though no vectors cross."""
        first, step = self._window[0], self._window[number]
        one_side = first.distance * step.distance > 0.0
        if first.role not in PATHS or step.role is not Role.CONTOUR:
            return False
        if not (one_side and step.policy.checks_direction):
            return False
        if cuts(first, [step]):
            return True
        # A way that is to be changed itself, when its turn comes, says nothing.
        between = self._window[1 : number + 2]
        if step.corner is None or any(other.is_commanded or other.runs_back for other in between):
            return False
        return cuts(step, [first])

    def _runs_back_by_rounding(self) -> bool:
        """Whether the block behind the first runs back by so little that it need not be led round."""
        if len(self._window) < 3:
            return False
        step = self._window[1]
        checked = step.role is Role.CONTOUR and not step.is_commanded and _is_checked(step)
        return checked and step.runs_back_by(offset.BRIDGED_MM)

    def _interferes(self, number: int) -> bool:
        first, step = self._window[0], self._window[number]
        if step.corner is None or step.is_commanded or step.role is not Role.CONTOUR:
            return False
        if number == 1:
            return _is_checked(step) and step.runs_back
        if first.distance * step.distance <= 0.0:
            return False
        vector = first.corner.vectors[-1] if first.corner else step.first
        return step.policy.checks_direction and crosses(first.edge, vector, step.edge, step.corner.vectors[0])


def _is_checked(step: Step) -> bool:
    """Whether the control looks at the direction of a step between two others."""
    return step.policy.checks_direction if step.edge.center is None else step.policy.checks_arcs
