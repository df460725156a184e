"""`make bench`: every figure, one line each and as `docs/benchmarks.md`; exit status 1 where a goal is missed."""

from __future__ import annotations

import os
import sys

from benchmarks import (
    bulk,
    explaining,
    five_axes,
    installation,
    interpreter,
    mainrun,
    page,
    panel,
    planner,
    processes,
    sinumerik,
    snapshots,
    startup,
    turning,
)

BENCHMARKS = (
    processes.against_rs274,
    processes.short_programs,
    processes.calls_into_programs,
    processes.many_files,
    interpreter.plain_blocks,
    interpreter.macro_loop,
    interpreter.memory,
    bulk.scanner,
    bulk.streaming,
    bulk.gigabyte,
    installation.first_run,
    installation.size,
    five_axes.tip_control,
    startup.small_run,
    sinumerik.loop,
    sinumerik.blocks,
    turning.cycles,
    planner.speed,
    planner.optimum,
    explaining.explained,
    mainrun.real_time,
    mainrun.actions,
    mainrun.couplings,
    snapshots.milling,
    panel.long_program,
    panel.processor,
    panel.page,
)


def main() -> int:
    """Run all benchmarks and print their ratios."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    missed = 0
    figures = []
    for benchmark in BENCHMARKS:
        for figure in benchmark():
            figures.append(figure)
            mark = "  --  " if figure.ratio is None else f"{figure.ratio:5.2f}x"
            missed += figure.ratio is not None and figure.ratio < 1.0
            print(f"{mark}  {figure.name}: {figure.said}", flush=True)
    page.write(figures)
    print("a ratio of 1 is the goal; above it is better")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
