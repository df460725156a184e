"""The interference check: vectors that have changed places are left out, led round, or an alarm (0i-TF Plus 5.4.6)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.compensation.avoidance import crosses, way_round
from polycnc.compensation.policies import Violation
from polycnc.compensation.step import Role
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Corner, Joint
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.path import Move
    from polycnc.compensation.step import Step


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
        violations: What the control objects to.
    """

    def __init__(self, window: list[Step], violations: Objections) -> None:
        self._window = window
        self.violations = violations

    def check(self, step: Step, following: Step) -> None:
        """Look for vectors that have changed places with those just found (FANUC 0i-TF Plus 5.4.6)."""
        policy, is_line = step.policy, step.edge.center is None
        if step.corner is None:
            return
        self._check_behind_avoidance(step)
        if len(self._window) < 2:
            return
        ends = step.corner.vectors
        for earlier in self._window[:-2] if policy.checks_direction and not policy.looks_far else ():
            if earlier.corner is None or earlier.forced is not None:
                continue
            if crosses(earlier.edge, earlier.corner.vectors[-1], step.edge, ends[0]):
                self.violations.object(Violation.INTERFERENCE, step.move)
        previous = self._window[-2]
        if previous.corner is None or previous.forced is not None:
            return
        if not (policy.checks_direction if is_line else policy.checks_arcs):
            return
        starts = previous.corner.vectors
        # Of several vectors those that cross are left out in pairs, the inmost first; the last must not cross.
        while offset.reverses(step.edge, starts[-1], ends[0]):
            is_last = len(starts) == 1 and len(ends) == 1
            if policy.looks_far and is_last:
                # Decided when the block in front is passed on.
                return
            if is_last or (policy.avoids and not policy.looks_far):
                self._avoid(previous, step, following)
                return
            if len(starts) > 1:
                starts.pop()
            if len(ends) > 1:
                ends.pop(0)
            step.first, step.straight = starts[-1], True

    def keep_clear(self) -> None:
        """Before a block is passed on: compare its end with those of the blocks read, the farthest first (5.4.6)."""
        first = self._window[0]
        if not first.policy.looks_far or first.corner is None or first.forced is not None:
            return
        numbers: list[int] = []
        for number in range(len(self._window) - 2, 0, -1):
            step = self._window[number]
            if step.corner is None or step.forced is not None or step.role is not Role.CONTOUR:
                continue
            vector, other = first.corner.vectors[-1], step.corner.vectors[0]
            if number > 1:
                found = step.policy.checks_direction and crosses(first.edge, vector, step.edge, other)
            else:
                is_line = step.edge.center is None
                checked = step.policy.checks_direction if is_line else step.policy.checks_arcs
                found = checked and offset.reverses(step.edge, vector, other)
            if found:
                numbers.append(number)
        # A way round that would cut gives way to one past fewer blocks.
        if numbers and not any(self._lead_round(number) for number in numbers):
            self._lead_round(numbers[0], dares=True)

    def _lead_round(self, number: int, *, dares: bool = False) -> bool:
        """Replace the blocks between the first one of the window and the one behind `number` (5.4.6.3).

        False where there is no way, or a dangerous one; with `dares` these are alarms, as far as the control has them.
        """
        first, last, following = self._window[0], self._window[number], self._window[number + 1]
        if number == 1 and _meets_joint(first, last):
            return True
        way, between = None, self._window[1 : number + 1]
        if first.role is following.role is Role.CONTOUR:
            edges = [step.edge for step in between]
            way = way_round(first.edge, first.first, edges, following.edge, last.distance)
        if not dares and (way is None or way.is_dangerous):
            return False
        if way is None:
            self.violations.object(Violation.NO_AVOIDANCE, last.move)
            return True
        if way.is_dangerous and not first.policy.dares:
            self.violations.object(Violation.AVOIDANCE_DANGEROUS, last.move)
        first.corner = Corner([way.leaving])
        del self._window[1 : number + 1]
        for step in between[:-1] if way.arriving is not None else between:
            first.after.extend(step.after)
        behind = first
        if way.arriving is not None:
            move = replace(
                last.move, kind=Kind.FEED, start=first.move.end, center=None, turns=0.0, parameters=()
            )
            edge = offset.line(first.edge.end, last.edge.end)
            behind = replace(last, move=move, edge=edge, first=way.leaving, corner=Corner([way.arriving]))
            self._window.insert(1, behind)
        behind.lead_to(following)
        following.behind_avoidance = True
        self._check_behind_avoidance(following)
        return True

    def _check_behind_avoidance(self, step: Step) -> None:
        """The block behind an avoidance must not run backwards itself."""
        if not step.behind_avoidance or step.corner is None or step.policy.dares:
            return
        if offset.reverses(step.edge, step.first, step.corner.vectors[0]):
            self.violations.object(Violation.AVOIDANCE_INTERFERES, step.move)

    def _avoid(self, previous: Step, step: Step, following: Step) -> None:
        """Leave a move out: the one in front runs on to the one that follows (FANUC 0i-TF Plus 5.4.6.3)."""
        if not step.policy.avoids:
            self.violations.object(Violation.INTERFERENCE, step.move)
            return
        dares = step.policy.dares
        if previous.avoided and not dares:
            self.violations.object(Violation.AVOIDANCE_INTERFERES, step.move)
        if _meets_joint(previous, step):
            return
        before, beyond = previous.edge, following.edge
        point = None
        if previous.role is following.role is Role.CONTOUR:
            point = offset.meet(before, beyond, step.distance, step.distance)
        if point is None:
            self.violations.object(Violation.NO_AVOIDANCE, step.move)
            return
        vector = (point[0] - before.end[0], point[1] - before.end[1])
        leads_back = offset.reverses(before, previous.first, vector)
        if not dares and (leads_back or offset.is_outer(before, beyond, step.distance)):
            self.violations.object(Violation.AVOIDANCE_DANGEROUS, step.move)
        previous.corner, previous.avoided = Corner([vector]), True
        previous.after.extend(step.after)
        self._window.remove(step)


def _meets_joint(previous: Step, step: Step) -> bool:
    """Let the move in front run on to the arc about the corner behind a step too short for the tool."""
    if step.corner is None or step.corner.joint is not Joint.ARC:
        return False
    about, distance = step.edge.end, step.distance
    first, last = (arcs.plus(about, vector) for vector in (step.corner.vectors[0], step.corner.vectors[-1]))
    joint = offset.arc(first, last, about, distance < 0.0)
    point = offset.meet(previous.edge, joint, distance, 0.0)
    if point is None or not arcs.contains_direction(first, last, about, joint.ccw, point):
        return False
    previous.corner = Corner([arcs.minus(point, previous.edge.end)])
    step.first = arcs.minus(point, step.edge.start)
    step.corner.vectors[0] = arcs.minus(point, about)
    return True
