"""Snapshots: how long it takes to note a channel in the midst of a program, and to bring it back."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.measure import Figure, best_of
from polycnc.channel.channel import Channel
from polycnc.channel.states.snapshot import Snapshot
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.program import ProgramStore

LIMIT_S = 0.002
TIMES = 100
#: Stops in a macro, under cutter compensation, with variables and many rows behind it.
PROGRAM = """O0001
G90 G54 G0 X0 Y0 Z10. S1000 M3
#500=0
WHILE [#500 LT 2000] DO1
#[501+#500-FIX[#500/400]*400]=#500
G1 X#500 Y[#500/2] F500
#500=#500+1
END1
G41 D1 G1 X0 Y10.
Y20.
G65 P9010 A1. B2.
M30
"""
MACRO = "O9010\nG1 X#1 Y30.\nM0\nM99\n"


def milling() -> Iterator[Figure]:
    """A milling channel that waits."""
    chosen, store = control("fanuc-m"), ProgramStore()
    main = store.add_text("MAIN", PROGRAM)
    store.add_text("O9010", MACRO)
    setup = parse_setup({"tools": {1: {"radius": 2.0}}})
    channel = Channel(chosen, load_machine(chosen.default_machine), setup, store)
    if next(channel.run(main)).reason != "stop":
        raise RuntimeError(channel.alarms)
    snapshots = [Snapshot(channel)]

    def note() -> None:
        for _ in range(TIMES):
            snapshots[0] = Snapshot(channel)

    def restore() -> None:
        for _ in range(TIMES):
            snapshots[0].restore()

    for name, action in (("snapshot of a channel", note), ("its restoration", restore)):
        seconds = best_of(action) / TIMES
        said = f"{seconds * 1e3:.2f} ms, limit {LIMIT_S * 1e3:g}"
        yield Figure(name, said, LIMIT_S / seconds)
