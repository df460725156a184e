"""Any key in any mode: never a traceback, never a position outside the limits, and a control that can be used again."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import CommandRefused, Mode, State, VirtualControl
from tests.examples import examples

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

LIMITS = (-60.0, 90.0)


def limited(base: str, axes: str = "XYZ") -> str:
    limits = f"limit_minus = {LIMITS[0]}\nlimit_plus = {LIMITS[1]}\n"
    return f'base = "{base}"\n\n' + "".join(f"[axis.{axis}]\n{limits}" for axis in axes)


WORDS = (
    "G90 G54 G0 X10. Y5.\nM3 S1000\nG1 X50. F3000\nG2 X60. Y15. R10.\nM8\nG91 X5.\nX5.\nG90 G1 Y40. Z-5.\n"
    "M0\nG81 X20. Z-10. R2. F500\nX30.\nG80\n/G1 X0\nM1\nG4 P100\nG0 X0 Y0 Z0\nM9\n"
)
PROGRAMS = {
    "fanuc-m": f"O1\n{WORDS}G31 X30. F500\nG28 X0\nM30\n",
    "meldas-m": f"O1\n{WORDS}M30\n",
    "syntec-mill": f"{WORDS}G31 X30. F500\nM30\n",
    "sinumerik-840d": (
        "SOFT G64\nG90 G54 G0 X10 Y5\nM3 S1000\nG1 X50 F3000\nG2 X60 Y15 CR=10\nM8\nG91 X5\nG90 G1 Y40 Z-5\nM0\n"
        "STOPRE\nBRISK\nG641 ADIS=1\nG1 X20\nY20\nX0\n/G1 X10\nG4 F0.1\nSBLOF\nG1 X5\nSBLON\nG0 X0 Y0 Z0\nM9\nM30\n"
    ),
}
#: A lathe with its cycles, a thread, a rigid tap and polar interpolation.
TURNING = """O1
G98 G97 S300 M3
G0 X60. Z10.
M8
G71 U2. R1.
G71 P10 Q20 U1. W0.5 F2000.
N10 G0 X20.
G1 Z-20.
N20 X50. Z-30.
G70 P10 Q20
M0
G76 P010060 Q100 R0.1
G76 X30. Z-20. P600 Q300 F2.
/G0 X60.
G90 X40. W-10. F1000.
G1 X#100 Z5.
M1
G0 Z20.
M29 S200
G84 X0 Z-10. R2. F200.
G80
G0 X60. Z10.
G1 W-5. F3000.
G0 X0 Z0
M9
M30
"""
POLAR = "O1\nG98 G0 X60. Z5. C0\nG12.1\nG1 X20. F1000.\nC10.\nX-20.\nM0\nG3 X20. C10. R20.\nG13.1\nG0 X0 C0\nM30\n"
#: What a control runs in the end.
LAST = {
    "sinumerik-840d": "G90 G1 X10 F1000\nM30\n",
    "fanuc-0i-tf": "O1\nG98 G1 X10. F1000\nM30\n",
}
MAIN = 'INIT(2,"B")\nSTART(2)\nG0 X10\nRELEASE(Y)\nG1 X80 F6000\nWAITM(1,1,2)\nG1 X0\nWAITE(2)\nG0 Y3\nM30\n'
SIDE = "GET(Y)\nG1 Y50 F3000\nWAITM(1,1,2)\nG4 F0.5\nG1 Y20\nRELEASE(Y)\nM30\n"


def power_off_and_on(virtual: VirtualControl) -> None:
    virtual.power_off()
    virtual.run()
    virtual.power_on()


KEYS: tuple[Callable[[VirtualControl, Random], object], ...] = (
    lambda now, _: now.cycle_start(),
    lambda now, _: now.cycle_start(),
    lambda now, _: now.feed_hold(),
    lambda now, _: now.reset(),
    lambda now, dice: now.emergency_stop(pressed=dice.random() < 0.3),
    lambda now, dice: now.select_mode(dice.choice((*Mode, Mode.AUTO, Mode.AUTO))),
    lambda now, dice: now.jog(dice.choice("XYZQ"), dice.choice((1, -1)), rapid=dice.random() < 0.5),
    lambda now, dice: now.stop_jog(dice.choice((None, "X", "Z"))),
    lambda now, dice: now.increment(dice.choice("XYZ"), dice.randrange(-9, 10), 1.0),
    lambda now, dice: now.handle(dice.choice("XYZ"), dice.randrange(-99, 100), 0.1),
    lambda now, dice: now.home(dice.choice((None, "X", "Y"))),
    lambda now, dice: now.mdi(
        dice.choice(("G0 X1.\n", "G1 Y5. F500\n", "G99999\n", "G1 X9999. F100\n", "("))
    ),
    lambda now, dice: now.override(feed=dice.choice((0.0, 0.5, 2.0))),
    lambda now, dice: now.override(rapid=dice.choice((0.0, 0.25, 1.0)), spindle=dice.choice((0.5, 1.2))),
    lambda now, dice: now.override(feed=1.0, rapid=1.0),
    lambda now, dice: now.set_switches(single_block=dice.choice(("", "", "SBL1", "SBL2", "SBL3"))),
    lambda now, dice: now.set_switches(dry_run=dice.random() < 0.5, optional_stop=dice.random() < 0.5),
    lambda now, dice: now.set_switches(block_skip=dice.choice((False, True, (1, 2)))),
    lambda now, dice: now.set_switches(machine_lock=dice.random() < 0.3, z_lock=dice.random() < 0.3),
    lambda now, dice: now.set_switches(mst_lock=dice.random() < 0.3),
    lambda now, dice: now.set_switches(drf=dice.random() < 0.5),
    lambda now, dice: now.block_search(dice.choice((3, 5, 8, 12, "N5", 999))),
    lambda now, dice: now.teach("G1"),
    lambda now, dice: now.jog("Y", dice.choice((1, -1)), channel=2),
    lambda now, dice: now.handle("Y", dice.randrange(-99, 100), 0.1, channel=dice.choice((1, 2, 3))),
    lambda now, dice: now.signals.__setitem__("MANUAL_ABSOLUTE", float(dice.random() < 0.7)),
    lambda now, dice: now.signals.__setitem__("SKIP", float(dice.random() < 0.5)),
    lambda now, dice: now.signals.__setitem__(dice.choice(("CYCLE_START", "FEED_HOLD", "RESET")), 1.0),
    lambda now, dice: now.signals.__setitem__(dice.choice(("CYCLE_START", "FEED_HOLD", "RESET")), 0.0),
    lambda now, _: power_off_and_on(now),
)


def press(
    virtual: VirtualControl, dice: Random, seed: int, keys: int, axes: tuple[int, ...] = (0, 1, 2)
) -> None:
    """A script of keys, with the axes watched that have limits."""
    refusals: list[CommandRefused] = []
    for _ in range(keys):
        try:
            dice.choice(KEYS)(virtual, dice)
        except CommandRefused as refused:
            refusals.append(refused)
        for _ in range(dice.randrange(4)):
            virtual.step(dice.choice((0.004, 0.02, 0.1, 0.4)))
            stands = virtual.machine_position
            assert all(LIMITS[0] - 1e-6 <= stands[axis] <= LIMITS[1] + 1e-6 for axis in axes), (seed, stands)
        assert virtual.snapshot.state is virtual.state
    assert all(refused.text("en") and refused.text("zh-TW") for refused in refusals)


@pytest.mark.parametrize("control", PROGRAMS)
def test_no_script_of_keys_leads_out_of_the_limits_or_into_a_traceback(control: str, tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(limited("mill3"), encoding="utf-8")
    for seed in range(examples(25)):
        virtual = VirtualControl(control, machine=file)
        virtual.load(PROGRAMS[control])
        press(virtual, Random(seed), seed, 120)
        assert _is_ready_after_a_reset(virtual), (seed, virtual.state, virtual.alarms)


@pytest.mark.parametrize(
    ("machine", "text"), [("lathe2", TURNING), ("lathe-c-transmit", POLAR)], ids=["cycles", "polar"]
)
def test_nor_does_one_on_a_lathe(machine: str, text: str, tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(limited(machine, "XZ"), encoding="utf-8")
    for seed in range(examples(25)):
        virtual = VirtualControl("fanuc-0i-tf", machine=file, setup={"variables": {"#100": 30}})
        virtual.load(text)
        press(virtual, Random(seed), seed, 120, axes=(0, 1))
        assert _is_ready_after_a_reset(virtual), (seed, virtual.state, virtual.alarms)


def test_nor_does_one_on_two_channels_that_wait_for_each_other(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(limited("mill3-2ch"), encoding="utf-8")
    for seed in range(examples(25)):
        virtual = VirtualControl("sinumerik-840d", machine=file, files={"B.MPF": SIDE})
        virtual.load(MAIN)
        press(virtual, Random(seed), seed, 120)
        assert _is_ready_after_a_reset(virtual), (seed, virtual.state, virtual.alarms)


def _is_ready_after_a_reset(virtual: VirtualControl) -> bool:
    """Whether a reset leads to a control that runs a program to its end."""
    virtual.emergency_stop(pressed=False)
    virtual.override(feed=1.0, rapid=1.0)
    for key in ("CYCLE_START", "FEED_HOLD", "RESET", "SKIP"):
        virtual.signals[key] = 0.0
    virtual.reset()
    virtual.run()
    if virtual.state is not State.READY:
        return False
    virtual.set_switches(single_block="", machine_lock=False, z_lock=False, optional_stop=False)
    virtual.power_off()
    virtual.power_on()
    virtual.run()
    virtual.select_mode("auto")
    virtual.load(LAST.get(virtual.control.id, "O1\nG90 G1 X10. F1000\nM30\n"))
    virtual.cycle_start()
    return virtual.run() is State.READY and not virtual.alarms
