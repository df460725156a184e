"""Measuring: a program to interpret, processor time of this process or of a child, and how a result is said."""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Figure:
    """One result.

    Attributes:
        name: What is measured.
        said: The figure, and what was asked.
        ratio: How much better than asked (above 1 the goal is reached); None where a peer is missing.
        times: How many times as fast as the peer; None where there is none.
    """

    name: str
    said: str
    ratio: float | None
    times: float | None = None


def best_of(action: Callable[[], object], runs: int = 3) -> float:
    """Shortest processor time of an action in this process, seconds."""
    times = []
    for _ in range(runs):
        begin = time.process_time()
        action()
        times.append(time.process_time() - begin)
    return min(times)


def polycnc(*words: str | Path, control: str = "fanuc-m") -> list[str]:
    """A command line as a user types it: of the command that the installation has put beside its Python."""
    return [str(Path(sys.executable).with_name("polycnc")), *map(str, words), "--control", control]


def process_time(command: Sequence[str], runs: int = 3) -> float:
    """Shortest processor time of a command, user and system, seconds."""
    times = []
    for _ in range(runs):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


def interpret(text: str, control_id: str, machine: str, name: str = "MAIN") -> int:
    """Run a text through the interpreter, without planning or export; gives the number of rows."""
    from polycnc.channel.channel import Channel
    from polycnc.control.registry import control
    from polycnc.machine import load_machine
    from polycnc.machine.setup.values import Setup
    from polycnc.program import ProgramStore

    chosen = control(control_id)
    store = ProgramStore(form=chosen.form)
    main = store.add_text(name, text)
    channel = Channel(chosen, load_machine(machine), Setup(), store)
    for _ in channel.run(main):
        pass
    if channel.alarms:
        raise RuntimeError(channel.alarms[0].code)
    return len(channel.toolpath)


def rate(name: str, ours: float, limit: float, unit: str) -> Figure:
    """A rate against a lower limit."""
    return Figure(name, f"{ours:,.0f} {unit}, limit {limit:,.0f}", ours / limit)


def against(name: str, ours: float, peer: str, theirs: float, goal: float, unit: str) -> Figure:
    """A rate against a peer's; `goal` is how many times the peer's rate is asked."""
    said = f"{ours:,.0f} {unit}, {peer} {theirs:,.0f}: {ours / theirs:.1f} times, asked {goal:g}"
    return Figure(name, said, ours / theirs / goal, ours / theirs)


def skipped(name: str, why: str) -> Figure:
    """A figure that cannot be had here."""
    return Figure(name, f"skipped: {why}", None)
