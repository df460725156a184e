"""Whole processes, as a user calls them, in turn with LinuxCNC's rs274; smallest of three."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from random import Random
from statistics import median

from benchmarks.measure import Figure, polycnc, process_time, skipped
from benchmarks.programs import HEAD, NO_TIME, TIMED, Work, all_work, lines

TURNS = 3
FILES, FILES_LIMIT_S = 2_000, 2.0
#: The first one has a line of each kind that the others have.
FEW, SHORT, LONG = 3_000, 10_000, 100_000
#: Differences of processes are small beside the processes, which differ by more from run to run: median of so many.
GROWTH_TURNS = 41
#: Part of the speed of few calls that many keep: the cost is linear.
LINEAR = 0.8


def _write(path: Path, blocks: list[str]) -> Path:
    """A program file; one of SINUMERIK, by its ending, is no tape."""
    tape = (["%", "O0001"], ["%"]) if path.suffix == ".nc" else ([], [])
    path.write_text("\n".join([*tape[0], *blocks, *tape[1], ""]), encoding="ascii")
    return path


def against_rs274() -> Iterator[Figure]:
    """Every kind of work, with each set of options."""
    rs274 = shutil.which("rs274")
    for work in all_work():
        with tempfile.TemporaryDirectory() as name:
            yield from _figures(work, Path(name), rs274)


def _figures(work: Work, folder: Path, rs274: str | None) -> Iterator[Figure]:
    ours, peer, setup = _write(folder / "ours.nc", work.ours), folder / "peer.ngc", folder / "setup.yaml"
    peer.write_text("\n".join([*work.peer, ""]), encoding="ascii")
    setup.write_text(work.setup, encoding="ascii")
    with_setup = ("--setup", setup) if work.setup else ()
    first_goal = next(iter(work.goals.values()))
    runs, goals = {}, {}
    for options, goal in work.goals.items():
        given = (str(folder / o) if "." in o else o for o in options)
        name = f"{work.name}, {_said(options)}"
        runs[name], goals[name] = polycnc("run", ours, *with_setup, *given), goal
    for control, blocks in work.others.items():
        ending = ".mpf" if control.startswith("sinumerik") else ".nc"
        program = _write(folder / f"{control}{ending}", blocks)
        name = f"{work.name} on {control}, {_said(NO_TIME)}"
        runs[name], goals[name] = polycnc("run", program, *NO_TIME, control=control), first_goal
    used = dict.fromkeys(runs, float("inf"))
    theirs = float("inf")
    for _ in range(TURNS):
        for name, run in runs.items():
            used[name] = min(used[name], process_time(run, 1))
        if rs274 is not None:
            theirs = min(theirs, process_time([rs274, "-g", str(peer)], 1))
    for name, goal in goals.items():
        if rs274 is None:
            yield skipped(name, f"rs274 is not installed (Debian: linuxcnc-uspace); ours {used[name]:.2f} s")
            continue
        times = theirs / used[name]
        said = f"{used[name]:.2f} s, rs274 {theirs:.2f} s: {times:.2f} times as fast, asked {goal:g}"
        yield Figure(name, said, times / goal, times)


def _said(options: tuple[str, ...]) -> str:
    if options == TIMED:
        return "with cycle time"
    return "without cycle time" if options == NO_TIME else f"to {Path(options[-1]).suffix[1:]}"


def short_programs() -> Iterator[Figure]:
    """What a block of a short program with cycle time costs, and one of a long program.

    It is what further blocks cost: a longer program less a shorter one, by the blocks that it has more. So no part of
    it is what is loaded once, at the start and for the first run of blocks, nor what is learnt of each kind of line.
    """
    work = lines()
    short, long = _growth({count: [*work.ours[: count + 4], "M30"] for count in (FEW, SHORT, LONG)})
    said = f"{short:.2f} µs a block of {SHORT:,}, {long:.2f} of {LONG:,}"
    yield Figure("short programs with cycle time", said, long / max(short, 1e-9))


def calls_into_programs() -> Iterator[Figure]:
    """`M98 P Q`, which calls a program from a sequence number on: a call costs the same among few and among many."""
    body = ["O2000", "X1.", "N10 X2.", "Y1.", "M99"]
    calls = [[f"X{k % 50}.", f"Y{k % 7}.", "M98 P2000 Q10"] for k in range(LONG // 5)]
    few, many = _growth({
        count: [*HEAD, *(block for call in calls[:count] for block in call), "M30", *body]
        for count in (len(calls) // 100, len(calls) // 10, len(calls))
    })  # fmt: skip
    said = f"{few:.2f} µs a call of {len(calls) // 10:,}, {many:.2f} of {len(calls):,}, limit {1 / LINEAR:g} times"
    yield Figure("calls M98 Q", said, few / LINEAR / max(many, 1e-9))


def _growth(programs: dict[int, list[str]]) -> list[float]:
    """Microseconds that each further block takes between programs of three lengths."""
    used: dict[int, list[float]] = {count: [] for count in programs}
    with tempfile.TemporaryDirectory() as name:
        runs = {
            count: polycnc("run", _write(Path(name, f"{count}.nc"), blocks))
            for count, blocks in programs.items()
        }
        order, random = [*runs.items()], Random(1)
        for _ in range(GROWTH_TURNS):
            random.shuffle(order)  # a process is slower or quicker for the one before it
            for count, run in order:
                used[count].append(process_time(run, 1))
    usual = {count: median(seconds) for count, seconds in used.items()}
    return [
        (usual[large] - usual[small]) / (large - small) * 1e6 for small, large in pairwise(sorted(programs))
    ]


def many_files() -> Iterator[Figure]:
    """`polycnc check` of many small files, on all cores: time that passes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for i in range(FILES):
            text = "".join(f"X{j}. Y{(i * j) % 50}.\n" for j in range(20))
            (folder / f"{i:04d}.nc").write_text(
                f"O1\nG90 G54 G0 Z5.\nG1 F500.\n{text}M30\n", encoding="ascii"
            )
        run = polycnc("check", *sorted(folder.iterdir()))
        took = []
        for _ in range(TURNS):
            begin = time.perf_counter()
            process_time(run, 1)
            took.append(time.perf_counter() - begin)
    said = f"{min(took):.2f} s pass, limit {FILES_LIMIT_S:g}"
    yield Figure(f"check of {FILES:,} files", said, FILES_LIMIT_S / min(took))
