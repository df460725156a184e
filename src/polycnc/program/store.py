"""The programs that a run can reach: those of the main file, and those that calls find elsewhere.

Programs live in directories as on a SINUMERIK control (`/_N_WKS_DIR/_N_TEST_WPD`); on all other controls
there is one directory, `""`. Names are compared as `names.stored_name` spells them on SINUMERIK, else without
regard to case. Whatever was added as text or stands in the main file wins over files of the host; those are
read when a call asks for them, once.
"""

from __future__ import annotations

from polycnc.deferred.paths import is_dir, name_of, parent_of, resolved, text_of
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.messages.catalogue import listed
from polycnc.program import names
from polycnc.program.encoding import decode
from polycnc.program.errors import ProgramFileError
from polycnc.program.folders import Folder, number_of_file, read_file, stored_name_of_file
from polycnc.program.long_text import read_long
from polycnc.program.program import Form, Program
from polycnc.program.split import Source, split_programs
from polycnc.program.text import split_lines

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

EXTERNAL = "external:"
"""Prefix of the directories of an external memory: reached by EXTCALL and M198, never by a normal call."""


def load_programs(
    path: str, encoding: str | None = None, default: Form = Form.WORD_ADDRESS
) -> tuple[Program, ...]:
    """All programs of one file of the host, at least one.

    Args:
        path: The file.
        encoding: What the user says it is; None to detect it.
        default: Form of a file whose own headings do not tell.

    Raises:
        ProgramFileError: The file cannot be read, or a line is too long for a block.
    """
    long = read_long(path) if encoding is None else None
    if long is not None:
        source = Source(name_of(path), path, long.file.codec, long.file.replaced)
        programs = split_programs(long, source, default)
    else:
        decoded = decode(read_file(path), encoding)
        source = Source(name_of(path), path, decoded.encoding, decoded.replaced)
        programs = split_programs(split_lines(decoded.text, path), source, default)
    number = number_of_file(path)
    first = programs[0]
    if (
        number is not None
        and first.number is None
        and first.form is not Form.SINUMERIK
        and first.name == source.name
    ):
        first = replace(first, number=number, name=names.program_name(number))
    return (first, *programs[1:])


#: Edited programs by directory and name in lower case; None for deleted ones.
Edits: TypeAlias = dict[tuple[str, str], Program | None]


