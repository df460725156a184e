"""Chuck and tailstock barrier."""

from __future__ import annotations

import pytest

from tests.control.fanuc.lathe.support import alarms, run

CHUCK = {
    "1330": 1,
    "1331": 40.0,
    "1332": 30.0,
    "1333": 20.0,
    "1334": 5.0,
    "1335": 100.0,
    "1336": -50.0,
    "1348": 200.0,
}
TAILSTOCK = {
    "1341": 50.0,
    "1342": 60.0,
    "1343": 20.0,
    "1344": 40.0,
    "1345": 10.0,
    "1346": 20.0,
    "1347": 2.0,
    "1336": -50.0,
    "1348": 200.0,
}


@pytest.mark.parametrize(
    ("program", "code"),
    [
        ("G0 X180. Z-40.\nZ-100.", []),
        ("G0 X90. Z-40.\nZ-60.", []),
        ("G0 X120. Z-40.\nZ-60.", ["OT0503"]),
        ("G0 X96. Z-40.\nZ-80.", ["OT0503"]),
        ("G0 X-120. Z-40.\nZ-60.", ["OT0503"]),
    ],
)
def test_jaws_are_forbidden_where_they_are(program: str, code: list[str]) -> None:
    assert alarms(run(program + "\nM30", parameters=CHUCK)) == code


def test_a_way_across_the_tailstock_is_forbidden_too() -> None:
    assert alarms(run("G0 X100. Z230.\nX-100.\nM30", parameters=TAILSTOCK)) == ["OT0503"]


def test_its_point_is_taken_as_one_of_90_degrees() -> None:
    assert alarms(run("G0 X14. Z190.\nZ203.\nM30", parameters=TAILSTOCK)) == []
    assert alarms(run("G0 X14. Z190.\nZ207.\nM30", parameters=TAILSTOCK)) == ["OT0502"]


def test_the_signal_takes_the_tailstock_away() -> None:
    setup = {"parameters": TAILSTOCK, "switches": {"*TSB": 1}}
    assert alarms(run("G0 X0 Z230.\nM30", **setup)) == []


def test_the_area_follows_the_work_coordinates() -> None:
    assert alarms(run("G50 Z100.\nG0 X120. Z40.\nM30", parameters=CHUCK)) == []
    assert alarms(run("G50 Z0\nG0 X200. Z-60.\nX120.\nM30", parameters=CHUCK)) == ["OT0503"]


def test_no_dimensions_no_barrier() -> None:
    assert alarms(run("G0 X0 Z-60.\nM30", parameters={"1336": -50.0})) == []
