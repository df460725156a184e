"""What is mutated: the programs and setups of the cases of this repository, its examples and its machine files."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from polycnc.control import registry
from polycnc.machine.load import BUILTIN
from tests.conformance.reading import FILES, cases_in

TESTS = Path(__file__).parents[1]
EXAMPLES = TESTS.parent / "examples"


@dataclass(frozen=True)
class Seed:
    """A run that works.

    Attributes:
        name: The case or the file.
        control: Id of the control.
        program: Text of the main program.
        setup: What the run starts from.
        files: Further programs, by name.
        operate: What an operator does; empty for a run that is only calculated.
    """

    name: str
    control: str
    program: str
    setup: dict[str, object] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)
    operate: tuple[object, ...] = ()


@cache
def seeds() -> tuple[Seed, ...]:
    """Every seed, in an order that does not change as long as the cases do not."""
    cases = [case for path in FILES for case in cases_in(path)]
    found = [
        Seed(
            case["id"], case["control"], case["program"], case.get("setup") or {}, case.get("files") or {},
            tuple(case.get("operate") or ()),
        )
        for case in cases
    ]  # fmt: skip
    for path in sorted(EXAMPLES.glob("*.nc")) + sorted(EXAMPLES.glob("*.mpf")):
        control = max((name for name in registry.ids() if path.stem.startswith(name)), key=len, default="")
        if control:
            found.append(Seed(path.name, control, path.read_text(encoding="utf-8")))
    return tuple(found)


@cache
def seeds_of(control: str) -> tuple[Seed, ...]:
    """The seeds of one control."""
    return tuple(seed for seed in seeds() if seed.control == control)


@cache
def machine_files() -> tuple[tuple[str, str], ...]:
    """The shipped machine files: id and text."""
    return tuple(
        (path.stem, path.read_text(encoding="utf-8")) for path in sorted(Path(BUILTIN).glob("*.toml"))
    )
