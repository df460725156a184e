"""What a small run costs as a whole process."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks.interpreter import program
from benchmarks.measure import Figure, polycnc, process_time

LIMIT_S = 0.15


def small_run() -> Iterator[Figure]:
    """`polycnc run` of a 20-line program, byte code compiled."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "small.nc")
        path.write_text(program(16), encoding="ascii")
        command = polycnc("run", path)
        used = process_time(command, 5)
    yield Figure("polycnc run of 20 lines", f"{used:.2f} s of process time, limit {LIMIT_S}", LIMIT_S / used)
