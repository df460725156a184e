"""Plain blocks in bulk: a CAM program of a million blocks against LinuxCNC's rs274, the scanner alone, the export.

The same contour is written for FANUC and for LinuxCNC, about 30 MB each. The commands run as whole processes, in turn
with the peer; shortest processor times count. Kernels are warm, but for the figure that says what the first run costs.
"""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.measure import Figure, process_time, rate, skipped

if TYPE_CHECKING:
    from collections.abc import Iterator

BLOCKS = 1_000_000
TURNS = 3
PEER_TIMES = 10
SCANNED_PER_SECOND = 2_000_000
EXPORTED_PER_SECOND = 500_000
#: Resident memory that a program may take, however long it is.
MEMORY_LIMIT_MB = 1_500


def write_programs(folder: Path, blocks: int = BLOCKS) -> tuple[Path, Path]:
    """The program for FANUC and for LinuxCNC."""
    head, foot = ["G21 G17 G90 G94", "G54 G0 X0 Y0 Z10.", "M3 S8000", "G1 Z-1. F1000."], ["M5", "M30"]
    contour = [
        f"N{i} G1 X{50 * math.cos(i / 900) + i * 1e-5:.3f} Y{50 * math.sin(i / 900):.3f}"
        + (f" Z{-1 - 2 * math.sin(i / 70):.3f}" if i % 3 == 0 else "")
        + (f" F{900 + i // 1000 % 7 * 50}." if i % 1000 == 0 else "")
        for i in range(1, blocks + 1)
    ]
    ours, peer = folder / "cam.nc", folder / "cam.ngc"
    text = "\n".join([*head, *contour, *foot])
    ours.write_text(f"%\nO0001\n{text}\n%\n", encoding="ascii")
    peer.write_text(f"{text}\n", encoding="ascii")
    return ours, peer


def command(*arguments: str | Path) -> list[str]:
    """`polycnc run …` for FANUC as a process of its own."""
    return [sys.executable, "-m", "polycnc", "run", *map(str, arguments), "--control", "fanuc-m"]


def whole_process() -> Iterator[Figure]:
    """The whole command, without the plan and with it, and with a trace."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours, peer = write_programs(folder)
        size = f"{ours.stat().st_size / 1e6:.0f} MB"
        plain, planned = command(ours, "--no-time"), command(ours)
        traced = command(ours, "--no-time", "--trace", folder / "out.parquet")
        process_time(plain, 1), process_time(planned, 1)  # kernels into the cache
        rs274 = shutil.which("rs274")
        theirs = [0.0]
        times: list[list[float]] = [[], [], []]
        for turn in range(TURNS):
            for measured, run in zip(times, (plain, planned, traced), strict=True):
                measured.append(process_time(run, 1))
            if rs274 is not None:
                theirs[turn:] = [process_time([rs274, "-g", str(peer)], 1)]
        seconds, with_plan, with_trace = map(min, times)
        name = f"1,000,000 blocks ({size}), whole process"
        if rs274 is None:
            why = "rs274 is not installed (Debian: linuxcnc-uspace)"
            yield skipped(name, f"{why}; ours {seconds:.2f} s, with cycle time {with_plan:.2f} s")
        else:
            yield _against(name, seconds, min(theirs))
            yield Figure(
                f"{name}, with cycle time",
                f"{with_plan:.2f} s, rs274 -g {min(theirs):.2f} s without one",
                None,
            )
        exported = BLOCKS / max(with_trace - seconds, 1e-9)
        yield rate("parquet export", exported, EXPORTED_PER_SECOND, "moves/s")


def _against(name: str, ours: float, theirs: float) -> Figure:
    said = f"{ours:.2f} s, rs274 -g {theirs:.2f} s: {theirs / ours:.1f} times as fast, asked {PEER_TIMES}"
    return Figure(name, said, theirs / ours / PEER_TIMES)


def scanner() -> Iterator[Figure]:
    """From the lines of a program to columns of the toolpath, in this process."""
    from polycnc.channel.channel import Channel
    from polycnc.control.registry import control
    from polycnc.language.bulk.compiled import LIBRARY
    from polycnc.language.bulk.kernels import scan
    from polycnc.language.bulk.scanner import Bulk
    from polycnc.machine import load_machine
    from polycnc.machine.setup.values import Setup
    from polycnc.program import ProgramStore
    from polycnc.toolpath import Toolpath

    if LIBRARY.compiled(scan) is None:
        yield skipped("scanner", "numba is not installed (extra `fast`)")
        return
    machine = load_machine("mill3")
    with tempfile.TemporaryDirectory() as name:
        ours, _ = write_programs(Path(name))
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
    with tempfile.TemporaryDirectory() as cache:
        code = (
            "from polycnc.language.bulk.compiled import LIBRARY\n"
            "from polycnc.language.bulk.kernels import scan\nLIBRARY.compiled(scan)"
        )
        cold = [sys.executable, "-c", code]
        environment = os.environ | {"NUMBA_CACHE_DIR": cache}
        begin = time.perf_counter()
        subprocess.run(cold, check=True, env=environment)
        seconds = time.perf_counter() - begin
    yield Figure("scanner, first run ever", f"{seconds:.1f} s for compiling, kept from then on", None)


#: Peak of the process itself: what `getrusage` tells counts the process that has started it, too.
_MEMORY = """
import re, sys
from polycnc.cli.app import main
sys.argv = ["polycnc", "run", sys.argv[1], "--control", "fanuc-m", "--trace", sys.argv[2]]
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
        ours, _ = write_programs(folder, 3 * BLOCKS)
        run = [sys.executable, "-c", _MEMORY, str(ours), str(folder / "out.parquet")]
        out = subprocess.run(run, check=True, capture_output=True, text=True).stdout
        used, size = float(out.split()[-1]), ours.stat().st_size / 1e6
    said = f"{used:.0f} MB for a program of {size:.0f} MB with trace, limit {MEMORY_LIMIT_MB}"
    yield Figure("memory of a long run", said, MEMORY_LIMIT_MB / used)
