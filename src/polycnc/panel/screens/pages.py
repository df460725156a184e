"""What the screens of a family are: pages, windows, soft keys; read from data.

A file names its function keys (`[keys]`) and its pages. A soft key leads to a page (`page`), to further soft keys
(`menu`) or does something (`action`, see `actions`). Texts have a value for each language; a plain text is the same in
both, as real controls show it.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources

from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

#: A text by language, or one for all.
Text: TypeAlias = "str | Mapping[str, str]"
#: Decimals of lengths in millimetres.
DIGITS = 3
#: The files of each control's screens; later ones add to earlier ones.
SCREENS = {
    "fanuc-m": ("fanuc.toml", "fanuc-mill.toml", "hartford.toml"),
    "fanuc-0i-tf": ("fanuc.toml", "fanuc-lathe.toml"),
    "meldas-m": ("meldas.toml", "hartford.toml"),
    "sinumerik-840d": ("sinumerik.toml",),
    "syntec-mill": ("syntec.toml",),
}


def in_language(text: Text, lang: str) -> str:
    """A text in a language."""
    return text if isinstance(text, str) else text.get(lang, text["en"])


@cache
def _units() -> Mapping[str, Text]:
    file = resources.files("polycnc.panel.screens").joinpath("units.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def unit_in_language(unit: str, lang: str) -> str:
    """A unit of a parameter in a language."""
    return in_language(_units().get(unit, unit), lang)


@dataclass(frozen=True)
class SoftKey:
    """A soft key: its text, and what it does. Without any of them it is dark.

    Attributes:
        text: What stands on it.
        page: The page that it opens.
        menu: The row of soft keys that it opens.
        action: What it does (`actions`).
        switch: Panel switch that it turns over.
        signal: Signal that it turns over.
        search: The kind of block search that it chooses.
        when: Parameters under which it is there (`8136#6`, `!8136#6`, several with `&`); empty for always.
        by_page: The row that it opens is the page's own, where the page has one (`operations`).
        large: What stands on it on displays with keys at the side; empty for the same.
    """

    text: Text = ""
    page: str = ""
    menu: str = ""
    action: str = ""
    switch: str = ""
    signal: str = ""
    search: str = ""
    when: str = ""
    by_page: bool = False
    large: Text = ""


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes:
        head: What stands above it.
        variable: Name of the variable of a row. `{n}` is the number of the row times `step`, with `add` to it, and
            the place of the axis where the column is `by_axis`, unless its name stands there as `{axis}`.
        add: See `variable`.
        step: See `variable`.
        by_axis: There is such a column for every axis of the channel, with its name as the head.
        digits: Decimals of its values.
        axis: The axis that it belongs to, by which MEASURE and INP.C. find it.
        source: Where its fields come from (`sources`); empty for variables.
        axis_of: Parameter with the number of its axis; no column where it is 0.
        when: Parameters under which it is there, as for soft keys.
    """

    head: Text
    variable: str
    add: int = 0
    step: int = 1
    by_axis: bool = False
    digits: int = DIGITS
    axis: str = ""
    source: str = ""
    axis_of: str = ""
    when: str = ""

    def name(self, row: int) -> str:
        """The variable of a row."""
        return self.variable.format(n=row * self.step + self.add, axis=self.axis)

    def of(self, axes: Sequence[str]) -> tuple[Column, ...]:
        """The columns that a channel with these axes has."""
        if not self.by_axis:
            return (self,) if self.axis in ("", *axes) else ()
        step = 0 if "{axis}" in self.variable else 1
        return tuple(
            replace(self, head=axis, axis=axis, add=self.add + step * place, by_axis=False)
            for place, axis in enumerate(axes)
        )


@dataclass(frozen=True)
class WindowSpec:
    """A window: its kind, and what that kind wants to know.

    `count_of` is a parameter with the number of rows; where that is 0, `count` holds. `head` stands above the numbers
    of a table.
    """

    kind: str
    title: Text = ""
    of: str = ""
    size: str = ""
    label: str = "{n}"
    head: Text = ""
    first: int = 1
    count: int = 0
    count_of: str = ""
    shown: int = 17
    exists: str = ""
    columns: tuple[Column, ...] = ()
    labels: tuple[Text, ...] = ()
    words: Mapping[str, Text] = field(default_factory=dict)


@dataclass(frozen=True)
class Page:
    """A page: its title, its windows, the soft keys that come with it.

    Attributes:
        id: Its name in the data.
        title: Its title.
        windows: Its windows.
        menu: Its soft keys.
        operations: Its own row of operations; empty where its chapter's is meant.
        data: What [READ] and [PUNCH] transfer (`card`).
        turns: The page that the page keys lead to; empty where they move the cursor.
        other: The page that the soft key SWITCH leads to.
        edits: Keys change words of the program, in mode EDIT.
        edits_blocks: Keys change the program block by block.
        when: Parameters under which it is there, as for soft keys; else `instead` is the page that is shown.
        instead: See `when`.
    """

    id: str
    title: Text
    windows: tuple[WindowSpec, ...]
    menu: str = ""
    operations: str = ""
    data: str = ""
    turns: str = ""
    other: str = ""
    edits: bool = False
    edits_blocks: bool = False
    when: str = ""
    instead: str = ""

    def of(self, axes: Sequence[str]) -> Page:
        """The page of a channel with these axes."""
        windows = (
            replace(each, columns=tuple(one for column in each.columns for one in column.of(axes)))
            for each in self.windows
        )
        return replace(self, windows=tuple(windows))


