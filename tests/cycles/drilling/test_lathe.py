"""What lathes add to drilling strokes."""

from __future__ import annotations

from polycnc.cycles.drilling.holes import Action, Hole, drill
from polycnc.cycles.drilling.lathe import clamped, tap, tap_clearing_chips, with_extraction

HOLE = Hole(initial=5.0, r=2.0, bottom=-10.0, back=5.0, by_r=True)


def test_the_axis_is_clamped_before_the_hole_and_free_before_the_way_to_the_initial_level() -> None:
    strokes = list(clamped(drill(HOLE), 31, 32, 0.5))
    assert (strokes[0].action, strokes[0].value) == (Action.OUTPUT, 31)
    assert [(s.action, s.value) for s in strokes[-3:]] == [
        (Action.OUTPUT, 32),
        (Action.DWELL, 0.5),
        (Action.RAPID, 5.0),
    ]


def test_only_ways_out_of_the_hole_are_faster() -> None:
    peck = Hole(5.0, 2.0, -10.0, 5.0, peck=6.0, relief=1.0)
    taps = [(s.value, s.factor) for s in with_extraction(tap(peck), peck, 2.0) if s.action is Action.TAP]
    assert taps == [(-4.0, 1.0), (-3.0, 2.0), (-10.0, 1.0), (2.0, 2.0)]


def test_a_clearing_tap_comes_out_to_r_after_each_peck() -> None:
    peck = Hole(5.0, 2.0, -10.0, 5.0, peck=6.0, relief=1.0)
    assert [s.value for s in tap_clearing_chips(peck) if s.action is Action.TAP] == [
        -4.0,
        2.0,
        -3.0,
        -10.0,
        2.0,
    ]
