"""What a window of each kind shows: rows of cells, from the snapshot of the control."""

from __future__ import annotations

from collections.abc import Callable
from itertools import zip_longest

from polycnc.control.fanuc.lathe.tools.screens import modal_codes
from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.geometry.units import INCH_MM
from polycnc.messages import text
from polycnc.panel.description import RETURNED, is_returned
from polycnc.panel.screens import forms, operate, tables
from polycnc.panel.screens.pages import in_language, unit_in_language
from polycnc.panel.screens.view import Cell, Window
from polycnc.panel.screens.words import END, spans

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun.reading.snapshot import Snapshot
    from polycnc.panel.screens.pages import WindowSpec
    from polycnc.panel.screens.state import ScreenState

Rows: TypeAlias = tuple[tuple[Cell, ...], ...]


@dataclass(frozen=True, slots=True)
class Asked:
    """What a window is made from: the screen, what its page says of it, the snapshot, the language."""

    screen: ScreenState
    spec: WindowSpec
    snapshot: Snapshot
    lang: str


Reader: TypeAlias = Callable[[Asked], Rows]

#: A G code: its number, and what stands behind the point.
_G_CODE = regex(r"G(\d+)((?:\.\d+)?)")
#: Blocks that a program window shows in front of the one in execution.
_BEFORE = 3


def window(screen: ScreenState, spec: WindowSpec, snapshot: Snapshot, lang: str) -> Window:
    """One window of a page."""
    return Window(
        spec.kind, in_language(spec.title, lang), KINDS[spec.kind](Asked(screen, spec, snapshot, lang))
    )


# ---- positions, speeds, codes ------------------------------------------------------------------------------------


def _positions(at: Asked) -> Rows:
    """An axis a row: its position as `of` says, `work`, `machine`, `to_go` or `relative`."""
    style = at.spec.size or "value"
    shown = at.screen.positions(at.snapshot, at.spec.of)
    return tuple(
        (
            Cell(at.screen.axis_label(axis, at.spec.of), style),
            Cell(at.screen.position_text(axis, at.spec.of, value), style),
        )
        for axis, value in shown.items()
    )


def _all_positions(at: Asked) -> Rows:
    """A column for each kind of position."""
    kinds = ("relative", "work", "machine", "to_go")
    columns = [(kind, at.screen.positions(at.snapshot, kind)) for kind in kinds]
    head = (Cell("", "label"), *(Cell(text(f"screen.{kind}", at.lang), "label") for kind in kinds))
    axes = at.snapshot.positions.work
    rows = [
        (
            Cell(axis, "label"),
            *(
                Cell(at.screen.position_text(axis, kind, column.get(axis, 0.0)), "value")
                for kind, column in columns
            ),
        )
        for axis in axes
    ]
    return (head, *rows)


def _rates(at: Asked) -> Rows:
    """Feed, spindle and tool, with their overrides."""
    over, spindle, tool = at.snapshot.overrides, at.snapshot.spindle, at.snapshot.tool
    return (
        (Cell("F", "label"), Cell(_feed(at), "value"), Cell(f"{over.feed:.0%}", "label")),
        (Cell("S", "label"), Cell(f"{spindle.rpm:.0f}", "value"), Cell(f"{over.spindle:.0%}", "label")),
        (
            Cell("T", "label"),
            Cell(tool.name or str(tool.tool), "value"),
            Cell(str(tool.next_tool or ""), "label"),
        ),
    )


def _feed(at: Asked) -> str:
    """The feed now, in the unit of lengths a minute."""
    inch = at.screen.in_inches
    return f"{at.snapshot.feed / INCH_MM:.2f}" if inch else f"{at.snapshot.feed:.1f}"


def _modal(at: Asked) -> Rows:
    """The code that holds of every modal group; on the lathe column by column as its manual has them (III.2.1.6)."""
    if at.screen.family.modal_by_column:
        rows = zip_longest(*modal_codes(at.screen.control.channel), fillvalue="")
        return tuple(tuple(Cell(code, "value") for code in row) for row in rows)
    digits = at.screen.family.modal_digits
    codes = [code for code in at.snapshot.modal.values() if code and (not digits or _G_CODE.fullmatch(code))]
    if digits:
        codes = [_G_CODE.sub(lambda found: f"G{found[1].zfill(digits)}{found[2]}", code) for code in codes]
    width = at.spec.count or 6
    return tuple(
        tuple(Cell(code, "value") for code in codes[i : i + width]) for i in range(0, len(codes), width)
    )


