"""The programs of a virtual control: what is loaded, what was typed in, and the text of their blocks."""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.errors import CommandRefused
from polycnc.program import Form, ProgramStore, decode, names
from polycnc.program.heads import sequence_number

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import LanguageMemory
    from polycnc.program import Program
    from polycnc.program.store import Edits

#: Where SINUMERIK programs lie that come as texts.
_DIRECTORY = "/_N_WKS_DIR/_N_TEST_WPD"


class Programs:
    """Programs by what a run of them needs.

    Args:
        form: How the control's program files are marked off.
        search: Folders in which calls look for subprograms.
        files: Further programs as texts, by name.
        edited: Programs that were edited, retained.

    Attributes:
        mains: The program that is loaded in each channel.
    """

    def __init__(
        self, form: Form, search: Sequence[str | Path], files: Mapping[str, str], edited: Edits
    ) -> None:
        self._form = form
        self._search = tuple(search)
        self._files = dict(files)
        self._edited = edited
        self.store = self._new_store(edited)
        self.store.take_edits()
        self.mains: dict[int, Program] = {}
        self._loaded: dict[int, list[Program]] = {}
        self._inserted: dict[int, int] = {}

    def _new_store(self, edited: Edits | None = None) -> ProgramStore:
        return ProgramStore(search=self._search, form=self._form, edited=edited)

    def load(self, source: str | bytes | Path, channel: int) -> Program:
        """Load a file, or a program as `bytes` or as a `str` with line ends: the main program of a channel.

        What is loaded in other channels stays; all of them find the programs of each. What was edited counts, but for
        programs that are loaded again.

        Raises:
            ProgramFileError: The file cannot be read.
        """
        store = self._new_store(self._edited)
        content = decode(source).text if isinstance(source, bytes) else source
        if isinstance(source, bytes) or (isinstance(source, str) and "\n" in source):
            main = store.add_text(self._key("MAIN" if channel == 1 else f"MAIN{channel}"), str(content))
        else:
            main = store.add_file(content)
        self._loaded[channel] = list(store)
        for number in self._loaded.keys() - {channel}:
            for program in self._loaded[number]:
                store.put(program)
        for name, text in self._files.items():
            store.add_text(name, text)
        store.take_edits(self._loaded[channel])
        self.store, self.mains[channel] = store, main
        self._inserted.pop(channel, None)
        return main

    # ---- the memory ----------------------------------------------------------------------------------------

    @property
    def all(self) -> tuple[Program, ...]:
        """Every program that is loaded or was edited, once."""
        kept = [each for each in self._edited.values() if each is not None]
        loaded = [each for programs in self._loaded.values() for each in programs]
        names = {(each.directory, each.name.casefold()): each for each in (*loaded, *kept)}
        return tuple(names.values())

    def named(self, name: str) -> Program | None:
        """A program by the name or number that an operator types; None for none."""
        wanted = name.casefold()
        exact = (
            each
            for each in self.all
            if wanted in (each.name.casefold(), f"{each.directory}/{each.name}".casefold())
        )
        return next(exact, None) or self.store.kept(name) or self._by_number(name) or self._of_cycles(name)

    def _of_cycles(self, name: str) -> Program | None:
        """A text file of a cycle directory (`UC.COM`), the user's first; it is none of the programs that are listed."""
        stored = names.stored_name(name.rpartition("/")[2])
        if self._form is not Form.SINUMERIK or not stored.endswith("_COM"):
            return None
        there = self.copy()
        found = (there.find_in(directory, stored) for directory in (*names.CYCLE_DIRS, _DIRECTORY))
        return next((each for each in found if each is not None), None)

    def _by_number(self, name: str) -> Program | None:
        digits = name.strip().upper().removeprefix("O")
        return next((each for each in self.all if digits.isdigit() and each.number == int(digits)), None)

    def keep(self, name: str, text: str) -> None:
        """Put the programs of a text into the memory; the first one has the name, unless its own heading has one."""
        store = self._new_store()
        store.add_text(self._key(name), text)
        for program in store:
            self.store.replace(program)
            for number, programs in self._loaded.items():
                known = next((each for each in programs if _is_same(each, program)), None)
                self._loaded[number] = [program if each is known else each for each in programs]
                if known is not None and self.mains.get(number) is known:
                    self.mains[number] = program

    def forget(self, program: Program) -> None:
        """Take a program out of the memory."""
        self.store.remove(program)
        for number, programs in self._loaded.items():
            self._loaded[number] = [each for each in programs if each is not program]
            if self.mains.get(number) is program:
                del self.mains[number]

    def select(self, program: Program, channel: int) -> None:
        """A program of the memory becomes the main program of a channel; those that are loaded stay."""
        if not any(program is each for programs in self._loaded.values() for each in programs):
            others = (each for each in self._loaded.get(channel, ()) if not _is_same(each, program))
            self._loaded[channel] = [*others, program]
            self.store.put(program)
        self.mains[channel] = program
        self._inserted.pop(channel, None)

    # ---- what comes from elsewhere -------------------------------------------------------------------------

    def from_outside(self, source: str | bytes | Path) -> Program:
        """A program that is run without being stored; sources as for `load`."""
        content = decode(source).text if isinstance(source, bytes) else source
        if isinstance(source, bytes) or (isinstance(source, str) and "\n" in source):
            return self._new_store().add_text(self._key("TAPE"), str(content))
        return self._new_store().add_file(content)

    def main(self, channel: int) -> Program:
        """The main program of a channel.

        Raises:
            CommandRefused: None is loaded.
        """
        if channel not in self.mains:
            raise CommandRefused("mainrun.no-program")
        return self.mains[channel]

    def insert(self, block: str, line: int | None, channel: int) -> None:
        """Put a block behind a line of a main program's file, or behind the one that was put in last."""
        main = self.main(channel)
        last = main.first_line + len(main.lines) - 1
        behind = line if line is not None else self._inserted.get(channel, last)
        if not main.first_line - 1 <= behind <= last:
            raise CommandRefused(
                "mainrun.value", name="line", allowed=f"{main.first_line} … {last}", value=line
            )
        at = behind - main.first_line + 1
        changed = self.mains[channel] = replace(main, lines=(*main.lines[:at], block, *main.lines[at:]))
        self._loaded[channel] = [changed if each is main else each for each in self._loaded[channel]]
        self._inserted[channel] = behind + 1
        self.store.replace(changed)

    def line_of(self, target: int | str, channel: int) -> int:
        """The line of a block of a main program: the line itself, or that of a block number."""
        main = self.main(channel)
        if isinstance(target, int):
            return target
        wanted = target.strip().upper()
        for i, text in enumerate(main.lines):
            if wanted and sequence_number(text) == wanted:
                return main.line_number(i)
        raise CommandRefused("mainrun.search", target=target)

    def typed(self, text: str) -> Program:
        """What was typed in at MDI."""
        return self._new_store().add_text(self._key("MDI"), text)

    def copy(self) -> ProgramStore:
        """A store with all that is there: whoever works with it leaves this one alone."""
        store = self._new_store()
        for program in self.all:
            store.put(program)
        for name, text in self._files.items():
            store.add_text(name, text)
        return store

    def key_of(self, name: str) -> str:
        """The name under which a store takes a text: with its directory where the memory has the program."""
        known = self.named(name)
        if known is not None and known.directory:
            return f"{known.directory}/{known.name}"
        return self._key(name)

    def _key(self, name: str) -> str:
        """Where a text of a name lies; a SINUMERIK name may say its directory or its type itself."""
        if self._form is not Form.SINUMERIK or name.startswith("/"):
            return name
        stored = names.stored_name(name)
        return f"{_DIRECTORY}/{stored if stored.endswith(('_MPF', '_SPF')) else stored + '_MPF'}"


def _is_same(one: Program, other: Program) -> bool:
    return (one.directory, one.name.casefold()) == (other.directory, other.name.casefold())


def forget_skipped(channel: Channel) -> None:
    """Block skip has been switched: programs that keep what they skip read their blocks again."""
    language: LanguageMemory | None = getattr(channel.memory, "language", None)
    if language is not None:
        language.programs.forget_steps()


def text_of(program: Program | None, line: int) -> str:
    """The text of a line of a program's file; empty where there is none."""
    index = line - program.first_line if program is not None else -1
    return program.lines[index].strip() if program is not None and 0 <= index < len(program.lines) else ""
