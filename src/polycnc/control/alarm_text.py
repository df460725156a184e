"""The text of an alarm."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.messages import text

if TYPE_CHECKING:
    from polycnc.control.interface import Control
    from polycnc.messages import Alarm


def alarm_text(control: Control, alarm: Alarm, lang: str | None = None) -> str:
    """The control's own text of an alarm, with the hint on this very case if there is one."""
    catalogue = control.catalogue
    told = alarm.detail or (catalogue.text(alarm.code, lang, **alarm.args) if alarm.code in catalogue else "")
    hint = text(alarm.hint, lang, **alarm.args) if alarm.hint else ""
    return ": ".join(filter(None, (told, hint)))