def _counters(at: Asked) -> Rows:
    """Parts and times."""
    kept = at.screen.control.counters
    return (
        (Cell(text("screen.parts", at.lang), "label"), Cell(str(at.snapshot.parts), "value")),
        (Cell(text("screen.parts-total", at.lang), "label"), Cell(str(kept.parts), "value")),
        (Cell(text("screen.run-time", at.lang), "label"), Cell(_hours(kept.running_s), "value")),
        (Cell(text("screen.cycle-time", at.lang), "label"), Cell(_hours(kept.cycle_s), "value")),
    )


def _hours(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}H{minutes:2d}M{rest:2d}S"


# ---- programs ----------------------------------------------------------------------------------------------------


def _program(at: Asked) -> Rows:
    """The program with the block in execution in sight, or the cursor where an operator has moved it."""
    block = at.snapshot.block
    name, lines, first = at.screen.shown_program
    if not name:
        return ()
    if not lines:
        return ((Cell(block.text, "active"),),)
    active = block.line - first if block.program == name else -1
    cursor = at.screen.program_row
    top = max(0, min((active if cursor is None else cursor) - _BEFORE, len(lines) - at.spec.shown))
    shown = range(top, min(top + at.spec.shown, len(lines)))
    if at.screen.edits:
        place = at.screen.edit_place
        return tuple(_words(lines[row], place.word if row == place.row else -1) for row in shown)
    return tuple(
        (Cell(lines[index], "active" if index == active else "code", cursor=index == cursor),)
        for index in shown
    )


def _words(block: str, word: int) -> tuple[Cell, ...]:
    """A block under edit, word by word with its end; the cursor stands on one of them."""
    texts = [*(block[start:end] for start, end in spans(block)), END]
    return tuple(Cell(text, "code", cursor=place == word) for place, text in enumerate(texts))


def _listing(at: Asked) -> Rows:
    """The programs of the memory; the cursor chooses one."""
    entries = at.screen.control.programs
    row, _ = at.screen.cursor
    row = max(0, min(row, len(entries) - 1))
    at.screen.place(row, 0)
    first = row // at.spec.shown * at.spec.shown
    return tuple(
        (
            Cell(entry.name, "value", cursor=index == row),
            Cell(entry.directory, "label"),
            Cell(text("screen.blocks", at.lang, count=entry.blocks), "label"),
        )
        for index, entry in enumerate(entries[first : first + at.spec.shown], first)
    )


def _card(at: Asked) -> Rows:
    """The files of the memory card; the cursor chooses one."""
    files = at.screen.card.files
    row = at.screen.place(max(0, min(at.screen.cursor[0], len(files) - 1)), 0)
    first = row // at.spec.shown * at.spec.shown
    return tuple(
        (Cell(name, "value", cursor=index == row), Cell(str(size), "label"))
        for index, (name, size) in enumerate(files[first : first + at.spec.shown], first)
    )


def _mdi(at: Asked) -> Rows:
    """What has been typed in, with the block in execution in sight."""
    typed = at.screen.mdi_text.splitlines()
    active = at.snapshot.block.text
    return tuple((Cell(line, "active" if line.strip() == active and active else "code"),) for line in typed)


# ---- alarms and messages -----------------------------------------------------------------------------------------


def _alarms(at: Asked) -> Rows:
    control = at.screen.control
    rows: list[tuple[Cell, ...]] = [
        (
            Cell(alarm.code, "alarm"),
            Cell(control.alarm_text(alarm, at.lang), "alarm"),
            Cell(_place(alarm.program, alarm.line), "label"),
        )
        for alarm in at.snapshot.alarms
    ]
    rows += [
        (Cell(code, "note"), Cell(control.catalogue.text(code, at.lang), "note"))
        for code in at.snapshot.notices
    ]
    return tuple(rows)


def _help(at: Asked) -> Rows:
    """What each alarm and message that is there means: its text, why it comes, what to do about it."""
    catalogue = at.screen.control.catalogue
    told = [
        (alarm.code, at.screen.control.alarm_text(alarm, at.lang), dict(alarm.args))
        for alarm in at.snapshot.alarms
    ]
    told += [(code, catalogue.text(code, at.lang), {}) for code in at.snapshot.notices]
    rows: list[tuple[Cell, ...]] = []
    for code, said, args in told:
        rows.append((Cell(code, "alarm"), Cell(said, "alarm")))
        if code in catalogue:
            rows.append((Cell("", "label"), Cell(catalogue.note(code, "cause", at.lang, args), "value")))
            rows.append((Cell("→", "label"), Cell(catalogue.note(code, "remedy", at.lang, args), "value")))
    return tuple(rows)


