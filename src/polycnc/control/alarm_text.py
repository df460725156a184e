"""The texts of alarms: the catalogue of a control, and what one alarm says."""

from __future__ import annotations

import re
from importlib import resources
from typing import TYPE_CHECKING

from polycnc.messages import Catalogue, text
from polycnc.messages.catalogue import language

if TYPE_CHECKING:
    from polycnc.control.interface import Control
    from polycnc.messages import Alarm


def alarm_catalogue(*files: str) -> Catalogue:
    """The alarms of a control, as `folder/file`, and those of polycnc itself; of two texts the later one counts."""
    folder = resources.files("polycnc.control")
    return Catalogue(*map(folder.joinpath, ("alarms.toml", *files)))


def alarm_text(control: Control, alarm: Alarm, lang: str | None = None) -> str:
    """The control's own text of an alarm, with the hint on this very case if there is one."""
    catalogue = control.catalogue
    told = alarm.detail or (catalogue.text(alarm.code, lang, **alarm.args) if alarm.code in catalogue else "")
    hint = text(alarm.hint, lang, **alarm.args) if alarm.hint else ""
    return (": " if (lang or language()) == "en" else "：").join(filter(None, (told, hint)))


def alarm_key(control: Control, code: str | int) -> tuple[str, int | str]:
    """What two alarm codes of a control must share to be the same alarm: `33`, `"033"` and `"PS0033"` are one."""
    written = str(code).strip().upper()
    match = re.fullmatch(r"\D*?([A-Z]*)[-\s]*0*(\d+)", written)
    if match is None:
        return "", written
    series = control.alarm_series
    return "" if series is None else series.get(match[1], match[1]), int(match[2])
