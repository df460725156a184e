"""The catalogues of alarms: of a control, and of a control with a machine; and which codes mean the same alarm."""

from __future__ import annotations

import re

from polycnc.deferred.paths import package_path
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import Catalogue

if TYPE_CHECKING:
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine


def alarm_catalogue(*files: str) -> Catalogue:
    """The alarms of a control, as `folder/file`, and those of polycnc itself; of two texts the later one counts."""
    return Catalogue(*(package_path("control", file) for file in ("alarms.toml", *files)))


def catalogue_of(control: Control, machine: Machine) -> Catalogue:
    """What can be told on a control with a machine: the control's alarms, and under their own numbers the machine's."""
    return control.catalogue.extended(
        *machine.builder.texts(control.id), entries=_own_texts(control.id, machine)
    )


def _own_texts(control: str, machine: Machine) -> dict[str, dict[str, str]]:
    """The texts that stand with the alarms of a machine file; a text in one language serves for both."""
    entries: dict[str, dict[str, str]] = {}
    for row in machine.plc(control).alarms:
        if row.text.en and row.code not in entries:
            entry = {"en": row.text.en, "zh-TW": row.text.zh_tw or row.text.en}
            for note, told in (("cause", row.cause), ("remedy", row.remedy)):
                if told.en:
                    entry |= {note: told.en, f"{note}-zh-TW": told.zh_tw or told.en}
            entries[row.code] = {
                key: value.replace("{", "{{").replace("}", "}}") for key, value in entry.items()
            }
    return entries


def alarm_key(control: Control, code: str | int) -> tuple[str, int | str]:
    """What two alarm codes of a control must share to be the same alarm: `33`, `"033"` and `"PS0033"` are one."""
    written = str(code).strip().upper()
    match = re.fullmatch(r"\D*?([A-Z]*)[-\s]*0*(\d+)", written)
    if match is None:
        return "", written
    series = control.alarm_series
    return "" if series is None else series.get(match[1], match[1]), int(match[2])
