"""The MELDAS machining centre: what differs from the FANUC one."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.control.meldas.code_calls import registered_codes
from polycnc.control.registry import control
from tests.support import codes, ends, run

MELDAS: Any = control("meldas-m")
FANUC: Any = control("fanuc-m")


def test_its_own_codes_are_not_those_of_fanuc() -> None:
    own = {"G2.1", "G12", "G13", "G34", "G35", "G36", "G37.1", "G61.1", "G31.1"}
    assert own <= set(MELDAS.g_codes)
    assert own.isdisjoint(FANUC.g_codes)


def test_arc_and_interference_alarms_have_their_own_numbers() -> None:
    assert codes(run("G2 X10. Y5. I2. F10\nM30\n", "meldas-m")) == ["P70"]


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_reference_points_are_parameters_of_each_axis(number: int) -> None:
    setup = {"parameters": {f"{2036 + number} Y": 10.0 * number}}
    block = "G28 Y0" if number == 1 else f"G30 P{number} Y0"
    assert ends(run(block + "\nM30\n", "meldas-m", setup=setup)) == [(0, 10.0 * number, 0)]


def test_registered_codes_name_their_type_and_program() -> None:
    parameters = {
        "7201": 120,
        "7202": 1,
        "7203": 500,
        "7291": 255,
        "7292": 3,
        "7293": 600,
        "7001": 60,
        "7002": 0,
        "7003": 700,
    }
    calls = registered_codes(run("M30\n", "meldas-m", setup={"parameters": parameters}).memory.parameters)
    assert {
        code: (call.program, call.kind) for code, call in calls.g.items() if code > "G1" and code < "G3"
    } == {
        "G120": (500, "macro"),
        "G255": (600, "each"),
    }
    assert {code: (call.program, call.kind) for code, call in calls.m.items()} == {60: (700, "sub")}


def test_g53_takes_increments_where_fanuc_ignores_them() -> None:
    text = "G91 G53 G0 X5.\nM30\n"
    assert ends(run(text, "meldas-m")) == [(5, 0, 0)]
    assert ends(run(text, "fanuc-m")) == []


@pytest.mark.parametrize("count", ["", "K0", "K10000", "K0.5"])
def test_a_pattern_needs_a_count(count: str) -> None:
    assert codes(run(f"G35 X1. I5. J0 {count}\nM30\n", "meldas-m"))


def test_the_fraction_of_a_count_is_dropped() -> None:
    assert ends(run("G35 X1. I5. J0 K2.9\nM30\n", "meldas-m")) == ends(
        run("G35 X1. I5. J0 K2\nM30\n", "meldas-m")
    )


def test_a_pattern_drills_with_the_cycle_that_is_stored() -> None:
    channel = run("G0 Z5. F100\nG99 G81 R1. Z-1. L0\nG35 X1. Y0 I2. J0 K2\nG80\nM30\n", "meldas-m")
    assert ends(channel)[1:] == [
        (1, 0, 5), (1, 0, 1), (1, 0, -1), (1, 0, 1), (3, 0, 1), (3, 0, -1), (3, 0, 1),
    ]  # fmt: skip
