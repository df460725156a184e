"""`polycnc features`: what works, from the project's own cases and tests."""

from __future__ import annotations

import json
from enum import StrEnum

from polycnc.cli import options
from polycnc.cli.console import fail, show
from polycnc.cli.declaration import Commands, Option, Path
from polycnc.cli.progress import Waiting
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cases.features import Features

commands = Commands()


class Format(StrEnum):
    """How the features are written."""

    TEXT = "text"
    JSON = "json"
    MARKDOWN = "markdown"


@commands.command("help.features", runs="cases")
def features(
    control: options.Control = None,
    cases: Annotated[Path | None, Option("help.features.from", "--from", metavar="DIR")] = None,
    tests: Annotated[Path | None, Option("help.features.tests", "--tests", metavar="FILE")] = None,
    form: Annotated[Format, Option("help.option.format", "--format")] = Format.TEXT,
    output: options.Output = None,
    _lang: options.Lang = None,
) -> int:
    """Show the features that work, of one control or in short of all."""
    from polycnc.cases.features import case_files, proved, shipped
    from polycnc.cli.output import write_whole
    from polycnc.control.registry import ids
    from polycnc.messages.files import refuse_inputs

    if control is not None and control not in ids():
        return fail(text("session.control-unknown", control=control, known=listed(ids())), 2)
    if cases is not None and not cases.is_dir():
        return fail(text("file.unreadable", file=cases, reason=text("file.no-folder")), 2)
    files = [] if cases is None else case_files(cases)
    with Waiting("polycnc features", len(files), "files") as waiting:
        found = shipped() if cases is None and tests is None else proved(cases, tests, waiting.each)
    if control is not None:
        found = {control: found.get(control, {})}
    if form is Format.JSON:
        content = json.dumps(found, indent=1) + "\n"
    else:
        content = "".join(f"{line}\n" for line in _lines(found, control, form))
    if output is None:
        show(content)
    else:
        refuse_inputs([output], [tests, *files])
        write_whole(output, content)
    return 0


def _lines(found: Features, control: str | None, form: Format) -> Iterator[str]:
    if form is Format.MARKDOWN:
        for number, one in enumerate(found):
            if number:
                yield ""
            yield from _table(one, found[one])
    elif control is not None:
        yield from _all(found[control])
    else:
        yield from _short(found)


def _short(found: Features) -> Iterator[str]:
    from polycnc.control.registry import ids

    for control in ids():
        counts = found.get(control, {})
        yield text("features.control", control=f"{control:14}", count=len(counts), cases=sum(counts.values()))


def _all(counts: dict[str, int]) -> Iterator[str]:
    from polycnc.cases.features import functions, in_manual_order

    width = max(map(len, counts), default=0)
    for feature in in_manual_order(counts):
        name = functions().text(feature) if feature in functions() else ""
        shown = text(
            "features.feature", feature=f"{feature:{width}}", cases=f"{counts[feature]:3}", name=name
        )
        yield shown.rstrip()


def _table(control: str, counts: dict[str, int]) -> Iterator[str]:
    """One control as a page of Markdown."""
    from polycnc.cases.features import functions, in_manual_order

    yield text("features.title", control=control)
    yield ""
    yield text("features.proof")
    yield ""
    yield text("features.table")
    yield "|---|---|---|--:|"
    for feature in in_manual_order(counts):
        entry = functions().entry(feature) if feature in functions() else {}
        name = functions().text(feature) if entry else ""
        codes = entry.get("codes", "").replace("|", "\\|")
        yield f"| {name} | {codes} | `{feature}` | {counts[feature]} |"
