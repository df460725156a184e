"""G53.6, under tip control G53.1 and G53.3, CYCLE800: where the tip is on the work at every sample of the motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import polycnc
from polycnc.machine import load_machine
from tests.control.sinumerik.transformations.test_accuracy import samples_of
from tests.support import run

if TYPE_CHECKING:
    from pathlib import Path

LENGTH, HOLDER = 100.0, 150.0
PLANE = "G68.2 X5. Y0 Z0 I90. J60. K-90.\n"


def turns(axis: int, angles: np.ndarray) -> np.ndarray:
    """Matrices of right-handed turns about X, Y or Z, one for each angle in degrees."""
    c, s = np.cos(np.radians(angles)), np.sin(np.radians(angles))
    found = np.tile(np.eye(3), (len(angles), 1, 1))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found[:, i, i], found[:, i, j], found[:, j, i], found[:, j, j] = c, -s, s, c
    return found


def on_work(machine: str, positions: np.ndarray, arm: float, holder: float = 0.0) -> np.ndarray:
    """Where a point of the tool is on the work, by the joints of the machine and nothing of polycnc."""
    linear, first, second = positions[:, :3], positions[:, 3], positions[:, 4]
    upright = np.tile([0.0, 0.0, 1.0], (len(positions), 1))
    if machine == "mill5-ac-table":
        table = turns(0, first) @ turns(2, second)
        return np.array(np.matmul(table.transpose(0, 2, 1), (linear - arm * upright)[:, :, None])[:, :, 0])
    along = np.matmul(turns(2, second) @ turns(1, first), upright[:, :, None])[:, :, 0]
    return np.array(linear + holder * upright - (holder + arm) * along)


def positions_of(text: str, control: str, machine: str, **parameters: int) -> np.ndarray:
    setup = {"tools": {1: {"length": LENGTH}}, "parameters": parameters}
    result = polycnc.run(text, control=control, machine=machine, setup=setup)
    assert not result.alarms, result.alarms
    return samples_of(result, load_machine(machine)).position


def turning(positions: np.ndarray) -> np.ndarray:
    """The samples in which rotary axes move."""
    moves = np.abs(np.diff(positions[:, 3:], axis=0)).max(axis=1) > 0.0
    assert moves.sum() > 20
    return np.array(positions[1:][moves])


@pytest.mark.parametrize("machine", ["mill5-ac-table", "mill5-bc-head"])
@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
def test_the_tip_rests_on_the_work_while_g53_6_turns_the_tool(control: str, machine: str) -> None:
    text = f"G90 G43 H1 G00 X3. Y4. Z120.\n{PLANE}G53.6{' H1' if control == 'syntec-mill' else ''}\nM30\n"
    tips = on_work(machine, turning(positions_of(text, control, machine)), LENGTH)
    assert np.abs(tips - [3.0, 4.0, 120.0]).max() < 1e-3


@pytest.mark.parametrize("machine", ["mill5-ac-table", "mill5-bc-head"])
def test_a_point_above_the_tip_rests_on_the_work(machine: str) -> None:
    text = f"G90 G43 H1 G00 X3. Y4. Z120.\n{PLANE}G53.6 H1 R40.\nM30\n"
    points = on_work(machine, turning(positions_of(text, "syntec-mill", machine)), LENGTH - 40.0)
    assert np.abs(points - [3.0, 4.0, 160.0]).max() < 1e-3


@pytest.mark.parametrize("code", ["G53.1", "G53.6"])
@pytest.mark.parametrize("machine", ["mill5-ac-table", "mill5-bc-head"])
def test_under_tip_control_the_tip_rests_while_the_tool_is_aligned(machine: str, code: str) -> None:
    text = f"G90 G43.4 H1\nG00 X3. Y4. Z20.\n{PLANE}{code}\nM30\n"
    tips = on_work(machine, turning(positions_of(text, "syntec-mill", machine)), LENGTH)
    assert np.abs(tips - [3.0, 4.0, 20.0]).max() < 1e-3


@pytest.mark.parametrize("machine", ["mill5-ac-table", "mill5-bc-head"])
def test_under_tip_control_g53_3_leads_the_tip_straight_to_the_plane(machine: str) -> None:
    text = f"G90 G43.4 H1\nG00 X3. Y4. Z20.\n{PLANE}G53.3 X0 Y0 Z20.\nM30\n"
    tips = on_work(machine, turning(positions_of(text, "syntec-mill", machine)), LENGTH)
    begin, end = np.array([3.0, 4.0, 20.0]), np.array([5.0 + 20.0 * np.sqrt(0.75), 0.0, 10.0])
    along = (end - begin) / np.linalg.norm(end - begin)
    beside = tips - begin
    assert np.abs(beside - np.outer(beside @ along, along)).max() < 1e-3


@pytest.mark.parametrize(("machine", "angles"), [("mill5-ac-table", "50,0,0"), ("mill5-bc-head", "0,60,0")])
def test_cycle800_tracks_the_tip_on_the_work(machine: str, angles: str) -> None:
    text = f'T1 D1\nTRAORI\nG0 X3 Y4 Z20\nCYCLE800(0,"",200010,57,0,0,0,{angles},0,0,0,1)\nM30\n'
    tips = on_work(machine, turning(positions_of(text, "sinumerik-840d", machine)), LENGTH)
    assert np.abs(tips - [3.0, 4.0, 20.0]).max() < 1e-3


def test_the_holder_of_a_head_counts_along_the_tool() -> None:
    text = f"G90 G43.4 H1\nG00 X3. Y4. Z20.\n{PLANE}G53.6\nM30\n"
    samples = turning(positions_of(text, "syntec-mill", "mill5-bc-head", **{"3013": int(1000 * HOLDER)}))
    tips = on_work("mill5-bc-head", samples, LENGTH, HOLDER)
    assert np.abs(tips - [3.0, 4.0, 20.0]).max() < 1e-3


#: C carries B, whose axis lies 30 mm beside that of C and 80 mm below it.
CRANKED = """
base = "mill5-bc-head"
[[joint]]
axis = "C"
carries = "tool"
direction = [0, 0, 1]
[[joint]]
axis = "B"
carries = "tool"
direction = [0, 1, 0]
offset = [30, 0, -80]
"""


@pytest.mark.parametrize("align", ["G53.1\nG43 H1", "G53.6", "G53.1\nG43 H1\nG91 G0 X1.\nG90"])
@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
def test_the_tip_of_a_cranked_head_is_where_the_plane_says(control: str, align: str, tmp_path: Path) -> None:
    machine = tmp_path / "cranked.toml"
    machine.write_text(CRANKED, encoding="utf-8")
    text = f"G43 H1\nG68.2 X5. Y0 Z0 I0 J40. K0\n{align}\nG0 X1. Y2. Z3.\nM30\n"
    setup = {"tools": {1: {"length": LENGTH}}}
    found = run(text, control, machine=str(machine), setup=setup).coordinates.machine
    b, c = (np.array([angle]) for angle in found[3:5])
    joint = np.array([30.0, 0.0, -80.0])
    moved = (turns(2, c) @ (joint + turns(1, b)[0] @ [0.0, 0.0, -LENGTH]))[0] - joint
    assert found[:3] + moved == pytest.approx(
        [5.0, 0.0, 0.0] + turns(0, np.array([40.0]))[0] @ [1.0, 2.0, 3.0]
    )
