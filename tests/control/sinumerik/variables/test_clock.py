"""The clock of SINUMERIK: dwells count, looks take a millisecond."""

from __future__ import annotations

from polycnc.control.sinumerik.variables.clock import Clock


def test_each_look_takes_time_so_that_a_loop_which_waits_ends() -> None:
    clock = Clock()
    looks = 0
    while clock.look() < 0.01:
        looks += 1
    assert looks == 10


def test_what_was_waited_matters_to_a_program_that_has_looked() -> None:
    one, other = Clock(waited=1.0), Clock(waited=2.0)
    assert one.compared() == other.compared()
    one.look()
    other.look()
    assert one.compared() != other.compared()
