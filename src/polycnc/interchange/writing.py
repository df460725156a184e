"""Everything that a memory holds as files, and what these files cannot say."""

from __future__ import annotations

from pathlib import Path

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.interchange import comparison, programs, setups
from polycnc.interchange.controls.kinds import PROGRAMS, SETUP, texts_of
from polycnc.interchange.errors import InterchangeError
from polycnc.interchange.power_on import channel_on
from polycnc.interchange.reading import Reading
from polycnc.memory.retained import InMemoryStore
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.memory.retained import RetainedStore

#: The file of a setup.
SETUP_FILE = "setup.yaml"


@dataclass(slots=True)
class Written:
    """Files by name, and what of the memory they do not say: table and key."""

    files: dict[str, str] = field(default_factory=dict)
    left_out: list[tuple[str, object]] = field(default_factory=list)


def kinds_of(control: str) -> tuple[str, ...]:
    """Kinds of data that a control writes."""
    return (PROGRAMS, *texts_of(control).kinds, SETUP)


def write(memory: RetainedStore, control: str, machine: str | Path | None, kinds: Sequence[str]) -> Written:
    """The files of some kinds of data; of all that the control itself writes where none is named.

    Raises:
        InterchangeError: There is no such kind, or a program that no file can hold.
    """
    known = kinds_of(control)
    for kind in kinds:
        if kind not in known:
            raise InterchangeError("data.kind", kind=kind, known=listed(known))
    texts, found = texts_of(control), Written()
    channel = channel_on(memory, control, machine)
    wanted = tuple(kinds) or tuple(kind for kind in known if kind != SETUP)
    for kind in wanted:
        if kind == PROGRAMS:
            found.files.update(programs.written(programs.kept_programs(memory), texts))
        elif kind == SETUP:
            found.files[SETUP_FILE] = setups.text_of(channel, machine)
        else:
            found.files[texts.kinds[kind].file] = texts.kinds[kind].write(channel)
    if not kinds:
        found.left_out = _left_out(memory, control, machine, found.files)
    return found


def _left_out(
    memory: RetainedStore, control: str, machine: str | Path | None, files: dict[str, str]
) -> list[tuple[str, object]]:
    """What is missing when the files are read into an empty memory."""
    again = InMemoryStore()
    Reading(again, control, machine).take_texts({Path(name): text for name, text in files.items()})
    channels = channel_on(memory, control, machine).group
    count = len(channels.channels) if channels is not None else 1
    return list(comparison.missing(memory, again, count))
