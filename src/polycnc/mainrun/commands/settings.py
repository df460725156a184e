"""What the operator has set: switches of the panel, overrides, locked axes."""

from __future__ import annotations

from math import inf

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.preparation.items import Rates
from polycnc.mainrun.reading.snapshot import PanelSwitches

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.interface import HandMotion
    from polycnc.machine.model import Axis
    from polycnc.machine.setup.values import Switches as SetupSwitches
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.toolpath.motion_settings import DryRun

#: Jog rate at a feed override of 100 %, mm/min or degrees/min (Hartford manual).
JOG_RATE = 1000.0
SINGLE_BLOCK_KINDS = ("", "SBL1", "SBL2", "SBL3")


class Switches:
    """What the operator has set.

    Args:
        start: Switches at power-on.

    Attributes:
        panel: Switches of the panel.
        dials: Where the override switches stand.
        rates: What acts on the speeds: these, feed hold, dry run.
        locked_at: Where locked axes stand, by channel and their column in it.
        tests: Number of a channel whose program is tested: its axes stand; 0 for none.
    """

    def __init__(self, start: SetupSwitches) -> None:
        self.panel = PanelSwitches(start.single_block, start.optional_stop, start.block_skip)
        self.dials, self.rates = Rates(), Rates()
        self.locked_at: dict[int, dict[int, float]] = {}
        self.tests = 0

    def jog_speed(self, axis: Axis) -> float:
        """Speed of an axis in jog, mm/s or degrees/s."""
        return min(JOG_RATE / 60.0 * self.dials.feed, axis.max_feed or inf)

    def hand_speed(
        self, run: ChannelRun, column: int, what: HandMotion = "axis", place: int = 0, *, rapid: bool
    ) -> float:
        """Speed of an axis by hand, mm/s or degrees/s: that of the control, or else of the machine panel.

        `what` and `place`: what it is while it moves, and which one, as `Control.hand_speed` has them.
        """
        axis, control = run.channel.axis_data[column], run.channel.control
        own: float | None = control.hand_speed(run.channel, column, what, place, rapid=rapid)
        if rapid:
            return min(own or inf, axis.rapid or 1e9) * self.rates.rapid
        if own is None:
            return self.jog_speed(axis)
        return min(own * self.dials.feed, axis.rapid or inf)

    def rapid_speed(self, axis: Axis) -> float:
        """Speed of an axis in rapid traverse, mm/s or degrees/s."""
        return (axis.rapid or 1e9) * self.rates.rapid

    def set_rates(self, *, feed_is_100: bool, rapid_held: bool, dry_run: DryRun | None) -> None:
        """The speeds follow the dials; a soft key of the machine holds the feed at 100 %."""
        dials, rates = self.dials, self.rates
        rates.feed_cancelled, rates.rapid_held = feed_is_100, rapid_held
        rates.feed = 1.0 if feed_is_100 else dials.feed
        rates.rapid, rates.spindle, rates.dry_run = dials.rapid, dials.spindle, dry_run

    def lock(self, run: ChannelRun) -> dict[int, float]:
        """Axes of a channel that are to be locked stand where they are; gives those that are locked no more."""
        position, before = run.machine_position, self.locked_at.get(run.number, {})
        z = run.channel.machine.geometry_indices(run.number)[2]
        panel = self.panel
        all_stand = panel.machine_lock or self.tests == run.number
        wanted = range(len(position)) if all_stand else [z] if panel.z_lock and z >= 0 else []
        self.locked_at[run.number] = {i: before.get(i, position[i]) for i in wanted}
        return {i: place for i, place in before.items() if i not in wanted}

    def apply_to(self, channel: Channel, *, typed: bool) -> None:
        """Let a channel prepare its blocks as the switches are; `typed`: its program runs in MDI."""
        panel, skip = self.panel, self.panel.block_skip
        switches = replace(
            channel.setup.switches,
            single_block=panel.single_block or SINGLE_BLOCK_KINDS[1],  # so that blocks are run one by one
            block_skip=skip,
            optional_stop=panel.optional_stop,
            mode="mdi" if typed else "memory",
        )
        channel.setup = replace(channel.setup, switches=switches)
        channel.skip_levels = switches.block_skip_mask(plain=1)
        channel.is_tested = self.tests == channel.number
        channel.control.expect_handwheel(channel, is_on=panel.drf)
        # Whether to halt is decided when the block is executed, not when it is prepared.
        channel.single_block = channel.block_by_block = channel.optional_stop = True
