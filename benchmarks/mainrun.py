"""The main run against real time: simulated seconds in a second of the processor, block by block and cycle by cycle."""

from __future__ import annotations

import time
from itertools import pairwise
from math import cos, sin
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from benchmarks.measure import Figure, rate
from polycnc import VirtualControl
from polycnc.machine import load_machine

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.machine import Machine

LINES = 10_000
#: A circle of 50 mm in lines of 0.2 mm.
CIRCLE = "\n".join(f"X{50 * sin(k / 250):.4f} Y{50 - 50 * cos(k / 250):.4f}" for k in range(1, LINES + 1))
ARCS = "\n".join(f"G{2 + k % 2} X{2 * k}. R1." for k in range(1, LINES // 20))
HOLES = "\n".join(f"X{k}." for k in range(LINES // 20))
#: Control and program. At 6 m/min the lines come faster than any other program asks for blocks.
PROGRAMS = {
    "lines of 0.2 mm, BRISK": ("sinumerik-840d", f"BRISK G642 G1 F6000\n{CIRCLE}\nM30\n"),
    "lines of 0.2 mm, SOFT": ("sinumerik-840d", f"SOFT G642 G1 F6000\n{CIRCLE}\nM30\n"),
    "lines of 0.2 mm, FANUC": ("fanuc-m", f"O1\nG1 F6000.\n{CIRCLE}\nM30\n"),
    "arcs of 1 mm": ("fanuc-m", f"O1\nG1 F6000.\n{ARCS}\nM30\n"),
    "drilling": ("fanuc-m", f"O1\nG81 Z-5. R2. F500.\n{HOLES}\nG80\nM30\n"),
}
#: Modal synchronised actions, and the program in which they are looked at in every interpolation cycle.
ACTIONS = 20
ACTING = "\n".join(
    f"ID={k} WHENEVER $AA_IM[X]>{5 * k} DO $AC_MARKER[{k % 8}]=$AC_MARKER[{k % 8}]+1"
    if k % 2
    else f"ID={k} EVERY $AC_TIMER[1]>{k} DO $R{k}=$AA_IM[X]*2"
    for k in range(1, ACTIONS + 1)
)
#: Cycles a second of the processor: 20 s of machine time at a cycle of 2 ms.
CYCLES_A_SECOND = 10_000
#: Axes that follow one another, what each of them can do, and how near they are to their place in the end.
CHAIN, LIMITS, PLACE_MM = 64, "acceleration = 2000\nrapid = 30000\nmax_feed = 30000\n", 1e-6
#: Simulated seconds of the run that is read in every cycle.
READ_S = 3.0


def real_time() -> Iterator[Figure]:
    """How many times faster than real time each program runs, and how many when a panel reads it in every cycle."""
    for name, (control, text) in PROGRAMS.items():
        virtual = _started(control, text)
        begin = time.process_time()
        virtual.run()
        yield rate(f"main run, {name}", virtual.time / (time.process_time() - begin), 1.0, "times real time")
    virtual = _started(*PROGRAMS["lines of 0.2 mm, SOFT"])
    begin = time.process_time()
    while virtual.time < READ_S:
        virtual.step()
        virtual.machine_position  # noqa: B018 - what a panel reads
    seconds = time.process_time() - begin
    yield rate("main run, SOFT, read in every cycle", READ_S / seconds, 1.0, "times real time")


def actions() -> Iterator[Figure]:
    """Interpolation cycles a second of the processor while modal synchronised actions are looked at in each."""
    virtual = _started("sinumerik-840d", f"$AC_TIMER[1]=0\n{ACTING}\nG1 X100 F300\nM30\n")
    begin = time.process_time()
    virtual.run()
    cycles = virtual.time / load_machine("mill3").interpolation_cycle_s
    rated = cycles / (time.process_time() - begin)
    yield rate(f"main run, {ACTIONS} modal synchronised actions", rated, CYCLES_A_SECOND, "cycles/s")


def couplings() -> Iterator[Figure]:
    """How many times faster than real time a chain of axes runs, each of them coupled to the one before it."""
    names = ["X", "Y", "Z", *(f"V{k}" for k in range(CHAIN - 3))]
    chain = "".join(f"TRAILON({after},{before},1)\n" for before, after in pairwise(names))
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.toml"
        limits = "".join(f"[axis.{name}]\n{LIMITS}" for name in names)
        path.write_text(f'base = "mill3"\n[channel.1]\naxes = {names}\n{limits}', encoding="utf-8")
        virtual = _started("sinumerik-840d", f"{chain}G1 X100 F3000\nX0\nX100\nM30\n", load_machine(path))
    begin = time.process_time()
    virtual.run()
    seconds = time.process_time() - begin
    if any(abs(place - 100.0) > PLACE_MM for place in virtual.machine_position):
        raise ValueError("an axis of the chain stands elsewhere")
    yield rate(
        f"main run, {CHAIN} axes in a chain of couplings", virtual.time / seconds, 1.0, "times real time"
    )


def _started(control: str, text: str, machine: Machine | None = None) -> VirtualControl:
    virtual = VirtualControl(control, machine=machine)
    virtual.load(text)
    virtual.cycle_start()
    return virtual
