"""Running a few lines on the control."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.session import open_session

if TYPE_CHECKING:
    from polycnc.session import Result


def run(*lines: str, **setup: Any) -> Result:
    """Run a program of these lines; keywords are keys of the setup."""
    return open_session("\n".join((*lines, "M30")) + "\n", control="sinumerik-840d", setup=setup).run()


def moves(result: Result) -> list[tuple[str, dict[str, float]]]:
    """Type and work position of every move."""
    return [(row["type"], row["to"]) for row in result.rows if "to" in row]


def codes(result: Result) -> list[tuple[str, int]]:
    """Code and line of every alarm."""
    return [(alarm.code, alarm.line) for alarm in result.alarms]
