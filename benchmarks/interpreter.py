"""The interpreter: plain blocks against pygcode, a macro loop against LinuxCNC's rs274, memory of a long table."""

from __future__ import annotations

import math
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks.measure import Figure, against, best_of, interpret, process_time, rate, skipped

PLAIN_BLOCKS = 200_000
PEER_BLOCKS = 4_000
LOOP_PASSES = 100_000
MEMORY_MOVES = 1_000_000
MEMORY_LIMIT_MB = 400

OUR_LOOP = f"""O0001
G90 G54 G0 X0 Y0
#1=0
WHILE[#1LT{LOOP_PASSES}]DO1
#2=#1*0.36
#3=COS[#2]*50
#4=SIN[#2]*50
IF[#3GT100]GOTO900
G1 X#3 Y#4 F500
#1=#1+1
END1
N900 M30
"""
PEER_LOOP = f"""G21 G90 G0 X0 Y0
#1=0
o100 while [#1 LT {LOOP_PASSES}]
#2=[#1*0.36]
#3=[COS[#2]*50]
#4=[SIN[#2]*50]
o110 if [#3 GT 100]
M2
o110 endif
G1 X#3 Y#4 F500
#1=[#1+1]
o100 endwhile
M2
"""


def contour(blocks: int) -> list[str]:
    """Short G1 blocks as a CAM system writes them."""
    return [
        f"X{50 * math.cos(i / 900) + i * 1e-4:.3f} Y{50 * math.sin(i / 900):.3f} Z{-1 - i * 1e-6:.4f}"
        for i in range(blocks)
    ]


def program(blocks: int) -> str:
    """A program of short blocks for FANUC."""
    return "\n".join(["O0001", "G90 G54 G0 X0 Y0 Z10.", "G1 Z-1. F1000.", *contour(blocks), "M30", ""])


def plain_blocks() -> Iterator[Figure]:
    """200,000 short G1 blocks."""
    text = program(PLAIN_BLOCKS)
    ours = PLAIN_BLOCKS / best_of(lambda: interpret(text, "fanuc-m", "mill3"))
    yield rate("short G1 blocks", ours, 40_000, "blocks/s")
    try:
        from pygcode import Line, Machine
    except ImportError:
        yield skipped("short G1 blocks", "pygcode is not installed (extra `bench`)")
        return
    lines = ["G90 G0 X0 Y0 Z10.", "G1 Z-1. F1000.", *contour(PEER_BLOCKS)]

    def peer() -> None:
        machine = Machine()
        for line in lines:
            machine.process_block(Line(line).block)

    theirs = PEER_BLOCKS / best_of(peer, 1)
    yield against("short G1 blocks", ours, "pygcode 0.2.1", theirs, 10, "blocks/s")


def macro_loop() -> Iterator[Figure]:
    """Assignments, trigonometry, IF and a G1 in each pass."""
    ours = LOOP_PASSES / best_of(lambda: interpret(OUR_LOOP, "fanuc-m", "mill3"))
    rs274 = shutil.which("rs274")
    if rs274 is None:
        yield skipped(
            "macro loop", f"rs274 is not installed (Debian: linuxcnc-uspace); ours {ours:,.0f} passes/s"
        )
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "loop.ngc")
        path.write_text(PEER_LOOP, encoding="ascii")
        theirs = LOOP_PASSES / process_time([rs274, "-g", str(path)], 1)
    yield against("macro loop", ours, "rs274 -g", theirs, 5, "passes/s")


_MEMORY = """
from benchmarks.interpreter import program, resident_mb
from benchmarks.measure import interpret
interpret(program(1000), "fanuc-m", "mill3")
before = resident_mb()
from polycnc.toolpath import Toolpath
table = Toolpath(("X", "Y", "Z"))
end = [1.0, 2.0, 3.0]
for i in range({moves}):
    table.append(1, 0, i, 0, 10.0, end)
    table.block_boundary()
print(resident_mb() - before)
"""


def resident_mb() -> float:
    """Resident memory of this process (Linux)."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def memory() -> Iterator[Figure]:
    """What a table of a million moves holds."""
    code = _MEMORY.format(moves=MEMORY_MOVES)
    out = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    used = float(out)
    yield Figure(
        "table of 1,000,000 moves",
        f"{used:.0f} MB, limit {MEMORY_LIMIT_MB}",
        MEMORY_LIMIT_MB / max(used, 1.0),
    )
