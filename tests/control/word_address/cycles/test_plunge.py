"""Holes whose rows are written at once: the same table as stroke by stroke."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from polycnc.control.word_address.cycles import drilling, plunge
from polycnc.cycles.drilling import holes
from tests.support import codes, run

HOLES = (
    "X1. Y2.\nX3.\nY7. R1.\nX4. Z-8.\nF90\nX5. Y-0.\nG99 X6.\nX7.\nL0\nX8. L3\nG98 X9.\nG80\nG0 X0 Z1.\nM30\n"
)
CYCLES = {
    "fanuc-m": ("G81", "G82 P100", "G83 Q2.5", "G73 Q3.", "G85", "G89 P50", "G86", "G76 Q1. P20", "G84"),
    "meldas-m": ("G81", "G83 Q2.5", "G85"),
    "syntec-mill": ("G81", "G82 P0.1", "G83 Q2.5", "G73 Q3.", "G85"),
    "fanuc-0i-tf": ("G83 Q2500", "G85"),
}
HEADS = ("G90", "G91", "G90 G68 X0 Y0 R30.", "G90 G51 X0 Y0 Z0 P2000", "G41 D1 G90", "G90 G18")


def table(control: str, text: str, **options: object) -> list[str]:
    """Everything that a run leaves: rows, alarms, blocks, where the channel stands."""
    channel = run(text, control, **options)  # type: ignore[arg-type]
    c = channel.coordinates
    rows = [repr(row) for row in channel.toolpath.rows()]
    return [
        *rows,
        repr(channel.alarms),
        repr(channel.blocks),
        repr(c.position),
        repr(c.programmed),
        repr(c.pending),
    ]


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize(
    ("control", "cycle"), [(control, cycle) for control, found in CYCLES.items() for cycle in found]
)
def test_holes_are_the_same_at_once_and_stroke_by_stroke(
    control: str, cycle: str, head: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = f"{head}\nG0 X0 Y0 Z5.\nM3 S500\nG98 {cycle} X0 Y0 Z-6. R2. F100.\n{HOLES}"
    setups: list[dict[str, object]] = [
        {},
        {"setup": {"switches": {"single_block": True}}},
        {"block_limit": 12},
        {"chunk_rows": 20},
    ]
    for options in setups:
        fast = table(control, text, **options)
        with monkeypatch.context() as plain:
            plain.setattr(drilling, "plunges", lambda *_: False)
            assert table(control, text, **options) == fast


@pytest.mark.parametrize("bottom", [-6.0, -41.0, -39.9999999])
def test_a_hole_beyond_the_travel_alarms_at_its_stroke(
    bottom: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = tmp_path / "short.toml"
    machine.write_text('base = "mill3"\n[axis.Z]\nlimit_minus = -40\nlimit_plus = 50\n', encoding="utf-8")
    text = f"G90 G0 X0 Y0 Z5.\nG83 X0 Y0 Z-6. R2. Q2. F100.\nX1. Z{bottom}\nX2.\nM30\n"
    fast = table("fanuc-m", text, machine=str(machine))
    monkeypatch.setattr(drilling, "plunges", lambda *_: False)
    assert table("fanuc-m", text, machine=str(machine)) == fast
    assert ("OT0500" in "".join(fast) or "OT0501" in "".join(fast)) == (bottom == -41.0)


def test_plain_holes_are_written_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drilling, "_work", lambda *_: pytest.fail("stroke by stroke"))
    channel = run("G90 G0 X0 Y0 Z5.\nG83 X0 Y0 Z-6. R2. Q2. F100.\nX1.\nM30\n")
    assert codes(channel) == []


def test_a_minus_at_zero_is_kept() -> None:
    plain, minus = (
        [
            row.end[2]
            for row in run(f"G0 Z5.\nG81 X1. Z{zero} R2. F100.\nX2.\nM30\n").toolpath.rows()
            if row.event is None
        ]
        for zero in ("0.", "-0.")
    )
    assert [math.copysign(1.0, end) for end in plain] != [math.copysign(1.0, end) for end in minus]


def test_a_hole_with_very_many_strokes_is_none() -> None:
    hole = holes.Hole(5.0, 2.0, -1000.0, 5.0, peck=0.1)
    assert plunge.plunge_of(holes.peck_clearing_chips, hole, 5.0, 1.0) is None