def _history(at: Asked) -> Rows:
    control = at.screen.control
    alarms = control.alarm_history[: at.spec.shown]
    return tuple(
        (Cell(alarm.code, "value"), Cell(control.alarm_text(alarm, at.lang), "label")) for alarm in alarms
    )


def _messages(at: Asked) -> Rows:
    shown = [(Cell(message, "note"),) for message in at.snapshot.messages]
    notices = [
        (Cell(code, "note"), Cell(at.screen.control.catalogue.text(code, at.lang), "note"))
        for code in at.snapshot.notices
    ]
    return (*shown, *notices)


def _message_history(at: Asked) -> Rows:
    """The texts that programs have put out, the latest first."""
    return tuple((Cell(said, "label"),) for said in at.screen.control.message_history[: at.spec.shown])


def _place(program: str, line: int) -> str:
    return f"{program}:{line}" if program else ""


# ---- data --------------------------------------------------------------------------------------------------------


def _table(at: Asked) -> Rows:
    return tables.rows_of(at.screen, at.spec, at.lang)


def _parameters(at: Asked) -> Rows:
    """The parameters of the control, on the page of the list where the cursor stands."""
    known = at.screen.parameters
    row, _ = at.screen.cursor
    row = max(0, min(row, len(known) - 1))
    at.screen.place(row, 0)
    first = row // at.spec.shown * at.spec.shown
    return tuple(
        (
            Cell(number, "label"),
            Cell(
                "" if (value := at.screen.control.read_parameter(number)) is None else f"{value}",
                "value",
                cursor=i == row,
            ),
            Cell(unit_in_language(each.unit, at.lang), "label"),
            Cell(each.texts.get(at.lang, each.texts["en"]), "label"),
        )
        for i, (number, each) in enumerate(known[first : first + at.spec.shown], first)
    )


def _signals(at: Asked) -> Rows:
    """The signals of the machine's controller, to read."""
    on = sorted(name for name, value in at.snapshot.signals.items() if value)
    return tuple(tuple(Cell(name, "value") for name in on[i : i + 3]) for i in range(0, len(on), 3))


def _switches(at: Asked) -> Rows:
    """What the panel's switches say, and whether parameters may be written; the cursor chooses one."""
    switches = at.screen.panel_switches
    row = at.screen.place(max(0, min(at.screen.cursor[0], len(switches) - 1)), 0)
    return tuple(
        (
            Cell(in_language(at.spec.words[name], at.lang), "label"),
            Cell(str(int(at.screen.switch(name))), "value", cursor=i == row),
        )
        for i, name in enumerate(switches)
    )


def _diagnosis(at: Asked) -> Rows:
    """What the control does or waits for: a number and 0 or 1 each."""
    snapshot, pending = at.snapshot, at.screen.pending.status if at.screen.pending is not None else ""
    is_on = {
        "0000": snapshot.waiting == "function",
        "0001": snapshot.feed > 0.0,
        "0002": snapshot.waiting == "dwell",
        "0004": snapshot.overrides.feed == 0.0,
        "0010": pending == "OUTPUT",
        "0011": pending == "INPUT",
        "0013": snapshot.overrides.feed == 0.0 and snapshot.mode == "jog",
        "0014": snapshot.state in ("emergency", "braking"),
        "0016": bool(at.screen.background),
    }
    return tuple(
        (
            Cell(number, "label"),
            Cell(in_language(said, at.lang), "label"),
            Cell(str(int(is_on[number])), "value"),
        )
        for number, said in at.spec.words.items()
    )


def _soft_switches(at: Asked) -> Rows:
    """The soft keys of the page that are switches, and how they stand."""
    keys = at.screen.family.menus.get(at.screen.page.menu, ())
    return tuple(
        (
            Cell(in_language(key.text, at.lang), "label"),
            Cell("ON" if at.screen.is_on(key) else "OFF", "value"),
        )
        for key in keys
        if key.switch or key.signal
    )


