"""What effects of actions know and leave behind while a cycle of the main run is looked at."""

from __future__ import annotations

from polycnc.channel.interpolator import Influence
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.interpolator import Interpolator
    from polycnc.control.sinumerik.actions.action import Action
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel


@dataclass(slots=True)
class Deleted(State, lifetime=Lifetime.RESET):
    """Distances that DELDTG has dropped: of the path, and of axes by their columns; mm or degrees."""

    path: float = 0.0
    axes: dict[int, float] = field(default_factory=dict)


class Running:
    """The channel while its actions run.

    Args:
        channel: The channel.

    Attributes:
        influence: What the actions of this cycle make of the speeds.
        changed: Something is other than before the cycle.
        releases: Preparation need not wait any more for the end of the block (STOPREOF).
        started: Columns of axes that the running line has started.
        at_once: Whether all lines of the technology cycle that runs come in one interpolation cycle.
        action: The action that is looked at.
        targets: Where axes shall go when its effects are through, by column; `directions` those without end, `speeds`
            axes with a new feed.
        endless: Actions whose MOV moves an axis, by its column.
        coordinate: Locks, unlocks and resets actions: word and numbers.
    """

    coordinate: Callable[[str, Arguments], None]
    action: Action

    def __init__(self, channel: SinumerikChannel) -> None:
        self.channel = channel
        self.influence = Influence()
        self.changed = False
        self.releases = False
        self.started: set[int] = set()
        self.at_once = False
        self._kept = channel.mode
        self.targets: dict[int, float] = {}
        self.directions: dict[int, int] = {}
        self.speeds: set[int] = set()
        self.endless: dict[int, Action] = {}

    @property
    def clocked(self) -> Interpolator:
        """The main run."""
        return self.channel.on_clock()

    def begin(self, action: Action, modal: Mapping[str, str]) -> None:
        """An action is looked at: in its own measuring system, or in that of the block in execution; so with diameters.

        `modal` are the codes of that block, by their groups; none before the first one.
        """
        self.action, self._kept = action, self.channel.mode
        if self.channel.memory.transverse >= 0:
            self._use("diameter", modal.get("diameter", ""))
        self.use_unit(action.code.unit or modal.get("unit", ""))

    def use_unit(self, code: str) -> None:
        """`G70` … hold for what follows in this action; empty for those of the program."""
        self._use("unit", code)

    def _use(self, group: str, code: str) -> None:
        mode = self.channel.mode
        if code and mode[group] != code:
            self.channel.mode = mode.with_code(group, code)

    def end(self) -> None:
        """The action has been looked at: what is prepared goes on as it was; what an alarm has left does not act."""
        self.channel.mode = self._kept
        self.targets.clear()
        self.directions.clear()
        self.speeds.clear()

    @property
    def unit(self) -> str:
        """Measuring system of the action."""
        return self.channel.mode["unit"]

    def finish(self) -> None:
        """The effects of an action are through: its axes start."""
        if not (self.targets or self.directions or self.speeds):
            return
        clocked, axes = self.clocked, ActionAxes.of(self.channel)
        for column in self.speeds - self.targets.keys() - self.directions.keys():
            clocked.commanded(column).change_speed(action_axes.speed_of(self.channel, column))
        for column, target in self.targets.items():
            clocked.commanded(column).move_to(target, action_axes.speed_of(self.channel, column))
        for column, direction in self.directions.items():
            self._run_on(column, direction)
        for column in self.targets:
            self.endless.pop(column, None)
        self.action.endless -= self.targets.keys()
        self.action.endless |= {column for column, direction in self.directions.items() if direction}
        for column in (*self.targets, *self.directions):
            axes.states[column] = action_axes.COMMANDED
            self.started.add(column)
            self.action.axes.add(column)
            clocked.move_static(column, static=self.action.is_static)
        self.targets.clear()
        self.directions.clear()
        self.speeds.clear()

    def _run_on(self, column: int, direction: int) -> None:
        """MOV: an axis goes on to the end of its travel, if it has one; 0 brakes it."""
        self.endless.pop(column, None)
        end = None
        if direction:
            self.endless[column] = self.action
            end = action_axes.end_of_travel(self.channel, column, direction)
            if direction * (end - self.clocked.machine(column)) <= NO_WAY:
                direction = 0
        speed = action_axes.speed_of(self.channel, column)
        self.clocked.commanded(column).run_on(direction, speed, end)

    def axis_moves(self, column: int) -> bool:
        """Whether a commanded axis is under way."""
        return self.clocked.commanded(column).moves
