from __future__ import annotations

from tests.control.sinumerik.support import codes, run

SIGNAL = {"switches": {"plc": {"DB32.DBX26.4": 1}}}


def test_a_place_beyond_the_travel_is_refused() -> None:
    result = run(
        "EGDEF(Y,X,1)", 'EGONSYN(Y,"FINE",500,X,0,1,1)', parameters={"$MA_POS_LIMIT_PLUS[Y]": 100}, **SIGNAL
    )
    assert codes(result) == [("10720", 2)]


def test_an_approach_beside_another_coupling_is_refused() -> None:
    result = run("TRAILON(Z,X)", "EGDEF(Y,X,1)", 'EGONSYN(Y,"FINE",5,X,0,1,1)', **SIGNAL)
    assert codes(result) == [("PC0001", 3)]
