"""The options that all commands share."""

from __future__ import annotations

from enum import StrEnum

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT
from polycnc.cli.declaration import Option, Path
from polycnc.deferred.paths import text_of
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Annotated

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from polycnc.session import Session


class Language(StrEnum):
    """The languages that polycnc speaks."""

    EN = "en"
    ZH_TW = "zh-TW"


def controls() -> tuple[str, ...]:
    """The ids of all controls."""
    from polycnc.control import registry

    return tuple(registry.ids())


def machines() -> tuple[str, ...]:
    """The ids of the built-in machines."""
    from polycnc.machine import builtin_ids

    return builtin_ids()


def expanded(names: Iterable[str]) -> list[str]:
    """File names with patterns resolved that the shell has left as they are, as on Windows."""
    from glob import glob, has_magic

    files: list[str] = []
    for name in names:
        found = sorted(glob(name)) if has_magic(name) and not Path(name).exists() else []  # noqa: PTH207 - names stay as typed
        files += found or [name]
    return files


def _file(name: str | Path) -> str | Path:
    """A file as `open_session` takes it for one: a text of several lines would be a program."""
    path = text_of(name)
    return Path(path) if "\n" in path else path


def _option(
    text: str, *flags: str, metavar: str, values: Callable[[], Iterable[str]] | None = None
) -> Option:
    return Option(text, *flags, metavar=metavar, shows_default=False, values=values)


Control = Annotated[str | None, _option("help.option.control", "--control", metavar="ID", values=controls)]
Machine = Annotated[
    str | None, _option("help.option.machine", "--machine", metavar="ID|FILE", values=machines)
]
Setup = Annotated[Path | None, _option("help.option.setup", "--setup", metavar="FILE")]
Search = Annotated[list[Path] | None, _option("help.option.search", "--search", metavar="DIR")]
Encoding = Annotated[str | None, _option("help.option.encoding", "--encoding", metavar="NAME")]
Lang = Annotated[Language | None, _option("help.option.lang", "--lang", metavar="en|zh-TW")]
BlockLimit = Annotated[
    int, Option("help.option.block-limit", "--block-limit", metavar="NUMBER", limits=(1, None))
]
Memory = Annotated[Path | None, _option("help.option.memory", "--memory", metavar="FILE")]
NoBulk = Annotated[bool, Option("help.option.no-bulk", "--no-bulk")]
Output = Annotated[Path | None, _option("help.option.output", "--output", "-o", metavar="FILE")]


@dataclass(frozen=True)
class Opening:
    """How a program is opened: the options of every command that runs one, in the order of its help."""

    control: Control = None
    machine: Machine = None
    setup: Setup = None
    search: Search = None
    encoding: Encoding = None
    block_limit: BlockLimit = DEFAULT_BLOCK_LIMIT
    no_bulk: NoBulk = False
    _lang: Lang = None

    def inputs(self, *files: str | Path) -> list[str | Path]:
        """The files that a command reads, which none of its outputs may replace."""
        return [*files, *(each for each in (self.setup, self.machine) if each is not None)]

    def session(
        self,
        source: bytes | str | Path,
        *,
        name: str = "",
        keep: bool,
        timed: bool = True,
        memory: Path | None = None,
    ) -> Session:
        """Open a session of a file, or of the bytes of a program without one; `session.open_session` has the errors."""
        from polycnc.cli.freed import keep_freed_memory
        from polycnc.session import open_session

        keep_freed_memory()
        if not isinstance(source, bytes):
            source = _file(source)
        return open_session(
            source, name=name, control=self.control, machine=self.machine, setup=self.setup,
            search=self.search or (), encoding=self.encoding, block_limit=self.block_limit,
            keep=keep, timed=timed, bulk=not self.no_bulk, memory=memory,
        )  # fmt: skip
