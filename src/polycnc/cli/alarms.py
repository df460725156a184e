"""`polycnc alarms`: what an alarm of a control means, or the list of all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from polycnc.cli import options
from polycnc.cli.console import fail, say
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Iterator

app = typer.Typer(add_completion=False, rich_markup_mode=None)


@app.command(help=text("help.alarms"))
def alarms(
    code: Annotated[str | None, typer.Argument(metavar="CODE", help=text("help.alarms.code"))] = None,
    control: options.Control = None,
    _lang: options.Lang = None,
) -> int:
    """Explain one alarm, or list all of a control."""
    from polycnc.control.registry import ids

    if control is not None and control not in ids():
        return fail(text("session.control-unknown", control=control, known=", ".join(ids())), 2)
    if code is None and control is None:
        return fail(text("alarms.control-wanted", known=", ".join(ids())), 2)
    told = [line for each in ([control] if control else ids()) for line in _lines(each, code)]
    if not told:
        return fail(text("alarms.unknown", code=code, control=control or ", ".join(ids())), 2)
    for line in told:
        say(line)
    return 0


def _lines(control: str, code: str | None) -> Iterator[str]:
    """All alarms of a control, or one with its remedy."""
    from polycnc.cases.compare import alarm_key
    from polycnc.cli.diagnostics import remedy_of
    from polycnc.control import registry

    catalogue = registry.control(control).catalogue
    for known in catalogue:
        if code is not None and alarm_key(control, known) != alarm_key(control, code):
            continue
        yield f"{control} {known} {catalogue.text(known)}" if code else f"{known:10} {catalogue.text(known)}"
        if code is not None and (remedy := remedy_of(catalogue.entry(known))):
            yield f"  {text('alarms.remedy')}: {remedy}"
