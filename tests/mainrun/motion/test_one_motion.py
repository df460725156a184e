"""Plan, samples and main run are one motion, on random programs of the controls.

The times agree, and by the differences of the sampled positions themselves no axis exceeds its velocity, acceleration
(what `ACC` leaves it) or, but under BRISK and DRIVE, its jerk. The main run passes the same places at the same times.
2,000 programs are drawn; what is in them, `random_programs` and `drawn` say.
`pytest --hypothesis-profile=explore` draws 20,000 others.
"""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.motion.limits import channel_axes
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.examples import examples
from tests.mainrun.motion.drawn import limited
from tests.mainrun.motion.drawn.kinds import drawn
from tests.mainrun.motion.random_programs import Back, Writer, planned_ahead, writer
from tests.mainrun.support import power_on, recorded

if TYPE_CHECKING:
    from polycnc.machine import Machine
    from polycnc.motion.sampling.run import Numbers

PERIOD = 0.001
#: Sums of many terms, and positions of many digits behind third differences.
SLACK = 1.001
#: Programs that are drawn in every run, and in one test, and those of a run that explores; rows that turn back;
#: programs of each kind under limits of real axes.
DRAWN, IN_A_TEST, EXPLORE, BACK, LIMITED = 2000, 50, 20_000, 30, 16
#: Programs of `random_programs` that exploring has found: the main run took the averages of the real axes where a
#: transformation ends; a rotary axis was too quick beside the centre under BRISK; on bends, arcs and splines axes
#: exceeded what TRACYL, TRAANG and ACC leave them; the main run went on by averages where a spline turns back on a line
#: under SOFT.
FOUND = (341917, 487807, 535447, 975837, 998267, 294, 674, 705, 1895, 3265, 1310, 203865)
#: Programs without a transformation in which an axis exceeded what JERKLIM leaves it, on rows that do not move it, and
#: with one in which it exceeded what VELOLIM does, where a chord of a curve moves it faster than its ends say. Beside
#: the centre of a polar plane C exceeded what ACC leaves it under SOFT, and what VELOLIM does where a line is nearest.
#: Where a path is bent at a corner an axis exceeded it that moves less in one of both rows.
LIMITED_FOUND = {
    limited.LimitedMill: (47, 67),
    limited.SlowAxes: (27, 116, 118),
    limited.LimitedPolar: (81, 89, 118),
    limited.LimitedVectors: (33, 182),
}
#: Parameters that leave axes less than the machine: at corners, on short lines and arcs, by time constants.
PARAMETERS: dict[str, tuple[dict[str, object], ...]] = {
    "fanuc-m": (
        {"1783 X": 200, "1783 Y": 60, "1737 X": 300, "1735 X": 500, "1738": 30},
        {"1660": 2000, "1772": 50, "1783 Y": 500},
    ),
    "syntec-mill": ({"406": 120, "408": 600}, {"401": 100, "641": 60}, {"406": 1000}),
    "meldas-m": ({"1206": 6000, "1207": 100},),
}
#: Samples of a program whose places are looked up in the main run, from its first on.
PLACES = 1500
#: Largest distance of both, mm or degrees: an arc is a circle in the main run, cubics of 7.5° in the samples.
APART = 0.002


def planned(text: str, written: Writer) -> tuple[float, float, Samples, Machine]:
    """Planned time, the end of the samples, all of them, and the machine."""
    given: list[Samples] = []
    session = open_session(
        text.encode(), control=written.control, machine=written.machine, setup=written.setup, keep=False
    )
    sampler = session.sample(PERIOD, given.append)
    result = session.run()
    assert result.ok, text
    total = result.plan.total_s
    sampler.close()
    columns = [np.concatenate(column) for column in zip(*given, strict=True)]
    return total, sampler.time, Samples(*columns), result.machine


