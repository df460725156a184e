from __future__ import annotations

from tests.control.sinumerik.support import codes, moves, run


def test_a_reset_in_the_midst_leaves_nothing_of_a_definition() -> None:
    result = run("CTABDEF(Y,X,1,0)", "G1 X0 Y0", "G999 X5")
    assert codes(result)
    assert moves(result) == []
    assert codes(run("CTABEND")) == [("10942", 1)]


def test_definitions_do_not_nest_and_need_two_axes() -> None:
    assert codes(run("CTABDEF(Y,X,1,0)", "G1 X0 Y0", "CTABDEF(Y,X,2,0)")) == [("10942", 3)]
    assert codes(run("CTABDEF(X,X,1,0)")) == [("10945", 1)]
    assert codes(run("CTABDEF(Y,X,0,0)")) == [("14020", 1)]
    assert codes(run("CTABDEF(Y,X,1,3)")) == [("14020", 1)]
    assert codes(run("CTABDEF(Y,X,1)")) == [("14020", 1)]


def test_under_a_transformation_a_table_has_places_of_the_basic_system() -> None:
    lines = ("TRANS X5", "CTABDEF(Z,Y,1,0)", "G1 Y0 Z0", "Y10 Z4", "CTABEND", "R1=CTAB(5,1,R9)")
    result = run("G0 X20", "TRANSMIT", *lines, machine="lathe-c-transmit")
    assert codes(result) == []
    assert result.variables["R1"] == 2.0
