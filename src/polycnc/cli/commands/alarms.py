"""`polycnc alarms`: what an alarm of a control means, or the list of all."""

from __future__ import annotations

import json
from enum import StrEnum
from itertools import chain

from polycnc.cli import options
from polycnc.cli.console import fail, say
from polycnc.cli.declaration import Argument, Commands, Option
from polycnc.deferred.typing import TYPE_CHECKING, Annotated, Literal
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

commands = Commands()

#: What the catalogue may tell about an alarm beside its text.
NOTES: tuple[Literal["cause", "remedy"], ...] = ("cause", "remedy")


class Format(StrEnum):
    """How the alarms are printed."""

    TEXT = "text"
    JSON = "json"


@commands.command("help.alarms")
def alarms(
    code: Annotated[str | None, Argument("help.alarms.code", metavar="CODE")] = None,
    control: options.Control = None,
    form: Annotated[Format, Option("help.alarms.format", "--format")] = Format.TEXT,
    _lang: options.Lang = None,
) -> int:
    """Explain one alarm, or list all of a control."""
    from polycnc.control.registry import ids

    if control is not None and control not in ids():
        return fail(text("session.control-unknown", control=control, known=listed(ids())), 2)
    if code is None and control is None:
        return fail(text("alarms.control-wanted", known=listed(ids())), 2)
    found = [alarm for each in ([control] if control else ids()) for alarm in _alarms(each, code)]
    if not found:
        return fail(text("alarms.unknown", code=code, control=control or listed(ids())), 2)
    if form is Format.JSON:
        say(json.dumps(found, ensure_ascii=False, indent=1))
    else:
        for alarm in found:
            for line in _explained(alarm) if code else [f"{alarm['code']:10} {alarm['text']}"]:
                say(line)
    return 0


def _alarms(control: str, code: str | None) -> Iterator[dict[str, str]]:
    """All alarms of a control and of the machines that polycnc knows, or those that a user may mean by a code."""
    from polycnc.control import registry
    from polycnc.control.alarm_text import alarm_key
    from polycnc.machine.builder import builder_names, builder_texts

    known_control = registry.control(control)
    builders = (builder_texts(name, control) for name in builder_names())
    catalogue = known_control.catalogue.extended(*chain.from_iterable(builders))
    for known in catalogue:
        if code is None or alarm_key(known_control, known) == alarm_key(known_control, code):
            notes: dict[str, str] = {kind: catalogue.note(known, kind) for kind in NOTES}
            yield {
                "control": control,
                "code": known,
                "text": catalogue.text(known),
                **notes,
            }


def _explained(alarm: dict[str, str]) -> Iterator[str]:
    yield f"{alarm['control']} {alarm['code']} {alarm['text']}"
    for kind in NOTES:
        if alarm[kind]:
            yield f"  {text(f'alarms.{kind}')}: {alarm[kind]}"
