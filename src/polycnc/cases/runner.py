"""Runs cases: prepares the run that a case describes, lets it run, compares."""

from __future__ import annotations

from polycnc.cases import compare
from polycnc.cases.format import Case, CaseError, case_id, parse_case
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.machine.errors import FileError
from polycnc.memory.file import MemoryFileError
from polycnc.memory.retained import InMemoryStore
from polycnc.messages import text
from polycnc.messages.errors import place_of_failure
from polycnc.program import ProgramFileError
from polycnc.session import Result, SessionError, open_session
from polycnc.toolpath.kinds import TYPE_NAMES, Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from polycnc.cases.selection import Selection
    from polycnc.memory.file import FileStore
    from polycnc.messages import Alarm

Status = Literal["passed", "failed", "skipped"]
#: As many blocks as no case needs.
CASE_BLOCK_LIMIT = 1_000_000
_MOVES = frozenset(TYPE_NAMES) - {TYPE_NAMES[Kind.EVENT]}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a case. `readable` is false where the case itself does not follow the format."""

    id: str
    status: Status
    message: str = ""
    feature: str = ""
    control: str = ""
    readable: bool = True


def run_cases(
    data: Iterable[object], selection: Selection, folder: Path, memory: FileStore | None = None
) -> Iterator[Outcome]:
    """Run the selected cases of a file, in order.

    Args:
        data: The cases.
        selection: Which of them.
        folder: The folder of the file.
        memory: What every case begins with; nothing that a case does lasts.
    """
    for number, entry in enumerate(data, 1):
        name = case_id(entry, number)
        if not selection.names(name):
            continue
        try:
            case = parse_case(entry)
        except CaseError as error:
            yield Outcome(name, "failed", str(error), readable=False)
            continue
        yield run_case(case, folder, memory=memory) if selection.features(case.feature) else _skipped(case)


def _skipped(case: Case) -> Outcome:
    return Outcome(
        case.id, "skipped", text("case.feature-skipped", feature=case.feature), case.feature, case.control
    )


def run_case(
    case: Case, folder: Path, block_limit: int = CASE_BLOCK_LIMIT, memory: FileStore | None = None
) -> Outcome:
    """Run one case; one that runs longer than `block_limit` blocks has got into a loop."""
    try:
        if memory is not None and memory.control != case.control:
            raise MemoryFileError(
                "memory.other-control", file=memory.path, held=memory.control, wanted=case.control
            )
        kept = None if memory is None else InMemoryStore()
        if memory is not None and kept is not None:
            memory.copy_to(kept.table)
        differences = (
            _operated(case, folder, kept) if case.operate else _differences(case, folder, block_limit, kept)
        )
    except (CaseError, SessionError, FileError, ProgramFileError, MemoryFileError) as error:
        return Outcome(case.id, "failed", str(error), case.feature, case.control, readable=False)
    except Exception as error:  # noqa: BLE001 - a mistake of polycnc in one case must not end all others
        where = place_of_failure(error)
        message = text("case.internal", error=f"{type(error).__name__}: {error}", where=where)
        return Outcome(case.id, "failed", message, case.feature, case.control)
    status: Status = "failed" if differences else "passed"
    return Outcome(case.id, status, "; ".join(differences), case.feature, case.control)


def _operated(case: Case, folder: Path, memory: InMemoryStore | None) -> list[str]:
    from polycnc.cases.operation import operated

    return operated(case, folder, memory)


def _differences(case: Case, folder: Path, block_limit: int, memory: InMemoryStore | None) -> list[str]:
    # A text without a line end would be taken for the name of a file.
    session = open_session(
        case.program.removesuffix("\n") + "\n",
        control=case.control,
        setup=case.setup,
        files=case.files,
        folder=folder,
        block_limit=block_limit,
        memory=memory,
    )
    result = session.run()
    expect = case.expect
    positions = compare.Positions(expect.tolerance, result.display.modulo_axes)
    moves = [row for row in result.rows if row["type"] in _MOVES]
    events = [row for row in result.rows if row["type"] not in _MOVES]
    differences = compare.compare_alarms(
        result.control,
        expect.alarms,
        result.alarms,
        lambda alarm: _block(result, alarm),
        lambda alarm: _shown(result, alarm),
    )
    if expect.moves is not None:
        exact = expect.moves_match == "exact"
        differences += compare.compare_moves(expect.moves, moves, positions, exact=exact)
    if expect.final is not None:
        final = result.final
        differences += compare.compare_final(expect.final, final["work"], final["machine"], positions)
    differences += compare.compare_variables(expect.variables, result.variables.__getitem__, expect.tolerance)
    differences += compare.compare_events(expect.events, events, expect.tolerance)
    exact = expect.stops_match == "exact"
    return differences + compare.compare_stops(expect.stops, result.stops, expect.no_stop, exact=exact)


def _block(result: Result, alarm: Alarm) -> str:
    """The N word of the block in which an alarm arose."""
    if alarm.block:
        return alarm.block
    program = result.program_of(alarm)
    return program.block_name(alarm.line) if program is not None else ""


def _shown(result: Result, alarm: Alarm) -> str:
    place = f"{alarm.program}:{alarm.line}" + (f":{alarm.column}" if alarm.column else "")
    return f"{alarm.code} {result.alarm_text(alarm)} ({place})"
