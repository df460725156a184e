"""One synchronised action in the main run: when it acts (10.1.2)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.actions.cycles import RunningCycle
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.language.sinumerik.actions.code import Acting, ActionCode, Frozen

_NOTHING: list[Any] = []


@dataclass(slots=True, eq=False)
class Action:
    """A synchronised action.

    Attributes:
        code: What its block says.
        number: ID; None for one that belongs to a block.
        frozen: Values that were worked out where its block was prepared.
        has_held: The condition held at the last look (EVERY), or has held once (FROM).
        is_done: It never acts again: a WHEN that has acted, or one that has raised an alarm.
        is_locked: LOCK.
        cycles: Technology cycles that it runs now, the first one in front.
        axes: Columns of axes that it has commanded; `endless` those that it has sent off without end.
        offsets: What it has brought into wear so far (FTOC), mm, by length, channel and spindle.
    """

    code: ActionCode
    number: int | None
    frozen: Frozen
    has_held: bool = False
    is_done: bool = False
    is_locked: bool = False
    cycles: list[RunningCycle] = field(default_factory=list)
    axes: set[int] = field(default_factory=set)
    endless: set[int] = field(default_factory=set)
    offsets: dict[Arguments, float] = field(default_factory=dict)

    @property
    def is_static(self) -> bool:
        """Whether it outlives the program (IDS)."""
        return self.code.word == "IDS"

    def acts(self, channel: Channel[Any, Any, Any], acting: Acting) -> bool:
        """Whether it acts in this cycle."""
        keyword, condition = self.code.keyword, self.code.condition
        if condition is None or (keyword == "FROM" and self.has_held):
            return True
        holds = bool(condition(channel, self.frozen, _NOTHING, acting))
        if keyword == "EVERY":
            rises, self.has_held = holds and not self.has_held, holds
            return rises
        if keyword == "FROM":
            self.has_held = holds
        elif keyword == "WHEN":
            self.is_done = holds
        return holds

    def restart(self) -> None:
        """Its technology cycle is broken off; a condition counts as not held (RESET)."""
        self.cycles.clear()
        self.has_held = False
