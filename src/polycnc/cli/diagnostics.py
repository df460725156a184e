"""What a run found, as values: alarms with their places, and what is odd about the files."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Literal
from polycnc.messages import Alarm, text
from polycnc.messages.errors import place_of_failure
from polycnc.messages.files import reason_with_file

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.messages import AlarmError
    from polycnc.session import Result

Severity = Literal["error", "warning"]


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a file; `line` and `column` count from 1, 0 is unknown."""

    file: str
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        return ":".join([self.file, *(str(number) for number in (self.line, self.column) if number)])


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding.

    Attributes:
        place: Where it is.
        code: The control's alarm code, or polycnc's own word for a warning.
        message: What it is, in the language of the run.
        rule: Stable id of what was found, such as `fanuc/PS0010`.
        severity: An alarm is an error.
        source: Text of the line.
        calls: The calls that led there, outermost first.
        summary: What the rule is about, without the values of this case.
        cause: Why it comes, where the catalogue tells it.
        remedy: What to do about it, where the catalogue tells it.
    """

    place: Place
    code: str
    message: str
    rule: str
    severity: Severity = "error"
    source: str = ""
    calls: tuple[Place, ...] = ()
    summary: str = ""
    cause: str = ""
    remedy: str = ""

    @property
    def unreadable(self) -> bool:
        """Whether the program could not be run at all."""
        return self.rule in _UNREADABLE

    def __str__(self) -> str:
        return f"{self.place}: {self.code} {self.message}".rstrip()


_UNREADABLE = ("polycnc/unreadable", "polycnc/internal")


def unreadable(name: str, error: Exception) -> Diagnostic:
    """A file that cannot be run, with what its error says; the error may name file, line and column itself."""
    message = reason_with_file(error) if isinstance(error, OSError) else str(error)
    return Diagnostic(Place(name), "unreadable", message, "polycnc/unreadable")


def internal(name: str, error: Exception) -> Diagnostic:
    """A mistake of polycnc itself that a file brings to light, with where it came up."""
    told = f"{type(error).__name__}: {error}"
    message = text("check.internal", file=name, error=told, where=place_of_failure(error))
    return Diagnostic(Place(name), "internal", message, "polycnc/internal")


def diagnostics_of(result: Result, main: str) -> list[Diagnostic]:
    """The findings of a run, each place and cause once; `main` is the main file as the user named it."""
    found = [_of_alarm(result, alarm, main) for alarm in result.alarms]
    found += _of_texts(result, main)
    found += _of_files(result, main)
    return list({(d.place, d.code, d.message): d for d in found}.values())


def _of_alarm(result: Result, alarm: Alarm, main: str) -> Diagnostic:
    catalogue = result.catalogue
    known = alarm.code in catalogue
    program = result.program_of(alarm)
    index = alarm.line - program.first_line if program is not None else -1
    source = program.lines[index] if program is not None and 0 <= index < len(program.lines) else ""
    calls = tuple(Place(result.file_of(name) or main, line) for name, line in alarm.call_chain)
    return Diagnostic(
        place=Place(_shown_file(alarm.file, result, main), alarm.line, alarm.column),
        code=alarm.code,
        message=result.alarm_text(alarm),
        rule=f"{alarm.control.partition('-')[0]}/{alarm.code}",
        source=source,
        calls=calls,
        summary=catalogue.text(alarm.code) if known else "",
        cause=catalogue.note(alarm.code, "cause", args=alarm.args) if known else "",
        remedy=catalogue.note(alarm.code, "remedy", args=alarm.args) if known else "",
    )


def _shown_file(file: str, result: Result, main: str) -> str:
    """The main file as the user named it, others by their path."""
    return main if not file or file == result.program.path else file


def _of_texts(result: Result, main: str) -> Iterable[Diagnostic]:
    """What cannot be read in texts that are read as a whole, whether the run came there or not."""
    for program in result.channel.programs:
        code = result.channel.executable(program)
        mistakes: Iterable[AlarmError] = getattr(code, "mistakes", ())
        for error in mistakes:
            alarm = Alarm(
                control=result.control.id,
                code=error.code,
                program=program.name,
                line=error.line,
                column=error.column,
                args=dict(error.args_by_name),
                hint=error.hint,
                file=program.path,
            )
            yield _of_alarm(result, alarm, main)
        unclosed: Iterable[int] = getattr(code, "unclosed", ())
        for line in unclosed:
            place = Place(_shown_file(program.path, result, main), line)
            yield Diagnostic(place, "unclosed", text("check.unclosed"), "polycnc/unclosed", "warning")


def _of_files(result: Result, main: str) -> Iterable[Diagnostic]:
    """What is odd about the files: characters that could not be read, programs that no call reaches."""
    program = result.program
    if not any(line.strip(" \t%") for line in program.lines):
        yield Diagnostic(Place(main), "empty", text("check.empty"), "polycnc/empty", "warning")
    if program.replaced:
        message = text("check.replaced", count=program.replaced, encoding=program.encoding)
        yield Diagnostic(Place(main), "encoding", message, "polycnc/encoding", "warning")
    for hidden in result.channel.store.shadowed:
        message = text("check.shadowed", program=hidden.name)
        place = Place(_shown_file(hidden.path, result, main), hidden.first_line)
        yield Diagnostic(place, "shadowed", message, "polycnc/shadowed", "warning")
