"""`polycnc data`: offsets, work offsets and programs as the text files of a control, written and read."""

from __future__ import annotations

from polycnc.cli import options
from polycnc.cli.console import fail, say, show
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.output import write_whole
from polycnc.cli.progress import Waiting
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.messages.files import refuse_inputs

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel

commands = Commands("help.data")

PROGRAMS = "programs"
Files = Annotated[list[Path] | None, Argument("help.data.programs", metavar="FILE…")]


@commands.command("help.data.export", "export")
def export(
    kind: Annotated[str, Argument("help.data.kind", metavar="KIND")],
    programs: Files = None,
    control: options.Control = None,
    machine: options.Machine = None,
    setup: options.Setup = None,
    output: options.Output = None,
    _lang: options.Lang = None,
) -> int:
    """Write the data of a setup, or programs, as one file."""
    if kind == PROGRAMS:
        return _give(_tape(programs or []), output, programs or [])
    from polycnc.control.data_files import data_files

    channel = _channel(control, machine, setup)
    files = data_files(channel.control)
    if files is None:
        return fail(text("data.no-files", control=channel.control.id), 2)
    if kind not in files.KINDS:
        return fail(text("data.kind", kind=kind, known=listed((*files.KINDS, PROGRAMS))), 2)
    return _give(files.write(channel, kind), output, [setup])


@commands.command("help.data.import", "import")
def import_file(
    file: Annotated[Path, Argument("help.data.file", metavar="FILE")],
    control: options.Control = None,
    machine: options.Machine = None,
    setup: options.Setup = None,
    folder: Annotated[Path, Option("help.data.folder", "--folder", metavar="DIR")] = Path(),
    overwrite: Annotated[bool, Option("help.data.overwrite", "--overwrite")] = False,
    _lang: options.Lang = None,
) -> int:
    """Read a file into a setup, or its programs into a folder; a damaged one changes nothing."""
    from polycnc.program import decode
    from polycnc.program.folders import read_file

    content = decode(read_file(str(file)), None).text
    if _holds_programs(content):
        return _import_programs(file, content, folder, overwrite=overwrite)
    from polycnc.control.data_files import DataFileError, data_files
    from polycnc.machine.setup import edit

    refuse_inputs([setup or Path("setup.yaml")], [file])
    channel = _channel(control, machine, setup)
    files, path = data_files(channel.control), setup or Path("setup.yaml")
    if files is None:
        return fail(text("data.no-files", control=channel.control.id), 2)
    if not edit.is_writable(path):
        return fail(text("data.setup-form", setup=path), 2)
    try:
        taken = files.read(channel, content)
    except DataFileError as error:
        return fail(text("data.refused", file=file, line=error.line, reason=error.text()), 1)
    document = edit.read_document(path)
    edit.merge(document, files.as_setup(channel, taken))
    write_whole(path, edit.document_text(document, str(path)))
    say(text("data.taken", file=file, count=taken.blocks, setup=path))
    return 0


def _channel(control: str | None, machine: str | None, setup: Path | None) -> Channel:
    """A channel at power-on, with the data of the setup."""
    from polycnc.control.registry import ids
    from polycnc.session import SessionError, open_session

    if control is None:
        raise SessionError("session.control-wanted", known=listed(ids()))
    known = setup if setup is not None and setup.exists() else None
    session = open_session(b"M30\n", name="DATA", control=control, machine=machine, setup=known)
    session.run()
    return session.channel


def _give(content: str, output: Path | None, inputs: Sequence[Path | None]) -> int:
    if output is None:
        show(content)
    else:
        refuse_inputs([output], inputs)
        write_whole(output, content)
    return 0


# ---- programs ----------------------------------------------------------------------------------------------------


def _tape(paths: Sequence[Path]) -> str:
    """All programs of the files between two `%`, each with its heading."""
    from polycnc.program.store import load_programs

    lines = ["%"]
    with Waiting("polycnc data export", len(paths), "files") as waiting:
        for program in (each for path in waiting.each(paths) for each in load_programs(str(path))):
            body = [line.rstrip() for line in program.lines if line.strip() not in ("", "%")]
            if not body or not _is_heading(body[0]):
                stem = program.name.rpartition(".")[0] or program.name
                lines.append(program.name if program.number is not None else f"<{stem.upper()}>")
            lines += body
    return "\n".join([*lines, "%"]) + "\n"


def _holds_programs(content: str) -> bool:
    return any(_is_heading(line) for line in content.splitlines())


def _is_heading(line: str) -> bool:
    begin = line.strip().upper()
    return (begin[:1] == "O" and begin[1:2].isdigit()) or begin[:1] == "<"


def _import_programs(file: Path, content: str, folder: Path, *, overwrite: bool) -> int:
    """Each program of a tape becomes a file of its own; everything is looked at before the first one is written."""
    lines = [(number, line.rstrip()) for number, line in enumerate(content.splitlines(), 1) if line.strip()]
    for (number, line), reason in ((lines[0], "no-start"), (lines[-1], "no-end")):
        if not line.startswith("%") or len(lines) < 2:
            return fail(text("data.refused", file=file, line=number, reason=text(f"data.{reason}")), 1)
    found: dict[str, list[str]] = {}
    name = ""
    for number, line in lines[1:-1]:
        if _is_heading(line):
            name = _file_name(line)
            if name in found:
                return fail(text("data.program-twice", file=file, line=number, name=name), 1)
            found[name] = []
        if not name:
            return fail(
                text("data.refused", file=file, line=number, reason=text("data.no-program", file=file)), 1
            )
        found[name].append(line)
    targets = {folder / f"{name}.nc": body for name, body in found.items()}
    present = next((path for path in targets if path.exists()), None)
    if present is not None and not overwrite:
        return fail(text("data.exists", file=present), 1)
    folder.mkdir(parents=True, exist_ok=True)
    refuse_inputs(targets, [file])
    with Waiting(file.name, len(targets), "files") as waiting:
        for path, body in waiting.each(targets.items()):
            write_whole(path, "\n".join(["%", *body, "%"]) + "\n")
            say(str(path))
    return 0


def _file_name(heading: str) -> str:
    """The name of the file of a program: its number with four digits at least, or what stands in `<…>`."""
    begin = heading.strip().upper()
    if begin[0] == "<":
        return "".join(c for c in begin[1:].partition(">")[0] if c.isalnum() or c in "-_+.") or "PROGRAM"
    digits = "".join(c for c in begin[1:].split("(")[0].strip().partition(" ")[0] if c.isdigit())
    return f"O{int(digits):04d}"
