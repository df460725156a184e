"""The steps of a program: those that are kept, by number, and several that stand in one line."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

Step: TypeAlias = Callable[["Channel"], None]
#: Programs with more steps keep only those that are there.
MANY_STEPS = 250_000


class FewSteps(dict[int, Step | None]):
    """The kept steps of a program so long that a place for each would fill the memory.

    Args:
        count: How many steps the program has.
    """

    def __init__(self, count: int) -> None:
        super().__init__()
        self._count = count

    def __len__(self) -> int:
        return self._count

    def __missing__(self, index: int) -> None:
        """A step that is not kept."""


KeptSteps: TypeAlias = list[Step | None] | FewSteps


def kept_steps(count: int) -> KeptSteps:
    """Room for the steps of a program; none is kept yet."""
    return FewSteps(count) if count > MANY_STEPS else [None] * count


def forget_steps(steps: KeptSteps) -> None:
    """Keep none any more."""
    if isinstance(steps, FewSteps):
        steps.clear()
    else:
        steps[:] = [None] * len(steps)


def several(steps: Sequence[Step]) -> Step:
    """The blocks of one line as one step: one after the other, up to one that leaves the line."""

    def run(channel: Channel) -> None:
        level, index = channel.level, channel.level.index
        for step in steps:
            step(channel)
            if channel.level is not level or level.index != index or channel.finished:
                return

    return run
