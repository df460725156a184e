"""Prepares a run: program, control, machine and setup, from what the caller names."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT
from polycnc.deferred.paths import exists, joined, parent_of, text_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages.catalogue import listed
from polycnc.messages.files import refuse_inputs
from polycnc.session.errors import SessionError
from polycnc.session.session import Session

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.memory.retained import RetainedStore
    from polycnc.program import Program, ProgramStore
    from polycnc.session.result import Result


def open_session(
    source: str | bytes | Path,
    *,
    name: str = "",
    control: str | None = None,
    machine: str | Path | None = None,
    setup: Mapping[str, object] | str | Path | None = None,
    search: str | Path | Sequence[str | Path] = (),
    encoding: str | None = None,
    files: Mapping[str, str] | None = None,
    folder: str | Path | None = None,
    block_limit: int = DEFAULT_BLOCK_LIMIT,
    keep: bool = True,
    timed: bool = True,
    bulk: bool = True,
    memory: RetainedStore | str | Path | None = None,
) -> Session:
    """Find everything that a run needs: program, control, machine, setup.

    Args:
        source: A file, or the program itself: `bytes`, or a `str` that holds a line end.
        name: Name of a program that is no file.
        control: Control id; guessed from the program where it is certain.
        machine: Built-in machine or machine file; the setup's, or else the control's usual one.
        setup: What a case writes under `setup`, or a YAML or TOML file with that.
        search: Folder, or folders, in which calls look for subprograms beside that of the program.
        encoding: Encoding of program files; detected where it is not told.
        files: Further programs as texts, by name.
        folder: Where a machine file that `setup` names is looked up, if `setup` is no file.
        block_limit: See `Session`; 1 at least.
        keep: See `Session`.
        timed: See `Session`.
        bulk: See `Session`.
        memory: The control's memory: a file, which is made where there is none, or a store. A program of it may be
            named in place of a file.

    Raises:
        SessionError: The control is unknown, or cannot be told from the program; the block limit is below 1.
        ProgramFileError: A program file cannot be read.
        FileError: The machine or the setup is wrong.
        MemoryFileError: The memory file cannot be used.
    """
    from polycnc.memory.retained import PROGRAMS, opened
    from polycnc.program import ProgramStore, decode

    if block_limit < 1:
        raise SessionError("session.block-limit", limit=block_limit)
    folders = (search,) if isinstance(search, str | PathLike) else search
    content = decode(source, encoding).text if isinstance(source, bytes) else source
    is_text = isinstance(source, bytes) or (isinstance(source, str) and "\n" in source)
    chosen = _control(control) if control else _guess(content, name, is_text=is_text, encoding=encoding)
    built, start = _machine_and_setup(machine, setup, folder, chosen)
    if start.tool_name and not chosen.tools_have_names:
        raise SessionError("session.tool-name", tool=start.tool_name, control=chosen.id)
    retained = opened(memory, chosen.id, built.id)
    store = ProgramStore(search=folders, form=chosen.form, encoding=encoding, edited=retained.table(PROGRAMS))
    program = _main_program(store, content, is_text=is_text)
    for key, text_of_file in (files or {}).items():
        store.add_text(key, text_of_file)
    return Session(
        chosen, built, start, store, program, block_limit=block_limit, keep=keep, timed=timed, bulk=bulk,
        retained=retained,
    )  # fmt: skip


def _main_program(store: ProgramStore, content: str | Path, *, is_text: bool) -> Program:
    """The program that is run: a text, a file, or one of the memory."""
    from polycnc.program import Form

    if is_text:
        program = store.add_text(_MAIN_PROGRAM if store.form is Form.SINUMERIK else "MAIN", str(content))
    else:
        program = _of_memory(store, content) or store.add_file(content)
    # The name of a text is not its own: what the memory has under that name is another program, and stays.
    store.take_edits(store, forget=not is_text)
    return program


def _of_memory(store: ProgramStore, name: str | Path) -> Program | None:
    """The program of the control's memory that is meant where no such file exists; None for none."""
    return None if exists(name) else store.kept(str(name))


