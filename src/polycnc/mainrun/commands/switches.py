"""Override switches, and the switches of the panel."""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun.commands.programs import forget_skipped
from polycnc.mainrun.commands.settings import SINGLE_BLOCK_KINDS
from polycnc.mainrun.commands.states import Command, Mode
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.execution.operation import Operation

#: Lowest and highest overrides, 1 for 100 % (Hartford manual, operator panel).
FEED_RANGE, RAPID_RANGE, SPINDLE_RANGE = (0.0, 2.0), (0.0, 1.0), (0.5, 1.2)
#: Switches that keep axes from moving.
LOCKS = ("machine_lock", "z_lock")


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
        for run in self._operation.runs:
            for axis in run.axes:
                axis.hand.revise(self._operation.clock.time)

    def set_switches(self, changes: dict[str, Any]) -> None:
        """Turn panel switches, by the names of `PanelSwitches`."""
        operation, panel = self._operation, self._switches.panel
        if "single_block" in changes:
            kind = changes["single_block"]
            changes["single_block"] = "SBL1" if kind is True else kind or ""
            if changes["single_block"] not in SINGLE_BLOCK_KINDS:
                allowed = listed(SINGLE_BLOCK_KINDS[1:])
                raise CommandRefused("mainrun.value", name="single_block", allowed=allowed, value=kind)
        if changes.get("drf") and not self._shifts_by_handwheel():
            raise CommandRefused("mainrun.value", name="drf", allowed="False", value=True)
        if changes.get("block_skip", panel.block_skip) != panel.block_skip:
            for run in operation.runs:
                forget_skipped(run.channel)
        locks = {lock: changes.get(lock, getattr(panel, lock)) for lock in LOCKS}
        if any(locks[lock] != getattr(panel, lock) for lock in LOCKS):
            self._permission.ask(Command.MACHINE_LOCK)
            if operation.runs.move_by_hand:
                raise CommandRefused("mainrun.moving")
        panel = self._switches.panel = replace(panel, **changes)
        self._lock()
        operation.set_rates()
        for run in operation.runs:
            run.machinery.optional_stop = panel.optional_stop
            run.machinery.mst_lock = panel.mst_lock
            run.execution.single_block = bool(panel.single_block)
            self._switches.apply_to(run.channel, typed=operation.program_mode is Mode.MDI)
        operation.runs.revise()
        operation.status.report("switch", **changes)

    def _shifts_by_handwheel(self) -> bool:
        """Whether the control lets a handwheel shift axes beside a program."""
        channel = self._operation.runs.first.channel
        speed, _ = channel.control.handwheel_offset(channel, 0)
        return bool(speed)

    def _lock(self) -> None:
        """Locked axes stand while the display runs on; when a lock ends, the display shows the axes again."""
        for run in self._operation.runs:
            released = self._switches.lock(run)
            if released:
                run.stand_at([released.get(i, value) for i, value in enumerate(run.machine_position)])
                self._operation.prepare(run)
