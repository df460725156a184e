"""`polycnc memory`: the memory of a control in a file, made, looked at, written as text files and read from them."""

from __future__ import annotations

from polycnc.cli import options
from polycnc.cli.console import fail, note, say, show
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.output import write_whole
from polycnc.cli.progress import Waiting
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.messages.files import refuse_inputs

if TYPE_CHECKING:
    from polycnc.memory.file import FileStore

commands = Commands("help.memory")

File = Annotated[Path, Argument("help.memory.file", metavar="FILE")]
#: What SQLite may leave beside a memory.
_BESIDE = ("-wal", "-shm", "-journal")


@commands.command("help.memory.new")
def new(
    file: File,
    control: options.Control = None,
    machine: options.Machine = None,
    setup: options.Setup = None,
    _lang: options.Lang = None,
) -> int:
    """Make a memory, as a control has it that nobody has worked with, or with what a setup says."""
    from polycnc.control.registry import ids
    from polycnc.interchange import setups
    from polycnc.interchange.power_on import NOTHING
    from polycnc.session import SessionError, open_session

    if control is None:
        raise SessionError("session.control-wanted", known=listed(ids()))
    if file.exists():
        return fail(text("memory.there", file=file), 1)
    refuse_inputs([file], [setup, machine])
    try:
        session = open_session(
            NOTHING, name="DATA", control=control, machine=machine, setup=setup, memory=file
        )
        store, built = session.channel.retained, machine or session.channel.machine.id
        try:
            session.run()
            if setup is not None:
                for line in setups.take(store, control, built, setup):
                    note(line)
            store.commit()
        finally:
            store.close()
    except BaseException:
        for each in (file, *(file.with_name(file.name + end) for end in _BESIDE)):
            each.unlink(missing_ok=True)
        raise
    say(text("memory.made", file=file, control=control, machine=session.channel.machine.id))
    return 0


@commands.command("help.memory.show", "show")
def show_memory(file: File, _lang: options.Lang = None) -> int:
    """What a memory is of, and what it holds."""
    from polycnc.memory.file import FileStore

    with FileStore(file) as store:
        say(text("memory.of", control=store.control, machine=store.machine))
        for name, channel, count in store.contents():
            table = text(f"memory.table.{name.replace(' ', '-')}")
            said = "memory.table" if channel == 0 else "memory.table-of-channel"
            say(text(said, table=table, channel=channel, count=count))
    return 0


@commands.command("help.memory.export")
def export(
    file: File,
    kinds: Annotated[list[str] | None, Argument("help.memory.kinds", metavar="KIND…")] = None,
    machine: options.Machine = None,
    folder: Annotated[Path | None, Option("help.memory.folder", "--folder", metavar="DIR")] = None,
    output: options.Output = None,
    overwrite: Annotated[bool, Option("help.memory.overwrite", "--overwrite")] = False,
    _lang: options.Lang = None,
) -> int:
    """Write what a memory holds as the control's own text files."""
    from polycnc.interchange.writing import write
    from polycnc.memory.file import FileStore

    with FileStore(file) as store:
        written = write(store, store.control, machine or store.machine, kinds or ())
    if folder is None and len(written.files) != 1:
        return fail(text("memory.folder-wanted", files=listed(written.files)), 2)
    if folder is None:
        content = next(iter(written.files.values()))
        if output is None:
            show(content)
        else:
            refuse_inputs([output], [file])
            write_whole(output, content)
        return 0
    targets = {folder / name: content for name, content in written.files.items()}
    present = next((path for path in targets if path.exists()), None)
    if present is not None and not overwrite:
        return fail(text("data.exists", file=present), 1)
    refuse_inputs(targets, [file])
    folder.mkdir(parents=True, exist_ok=True)
    with Waiting(file.name, len(targets), "files") as waiting:
        for path, content in waiting.each(targets.items()):
            write_whole(path, content)
            say(str(path))
    for table, key in written.left_out:
        note(text("memory.left-out", table=text(f"memory.table.{table.replace(' ', '-')}"), entry=key))
    return 1 if written.left_out else 0


@commands.command("help.memory.import", "import")
def import_files(
    file: File,
    files: Annotated[list[Path], Argument("help.memory.texts", metavar="TEXT…")],
    machine: options.Machine = None,
    _lang: options.Lang = None,
) -> int:
    """Read text files of the control, or setups, into a memory: all of them, or nothing."""
    from polycnc.memory.file import FileStore

    with FileStore(file) as store:
        _take(store, files, machine)
    say(text("memory.taken", count=len(files), file=file))
    return 0


def _take(store: FileStore, files: list[Path], machine: str | None) -> None:
    from polycnc.interchange.reading import Reading

    reading = Reading(store, store.control, machine or store.machine)
    reading.take(files)
    for line in reading.notes:
        note(line)
    store.commit()
