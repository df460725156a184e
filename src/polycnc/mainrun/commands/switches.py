"""Override switches, and the switches of the panel."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any

from polycnc.mainrun.commands.programs import forget_skipped
from polycnc.mainrun.commands.states import Command, Mode
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.preparation.items import Rates
from polycnc.mainrun.reading.snapshot import PanelSwitches
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.machine.model import Axis
    from polycnc.machine.setup.values import Switches as SetupSwitches
    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.execution.operation import Operation
    from polycnc.toolpath.motion_settings import DryRun

#: Lowest and highest overrides, 1 for 100 % (Hartford manual, operator panel).
FEED_RANGE, RAPID_RANGE, SPINDLE_RANGE = (0.0, 2.0), (0.0, 1.0), (0.5, 1.2)
#: Jog rate at a feed override of 100 %, mm/min or degrees/min (Hartford manual).
JOG_RATE = 1000.0
#: Switches that keep axes from moving.
LOCKS = ("machine_lock", "z_lock")
SINGLE_BLOCK_KINDS = ("", "SBL1", "SBL2", "SBL3")


class Switches:
    """What the operator has set.

    Args:
        start: Switches at power-on.

    Attributes:
        panel: Switches of the panel.
        dials: Where the override switches stand.
        rates: What acts on the speeds: these, feed hold, dry run.
        locked_at: Where locked axes stand, by their column in the first channel.
    """

    def __init__(self, start: SetupSwitches) -> None:
        self.panel = PanelSwitches(start.single_block, start.optional_stop, start.block_skip)
        self.dials, self.rates = Rates(), Rates()
        self.locked_at: dict[int, float] = {}

    def jog_speed(self, axis: Axis) -> float:
        """Speed of an axis in jog, mm/s or degrees/s."""
        return min(JOG_RATE / 60.0 * self.dials.feed, axis.max_feed or inf)

    def rapid_speed(self, axis: Axis) -> float:
        """Speed of an axis in rapid traverse, mm/s or degrees/s."""
        return (axis.rapid or 1e9) * self.rates.rapid

    def set_rates(self, *, feed_is_100: bool, dry_run: DryRun | None) -> None:
        """The speeds follow the dials; a soft key of the machine holds the feed at 100 %."""
        dials, rates = self.dials, self.rates
        rates.feed_cancelled = feed_is_100
        rates.feed = 1.0 if feed_is_100 else dials.feed
        rates.rapid, rates.spindle, rates.dry_run = dials.rapid, dials.spindle, dry_run

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
        # Whether to halt is decided when the block is executed, not when it is prepared.
        channel.single_block = channel.block_by_block = channel.optional_stop = True


class SwitchCommands:
    """Turns switches.

    Args:
        operation: The channels on which they act.
        permission: Asked where axes would be locked.
    """

    def __init__(self, operation: Operation, permission: Permission) -> None:
        self._operation = operation
        self._switches = operation.switches
        self._permission = permission

    def override(self, feed: float | None, rapid: float | None, spindle: float | None) -> None:
        """Turn the override switches."""
        new = {"feed": (feed, FEED_RANGE), "rapid": (rapid, RAPID_RANGE), "spindle": (spindle, SPINDLE_RANGE)}
        for name, (value, (low, high)) in new.items():
            if value is not None and not low <= value <= high:
                raise CommandRefused("mainrun.value", name=name, allowed=f"{low:g} … {high:g}", value=value)
        for name, (value, _) in new.items():
            if value is not None:
                setattr(self._switches.dials, name, float(value))
                self._operation.status.report("override", name=name, value=float(value))
        self._operation.set_rates()
        self._set_hand_speeds()

    def _set_hand_speeds(self) -> None:
        """Axes that are moved by hand go on with the new speeds."""
        operation, switches = self._operation, self._switches
        in_reference = operation.status.mode is Mode.REFERENCE
        speed = switches.rapid_speed if in_reference else switches.jog_speed
        for run in operation.runs:
            for axis in run.axes:
                axis.hand.change_speed(speed(axis.data), operation.clock.time)

    def set_switches(self, changes: dict[str, Any]) -> None:
        """Turn panel switches, by the names of `PanelSwitches`."""
        operation, panel = self._operation, self._switches.panel
        if "single_block" in changes:
            kind = changes["single_block"]
            changes["single_block"] = "SBL1" if kind is True else kind or ""
            if changes["single_block"] not in SINGLE_BLOCK_KINDS:
                allowed = listed(SINGLE_BLOCK_KINDS[1:])
                raise CommandRefused("mainrun.value", name="single_block", allowed=allowed, value=kind)
        if changes.get("block_skip", panel.block_skip) != panel.block_skip:
            for run in operation.runs:
                forget_skipped(run.channel)
        locks = {lock: changes.get(lock, getattr(panel, lock)) for lock in LOCKS}
        if any(locks[lock] != getattr(panel, lock) for lock in LOCKS):
            self._permission.ask(Command.MACHINE_LOCK)
            self._lock(locks)
        panel = self._switches.panel = replace(panel, **changes)
        operation.set_rates()
        for run in operation.runs:
            run.machinery.optional_stop = panel.optional_stop
            run.machinery.mst_lock = panel.mst_lock
            run.execution.single_block = bool(panel.single_block)
            self._switches.apply_to(run.channel, typed=operation.program_mode is Mode.MDI)
        operation.runs.revise()
        operation.status.report("switch", **changes)

    def _lock(self, locks: Mapping[str, bool]) -> None:
        """Locked axes stand while the display runs on; when a lock ends, the display shows the axes again."""
        operation, locked_at = self._operation, self._switches.locked_at
        if operation.runs.move_by_hand:
            raise CommandRefused("mainrun.moving")
        first = operation.runs.first
        position = first.machine_position
        z = operation.machine.geometry_indices(first.number)[2]
        wanted = set(range(len(position))) if locks["machine_lock"] else {z} if locks["z_lock"] else set()
        released = locked_at.keys() - wanted
        if released:
            first.stand_at([locked_at[i] if i in released else value for i, value in enumerate(position)])
            operation.prepare(first)
        self._switches.locked_at = {i: locked_at.get(i, position[i]) for i in wanted}
