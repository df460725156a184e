"""Machines that refuse words, and outputs that words set, in runs of plain blocks: both ways give the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.language.bulk.both_ways import differences, run, scanned

if TYPE_CHECKING:
    from pathlib import Path

CONTROLS = ("fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d", "fanuc-0i-tf")
HEADS = {"fanuc-0i-tf": "G98 G1 F100."}
#: What sets the output, what it refuses from then on, and blocks of which the last but two is refused.
SETTING = {
    "an M code, and a move": ("M77", "MOVE_X", ("X1.", "M78", "X2.", "M78", "Z1.", "M77", "Z2.", "X3.")),
    "an M code, and a speed": ("M77", "S_CODE", ("S300", "X1.", "M77", "X2.", "S500")),
    "a speed, and a move": ("S_CODE", "MOVE_X", ("X1.", "X2.", "Z1.", "S500", "Z3.", "X4.")),
    "a speed, and an M code": ("S_CODE", "M8", ("X1.", "M8", "Z2.", "S500", "Z3.", "M8")),
    "a move, and a move": ("MOVE_Z", "MOVE_X", ("X1.", "X2.", "X1.", "Z3.", "Z4.", "X4.")),
    "a move, and an M code": ("MOVE_X", "M8", ("M8", "Z2.", "X1.", "X2.", "Z3.", "M8")),
    "a move, and a speed": ("MOVE_X", "S_CODE", ("S5", "Z2.", "X1.", "X2.", "Z3.", "S500")),
}


def program(control_id: str, *blocks: str) -> str:
    """Blocks between moves."""
    return "\n".join(
        (HEADS.get(control_id, "G94 G1 F100."), *blocks, "Y5." if control_id[0] != "f" else "Z5.", "M30", "")
    )


def machine_of(folder: Path, control_id: str, tables: str) -> dict[str, object]:
    """The setup of a machine with further tables."""
    path = folder / "shop.toml"
    base = "lathe-c" if control_id == "fanuc-0i-tf" else "mill4"
    path.write_text(f'base = "{base}"\n{tables}', encoding="utf-8")
    return {"machine": str(path)}


@pytest.mark.parametrize("control_id", CONTROLS)
@pytest.mark.parametrize("setting", SETTING)
def test_an_output_that_a_word_sets_refuses_the_next(tmp_path: Path, control_id: str, setting: str) -> None:
    word, refused, blocks = SETTING[setting]
    tables = (
        f'[[rule]]\nwhen = "{word}"\noutput = "LOOSE"\nlatch = "on"\n'
        f'[[alarm]]\ncode = "1500"\nwhen = "{refused} & LOOSE"\ntext = "Loose"\n'
    )
    text, setup = program(control_id, *blocks), machine_of(tmp_path, control_id, tables)
    assert [(alarm.code, alarm.line) for alarm in run(text, control_id, setup).alarms] == [
        ("1500", len(blocks) + 1)
    ]
    assert differences(text, control_id, setup) == []


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill"])
def test_an_output_that_refuses_nothing_is_set_in_a_scan(tmp_path: Path, control_id: str) -> None:
    tables = '[[rule]]\nwhen = "M77"\noutput = "LAMP"\nlatch = "on"\n'
    text = program(control_id, *("X1.", "M77", "X2.") * 10)
    setup = machine_of(tmp_path, control_id, tables)
    assert scanned(text, control_id, setup) >= 25
    assert differences(text, control_id, setup) == []