class ProgramStore:
    """Programs by name, by number and by SINUMERIK path.

    Args:
        search: Folders of `--search`, in their order.
        form: Form of files whose own headings do not tell; `Form.SINUMERIK` for that control.
        encoding: Encoding that the user asked for; None to detect it file by file.
        directory: SINUMERIK directory of a main program that does not name its own.
        edited: Programs that were edited earlier, by directory and name in lower case, None for deleted ones; what is
            edited goes into it. See `take_edits`.

    Raises:
        ProgramFileError: A search folder is none.
    """

    def __init__(
        self,
        *,
        search: Sequence[str | Path] = (),
        form: Form = Form.WORD_ADDRESS,
        encoding: str | None = None,
        directory: str = names.MPF_DIR,
        edited: Edits | None = None,
    ) -> None:
        for path in search:
            if not is_dir(path):
                raise ProgramFileError("program.search-missing", str(path))
        self.search = [text_of(path) for path in search]
        self.form = form
        self.encoding = encoding
        self.reaches_host = bool(self.search)
        """Calls look for programs among the files of the host too."""
        self.bare_names: set[str] = set()
        """Names under which programs have been added, in upper case and without SINUMERIK's prefix and type."""
        self.shadowed: list[Program] = []
        """Programs that no call reaches, because one added earlier has the same name or number."""
        self._directory = directory
        self._edited: Edits = {} if edited is None else edited
        self._added: list[Program] = []
        self._main: Program | None = None
        self._beside: str | None = None
        self._by_name: dict[tuple[str, str], Program] = {}
        self._by_number: dict[tuple[str, int], Program] = {}
        self._removed: set[tuple[str, str]] = set()
        self._folders: dict[str, Folder] = {}
        self._files: dict[str, tuple[Program, ...]] = {}

    # --- filling --------------------------------------------------------------------------------------------

    @property
    def main(self) -> Program:
        """The program added first (of an archive its first main program); `LookupError` if there is none."""
        if self._main is None:
            raise LookupError
        return self._main

    def __iter__(self) -> Iterator[Program]:
        """Every program that was added, in order; files found by calls are not among them."""
        return iter(tuple(self._added))

    def add_file(self, path: str | Path) -> Program:
        """Add all programs of a host file. The first file added is the main one: calls look beside it.

        Returns:
            The program of the file that a start would run.

        Raises:
            ProgramFileError: The file cannot be used.

        The folder of a workpiece (`SHAFT.WPD`) stands for the main program that selecting it selects.
        """
        path = self._of_workpiece(text_of(path))
        programs = load_programs(path, self.encoding, self.form)
        if self._main is None:
            self._beside = parent_of(path)
            self.reaches_host = True
        return self._add([self._placed(program, path) for program in programs])

    def _of_workpiece(self, path: str) -> str:
        stored = names.stored_name(name_of(path))
        if self.form is not Form.SINUMERIK or not stored.endswith(names.WORKPIECE) or not is_dir(path):
            return path
        folder = self._folder(path)
        main = names.main_of_workpiece(stored, folder.stored_names())
        return folder.stored(main) or path if main else path

    def add_text(self, key: str, text: str) -> Program:
        """Add the programs of a text under a key such as `O9010`, `SUB1.SPF`, `/_N_CUS_DIR/_N_X_SPF`.

        A bare name lies beside the main program, a bare `_N_…_DEF` in the definitions directory, `external:`
        in front puts it into the external memory. The key names the first program of the text, however its
        own heading calls it; numbers of the text count too.
        """
        external = EXTERNAL if key.startswith(EXTERNAL) else ""
        key = key.removeprefix(EXTERNAL)
        sinumerik = (
            key.startswith("/") or key.upper().startswith("_N_") or key.upper().endswith((".MPF", ".SPF"))
        )
        default = Form.SINUMERIK if sinumerik else self.form
        programs = list(split_programs(split_lines(text, key), Source(key), default))
        first = programs[0]
        if sinumerik or first.form is Form.SINUMERIK:
            directory, name = self._place_of_key(key, external)
            programs[0] = replace(first, name=name, directory=external + directory)
            return self._add(programs)
        number = number_of_file(key)
        if number is not None and first.number is None:
            programs[0] = replace(first, name=names.program_name(number), number=number)
        placed = [replace(program, directory=external) for program in programs]
        added = self._add(placed)
        self._by_name.setdefault((external, key.casefold()), added)
        if number is not None:
            self._by_number.setdefault((external, number), added)
        return added

    def replace(self, program: Program) -> None:
        """Put a program in the place of the one with its name and directory (WRITE, edit functions)."""
        self._edited[_key(program.directory, program.name)] = program
        self.put(program)

    def kept(self, name: str) -> Program | None:
        """The edited program that a user names: by its name or number, with its directory or without; None for none."""
        wanted, number = name.casefold(), number_of_file(name)
        stored = names.stored_name(name.rpartition("/")[2]).casefold()
        for (directory, key), program in self._edited.items():
            if program is None:
                continue
            if wanted in (key, f"{directory}/{key}".casefold()) or stored == key:
                return program
            if number is not None and program.number == number:
                return program
        return None

    def put(self, program: Program) -> None:
        """As `replace`, of a program that nobody has edited."""
        key = _key(program.directory, program.name)
        known = self._by_name.get(key)
        self._added = [each for each in self._added if each is not known] + [program]
        self._by_name[key] = program
        self.bare_names.add(names.bare_name(program.name))
        self._removed.discard(key)
        if program.number is not None:
            self._by_number[program.directory, program.number] = program

    def remove(self, program: Program) -> None:
        """Forget a program (DELETE); a file of the host stays where it is, but is not found again."""
        key = _key(program.directory, program.name)
        self._edited[key] = None
        self._removed.add(key)
        self._added = [each for each in self._added if each is not program]
        self._by_name = {key: each for key, each in self._by_name.items() if each is not program}
        self._by_number = {key: each for key, each in self._by_number.items() if each is not program}

    def take_edits(self, loaded: Iterable[Program] = (), *, forget: bool = True) -> None:
        """Programs are as they were edited earlier, but for those that have just been loaded anew.

        What was edited of those is forgotten; without `forget` the memory keeps it.
        """
        anew = {_key(program.directory, program.name) for program in loaded}
        if forget:
            for key in anew:
                self._edited.pop(key, None)
        for key, edited in list(self._edited.items()):
            if key in anew:
                continue
            if edited is not None:
                self.put(edited)
            elif key in self._by_name:
                self.remove(self._by_name[key])
            else:
                self._removed.add(key)

    def _add(self, programs: list[Program]) -> Program:
        for program in programs:
            known = self._by_name.setdefault(_key(program.directory, program.name), program)
            self.bare_names.add(names.bare_name(program.name))
            if program.number is not None:
                known = self._by_number.setdefault((program.directory, program.number), program)
            if known is not program:
                self.shadowed.append(program)
        self._added += programs
        start = next((each for each in programs if each.name.endswith("_MPF")), programs[0])
        if self._main is None and not start.directory.startswith(EXTERNAL):
            self._main = start
        return start

    def _place_of_key(self, key: str, external: str) -> tuple[str, str]:
        directory, name = names.split_stored_path(key)
        typed = key.rpartition("/")[2]
        if "." not in typed and not typed.upper().startswith("_N_"):
            name += "_SPF"
        if not directory and not external:
            stored = typed.upper().startswith("_N_") and name.endswith("_DEF")
            is_definition = stored or names.is_definition_file(name)
            directory = names.DEF_DIR if is_definition else self._directory_beside()
        return directory, name

    def _directory_beside(self) -> str:
        return self._main.directory if self._main and self._main.directory else self._directory

    def _placed(self, program: Program, path: str) -> Program:
        """A SINUMERIK program of the host gets its stored name and the directory of its folder."""
        if program.form is not Form.SINUMERIK:
            return program
        is_named = program.name.startswith("_N_")
        return replace(
            program,
            name=program.name if is_named else stored_name_of_file(path),
            directory=program.directory or self._directory_of_folder(parent_of(path)),
        )

    def _directory_of_folder(self, folder: str) -> str:
        name = names.stored_name(name_of(resolved(folder)))
        if name.endswith("_WPD"):
            return "/_N_WKS_DIR/" + name
        return "/" + name if "/" + name in names.STANDARD_DIRS else self._directory_beside()

    # --- word address: numbers and names --------------------------------------------------------------------

    def find_number(self, number: int, digits: int = 4) -> Program | None:
        """The program with this number: in the main file, then beside it, then in the search folders.

        In a folder a file that is named so (`O0010`, `0010.nc`) wins; otherwise the one file in which a
        program of this number starts.

        Args:
            number: Program number.
            digits: Digits that file names have on this control.

        Raises:
            ProgramFileError: A file that is named so cannot be read, or several files hold this number.
        """
        known = self._by_number.get(("", number))
        if known is not None or _key("", names.program_name(number)) in self._removed:
            return known
        return self._number_on_host(number, digits)

    def find_name(self, name: str, extensions: Sequence[str] = ()) -> Program | None:
        """The program with this name (`<NAME>`, `G0200`, `T0000`), with or without one of the suffixes.

        Raises:
            ProgramFileError: The file of this name cannot be read.
        """
        suffixes = ("", *extensions)
        for suffix in suffixes:
            if found := self._by_name.get(_key("", name + suffix)):
                return found
        if _key("", name) in self._removed:
            return None
        for folder in self._call_folders():
            if path := folder.named(name, suffixes):
                programs = self._load(path)
                named = (each for each in programs if each.name.casefold() == name.casefold())
                return next(named, programs[0])
        return None

    def find_external_number(self, number: int, digits: int = 4) -> Program | None:
        """The program that M198 calls: external memory, else as `find_number`; host files are read anew."""
        known = self._by_number.get((EXTERNAL, number))
        if known is not None:
            return known
        self._files.clear()
        return self._number_on_host(number, digits) or self.find_number(number, digits)

    def _number_on_host(self, number: int, digits: int) -> Program | None:
        for folder in self._call_folders():
            if path := folder.numbered(number, digits):
                programs = self._load(path)
                return next((each for each in programs if each.number == number), programs[0])
            holders = folder.headed(number)
            if len(holders) > 1:
                files = listed(map(name_of, holders))
                raise ProgramFileError(
                    "program.number-twice", folder.path, number=f"{number:04d}", files=files
                )
            for each in self._load(holders[0]) if holders else ():
                if each.number == number:
                    return each
        return None

    # --- SINUMERIK: directories -----------------------------------------------------------------------------

    def find_sinumerik(
        self, name: str, current_directory: str, call_paths: Iterable[str] = ()
    ) -> Program | None:
        """The program that a call finds (job planning 2.1, search order of calls without path).

        Args:
            name: As written: `SUB1`, `_N_SUB1_SPF`, or with a path `/_N_CST_DIR/_N_CYCLE1_SPF`.
            current_directory: Directory of the calling program.
            call_paths: Directories of CALLPATH.

        Raises:
            ProgramFileError: The file of this name cannot be read.
        """
        directory, stored = names.split_stored_path(name)
        if directory:
            return self._first(directory, _with_types(stored))
        found = self._first(names.stored_directory(current_directory), _with_types(stored))
        subprogram = stored if stored.endswith("_SPF") else stored + "_SPF"
        for each in (names.SPF_DIR, *map(names.stored_directory, call_paths), *names.CYCLE_DIRS):
            found = found or self.find_in(each, subprogram)
        return found

    def find_in(self, directory: str, name: str) -> Program | None:
        """The program with exactly this stored name in this directory.

        Raises:
            ProgramFileError: The file of this name cannot be read.
        """
        key = _key(directory, name)
        if key in self._by_name or key in self._removed:
            return self._by_name.get(key)
        for folder in self._host_folders(directory):
            if path := folder.stored(name):
                programs = self._load(path, Form.SINUMERIK)
                program = next((each for each in programs if each.name == name), programs[0])
                found = replace(program, name=name, directory=directory, form=Form.SINUMERIK)
                return self._by_name.setdefault(key, found)
        return None

    def programs_in(self, directory: str) -> list[Program]:
        """Every program of a SINUMERIK directory, sorted by name (definition files in `/_N_DEF_DIR`).

        Raises:
            ProgramFileError: A file of that directory cannot be read.
        """
        found = (self.find_in(directory, name) for name in self._names_in(directory))
        return [program for program in found if program]

    def _names_in(self, directory: str) -> list[str]:
        """The stored names of all files of a SINUMERIK directory, sorted; none of them has been read."""
        stored = {program.name for program in self._added if program.directory == directory}
        folders = self._host_folders(directory)
        if directory == names.DEF_DIR:
            stored = {name for name in stored if name.endswith("_DEF")}
            stored.update(name for folder in folders for name in _definition_files(folder))
        else:
            stored.update(name for folder in folders for name in folder.stored_names())
        return sorted(stored)

    def main_of_workpiece(self, directory: str) -> Program | None:
        """The main program that selecting a workpiece directory selects, if it has one (job planning 2.1).

        Raises:
            ProgramFileError: A file of that directory cannot be read.
        """
        directory = names.stored_directory(directory)
        name = names.main_of_workpiece(directory, self._names_in(directory))
        return None if name is None else self.find_in(directory, name)

    def has_directory(self, directory: str) -> bool:
        """Whether a SINUMERIK directory exists (CALLPATH demands it)."""
        directory = names.stored_directory(directory)
        if directory in names.STANDARD_DIRS or any(each == directory for each, _ in self._by_name):
            return True
        return any(True for _ in self._host_folders(directory))

    def find_external(self, name: str, setting: str = "") -> Program | None:
        """The program that EXTCALL finds in the external memory (job planning 1.25.3.10).

        Args:
            name: As written: bare, relative or absolute.
            setting: Directory of SD42700 $SC_EXT_PROG_PATH.

        Raises:
            ProgramFileError: The file of this name cannot be read.
        """
        directory, stored = names.split_stored_path(name)
        is_absolute = name.replace("\\", "/").startswith("/")
        places = [directory] if is_absolute else [names.stored_directory(setting) + directory, directory]
        for place in dict.fromkeys(places):
            if found := self._first(EXTERNAL + place, _with_types(stored)):
                return found
        return None

    def _first(self, directory: str, stored_names: Iterable[str]) -> Program | None:
        for name in stored_names:
            if found := self.find_in(directory, name):
                return found
        return None

    def _host_folders(self, directory: str) -> Iterator[Folder]:
        """The folders of the host that stand for a directory.

        The main program's own directory is the folder of its file. Others are looked up by their names
        (`/_N_CUS_DIR` is `CUS.DIR`) in that folder, in the one that holds `WKS.DIR`, and in the search
        folders; the search folders themselves count as global subprograms.
        """
        path = directory.removeprefix(EXTERNAL)
        if self._beside and path == ("" if directory.startswith(EXTERNAL) else self._directory_beside()):
            yield self._folder(self._beside)
        for root in self._roots():
            folder: str | None = root
            for part in path.split("/")[1:]:
                folder = self._folder(folder).folder(part) if folder else None
            if folder and path:
                yield self._folder(folder)
        if directory == names.DEF_DIR and self._beside:
            yield self._folder(self._beside)
        if directory in (names.SPF_DIR, names.DEF_DIR, EXTERNAL):
            yield from map(self._folder, self.search)

    def _roots(self) -> Iterator[str]:
        if self._beside:
            yield self._beside
            root = resolved(self._beside)
            for part in reversed(self._directory_beside().split("/")[1:]):
                if names.stored_name(name_of(root)) != part:
                    break
                root = parent_of(root)
            else:
                yield root
        yield from self.search

    # --- host files -----------------------------------------------------------------------------------------

    def _call_folders(self) -> Iterator[Folder]:
        if self._beside:
            yield self._folder(self._beside)
        yield from map(self._folder, self.search)

    def _folder(self, path: str) -> Folder:
        return self._folders.setdefault(path, Folder(path))

    def _load(self, path: str, default: Form | None = None) -> tuple[Program, ...]:
        if path not in self._files:
            self._files[path] = load_programs(path, self.encoding, default or self.form)
        return self._files[path]


def _key(directory: str, name: str) -> tuple[str, str]:
    return directory, name.casefold()


def _definition_files(folder: Folder) -> list[str]:
    """Definition files in a folder: all of `DEF.DIR`; elsewhere names alone that nothing else can have."""
    is_theirs = "/" + names.stored_name(name_of(resolved(folder.path))) == names.DEF_DIR
    return [
        name
        for name in folder.stored_names()
        if names.is_definition_file(name) or (is_theirs and name.endswith("_DEF"))
    ]


def _with_types(stored: str) -> tuple[str, ...]:
    """The name as typed, then as subprogram, then as main program."""
    return (stored,) if stored.endswith(("_SPF", "_MPF")) else (stored, stored + "_SPF", stored + "_MPF")
