"""Windows of SINUMERIK and SYNTEC: alarms with date, time and what cancels them, messages, the state of channels."""

from __future__ import annotations

from polycnc.control.sinumerik.variables.blank import blank_of
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.messages import text
from polycnc.panel.screens.pages import in_language
from polycnc.panel.screens.view import Cell

if TYPE_CHECKING:
    from collections.abc import Mapping
    from datetime import datetime

    from polycnc.mainrun.reading.snapshot import Snapshot
    from polycnc.panel.screens.pages import Text
    from polycnc.panel.screens.state import ScreenState

Rows: TypeAlias = tuple[tuple[Cell, ...], ...]


def state_of(snapshot: Snapshot) -> str:
    """The state that is shown: that of the first channel where others still run.

    One that waits for another runs (SYNTEC G04.1, 2.7.1 (5)); one that has halted stands.
    """
    first = snapshot.channels.get(1)
    if snapshot.state == "running" and first is not None and first.runs and first.halt:
        return "stopped"
    return snapshot.state


def alarm_list(screen: ScreenState, snapshot: Snapshot, lang: str) -> Rows:
    """Alarms, the latest first: date and time, number, text, and the symbol of what cancels it."""
    head = tuple(
        Cell(text(f"screen.alarm-{each}", lang), "label") for each in ("time", "number", "text", "cancel")
    )
    rows = [
        (
            Cell(_stamp(screen.seen(alarm)), "label"),
            Cell(alarm.code, "alarm"),
            Cell(screen.control.alarm_text(alarm, lang), "alarm"),
            Cell("RESET //", "label"),
        )
        for alarm in reversed(snapshot.alarms)
    ]
    return (head, *rows) if rows else ()


def message_list(screen: ScreenState, snapshot: Snapshot, lang: str) -> Rows:
    """Messages: those of the machine's controller with their numbers, and the one of each channel's program."""
    catalogue = screen.control.catalogue
    rows = [
        (
            Cell(_stamp(screen.seen(code)), "label"),
            Cell(code, "note"),
            Cell(catalogue.text(code, lang), "note"),
        )
        for code in snapshot.notices
    ]
    told = {number: each.messages[-1] for number, each in snapshot.channels.items() if each.messages}
    if not told and snapshot.messages:
        told = {1: snapshot.messages[-1]}
    rows += [
        (Cell(_stamp(screen.seen((number, said))), "label"), Cell("", "note"), Cell(said, "note"))
        for number, said in told.items()
        if said
    ]
    return tuple(rows)


def channel_state(words: Mapping[str, Text], snapshot: Snapshot, lang: str) -> Rows:
    """A line of words: what the control is doing, its mode, and whether there is an alarm."""
    state = in_language(words.get(state_of(snapshot), ""), lang)
    mode = in_language(words.get(snapshot.mode, ""), lang)
    alarm = in_language(words.get("ALARM", ""), lang) if snapshot.alarms else ""
    return ((Cell(state, "value"), Cell(mode, "value"), Cell(alarm, "alarm")),)


def blank(screen: ScreenState, lang: str) -> Rows:
    """The blank that the program has described (WORKPIECE): form, the offset it refers to, dimensions."""
    found = blank_of(screen.control.channel)
    if found is None:
        return ()
    head = [Cell(text("screen.blank", lang), "label"), Cell(found.form, "value"), Cell(found.zero, "value")]
    rows = [
        (Cell(name, "label"), Cell(f"{value:.{screen.digits if name != 'N' else 0}f}", "value"))
        for name, value in found.values.items()
    ]
    return (tuple(head), *rows)


def _stamp(moment: datetime) -> str:
    return f"{moment:%Y-%m-%d %H:%M:%S}"
