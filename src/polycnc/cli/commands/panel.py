"""`polycnc panel`: a control to operate in the browser."""

from __future__ import annotations

from functools import partial
from secrets import token_urlsafe

from polycnc.cli import options
from polycnc.cli.console import fail, say
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.progress import end as end_of_waiting
from polycnc.deferred.contexts import ExitStack
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text
from polycnc.messages.catalogue import language

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.mainrun import VirtualControl
    from polycnc.panel.teaching.exercise import Exercise
    from polycnc.panel.web.desk import Desk

commands = Commands()
PORT = 8620
_Exercise = Annotated[str, Option("help.panel.exercise", "--exercise", metavar="FILE[#ID]")]
_Sheet = Annotated[Path | None, Option("help.panel.sheet", "--sheet", metavar="FILE")]
_Record = Annotated[Path | None, Option("help.panel.record", "--record", metavar="FILE")]
_Replay = Annotated[Path | None, Option("help.panel.replay", "--replay", metavar="FILE")]


def _no_number(value: float) -> str:
    """Click takes what is no number for one in every range."""
    return "nan is not in the range 0.01<=x<=1000.0." if value != value else ""


@commands.command("help.panel", runs="file")
def panel(
    file: Annotated[Path | None, Argument("help.panel.file", metavar="FILE")] = None,
    control: Annotated[list[str] | None, Option("help.option.control", "--control", metavar="ID")] = None,
    machine: options.Machine = None,
    setup: options.Setup = None,
    search: options.Search = None,
    memory: options.Memory = None,
    card: Annotated[Path | None, Option("help.panel.card", "--card", metavar="DIR")] = None,
    exercise: _Exercise = "",
    sheet: _Sheet = None,
    record: _Record = None,
    replay: _Replay = None,
    host: Annotated[str, Option("help.panel.host", "--host", metavar="ADDRESS")] = "127.0.0.1",
    port: Annotated[int, Option("help.panel.port", "--port", metavar="NUMBER", limits=(1, 65535))] = PORT,
    speed: Annotated[
        float,
        Option("help.panel.speed", "--speed", metavar="NUMBER", limits=(0.01, 1000.0), refusal=_no_number),
    ] = 1.0,
    no_open: Annotated[bool, Option("help.panel.no-open", "--no-open")] = False,
    _lang: options.Lang = None,
) -> int:
    """Serve one control, or several, each under its own address."""
    from polycnc.cli.output import refuse_unwritable
    from polycnc.control.registry import ids
    from polycnc.messages.catalogue import listed
    from polycnc.panel.web.desk import Desk
    from polycnc.panel.web.server import build, check_address, closing, needs_token, serve
    from polycnc.session import SessionError

    task = _exercise(exercise) if exercise else None
    chosen = control or ([task.control] if task is not None else [])
    if not chosen:
        raise SessionError("session.control-wanted", known=listed(ids()))
    if memory is not None and len(chosen) > 1:
        return fail(text("panel.one-memory"), 2)
    if (task is not None and chosen != [task.control]) or ((replay or record) and len(chosen) > 1):
        return fail(text("panel.one-control"), 2)
    if card is not None and not card.is_dir():
        return fail(text("file.unreadable", file=card, reason=text("file.no-folder")), 2)
    for output in filter(None, (sheet, record)):
        refuse_unwritable(output)
    check_address(host, port)
    desks: dict[str, Desk] = {}
    for each in chosen:
        made = _control(each, machine, setup, search or (), memory, task)
        if file is not None:
            made.load(file)
        desks[each if each not in desks else f"{each}-{len(desks) + 1}"] = Desk(made, speed, card)
    _teach(next(iter(desks.values())), task, replay)
    token = token_urlsafe(16) if needs_token(host) else ""
    build(desks, language(), token)
    named = f"[{host}]" if ":" in host else host
    say(f"http://{named}:{port}/" + (f"?token={token}" if token else ""))
    end_of_waiting()
    with closing() as interrupts:
        try:
            serve(interrupts, host=host, port=port, opens=not no_open)
        finally:
            _keep(desks.values(), sheet, record)
    return 0


def _control(
    control: str,
    machine: str | None,
    setup: Path | None,
    search: Sequence[Path],
    memory: Path | None,
    task: Exercise | None,
) -> VirtualControl:
    """A control whose machine answers to every fault, with the setup and the program of an exercise."""
    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.equipment import equipment
    from polycnc.panel.teaching.faults import with_faults

    given = task.setup if task is not None and setup is None else setup
    known, built, start = equipment(control, machine, given)
    made = VirtualControl(
        known, machine=with_faults(built, known.id), setup=start, search=search,
        files=task.files if task is not None else {}, retained=memory,
    )  # fmt: skip
    if task is not None and task.program:
        made.load(task.program.rstrip("\n") + "\n")
    return made


def _exercise(named: str) -> Exercise:
    """The exercise that `FILE#ID` names; the first of the file without an id."""
    from polycnc.messages.catalogue import listed
    from polycnc.panel.teaching.exercise import ExerciseError, load_exercises

    file, _, wanted = named.partition("#")
    found = load_exercises(Path(file))
    for each in found:
        if wanted in ("", each.id):
            return each
    raise ExerciseError("exercise.unknown", name=wanted, known=listed(each.id for each in found))


def _teach(desk: Desk, task: Exercise | None, replay: Path | None) -> None:
    """Give a desk its exercise, and what it is to do again."""
    from polycnc.panel.teaching.lesson import Lesson
    from polycnc.panel.teaching.recording import Replay, load_acts
    from polycnc.panel.web.messages import perform

    if task is not None:
        desk.lesson = Lesson(task, desk.control, desk.screen)
    if replay is not None:
        acts = load_acts(replay, desk.control.control.id)
        desk.replay = Replay(desk.control, acts, partial(perform, desk))


def _keep(desks: Iterable[Desk], sheet: Path | None, record: Path | None) -> None:
    """Write what a teacher takes away from the first control, and close all; each whatever becomes of the others."""
    from polycnc.cli.output import write_whole

    with ExitStack() as last:
        for each in desks:
            last.callback(each.control.close)
        desk = next(iter(desks))
        if sheet is not None and desk.lesson is not None:
            last.callback(lambda lesson: write_whole(sheet, lesson.sheet(language())), desk.lesson)
        if record is not None:
            last.callback(lambda: write_whole(record, desk.recording.text()))
