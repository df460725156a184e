"""Mistakes by name and the MELDAS alarms for them.

The Hartford manual prints the numbers 23, 34 and 36 for both of its controls; where it names none, the number is that
of the FANUC alarm, so that every mistake has one.
"""

from __future__ import annotations

from polycnc.control.fanuc.alarm_codes import ALARMS as FANUC_ALARMS

ALARMS: dict[str, str] = {
    **FANUC_ALARMS,
    "arc_end": "P70",
    "comp_interference": "P153",
}
