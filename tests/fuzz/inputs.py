"""The input of a number, and what comes of it.

An input is one of four kinds: a changed program, a changed setup, a changed machine file, or a changed program under
the hands of an operator. What it starts from runs on a control, and so does it.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from itertools import islice
from math import isfinite
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from polycnc.cases.format import CaseError
from polycnc.cases.operation import Operator
from polycnc.mainrun import VirtualControl
from polycnc.messages import UserError
from polycnc.session import open_session
from tests.fuzz import values
from tests.fuzz.mutation import mutated
from tests.fuzz.seeds import Seed, machine_files, seeds, seeds_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.interface import Control
    from polycnc.messages import Alarm

BLOCK_LIMIT = 100_000
#: Rows that are looked at.
MOST_ROWS = 10_000
#: Simulated time after which an operator leaves, s.
PATIENCE_S = 60.0
KINDS, WEIGHTS = ("program", "setup", "machine", "operated"), (78, 12, 6, 4)


class WrongTableError(AssertionError):
    """What a run has given is no table of finite numbers."""


@dataclass(frozen=True)
class Input:
    """What is given to polycnc.

    Attributes:
        kind: Which part has been changed.
        seed: What it was made from.
        program: Text of the main program.
        setup: Text of a setup file (YAML); empty where `seed.setup` is given as it is.
        machine: Text of a machine file; empty for that of the setup.
    """

    kind: str
    seed: Seed
    program: str
    setup: str = ""
    machine: str = ""

    def __str__(self) -> str:
        parts = [f"{self.kind} of {self.seed.name} ({self.seed.control})", self.program]
        parts += [self.setup or repr(self.seed.setup), self.machine]
        return "\n----\n".join(parts)


def make(seed: int, number: int) -> Input:
    """The input of a number; the same whenever the seeds are the same."""
    random = Random(f"{seed}-{number}")
    kind = random.choices(KINDS, WEIGHTS)[0]
    chosen = random.choice(seeds())
    near = random.choice(seeds_of(chosen.control) if random.random() < 0.8 else seeds())
    if kind == "operated":
        chosen = random.choice([each for each in seeds() if each.operate])
    if kind == "setup":
        setup = values.document(random, values.changed(random, chosen.setup, near.setup))
        if random.random() < 0.3:
            setup = mutated(random, setup, values.document(random, near.setup))
        return Input(kind, chosen, chosen.program, setup)
    if kind == "machine":
        (_, text), (_, other) = random.choices(machine_files(), k=2)
        return Input(kind, chosen, chosen.program, machine=mutated(random, text, other))
    return Input(kind, chosen, mutated(random, chosen.program, near.program))


def run(given: Input, folder: Path) -> str:
    """Run an input and look at everything a user may look at; gives the alarm, or what was refused, in one line.

    Args:
        given: The input.
        folder: An empty folder for the files of the input.
    """
    try:
        if given.kind == "operated":
            return _operated(given)
        return _calculated(given, folder)
    except UserError as error:
        told = " ".join(error.text("en").split()) and " ".join(error.text("zh-TW").split())
        return f"refused: {told}"


def _calculated(given: Input, folder: Path) -> str:
    setup: object = given.seed.setup
    if given.setup:
        setup = _file(folder / "setup.yaml", given.setup)
    machine = _file(folder / "machine.toml", given.machine) if given.machine else None
    session = open_session(
        given.program + "\n", control=given.seed.control, setup=setup, machine=machine,  # type: ignore[arg-type]
        files=given.seed.files, folder=folder, block_limit=BLOCK_LIMIT,
    )  # fmt: skip
    result = session.run()
    for number, channel in result.channels.items():
        _look(islice(channel.display.records(), MOST_ROWS), f"channel {number}")
    _look([dict(result.final)], "final")
    if not isfinite(result.time):
        raise WrongTableError(f"time {result.time}")
    for name in result.variables:
        result.variables[name]
    return _alarms(result.control, result.alarms)


def _operated(given: Input) -> str:
    control = VirtualControl(given.seed.control, setup=given.seed.setup, files=given.seed.files)
    control.load(given.program + "\n")
    operator = Operator(control)
    for step in given.seed.operate:
        if step == "run":
            control.run(limit_s=PATIENCE_S)
        else:
            try:
                operator.does(step)  # type: ignore[arg-type]
            except CaseError:
                continue
    shown = control.positions
    _look([{"work": shown.work, "machine": shown.machine}], "positions")
    return _alarms(control.control, control.alarms)


def _file(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8", errors="replace", newline="\n")
    return path


def _look(rows: Iterable[object], name: str) -> None:
    """Every row can be written, and holds finite numbers."""
    for row in rows:
        try:
            json.dumps(row, allow_nan=False)
        except ValueError as error:
            raise WrongTableError(f"{name}: {error}") from None


def _alarms(control: Control, alarms: Iterable[Alarm]) -> str:
    told = []
    for alarm in alarms:
        for language in ("en", "zh-TW"):
            text = alarm.told_by(control.catalogue).text_in(language)
            if "\n" in text:
                raise WrongTableError(f"text of {alarm.code}")
        told.append(alarm.code)
    return " ".join(told)