#: Where a SINUMERIK program lies that comes as a text.
_MAIN_PROGRAM = "/_N_WKS_DIR/_N_TEST_WPD/_N_MAIN_MPF"


def _machine_and_setup(
    machine: str | Path | None,
    setup: Mapping[str, object] | str | Path | None,
    folder: str | Path | None,
    control: Control,
) -> tuple[Machine, Setup]:
    """The machine of the call, else that of the setup, else the control's usual one; and the setup itself."""
    from polycnc.machine import load_machine
    from polycnc.machine.setup.file import check_axes, check_bits, load_setup, parse_setup

    if setup is None or isinstance(setup, Mapping):
        start = parse_setup(setup)
    else:
        start = load_setup(setup)
        folder = parent_of(setup)
    chosen = machine or _beside(folder, start.machine) or control.default_machine
    built = load_machine(chosen)
    if start.channels:
        try:
            built = built.with_channels(start.channels)
        except KeyError as error:
            raise SessionError("session.channel-axis", axis=error.args[0], machine=built.id) from None
    file = "" if setup is None or isinstance(setup, Mapping) else setup
    check_axes(start, built, file)
    check_bits(start, control.id, control.last_bit, file)
    return built, start


def _beside(folder: str | Path | None, machine: str) -> str:
    """A machine file is looked up from the folder of the file that names it."""
    return joined(text_of(folder), machine) if folder is not None and machine.endswith(".toml") else machine


def _control(control_id: str) -> Control:
    from polycnc.control import registry

    if control_id not in registry.ids():
        raise SessionError("session.control-unknown", control=control_id, known=listed(registry.ids()))
    return registry.control(control_id)


def _guess(content: str | Path, name: str, *, is_text: bool, encoding: str | None) -> Control:
    """The control that a program is certainly written for."""
    from polycnc.control import registry
    from polycnc.program import load_programs, split_programs
    from polycnc.program.detect import guess_control
    from polycnc.program.split import Source
    from polycnc.program.text import split_lines

    if is_text:
        programs = split_programs(split_lines(str(content)), Source(name or "MAIN"))
    else:
        programs = load_programs(str(content), encoding)
    guess = guess_control(programs, name)
    if guess.control is not None:
        return _control(guess.control)
    known = listed(registry.ids())
    shown = name or (programs[0].name if is_text else str(content))
    if guess.reasons:
        reasons = "; ".join(reason.text() for reason in guess.reasons)
        raise SessionError("session.control-doubtful", program=shown, known=known, reasons=reasons)
    raise SessionError("session.control-open", program=shown, known=known)


def run(
    source: str | bytes | Path,
    *,
    control: str | None = None,
    machine: str | Path | None = None,
    setup: Mapping[str, object] | str | Path | None = None,
    search: str | Path | Sequence[str | Path] = (),
    encoding: str | None = None,
    block_limit: int = DEFAULT_BLOCK_LIMIT,
    print_to: str | Path | None = None,
    bulk: bool = True,
    memory: RetainedStore | str | Path | None = None,
) -> Result:
    """Run a program and give what came of it.

    `print_to` is a file for what the program prints (DPRNT and the like), and none that the run reads; the other
    arguments, and what is raised, are those of `open_session`.
    """
    output = None if print_to is None else text_of(print_to)
    inputs = (source, machine, setup, memory)
    refuse_inputs([output], [each for each in inputs if isinstance(each, str | PathLike)])
    session = open_session(
        source, control=control, machine=machine, setup=setup, search=search, encoding=encoding,
        block_limit=block_limit, bulk=bulk, memory=memory,
    )  # fmt: skip
    result = session.run()
    if isinstance(memory, str | PathLike):
        session.channel.retained.close()
    if output is not None:
        from pathlib import Path

        refuse_inputs([output], result.files)
        printed = (f"{row['text']}\n" for row in result.rows if row["type"] == "print")
        Path(output).write_text("".join(printed), encoding="utf-8")
    return result
