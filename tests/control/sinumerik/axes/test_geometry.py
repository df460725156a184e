"""Which channel axes are geometry axes behind a call of GEOAX."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, moves, run

ASSIGNED = [f"R{n}=ISAXIS({n})" for n in (1, 2, 3)]


@pytest.mark.parametrize(
    ("calls", "axes"),
    [
        (("GEOAX(1,U,2,V,3,W)",), "U V W"),
        (("GEOAX(1,U,2,V,3,W)", "GEOAX(1,XX,3,ZZ)"), "XX V ZZ"),
        (("GEOAX(1,U,2,V,3,W)", "GEOAX(0,V)"), "U - W"),
        (("GEOAX(1,U,2,V,3,W)", "GEOAX(3,V)"), "U - V"),
        (("GEOAX(1,U)", "GEOAX()"), "XX YY ZZ"),
        (("GEOAX(0,XX,0,YY,0,ZZ)",), "- - -"),
    ],
)
def test_pairs_take_effect_one_after_the_other(calls: tuple[str, ...], axes: str) -> None:
    result = run(*calls, machine="mill6-uvw")
    assert not result.alarms
    channel = result.channel
    names = [channel.axes[i] if i >= 0 else "-" for i in channel.coordinates.geometry]
    assert names == axes.split()


@pytest.mark.parametrize("call", ["GEOAX(1,X)", "GEOAX(1,U,1,V)", "GEOAX(1,U,2,U)", "GEOAX(0,U)", "GEOAX(1)"])
def test_a_wrong_call_is_refused(call: str) -> None:
    assert codes(run(call, machine="mill6-uvw")) == [("14414", 1)]


def test_words_of_one_shape_move_other_axes_behind_a_change() -> None:
    rows = moves(run("G1 F1000", "X1", "GEOAX(1,U)", "X2", "GEOAX()", "X3", machine="mill6-uvw"))
    assert [(to["X"], to.get("XX", 0.0), to.get("U")) for _, to in rows] == [
        (1.0, 0.0, 0.0),
        (2.0, 1.0, None),
        (3.0, 0.0, 2.0),
    ]
