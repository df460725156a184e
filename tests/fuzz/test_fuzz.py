"""The mutator itself, and a share of what it makes, always the same."""

from __future__ import annotations

from random import Random

import pytest

from polycnc.machine import load_machine
from tests.fuzz import inputs, values, worker
from tests.fuzz.farm import Farm, Findings
from tests.fuzz.mutation import mutated

COUNT = 1_500


def test_an_input_is_made_from_its_seed_and_number_alone() -> None:
    assert [str(inputs.make(7, n)) for n in range(20)] == [str(inputs.make(7, n)) for n in range(20)]
    assert len({str(inputs.make(7, n)) for n in range(20)}) == 20


def test_what_one_input_changes_is_not_changed_for_the_next() -> None:
    before = repr(values.LEAVES)
    for n in range(2_000):
        values.changed(Random(n), {"a": {"b": [1, {"c": 2}]}, "d": [3]}, {"a": {"e": []}})
    assert repr(values.LEAVES) == before


def test_every_kind_of_input_is_made() -> None:
    assert {inputs.make(3, n).kind for n in range(300)} == set(inputs.KINDS)


def test_a_mutation_changes_a_text() -> None:
    text = "N1 G0 X10. Y5.\nN2 G1 Z-3. F100.\nN3 M30"
    changed = [mutated(Random(n), text, "G81 X1. K3\nM99") for n in range(200)]
    assert sum(one != text for one in changed) > 150
    assert any("K3" in one for one in changed)


def test_inputs_end_in_a_table_an_alarm_or_one_clear_line() -> None:
    findings = Farm(seed=1, first=0, count=COUNT, jobs=1).run()
    assert findings.inputs == COUNT
    assert not findings.roots, findings.report()


def test_a_failure_is_known_by_its_kind_and_its_place() -> None:
    with pytest.raises(KeyError) as caught:
        load_machine("mill3").channel(9)
    assert worker.root_of(caught.value) == "KeyError at machine/model.py:channel"
    with pytest.raises(KeyError) as caught:
        raise KeyError(3)
    here = "test_fuzz.py:test_a_failure_is_known_by_its_kind_and_its_place"
    assert worker.root_of(caught.value).startswith("KeyError at ")
    assert worker.root_of(caught.value).endswith(here)


def test_failures_are_grouped_by_root() -> None:
    findings = Findings(inputs=9)
    for number in range(3):
        findings.add(failed=number, root="KeyError at a.py:f", what="KeyError: 1", path="a.py:3")
    findings.add(failed=7, root="TooLong at b.py:g", what="TooLong:")
    assert findings.report().splitlines()[0] == "9 inputs, 4 failed"
    assert findings.roots["KeyError at a.py:f"].numbers == [0, 1, 2]
