"""Single block is switched off again within a row that was to end in a rest: the path goes on as planned."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.mainrun import State
from tests.mainrun.motion.test_disturbed import JERK, PULL, every_ms
from tests.mainrun.support import power_on

#: The first row of each is long, and goes on into the next one without a rest.
PROGRAMS = {
    "gentle": "SOFT G642 CTOL=0.1 G1 X20 F6000\nX40 Y1\nX60 Y0\nX80 Y2\nM30\n",
    "straight on": "SOFT G64 G1 X20 F6000\nX40\nX60\nX80\nM30\n",
    "arc": "SOFT G645 CTOL=0.05 G1 X20 F6000\nG3 X40 Y20 CR=20\nG1 Y40\nM30\n",
    "facets": "SOFT G642 CTOL=0.02 G1 X20 F4000\n"
    + "".join(f"X{20 + 0.5 * k:.2f} Y{0.002 * k * k:.4f}\n" for k in range(1, 30))
    + "M30\n",
    "brisk": "BRISK G642 CTOL=0.1 G1 X20 F6000\nX40 Y1\nX60 Y0\nX80 Y2\nM30\n",
    "brisk and sharp": "BRISK G64 G1 X20 F6000\nX40 Y0.1\nX60 Y0\nX80 Y0.1\nM30\n",
}
#: Rows behind which the axes stand for the program: switching off changes nothing.
STANDING = {
    "back": "SOFT G64 G1 X20 F6000\nX0\nX20\nM30\n",
    "function": "SOFT G642 CTOL=0.1 G1 X20 F6000\nM8\nX40 Y1\nM30\n",
    "exact stop": "SOFT G642 CTOL=0.1 G1 X20 F6000 G9\nX40 Y1\nM30\n",
    "brisk and back": "BRISK G64 G1 X20 F6000\nX0\nX20\nM30\n",
}


def run(text: str, off: float | None, *, on: bool = True) -> tuple[float, np.ndarray]:
    """Seconds of a program that begins in single block, which is switched off after a while, and places by ms."""
    virtual = power_on(text, "sinumerik-840d")
    virtual.set_switches(single_block=on)
    places, halts = [virtual.machine_position] * 4, 0
    start = virtual.time
    virtual.cycle_start()
    while virtual.state is not State.READY:
        if off is not None and virtual.time - start >= off:
            virtual.set_switches(single_block=False)
            off = None
        if virtual.state is State.STOPPED:
            halts += 1
            virtual.set_switches(single_block=False)
            virtual.cycle_start()
        every_ms(virtual, places)
    return virtual.time - start, np.array(places)


def keeps_limits(places: np.ndarray, *, soft: bool) -> bool:
    steps = [np.abs(np.diff(places, order, axis=0)).max() for order in (1, 2, 3)]
    slack = 1.002 if soft else 1.1  # under BRISK a step of velocity without deviation is spread over some µm
    kept = steps[0] <= 0.4 * slack and steps[1] <= PULL * 1e-6 * slack
    return bool(kept and (not soft or steps[2] <= JERK * 1e-9 * slack))


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_row_goes_on_into_the_next_one_as_planned(name: str) -> None:
    text = PROGRAMS[name]
    planned, path = run(text, None, on=False)
    rests, _ = run(text, None)
    assert rests > planned + 0.02
    for off in (0.02, 0.06, 0.1):
        seconds, places = run(text, off)
        assert seconds == pytest.approx(planned, abs=0.012), off
        assert keeps_limits(places, soft="SOFT" in text), off
        assert places[-1] == pytest.approx(path[-1])


@pytest.mark.parametrize("name", PROGRAMS)
def test_however_late_it_is_switched_off_the_axes_keep_their_limits_and_jump_nowhere(name: str) -> None:
    text = PROGRAMS[name]
    planned, path = run(text, None, on=False)
    for k in range(8):
        seconds, places = run(text, 0.14 + 0.024 * k)
        assert seconds >= planned - 0.012
        assert keeps_limits(places, soft="SOFT" in text), k
        assert places[-1] == pytest.approx(path[-1])


@pytest.mark.parametrize("name", STANDING)
def test_where_the_program_stands_the_axes_rest_as_before(name: str) -> None:
    text = STANDING[name]
    planned, _ = run(text, None, on=False)
    for off in (0.04, 0.12):
        seconds, places = run(text, off)
        assert seconds == pytest.approx(planned, abs=0.009)
        assert keeps_limits(places, soft="SOFT" in text)
        corner = np.abs(places - [20.0, 0.0, 0.0]).max(axis=1)[:-1]
        nearest = int(corner.argmin())
        assert corner[nearest] < PULL * 1e-6
        assert np.abs(places[nearest + 1] - places[nearest]).max() <= PULL * 1e-6


@pytest.mark.parametrize("mode", ["BRISK", "DRIVE"])
@pytest.mark.parametrize("off", [0.069, 0.073])
def test_where_it_is_too_late_to_come_down_to_the_bend_behind_an_arc_the_axes_rest(
    mode: str, off: float
) -> None:
    text = f"{mode} G64\nG3 X-0.333 Y3.483 CR=1.949 F20000\nG3 X-0.760 Y7.473 CR=5.831 F6000\nM30\n"
    _, places = run(text, off)
    assert np.abs(np.diff(places, 2, axis=0)).max() <= PULL * 1e-6 * 1.002
    assert places[-1] == pytest.approx([-0.76, 7.473, 0.0])


@pytest.mark.parametrize("off", [0.109, 0.111, 0.113, 0.115])
def test_an_order_while_the_axes_brake_along_a_curve_leaves_no_speed_at_its_end(off: float) -> None:
    # The first block has no way: single block halts behind it, and is off already when the axes brake.
    text = (
        "BRISK G642 CTOL=0.02\nG3 X-12.0785 Y5.4765 I=AC(-9.10407) J=AC(-4.02130) F12000\n"
        "G2 X-15.6158 Y5.6050 I=AC(-13.66541) J=AC(10.54382) F20000\nM30\n"
    )
    _, places = run(text, off)
    assert np.abs(np.diff(places, 2, axis=0)).max() <= PULL * 1e-6 * 1.002
    assert places[-1] == pytest.approx([-15.6158, 5.605, 0.0])
