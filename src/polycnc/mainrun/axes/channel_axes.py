"""The axes of a channel, in its order: positions of all of them at once."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.mainrun.axes.about_tip import AboutTip
    from polycnc.mainrun.axes.along_line import AlongLine
    from polycnc.mainrun.axes.axis import Axis
    from polycnc.mainrun.execution.clock import Clock


class ChannelAxes:
    """What lies between the path of a channel and its axes.

    Positions are of all axes of the channel, mm (radius) and degrees. Of the path: where the program has led the axes.

    Args:
        axes: The axes.
        clock: The time.

    Attributes:
        by_hand: An operator has had the axes since a program led them.
        led: What leads axes that go together by hand, about the tip or along a line, which displays show from then on;
            None before.
    """

    def __init__(self, axes: Sequence[Axis], clock: Clock) -> None:
        self._axes = tuple(axes)
        self._clock = clock
        self.by_hand = False
        self.led: AboutTip | AlongLine | None = None

    def __getitem__(self, column: int) -> Axis:
        return self._axes[column]

    def __iter__(self) -> Iterator[Axis]:
        return iter(self._axes)

    # ---- positions -----------------------------------------------------------------------------------------

    def setpoints(self, path: Sequence[float]) -> list[float]:
        """Where the axes shall be now: the sums of their sources."""
        time = self._clock.time
        return [place + axis.beside(time) for place, axis in zip(path, self._axes, strict=True)]

    def without_hand(self, path: Sequence[float]) -> list[float]:
        """Where they would be if no operator moved them."""
        time = self._clock.time
        return [
            place + axis.uncounted(time) + axis.counted(time)
            for place, axis in zip(path, self._axes, strict=True)
        ]

    def counted(self, path: Sequence[float]) -> list[float]:
        """What the coordinates know when the path is here."""
        time = self._clock.time
        return [place + axis.counted(time) for place, axis in zip(path, self._axes, strict=True)]

    def commanded(self) -> list[float]:
        """How far commands have each axis from its path."""
        return [axis.commanded(self._clock.time) for axis in self._axes]

    def rebase(self) -> None:
        """The axes stand, and the path has them where they stand, but for what coordinates do not know of."""
        for axis in self._axes:
            axis.rebase()

    def uncounted(self) -> list[float]:
        """What lies between that and the axes."""
        return [axis.uncounted(self._clock.time) for axis in self._axes]

    def path_at(self, position: Sequence[float]) -> list[float]:
        """Where the path is when the axes are here, and nothing of them counts."""
        return [place - way for place, way in zip(position, self.uncounted(), strict=True)]

    # ---- events --------------------------------------------------------------------------------------------

    @property
    def due(self) -> float:
        """When something happens to an axis beside its path; inf where nothing will."""
        return min(axis.due for axis in self._axes)

    def arrive(self, time: float) -> None:
        """What is due happens."""
        for axis in self._axes:
            axis.arrive(time)

    # ---- by hand -------------------------------------------------------------------------------------------

    @property
    def move_by_hand(self) -> bool:
        """Whether an operator moves one."""
        return any(axis.hand.moves for axis in self._axes)

    @property
    def shall_move_by_hand(self) -> bool:
        """Whether one is not yet where an operator wants it."""
        return any(axis.hand.has_goal for axis in self._axes)

    def take_in_hand(self, place: Sequence[float], path: Sequence[float]) -> None:
        """An operator has the axes from now on, which stand at a place while the path is elsewhere, or there too."""
        if not self.by_hand:
            self.by_hand = True
            for axis, here, base in zip(self._axes, place, self.without_hand(path), strict=True):
                axis.hand.stand(here, base)

    def settle(self) -> None:
        """Axes that led others stand: those are where they have followed them."""
        if self.led is not None:
            self.led.leads = False
        for axis in self._axes:
            axis.hand.settle(self._clock.time)

    def forget_shift(self, column: int) -> None:
        """An axis that stays where it is returns to its reference point: its shift ends."""
        axis = self._axes[column]
        axis.hand.rebase(-axis.offset.shift)
        axis.offset.shift = 0.0

    def leave(self) -> None:
        """The axes belong to a program again."""
        self.by_hand, self.led = False, None
        for axis in self._axes:
            axis.hand.stand(0.0, 0.0)

    def brake_hands(self) -> None:
        """Axes that are moved by hand come to rest."""
        for axis in self._axes:
            axis.hand.brake(self._clock.time)

    def hand_speed(self) -> float:
        """The fastest one, mm/s or degrees/s."""
        return max(abs(axis.hand.speed(self._clock.time)) for axis in self._axes)

    # ---- manual offset -------------------------------------------------------------------------------------

    @property
    def have_offset(self) -> bool:
        """Whether one is beside its path because it was moved by hand."""
        return any(axis.offset.pending or axis.offset.shift for axis in self._axes)

    @property
    def have_pending(self) -> bool:
        """Whether something is to be taken back."""
        return any(axis.offset.pending for axis in self._axes)

    def moved(self, way: Sequence[float], *, absolute: bool) -> None:
        """An operator has moved them by this way, with manual absolute on or off."""
        for axis, value in zip(self._axes, way, strict=True):
            if abs(value) > NO_WAY and absolute:
                axis.offset.pending += value
            elif abs(value) > NO_WAY:
                axis.offset.shift += value

    def is_pending(self, mask: int) -> bool:
        """Whether something of these axes, a bit mask, is to be taken back."""
        return any(axis.offset.pending and mask >> column & 1 for column, axis in enumerate(self._axes))

    def take_back(self, mask: int) -> list[float]:
        """What is to be taken back of these axes, a bit mask; it is no more."""
        taken = [0.0] * len(self._axes)
        for column, axis in enumerate(self._axes):
            if mask >> column & 1:
                taken[column], axis.offset.pending = axis.offset.pending, 0.0
        return taken
