"""Dry run feed, as setting data say (SD42100 and SD42101)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.motion_settings import DryFeed, DryRun

if TYPE_CHECKING:
    from polycnc.control.sinumerik.data.machine_data import MachineData

#: What the units digit of `$SC_DRY_RUN_FEED_MODE` says; with a tens digit threads and taps are run as programmed.
FEEDS = {0: DryFeed.LARGER, 1: DryFeed.SMALLER, 2: DryFeed.REPLACES}


def dry_run(data: MachineData) -> DryRun:
    """`$SC_DRY_RUN_FEED`, mm/min, and how it stands to the programmed feed; rapids stay as they are."""
    tens, units = divmod(data.integer("$SC_DRY_RUN_FEED_MODE"), 10)
    return DryRun(
        data.number("$SC_DRY_RUN_FEED") / 60.0, FEEDS.get(units, DryFeed.LARGER), with_spindle=not tens
    )