@dataclass(frozen=True)
class Task:
    """A task of the maintenance schedule: number, name, and what is done in which period (letters of `works`)."""

    number: int
    name: Text
    work: Mapping[str, str]


@dataclass(frozen=True)
class Family:
    """All screens of a control.

    Attributes:
        start: The page after power-on.
        rows: Soft keys that stand in a row; what is more comes with the key `MENU` (▷).
        keys: The page that a key of the MDI unit opens.
        letters: Keys of the MDI unit that type, in rows.
        dual: Keys with two legends, and what each of them is: plain, and behind SHIFT.
        pages: Pages by id.
        menus: Soft keys below the screen, by name.
        side: Soft keys at its side, by name of the menu.
        modes: How the status line writes modes, by mode; states likewise.
        layout: How the halves are laid out: `crt` or `operate`.
        modal_by_column: Modal codes stand column by column in the order of the lathe's manual.
        modal_digits: Digits with which G codes are shown; other modal words are not shown then. 0: all as they are.
        axis_parameters: Parameters that every axis has its own of stand in a row for each axis.
        sequence: How the title line writes the block number (`N{n:05}`); empty for not at all.
        measures: It has measured input B.
        next_key: What the key ▷ is called on this control; empty for ▷.
        root: The main row of soft keys: where a row has no further keys, ▷ leads to the further ones of this; empty for
            not at all. A row `name-5` is there in the place of `name` on displays with five soft keys.
        more_keys: Keys that edit, beside those that every control has.
        tasks: The maintenance schedule of the machine; `periods` and `works` have its words by their ids.
        data_mode: The mode in which data are transferred; empty for every mode.
        message_line: Messages have a line of their own, beside that of alarms.
        next_page: What stands on the key of further chapters, on displays with keys at the side.
        clock: The status line has the time of day and the path.
        entry: How the key-in line is written where fields are numbered, of the number `n` at the cursor and what is
            `typed`; empty for as elsewhere.
    """

    start: str
    rows: int
    keys: Mapping[str, str]
    letters: tuple[str, ...]
    pages: Mapping[str, Page]
    menus: Mapping[str, tuple[SoftKey, ...]]
    side: Mapping[str, tuple[SoftKey, ...]] = field(default_factory=dict)
    modes: Mapping[str, str] = field(default_factory=dict)
    states: Mapping[str, str] = field(default_factory=dict)
    layout: str = "crt"
    dual: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    data_mode: str = ""
    modal_by_column: bool = False
    modal_digits: int = 0
    axis_parameters: bool = False
    sequence: str = ""
    measures: bool = False
    tasks: tuple[Task, ...] = ()
    periods: Mapping[str, Text] = field(default_factory=dict)
    works: Mapping[str, Text] = field(default_factory=dict)
    message_line: bool = False
    next_page: Text = ""
    clock: bool = False
    next_key: str = ""
    root: str = ""
    more_keys: tuple[str, ...] = ()
    entry: str = ""


#: What a family says in its files as it is kept.
_PLAIN = (
    "modes", "states", "layout", "data_mode", "modal_by_column", "modal_digits", "axis_parameters", "sequence",
    "measures", "periods", "works", "message_line", "next_page", "clock", "next_key",
    "root", "entry",
)  # fmt: skip


@cache
def family_of(control: str) -> Family:
    """The screens of a control; raises `KeyError` where polycnc knows none."""
    merged: dict[str, Any] = {"page": []}
    for file in SCREENS[control]:
        content = resources.files("polycnc.panel.screens").joinpath(file).read_text(encoding="utf-8")
        for name, value in tomllib.loads(content).items():
            if name == "page":
                merged["page"] += value
            elif isinstance(value, dict):
                merged[name] = {**merged.get(name, {}), **value}
            else:
                merged[name] = value
    pages = [_page(row) for row in merged["page"]]
    return Family(
        start=merged["start"],
        rows=merged["rows"],
        keys=merged["keys"],
        letters=tuple(merged["letters"]),
        pages={page.id: page for page in pages},
        menus={name: tuple(SoftKey(**key) for key in keys) for name, keys in merged.get("menu", {}).items()},
        side={name: tuple(SoftKey(**key) for key in keys) for name, keys in merged.get("side", {}).items()},
        dual={key: (legends[0], legends[1]) for key, legends in merged.get("dual", {}).items()},
        tasks=tuple(Task(**row) for row in merged.get("maintenance", ())),
        more_keys=tuple(merged.get("more_keys", ())),
        **{name: merged[name] for name in _PLAIN if name in merged},
    )


#: What a page may say beside its name, title and windows.
_PAGE = ("menu", "operations", "data", "turns", "other", "edits", "edits_blocks", "when", "instead")


def _page(row: Mapping[str, Any]) -> Page:
    windows = []
    for spec in row["windows"]:
        columns = tuple(Column(**column) for column in spec.get("columns", ()))
        rest = {name: value for name, value in spec.items() if name not in ("columns", "labels")}
        windows.append(WindowSpec(**rest, columns=columns, labels=tuple(spec.get("labels", ()))))
    more = {name: row[name] for name in _PAGE if name in row}
    return Page(row["id"], row["title"], tuple(windows), **more)
