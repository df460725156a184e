"""A control that runs one program after the other keeps nothing of them."""

from __future__ import annotations

import gc
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.channel.channel import Channel
from polycnc.control.registry import control
from polycnc.language.expressions.shapes import Shapes
from polycnc.language.word_address.patterns import Patterns
from polycnc.machine import load_machine
from polycnc.machine.setup.values import Setup
from polycnc.program import Form, ProgramStore

if TYPE_CHECKING:
    from polycnc.control.interface import Control

#: Programs of each control, all different; the first ones fill what is bounded.
PROGRAMS, FIRST = 2000, 500
#: Shapes that the controls keep here, so that they are soon full.
SHAPES = 64
#: Blocks of memory that may be there afterwards, for what is bounded changes: fewer than programs.
FEW = 1200

MACRO_B = """O{n}
#{common}=[{n}*#2+SIN[{n}.5]]/[#{local}+{n}]
G1 X[#{local}*[{places}]+{small}.] F{n}
IF[#{common}EQ{n}]GOTO{n}
N{n} M{m}
M30
"""
SYNTEC = """%@MACRO
#{local} := {n}*#2+SIN({n}.5) - {sum};
G01 X(#{local}*0+{places}+{small}.) F{n};
IF #{local}={n} THEN
#5 := {n};
END_IF;
N{n} M{m};
"""
SINUMERIK = """DEF INT VALUE_{n}
VALUE_{n}={n} R{common}=VALUE_{n}*{n}+SIN({n}.5)+{sum}
G1 G94 X=R2*{places}+{small} F={n}
IF VALUE_{n}=={n} GOTOF LABEL_{n}
LABEL_{n}: H{n}=5 M{m}
"""
TEXTS = {
    "fanuc-m": MACRO_B,
    "fanuc-0i-tf": MACRO_B,
    "meldas-m": MACRO_B,
    "syntec-mill": SYNTEC,
    "sinumerik-840d": SINUMERIK,
}


def program(control_id: str, n: int) -> str:
    """A program that no other one equals, in names, numbers, codes and the shapes of its expressions."""
    digits = [int(digit) for digit in f"{n:011b}"]
    return TEXTS[control_id].format(
        n=n,
        common=100 + n % 100,
        local=1 + n % 33,
        small=n % 7,
        m=200 + n % 90,
        places="+".join("1" if digit else "[#2]" for digit in digits).translate(BRACKETS[control_id]),
        sum="-".join("1" if digit else "[#2]" for digit in digits).translate(BRACKETS[control_id]),
    )


def brackets(opened: str, closed: str, variable: str) -> dict[int, str]:
    return str.maketrans({"[": opened, "]": closed, "(": opened, ")": closed, "#": variable})


BRACKETS = {
    "fanuc-m": brackets("[", "]", "#"),
    "fanuc-0i-tf": brackets("[", "]", "#"),
    "meldas-m": brackets("[", "]", "#"),
    "syntec-mill": brackets("(", ")", "#"),
    "sinumerik-840d": brackets("(", ")", "R"),
}


def run(chosen: Control, numbers: range) -> None:
    """Run programs, each on a channel of its own."""
    machine = load_machine("lathe2" if chosen.id == "fanuc-0i-tf" else "mill3")
    for n in numbers:
        store = ProgramStore(form=chosen.form)
        text = program(chosen.id, n)
        name = f"/_N_MPF_DIR/_N_P{n}_MPF" if chosen.form is Form.SINUMERIK else f"O{n}"
        channel = Channel(chosen, machine, Setup(), store)
        for _ in channel.run(store.add_text(name, text)):
            pass
        assert channel.alarms == []


def blocks_of_memory() -> int:
    gc.collect()
    return sys.getallocatedblocks()


def with_few_shapes(control_id: str) -> tuple[Control, Shapes]:
    """A control of its own, and where its compiled code is kept."""
    chosen: Any = type(control(control_id))()
    if control_id == "sinumerik-840d":
        shapes = vars(chosen)["shapes"] = Shapes(chosen.shapes.names, SHAPES)
    else:
        shapes = Shapes(chosen.grammar.shapes.names, SHAPES)
        vars(chosen)["grammar"] = replace(chosen.grammar, shapes=shapes, patterns=Patterns(SHAPES), plain={})
    return chosen, shapes


@pytest.mark.parametrize("control_id", list(TEXTS))
def test_thousands_of_different_programs_leave_memory_as_it_was(control_id: str) -> None:
    chosen, shapes = with_few_shapes(control_id)
    run(chosen, range(1, FIRST))
    before = blocks_of_memory()
    run(chosen, range(FIRST, PROGRAMS))
    assert len(shapes) <= SHAPES
    assert blocks_of_memory() - before < FEW
