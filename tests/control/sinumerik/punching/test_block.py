"""What words and machine data ask of punching and nibbling."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

ON = {"$MC_PUNCHNIB_ACTIVATION": 1}


def strokes(*lines: str, **parameters: int) -> int:
    result = run("G1 F2000", *lines, parameters={**ON, **parameters})
    assert not result.alarms
    return sum(row["type"] == "stroke" for row in result.rows)


@pytest.mark.parametrize(
    ("lines", "count"),
    [
        (("PON X10",), 1),
        (("SON X10",), 2),
        (("SON", "Z5", "X10"), 2),
        (("SON X10", "SON X20"), 3),
        (("SON X10", "PON X20", "SON X30"), 5),
        (("SON X10", "SONS X20"), 3),
        (("PON", "G2 I5"), 1),
        (("PON", "G111 X0 Y0", "AP=30 RP=10"), 1),
        (("PON", "G4 F1"), 0),
        (("PON", "G18 Y5"), 0),
        (("PON X10", "SPOF", "X20"), 1),
        (("PON SPN=3 X9", "X12"), 4),
    ],
)
def test_strokes_of_a_program(lines: tuple[str, ...], count: int) -> None:
    assert strokes(*lines) == count


def test_measuring_is_refused_with_a_leader() -> None:
    assert codes(run("G1 F2000", "PONS", "MEAS=1 X10", parameters=ON)) == [("PC0001", 3)]


def test_a_save_subprogram_leaves_the_segments() -> None:
    lines = ("G1 F2000", "SUB", "X10", "M30", "%_N_SUB_SPF", "PROC SUB SAVE", "SPP=5", "M17")
    result = run("%_N_MAIN_MPF", *lines, parameters=ON)
    assert [row["to"]["X"] for row in result.rows if "to" in row] == [5.0, 10.0]


def test_old_m_functions_stand_for_the_words_only_where_machine_data_say_so() -> None:
    assert strokes("M25", "X10") == 0
    assert strokes("M25", "X10", **{"$MC_PUNCHNIB_ACTIVATION": 2}) == 1
