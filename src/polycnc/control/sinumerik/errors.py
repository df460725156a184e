"""Alarms that several modules of the control raise."""

from __future__ import annotations

from polycnc.messages import AlarmError


def not_supported(what: str) -> AlarmError:
    """PC0001: a function of the control that polycnc knows and does not execute yet."""
    return AlarmError("PC0001", address=what, hint="hint.not-supported", code=what)
