"""Going back to a block of a case gives the same rest of it: rows, contexts, variables, alarms, waits."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from polycnc.cases.features import case_files
from polycnc.cases.format import Case, case_id, parse_case
from polycnc.cases.reading import read_cases
from polycnc.channel.states.snapshot import Snapshot
from polycnc.session import open_session
from tests.channel.states.test_snapshot import rest_of, state_of

HERE = Path(__file__).parent
#: One case in so many; all of them take minutes.
EVERY = 12
CASES = [
    (parse_case(data), case_id(data, number), path)
    for path in case_files(HERE)
    for number, data in enumerate(read_cases(path), 1)
]
SOME = [(case, name, path) for case, name, path in CASES if not case.operate][::EVERY]


@pytest.mark.parametrize(
    ("case", "path"), [(case, path) for case, _, path in SOME], ids=[name for _, name, _ in SOME]
)
def test_the_rest_of_a_case_is_the_same_from_a_block_on(case: Case, path: Path) -> None:
    session = open_session(
        case.program.removesuffix("\n") + "\n",
        control=case.control,
        setup=case.setup,
        files=case.files,
        folder=path.parent,
        block_limit=20_000,
    )
    session.channel.single_block = session.channel.block_by_block = True
    run = session.group.run(session.result.program)
    for _ in range(Random(case.id).randint(0, 12)):
        if next(run, None) is None:
            break
    here, snapshot = state_of(session.group), Snapshot(session.group)
    first = rest_of(run, session.group)
    for _ in range(2):
        snapshot.restore()
        assert state_of(session.group) == here
        assert rest_of(run, session.group) == first
