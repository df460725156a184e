"""Fails where too many expressions of `polycnc` have the type Any: what a type checker does not check.

`python tests/any_exprs.py REPORT` reads what `mypy --any-exprs-report` has written, and names the modules with most.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

#: Percentage of the expressions that may have the type Any.
MOST = 1.5
#: So many modules are named.
SHOWN = 20


class Module(NamedTuple):
    """A module, how many of its expressions have the type Any, and how many there are."""

    name: str
    anys: int
    expressions: int


def modules(report: str) -> list[Module]:
    """The modules of the package in a report: lines with a name, two counts and a percentage."""
    rows = (line.split() for line in report.splitlines())
    return [Module(row[0], int(row[1]), int(row[2])) for row in rows if row and row[0].startswith("polycnc")]


def share(found: list[Module]) -> float:
    """Percentage of the expressions that have the type Any."""
    return 100.0 * sum(module.anys for module in found) / sum(module.expressions for module in found)


def complaint(found: list[Module], most: float = MOST) -> str:
    """What to say where there are too many; empty where there are not."""
    if share(found) <= most:
        return ""
    worst = sorted(found, key=lambda module: -module.anys)[:SHOWN]
    named = "\n".join(f"{module.anys:6} of {module.expressions:5}  {module.name}" for module in worst)
    return (
        f"{share(found):.2f} % of the expressions have the type Any, more than {most} %. Most are in\n{named}"
    )


if __name__ == "__main__":
    sys.exit(complaint(modules(Path(sys.argv[1]).read_text(encoding="utf-8"))) or 0)
