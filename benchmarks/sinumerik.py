"""SINUMERIK programs as whole processes against nc-gcode-interpreter 0.2.8, which is compiled and needs Python 3.12.

The peer runs in an environment of its own, made where a Python 3.12 is found, in the folder of `POLYCNC_BENCH_ENV` or
the user's cache. Where there is none, the figures that it reached on a machine of 2024 stand in for it.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.measure import Figure, against, process_time, rate, skipped

if TYPE_CHECKING:
    from collections.abc import Iterator

PEER = "nc-gcode-interpreter 0.2.8"
PASSES = 200_000
BLOCKS = 200_000
#: What the peer reached; the goals are five times its passes and three times its blocks.
STATED_PASSES, PASSES_GOAL = 65_000, 5
STATED_BLOCKS, BLOCKS_GOAL = 37_000, 3

LOOP = f"""DEF INT COUNT
DEF REAL LIST[10]
G90 G0 X0 Y0
FOR COUNT=0 TO {PASSES - 1}
R1=COUNT*0.36
R2=COS(R1)*50
R3=SIN(R1)*50
IF R2>0
R4=R2+R3
ELSE
R4=R2-R3
ENDIF
LIST[COUNT MOD 10]=R4
G1 X=R2 Y=R3 Z=LIST[COUNT MOD 10] F500
ENDFOR
M30
"""
_PEER_CODE = """
import sys
from pathlib import Path
from nc_gcode_interpreter import nc_to_dataframe
text = Path(sys.argv[1]).read_text(encoding="ascii")
nc_to_dataframe(text, iteration_limit=10**9)
"""


def different_blocks(blocks: int) -> str:
    """G1 blocks with R expressions, each with other numbers."""
    lines = [
        f"N{10 * i} G1 X=R1*{i % 997}+{i / 1000:.3f} Y=SIN({i / 7:.3f})*R2 F500" for i in range(1, blocks + 1)
    ]
    return "\n".join(["R1=0.5 R2=20", "G90 G0 X0 Y0", *lines, "M30", ""])


def loop() -> Iterator[Figure]:
    """Assignments, trigonometry, IF/ELSE, array access and a G1 in each pass."""
    yield from _compared("SINUMERIK loop", LOOP, PASSES, "passes/s", STATED_PASSES, PASSES_GOAL)


def blocks() -> Iterator[Figure]:
    """G1 blocks with expressions that are all different."""
    text = different_blocks(BLOCKS)
    yield from _compared("SINUMERIK blocks", text, BLOCKS, "blocks/s", STATED_BLOCKS, BLOCKS_GOAL)


def _compared(name: str, text: str, count: int, unit: str, stated: float, goal: float) -> Iterator[Figure]:
    python = _peer_python()
    with tempfile.TemporaryDirectory() as folder:
        program, script = Path(folder, "bench.mpf"), Path(folder, "peer.py")
        program.write_text(text, encoding="ascii")
        script.write_text(_PEER_CODE, encoding="ascii")
        run = [
            sys.executable,
            "-m",
            "polycnc",
            "run",
            str(program),
            "--control",
            "sinumerik-840d",
            "--no-time",
        ]
        ours = count / process_time(run)
        theirs = (
            _peer_rate([str(python), str(script), str(program)], count)
            if isinstance(python, Path)
            else python
        )
    if isinstance(theirs, float):
        yield against(name, ours, PEER, theirs, goal, unit)
    else:
        yield skipped(name, theirs)
        yield rate(name, ours, stated * goal, unit)


def _peer_python() -> Path | str:
    """The Python of the peer's environment, made where it does not exist; else why there is none."""
    home = os.environ.get("POLYCNC_BENCH_ENV") or Path.home() / ".cache" / "polycnc-bench"
    folder = Path(home, "nc-gcode-interpreter")
    python = folder / "bin" / "python"
    if not python.exists():
        base = _python_3_12()
        if base is None:
            return f"{PEER} needs Python 3.12, and there is none"
        subprocess.run([base, "-m", "venv", str(folder)], check=True, capture_output=True)
    package = PEER.replace(" ", "==")
    command = [str(python), "-m", "pip", "install", "-q", "--disable-pip-version-check", package]
    if subprocess.run(command, check=False, capture_output=True).returncode:
        return f"{PEER} cannot be installed"
    return python


def _python_3_12() -> str | None:
    versions = Path.home() / ".pyenv" / "versions"
    found = [shutil.which("python3.12"), *map(str, sorted(versions.glob("3.12*/bin/python3.12")))]
    for candidate in filter(None, found):
        if not subprocess.run([candidate, "--version"], check=False, capture_output=True).returncode:
            return candidate
    return None


def _peer_rate(command: list[str], count: int) -> float | str:
    """What the peer does in a second of processor time; or what it says where it cannot run the program."""
    try:
        return count / process_time(command)
    except subprocess.CalledProcessError:
        told = subprocess.run(command, check=False, capture_output=True, text=True).stderr
        return f"{PEER}: {(told.strip().splitlines() or [''])[-1]}"
