"""How blocks are worked out: order, taking of words, alarms."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.control import Sinumerik
from polycnc.language.sinumerik.words import WordShape, block_of
from polycnc.session import open_session
from tests.control.sinumerik.support import codes, moves, run


def test_the_plan_of_a_block_is_made_once_for_a_modal_state() -> None:
    session = open_session("G1 F100\nX1 Y2\nX3 Y4\nX5 Y6\nM30\n", control="sinumerik-840d")
    result = session.run()
    block = block_of((), (WordShape("X"), WordShape("Y")))
    assert result.ok
    assert block in session.channel.mode.plans


def test_words_act_before_the_motion_and_stops_after_it() -> None:
    result = run("G1 X10 M0 F100 S500 M3")
    kinds = [row["type"] for row in result.rows]
    assert kinds == ["s", "m", "feed", "stop", "m"] or kinds[:4] == ["s", "m", "feed", "stop"]


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("G1 G2 X10 I5 F100", "12060"),
        ("G17 G18", "12060"),
        ("G1 X10 TURN=2 F100", "12080"),
        ("G0 X10 I5", "12080"),
        ("G2 X10 Y0 F100", "14040"),
        ("G2 X10 CR=0 F100", "14095"),
        ("G3 CR=5 F100 X0 Y0", "14040"),
        ("G2 X10 I5 AR=90 F100", "14900"),
        ("G0 X=ACP(3)", "16810"),
        ("G0 X=ACN(3)", "16820"),
        ("G0 X=CAC(3)", "17500"),
        ("TCARR=1", "14150"),
        ("SCPARA[X]=7", "12560"),
        ("DL=7", "12560"),
        ("G4 X3", "12080"),
        ("G111 AP=30", "14270"),
        ("G111 AP=30 RP=-2", "14250"),
        ("G0 AP=400 RP=5", "14210"),
        ("G0 AP=30 RP=5 X10", "14280"),
        ("G0 AP=30", "14280"),
        ("SCALE X0", "12160"),
        ("LIMS=-5", "14820"),
        ("S=-5", "16763"),
        ("SPOS=DC(400)", "16830"),
        ("D1", "17180"),
        ("T1.5", "17190"),
        ("ROT X0 Y0 TRANS X1", "12060"),
        ("G4 F1 TRANS X1", "12120"),
        ("OVR=300", "12560"),
        ("ADIS=-1", "12560"),
        ("G1 X10 F-5", "14800"),
        ("FA[X]=0", "10861"),
        ("FA[X]=-1", "14810"),
        ("SETAL(100)", "14020"),
        ("R1=$P_UIFR[200,X,TR]", "17020"),
        ("R1=$P_UIFR[1]", "12150"),
        ("R1=$MA_POS_LIMIT_PLUS", "12400"),
    ],
)
def test_a_wrong_block_raises_its_alarm(line: str, code: str) -> None:
    assert [alarm[0] for alarm in codes(run(line))] == [code]


def test_a_block_that_alarms_leaves_no_row() -> None:
    result = run("G0 X5", "G1 X10 F100 S3=100")
    assert moves(result) == [("rapid", {"X": 5, "Y": 0, "Z": 0})]
    assert codes(result) == [("16761", 2)]


def test_every_group_number_of_the_table_is_told_to_the_language() -> None:
    control = Sinumerik()
    assert control.g_groups["G642"] == 10
    assert control.g_function(8, 2) == "G54"
