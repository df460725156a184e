"""Runs SINUMERIK programs and gives back what a test looks at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.session import open_session

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.session import Result


def run(
    program: str, files: Mapping[str, str] | None = None, setup: Mapping[str, Any] | None = None
) -> Result:
    """Run a main program on the default machine."""
    session = open_session(
        program + "\n", control="sinumerik-840d", files=files, setup=setup, block_limit=100_000
    )
    return session.run()


def value(program: str, name: str = "R1", **more: Any) -> Any:
    """A variable at the end of a program that must not alarm."""
    result = run(program, **more)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == []
    return result.variables[name]


def values(program: str, *names: str, **more: Any) -> list[Any]:
    """Variables at the end of a program that must not alarm."""
    result = run(program, **more)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == []
    return [result.variables[name] for name in names]


def alarm(program: str, **more: Any) -> tuple[str, int, int]:
    """Code, line and column of the one alarm of a program."""
    alarms = run(program, **more).alarms
    assert len(alarms) == 1
    return alarms[0].code, alarms[0].line, alarms[0].column


def targets(program: str, **more: Any) -> list[dict[str, float]]:
    """Where the moves of a program go."""
    return [row["to"] for row in run(program, **more).rows if "to" in row]