def _restart(at: Asked) -> Rows:
    """Program restart: where the program goes on, `RP` once an axis is there, the way that is left (5.2.4.8 f).

    Below it what cycle start puts out first: the functions that the search has collected.
    """
    rows: Mapping[str, tuple[float, float]] = at.screen.control.restart
    if not rows:
        return ()
    system = at.snapshot.modal.get("wcs", "")
    head = (
        Cell(text("screen.restart-position", at.lang, system=system), "label"),
        Cell(text("screen.remaining", at.lang), "label"),
    )
    collected = at.screen.control.collected
    functions = (
        Cell(text("screen.collected", at.lang), "label"), *(Cell(word, "value") for word in collected)
    )  # fmt: skip
    shown = at.screen.position_text
    axes = [
        (
            Cell(f"{axis} {shown(axis, 'work', goes_on)}{RETURNED if is_returned(left) else ''}", "value"),
            Cell(f"{axis} {shown(axis, 'to_go', left)}", "value"),
        )
        for axis, (goes_on, left) in rows.items()
    ]
    return (head, *axes, *((functions,) if collected else ()))


def _magazine(at: Asked) -> Rows:
    """The tool in the spindle and the one that stands by, and where the magazine is."""
    tool, magazine = at.snapshot.tool, at.screen.control.machine.magazine
    pocket = at.snapshot.signals.get("MAGAZINE_POCKET", 0.0)
    told = {
        "spindle": tool.name or str(tool.tool),
        "next": str(tool.next_tool or ""),
        "places": str(magazine.places),
        "pocket": str(int(pocket) or ""),
    }
    return tuple(
        (Cell(in_language(at.spec.words[name], at.lang), "label"), Cell(said, "value"))
        for name, said in told.items()
    )


def _version(at: Asked) -> Rows:
    """What runs here: polycnc and its version, the control, the machine."""
    from polycnc.version import __version__

    control = at.screen.control
    told = {"polycnc": __version__, "NCK": control.control.id, "PLC": control.machine.id}
    return tuple((Cell(name, "label"), Cell(said, "value")) for name, said in told.items())


def _graph(_at: Asked) -> Rows:
    """The picture lies over this window: it has no texts."""
    return ()


def _maintenance(at: Asked) -> Rows:
    """The maintenance schedule: task, periods with what is done, running hours since it was noted as done."""
    family = at.screen.family
    tasks, done = family.tasks, at.screen.maintained
    row = at.screen.place(max(0, min(at.screen.cursor[0], len(tasks) - 1)), 0)
    first = row // at.spec.shown * at.spec.shown
    words = {letter: in_language(word, at.lang) for letter, word in family.works.items()}
    rows = []
    for place, task in enumerate(tasks[first : first + at.spec.shown], first):
        work = (
            f"{in_language(family.periods[period], at.lang)} {letters}"
            for period, letters in task.work.items()
        )
        since = at.screen.control.counters.running_s - done.get(str(task.number), 0.0)
        rows.append(
            (
                Cell(str(task.number), "label"),
                Cell(in_language(task.name, at.lang), "value", cursor=place == row),
                Cell(", ".join(work), "value"),
                Cell(_hours(since), "label"),
            )
        )
    legend = (Cell("  ".join(f"{letter}: {word}" for letter, word in words.items()), "label"),)
    return (*rows, legend)


KINDS: dict[str, Reader] = {
    "positions": _positions,
    "all-positions": _all_positions,
    "rates": _rates,
    "modal": _modal,
    "counters": _counters,
    "program": _program,
    "listing": _listing,
    "card": _card,
    "mdi": _mdi,
    "alarms": _alarms,
    "help": _help,
    "history": _history,
    "message-history": _message_history,
    "messages": _messages,
    "table": _table,
    "parameters": _parameters,
    "signals": _signals,
    "restart": _restart,
    "switches": _switches,
    "diagnosis": _diagnosis,
    "soft-switches": _soft_switches,
    "alarm-list": lambda at: operate.alarm_list(at.screen, at.snapshot, at.lang),
    "message-list": lambda at: operate.message_list(at.screen, at.snapshot, at.lang),
    "channel-state": lambda at: operate.channel_state(at.spec.words, at.snapshot, at.lang),
    "blank": lambda at: operate.blank(at.screen, at.lang),
    "cycles": lambda at: forms.cycles(at.screen, at.spec.shown),
    "mask": lambda at: forms.mask(at.screen, at.spec.shown),
    "dialog": lambda at: forms.dialog(at.screen, at.lang),
    "steps": lambda at: forms.steps(at.screen, at.spec.shown),
    "magazine": _magazine,
    "version": _version,
    "graph": _graph,
    "maintenance": _maintenance,
}