def executed(text: str, written: Writer, places: Numbers, rotary: list[bool]) -> float:
    """Seconds that the main run takes; in each of its cycles the axes are where the samples say."""
    virtual = power_on(text, written.control, machine=written.machine, setup=parse_setup(written.setup))
    records = recorded(virtual)
    start = virtual.time
    virtual.cycle_start()
    for sampled in places[::4]:
        for place, sample, turns in zip(virtual.machine_position, sampled, rotary, strict=True):
            off = place - sample
            assert abs((off + 180.0) % 360.0 - 180.0 if turns else off) < APART, text
        virtual.step(4.0 * PERIOD)
    virtual.run(limit_s=10_000.0)
    assert virtual.state is State.READY, text
    return next(record.time for record in reversed(records) if record.what == "state") - start


def check(written: Writer) -> None:
    compare(planned_ahead(written.program(), written.control), written)


def compare(text: str, written: Writer) -> None:
    """Compare plan, samples and main run of a program."""
    total, end, samples, machine = planned(text, written)
    axes = channel_axes(machine, 1, machine.channels[0].names)
    rotary = [axis is not None and axis.rotary for axis in axes]
    assert end == pytest.approx(total, abs=1e-6), text
    assert executed(text, written, samples.position[:PLACES], rotary) == pytest.approx(total, abs=0.001), text
    steps = np.diff(samples.position, axis=0)
    middle = 0.5 * PERIOD * (samples.velocity[1:] + samples.velocity[:-1])
    change = np.diff(samples.acceleration, axis=0) * PERIOD**2 / 12.0
    for i, axis in enumerate(axes):
        assert axis is not None
        if axis.rotary:
            steps[:, i] = (steps[:, i] + 180.0) % 360.0 - 180.0
        slope = written.left.get(axis.name, 1.0) * axis.acceleration * PERIOD**2
        fastest = written.left_speed.get(axis.name, 1.0) * axis.rapid
        assert np.abs(steps[:, i]).max() <= fastest * PERIOD * SLACK, text
        assert np.abs(np.diff(steps[:, i])).max(initial=0.0) <= slope * SLACK, text
        if "BRISK" in text or "DRIVE" in text:  # the acceleration steps between two samples
            assert np.abs(steps - middle)[:, i].max() <= 0.26 * slope, text
            continue
        assert np.abs(steps - middle + change)[:, i].max() < 2e-6, text
        jerk = written.left_jerk.get(axis.name, 1.0) * axis.jerk
        assert np.abs(np.diff(steps[:, i], 2)).max(initial=0.0) <= jerk * PERIOD**3 * SLACK, text


@pytest.mark.parametrize("first", range(0, DRAWN, IN_A_TEST))
def test_plan_samples_and_main_run_are_one_motion(first: int) -> None:
    for seed in range(first, first + examples(IN_A_TEST)):
        try:
            check(drawn(seed))
        except Exception as error:
            error.add_note(f"seed {seed}:\n{drawn(seed).program()}")
            raise


@pytest.mark.parametrize("seed", FOUND)
def test_so_they_are_on_programs_that_were_found(seed: int) -> None:
    check(writer(seed))


@pytest.mark.parametrize("seed", range(examples(BACK)))
def test_so_they_are_where_rows_turn_back(seed: int) -> None:
    check(Back(Random(seed), "sinumerik-840d"))


@pytest.mark.parametrize("control", PARAMETERS)
def test_so_they_are_where_parameters_bound_cuts_that_are_planned_ahead(control: str) -> None:
    for seed in range(examples(LIMITED)):
        written = Writer(Random(seed), control)
        text = planned_ahead(written.program(), control)
        for parameters in PARAMETERS[control]:
            written.setup = {**Writer.setup, "parameters": parameters}  # type: ignore[misc]
            compare(text, written)


@pytest.mark.parametrize("kind", limited.KINDS)
def test_so_they_are_where_a_program_limits_the_axes_of_the_machine(
    kind: type[limited.Limited],
) -> None:
    for seed in (*range(LIMITED), *LIMITED_FOUND.get(kind, ())):
        check(kind(Random(seed), "sinumerik-840d"))


@settings(max_examples=EXPLORE if settings.get_current_profile_name() == "explore" else 1, deadline=None)
@given(st.integers(DRAWN, 10_000_000))
def test_so_they_are_on_programs_that_nobody_has_seen(seed: int) -> None:
    check(drawn(seed))
