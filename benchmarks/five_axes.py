"""Blocks of five axes through a control of the tool's tip, as whole processes with cycle time."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from math import cos, radians, sin
from pathlib import Path

from benchmarks.measure import Figure, polycnc, process_time, rate

#: Blocks of a program.
BLOCKS = 1_000_000
BLOCKS_PER_SECOND = 150_000
_SETUP = "machine: mill5-bc-head\ntools: {1: {length: 100}}\n"


def tip_control() -> Iterator[Figure]:
    """Rotary axes through G43.4 and TRAORI, and directions through TRAORI."""
    fanuc = ["%", "O0001", "G21 G17 G90 G94", "G54 G0 X0 Y0 Z10. B0 C0", "M3 S8000", "G43.4 H1", "G1 F1000."]
    sinumerik = ["G71 G17 G90 G94", "G54 G0 X0 Y0 Z10 B0 C0", "S8000 M3", "TRAORI", "G1 F1000"]
    works = (
        ("G1 X Y Z B C through G43.4", "fanuc-m", fanuc, "G49", _turned),
        ("G1 X Y Z B C through TRAORI", "sinumerik-840d", sinumerik, "TRAFOOF", _turned),
        ("G1 X Y Z A3 B3 C3 through TRAORI", "sinumerik-840d", sinumerik, "TRAFOOF", _directed),
    )
    for name, control, start, end, tool in works:
        with tempfile.TemporaryDirectory() as folder:
            program, setup = Path(folder, "part.nc"), Path(folder, "setup.yaml")
            lines = (f"N{i} G1 {_place(i)} {tool(i)}" for i in range(1, BLOCKS + 1))
            program.write_text("\n".join([*start, *lines, end, "M5", "M30", ""]), encoding="ascii")
            setup.write_text(_SETUP, encoding="ascii")
            run = polycnc("run", program, control=control)
            seconds = process_time([*run, "--setup", str(setup)], 1)
        yield rate(f"{name}, with cycle time", BLOCKS / seconds, BLOCKS_PER_SECOND, "blocks/s")


def _place(i: int) -> str:
    return f"X{40 * cos(i / 900):.3f} Y{40 * sin(i / 900):.3f} Z{-1 - 2 * sin(i / 70):.3f}"


def _angles(i: int) -> tuple[float, float]:
    return 20 * sin(i / 2000), 15 * cos(i / 3000)


def _turned(i: int) -> str:
    b, c = _angles(i)
    return f"B{b:.3f} C{c:.3f}"


def _directed(i: int) -> str:
    b, c = map(radians, _angles(i))
    return f"A3={sin(b) * cos(c):.6f} B3={sin(b) * sin(c):.6f} C3={cos(b):.6f}"
