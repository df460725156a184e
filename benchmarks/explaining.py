"""`polycnc run --explain-time` against the run itself."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from math import cos, sin
from pathlib import Path

from benchmarks.interpreter import program
from benchmarks.measure import Figure, polycnc, process_time

#: Blocks of the programs; how many times as long as the run itself the account may take.
BLOCKS, BLOCKS_OF_LAW, MOST_TIMES = 1_000_000, 20_000, 2.5


def explained() -> Iterator[Figure]:
    """Short lines by averages, and on a path that a law of third order leads."""
    for name, control, text in (
        (f"{BLOCKS:,} G1, --explain-time", "fanuc-m", program(BLOCKS)),
        (f"{BLOCKS_OF_LAW:,} G1 under SOFT, --explain-time", "sinumerik-840d", _soft()),
    ):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "part.nc")
            file.write_text(text, encoding="ascii")
            run = polycnc("run", file, control=control)
            alone, with_account = process_time(run), process_time([*run, "--explain-time"])
        times = with_account / alone
        said = f"{with_account:.2f} s, without it {alone:.2f} s: {times:.2f} times, limit {MOST_TIMES:g}"
        yield Figure(name, said, MOST_TIMES / times)


def _soft() -> str:
    """Short lines on a wavy circle under limited jerk."""
    places = (
        f"X{40 * cos(i / 400):.3f} Y{40 * sin(i / 400):.3f} Z{-1 - 0.2 * sin(i / 30):.3f}"
        for i in range(BLOCKS_OF_LAW)
    )
    return "\n".join(["G90 G54 SOFT G642", "G1 F3000", *places, "M30", ""])
