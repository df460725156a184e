"""What the builder of a machine has made of its control: tables that machine files name by `rules`.

A builder that comes with polycnc is a folder of `builders`. `rules.toml` and `m_functions.toml` hold on every control,
`CONTROL.toml` has the alarms and messages that the machine gives on that control, and `texts/CONTROL-….toml` say what
these mean. A builder of one's own is a file with the same tables.
"""

from __future__ import annotations

from polycnc.deferred.paths import is_dir, joined, names_in, package_path
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from polycnc.machine.plc import PlcAlarm
    from polycnc.machine.rules import Rule

BUILDERS = package_path("machine", "builders")


@dataclass(frozen=True)
class Builder:
    """The tables of a builder; without a name there are none.

    Attributes:
        name: As `rules` names it: a folder of `builders`, or a file.
        rules: Rules of the machine's own controller, in the order of their scan.
        alarms: Its alarms and messages, by the id of the control that they hold on; an empty id is any.
    """

    name: str = ""
    rules: tuple[Rule, ...] = ()
    alarms: Mapping[str, tuple[PlcAlarm, ...]] = field(default_factory=dict)

    def alarms_of(self, control: str, declared: Collection[str]) -> Iterator[PlcAlarm]:
        """The rows that hold on a control. A code that is declared has a function: no row refuses it outright."""
        for row in (*self.alarms.get("", ()), *self.alarms.get(control, ())):
            free = frozenset(word for word in row.words.intersection(declared) if row.refuses_outright(word))
            yield replace(row, free=free) if free else row

    def texts(self, control: str) -> tuple[str, ...]:
        """The files with the texts of its alarms on a control."""
        return builder_texts(self.name, control)


NO_BUILDER = Builder()


def builder_texts(name: str, control: str) -> tuple[str, ...]:
    """The files with the texts of a builder's alarms on a control, none for a builder of one's own."""
    if not name or name.endswith(".toml"):
        return ()
    texts = package_path("machine", "builders", name, "texts")
    return tuple(joined(texts, file) for file in names_in(texts) if file.startswith(f"{control}-"))


def builder_names() -> tuple[str, ...]:
    """The builders that come with polycnc, sorted."""
    return tuple(name for name in names_in(BUILDERS) if is_dir(joined(BUILDERS, name)))
