"""Where strokes of the lathe's drilling cycles overlap (FANUC 0i-TF Plus II.4.4)."""

from __future__ import annotations

from functools import partial

import pytest

from polycnc.cycles.drilling import holes
from polycnc.cycles.drilling.holes import Action, Cycle, Hole
from polycnc.cycles.drilling.lathe import Joint, overlapping

R, RETRACT, REENTRY = Joint.R_LEVEL, Joint.RETRACT, Joint.REENTRY
PECK, BOTTOM, HOLE = Joint.PECK, Joint.BOTTOM, Joint.HOLE
#: A cycle, whether it returns to the initial level, its pecks, and the points of the manual's figures in order.
FIGURES: dict[str, tuple[Cycle, bool, list[set[Joint] | None]]] = {
    "high-speed, initial": (holes.peck_breaking_chips, True, [{R}, {PECK}, {RETRACT}, {BOTTOM}, {R}, {HOLE}]),
    "high-speed, R": (holes.peck_breaking_chips, False, [{R}, {PECK}, {RETRACT}, {BOTTOM}, {HOLE}]),
    "deep, initial": (
        holes.peck_clearing_chips, True, [{R}, {PECK}, {RETRACT}, {REENTRY}, {BOTTOM}, {R}, {HOLE}],
    ),
    "bore, initial": (partial(holes.bore, out=2.0), True, [{R}, None, {R}, {HOLE}]),
    "bore, R": (partial(holes.bore, out=2.0), False, [{R}, None, {R, HOLE}]),
}  # fmt: skip


@pytest.mark.parametrize("figure", FIGURES)
def test_each_point_of_a_cycle_is_kept_apart_by_the_bits_that_its_figure_names(figure: str) -> None:
    cycle, initial, points = FIGURES[figure]
    hole = Hole(5.0, 2.0, -10.0, 5.0 if initial else 2.0, peck=6.0, relief=1.0, by_r=True)
    strokes = [s for s in cycle(hole) if s.action is not Action.DWELL]
    for number, point in enumerate(points):
        kept = {
            joint for joint in Joint if not list(overlapping(iter(strokes), hole, {joint}))[number].overlaps
        }
        assert kept == (set(Joint) if point is None else point), number


@pytest.mark.parametrize("cycle", [holes.drill, holes.peck_breaking_chips])
def test_a_dwell_keeps_the_strokes_at_the_bottom_apart(cycle: Cycle) -> None:
    hole = Hole(5.0, 2.0, -10.0, 5.0, dwell_s=1.0, by_r=True)
    cut = [s for s in overlapping(cycle(hole), hole, ()) if s.action is Action.FEED]
    assert [s.overlaps for s in cut] == [False]
