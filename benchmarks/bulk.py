"""Plain blocks in bulk: the scanner alone, and the memory of a long run."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.measure import Figure, polycnc, process_time, rate, skipped
from benchmarks.programs import FOOT, HEAD, cut

if TYPE_CHECKING:
    from collections.abc import Iterator

BLOCKS = 1_000_000
TURNS = 3
SCANNED_PER_SECOND = 2_000_000
#: Resident memory that a program may take, however long it is.
MEMORY_LIMIT_MB = 1_500
#: Processor time and resident memory of a program of a gigabyte with cycle time.
GIGABYTE_LIMIT_S, GIGABYTE_LIMIT_MB = 60.0, 300.0
#: So many contours of `BLOCKS` blocks are more than a gigabyte.
GIGABYTE_REPEATS = 36


def write_program(folder: Path, blocks: int = BLOCKS, repeats: int = 1) -> Path:
    """A contour of a CAM system, 30 bytes a block, cut so many times."""
    contour = "\n".join([*cut(blocks), ""])
    file = folder / "cam.nc"
    with file.open("w", encoding="ascii") as out:
        out.write("\n".join(["%", "O0001", *HEAD, ""]))
        for _ in range(repeats):
            out.write(contour)
        out.write("\n".join([*FOOT, "%", ""]))
    return file


def scanner() -> Iterator[Figure]:
    """From the lines of a program to columns of the toolpath, in this process."""
    from polycnc.channel.channel import Channel
    from polycnc.control.registry import control
    from polycnc.language.bulk.compiled import LIBRARY
    from polycnc.language.bulk.settings import Bulk
    from polycnc.machine import load_machine
    from polycnc.machine.setup.values import Setup
    from polycnc.program import ProgramStore
    from polycnc.toolpath import Toolpath

    if LIBRARY.compiled("scan") is None:
        yield skipped("scanner", "this installation has no compiled kernels")
        return
    machine = load_machine("mill3")
    with tempfile.TemporaryDirectory() as name:
        ours = write_program(Path(name))
        store = ProgramStore()
        main = store.add_file(ours)
        times = []
        for _ in range(TURNS):
            toolpath = Toolpath(machine.channel_axes(1), on_full=lambda _: True)
            channel = Channel(control("fanuc-m"), machine, Setup(), store, bulk=Bulk(), toolpath=toolpath)
            begin = time.process_time()
            for _ in channel.run(main):
                pass
            times.append(time.process_time() - begin)
            if channel.alarms:
                raise RuntimeError(channel.alarms[0].code)
        yield rate("scanner alone", BLOCKS / min(times), SCANNED_PER_SECOND, "blocks/s")


#: Peak of the process itself: what `getrusage` tells counts the process that has started it, too.
_MEMORY = """
import re, sys
from polycnc.cli.app import main
sys.argv = ["polycnc", "run", *sys.argv[1:], "--control", "fanuc-m"]
try:
    main()
finally:
    with open("/proc/self/status") as status:
        print(int(re.search("VmHWM:\\s*(\\d+)", status.read())[1]) / 1024)
"""


def streaming() -> Iterator[Figure]:
    """Resident memory while a program three times as long is planned and traced."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = write_program(folder, 3 * BLOCKS)
        used, size = _memory(ours, "--trace", folder / "out.parquet"), ours.stat().st_size / 1e6
    said = f"{used:.0f} MB for a program of {size:.0f} MB with trace, limit {MEMORY_LIMIT_MB}"
    yield Figure("memory of a long run", said, MEMORY_LIMIT_MB / used)


def _memory(*arguments: str | Path) -> float:
    """Peak of resident memory of `polycnc run`, megabytes."""
    run = [sys.executable, "-c", _MEMORY, *map(str, arguments)]
    return float(subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()[-1])


def gigabyte() -> Iterator[Figure]:
    """A program of a gigabyte with cycle time: one contour of a CAM system, again and again."""
    with tempfile.TemporaryDirectory() as name:
        ours = write_program(Path(name), repeats=GIGABYTE_REPEATS)
        size = ours.stat().st_size / 1e6
        run = polycnc("run", ours)
        took, used = process_time(run, 1), _memory(ours)
    said = f"{took:.0f} s for {size:.0f} MB, limit {GIGABYTE_LIMIT_S:g}"
    yield Figure("a gigabyte of G1 with cycle time", said, GIGABYTE_LIMIT_S / took)
    said = f"{used:.0f} MB, limit {GIGABYTE_LIMIT_MB:g}"
    yield Figure("memory of a gigabyte with cycle time", said, GIGABYTE_LIMIT_MB / used)
