"""What the scanner is told of formulas on controls with custom macro B."""

from __future__ import annotations

from array import array
from math import inf, isnan

import pytest

from polycnc.channel.channel import Channel
from polycnc.control.registry import control
from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
from polycnc.control.word_address.macro_b.plain import MacroPlainBlocks
from polycnc.language.bulk.layout import VARIABLES, Operation
from polycnc.machine import load_machine
from polycnc.machine.setup.file import parse_setup
from polycnc.program import ProgramStore

TEXT = "O1\n#1=1.5\n#33=-2\n#101=7\n#500=0.25\n#599=0\nM0\nM30\n"


def stopped(control_id: str = "fanuc-m") -> tuple[MacroPlainBlocks, Channel]:
    """A channel that stands at M0, and what it tells of plain blocks."""
    built = control(control_id)
    assert isinstance(built, CustomMacroControl)
    store = ProgramStore(form=built.form)
    program = store.add_text("MAIN", TEXT)
    channel = Channel(built, load_machine(built.default_machine), parse_setup({}), store)
    next(iter(channel.run(program)))
    plain = built.plain_blocks(channel)
    assert isinstance(plain, MacroPlainBlocks)
    assert plain.spelling.formulas
    return plain, channel


@pytest.mark.parametrize("control_id", ["fanuc-m", "fanuc-0i-tf", "meldas-m"])
def test_local_and_common_variables_are_at_hand(control_id: str) -> None:
    plain, channel = stopped(control_id)
    variables = array("d", (inf,)) * VARIABLES
    plain.put_variables(channel, variables)
    assert [variables[n] for n in (1, 33, 101, 500, 599)] == [1.5, -2.0, 7.0, 0.25, 0.0]
    assert all(isnan(variables[n]) for n in (2, 32, 100, 199, 501, 999))
    assert all(variables[n] == inf for n in (0, 34, 99, 200, 499))
    assert len(variables) == VARIABLES


def test_numbers_of_formulas_are_counted_without_those_of_words() -> None:
    plain, channel = stopped()
    keys, calculated = plain.formulas(channel, "N5 G1 Z2.5 X[#1+2.5] Y-3. F#101 (C)")
    assert keys == ("G1", "Z.", "X#", "Y.", "F#")
    assert calculated == (
        Operation.VARIABLE_OR_ZERO, 0, Operation.NUMBER, 1, Operation.ADD, 0, Operation.STORE, 1,
        Operation.VARIABLE, 2, Operation.STORE, 3,
    )  # fmt: skip


@pytest.mark.parametrize(
    "line",
    ["X#1 M#1", "X[#5001]", "X[1", "/X#1", "X#1 /Y2.", "#1=2", "X#1 #2=3", "X[ROUND[#1]]", "X1X"],
)
def test_other_lines_are_the_interpreters(line: str) -> None:
    plain, channel = stopped()
    assert plain.formulas(channel, line)[1] is None
