"""Programs on the lathe, for its tests."""

from __future__ import annotations

from typing import Any

from polycnc.session import Result, open_session


def run(program: str, **setup: Any) -> Result:
    """The result of a program."""
    return open_session(program + "\n", control="fanuc-0i-tf", setup=setup).run()


def moves(result: Result) -> list[tuple[str, float, float]]:
    """Kind, X as diameter and Z of every move."""
    return [
        (row["type"], round(row["to"]["X"], 4), round(row["to"]["Z"], 4))
        for row in result.rows
        if "to" in row
    ]


def alarms(result: Result) -> list[str]:
    """Codes of all alarms."""
    return [alarm.code for alarm in result.alarms]
