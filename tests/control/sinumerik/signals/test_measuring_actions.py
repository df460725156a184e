"""Measuring from synchronised actions: which calls are refused, and what a measurement leaves."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

PROBE = {"probe": {1: [{"axis": "X", "at": 5, "edge": "rising"}]}}


@pytest.mark.parametrize(
    ("job", "code"),
    [
        ("MEAWA[X]=(9,1)", "12560"),
        ("MEAWA[X]=(1,3)", "12560"),
        ("MEAWA[X]=(1)", "14020"),
        ("MEAC[X]=(1,11,1)", "14020"),
    ],
)
def test_a_wrong_job_is_refused(job: str, code: str) -> None:
    result = run("G1 F3000", f"WHEN TRUE DO {job}", "X10", switches=PROBE)
    assert [found for found, _ in codes(result)] == [code]


def test_the_move_goes_on_and_the_place_is_kept() -> None:
    result = run("G1 F3000", "WHEN TRUE DO MEAWA[X]=(1,1)", "X10", "STOPRE", "R1=$AA_MM1[X]", switches=PROBE)
    assert [row["to"]["X"] for row in result.rows if "to" in row] == [10.0]
    channel = result.channel
    assert channel.control.read_variable(channel, "R1") == pytest.approx(5.0)
