"""Plan, samples and main run are one motion on programs of the conformance cases, each with its control and its setup.

Of all cases that give no alarm every tenth is run, in the order of the files; `OUTSIDE` says which of them have no plan
to be compared with. The times agree to 1 ms, the axes are at the same places at the same times, and by differences of
the sampled positions none exceeds its velocity, its acceleration or, with limited jerk, its jerk.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from polycnc.cases.format import Case, CaseError, parse_case
from polycnc.cases.reading import read_cases
from polycnc.mainrun import State, VirtualControl
from polycnc.motion.limits import channel_axes
from polycnc.motion.sampling.samples import Samples
from polycnc.motion.time_constants import Use, after_s, dynamics
from polycnc.session import open_session
from polycnc.toolpath.modes import AccelerationMode
from tests.mainrun.support import recorded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.session import Result

CASES = Path(__file__).parents[2] / "conformance"
#: One of so many cases; tests into which they are put; a program that takes longer is left out, s.
EVERY, TESTS, LONGEST_S = 10, 20, 60.0
PERIOD, SLACK = 0.001, 1.001
#: Places of the main run that are compared; how far apart they may be, mm or degrees, at rest and by 0.15 ms of way.
PLACES, APART, LATE_S = 100, 0.002, 1.5e-4
#: What the control is told from outside, of which the plan knows an ideal: no time to brake, no operator.
SIGNALS = frozenset({
    "single_block", "signals_at", "skip_signal_at", "measure_signal_at", "probe", "interrupts", "mode",
})  # fmt: skip
#: Cases without a plan to compare with: the event of the main run, or the row, that says so.
OUTSIDE = {
    "action": "axes that are positioned beside the path",
    "skip": "an input that comes on the way",
}


@cache
def cases() -> list[tuple[Path, Case]]:
    """The cases that are run: of those without operator, alarms and signals, in the order of their files."""
    return list(_every())[::EVERY]


def _every() -> Iterator[tuple[Path, Case]]:
    for file in sorted(CASES.rglob("*.yaml")):
        for entry in read_cases(file):
            try:
                case = parse_case(entry)
            except CaseError:
                continue
            switches: Any = case.setup.get("switches", {})
            if not case.operate and not case.expect.alarms and not SIGNALS & switches.keys():
                yield file.parent, case


def planned(folder: Path, case: Case) -> tuple[Result, Samples] | None:
    """The result with its plan, and the samples; None where there is nothing to compare."""
    more: Any = {"control": case.control, "setup": case.setup, "files": case.files, "folder": folder}
    text = case.program.removesuffix("\n") + "\n"
    result = open_session(text, **more).run()
    group = result.channel.group
    several = group is not None and len(group.channels) > 1
    if not result.ok or result.main_run_s is not None or several or not 0.0 < result.plan.total_s < LONGEST_S:
        return None
    found: list[Samples] = []
    session = open_session(text, **more, keep=False)
    sampler = session.sample(PERIOD, found.append)
    again = session.run()
    assert again.plan.total_s == pytest.approx(result.plan.total_s, abs=1e-9)
    sampler.close()
    assert sampler.time == pytest.approx(result.plan.total_s, abs=1e-6)
    return result, Samples(*(np.concatenate(column) for column in zip(*found, strict=True)))


def executed(folder: Path, case: Case, samples: Samples, rotary: list[bool]) -> tuple[float, set[str]]:
    """Seconds that the main run takes, and the kinds of its events; its axes are where the samples say up to a stop."""
    machine = folder / str(case.setup.get("machine", ""))
    setup = case.setup | ({"machine": str(machine)} if machine.is_file() else {})
    virtual = VirtualControl(case.control, setup=setup, files=case.files)
    virtual.load(case.program.removesuffix("\n") + "\n")
    records = recorded(virtual)
    virtual.cycle_start()
    stride = 4 * max(1, len(samples.time) // (4 * PLACES))
    speeds = np.abs(samples.velocity).max(axis=1)
    off: list[float] = []
    for place, speed in zip(samples.position[::stride], speeds[::stride], strict=True):
        if virtual.state is not State.RUNNING:
            break
        apart = np.abs(np.array(virtual.machine_position) - place)
        apart = np.where(rotary, np.abs((apart + 180.0) % 360.0 - 180.0), apart)
        off.append(float(apart.max()) - APART - LATE_S * float(speed))
        virtual.step(stride * PERIOD)
    while virtual.run(limit_s=10.0 * LONGEST_S) is State.STOPPED:
        virtual.cycle_start()
    assert virtual.state is State.READY
    events = {str(record.data.get("type")) for record in records if record.what == "event"}
    assert events & OUTSIDE.keys() or max(off) <= 0.0
    states = [(record.time, record.data["state"]) for record in records if record.what == "state"]
    spans = pairwise(states)
    return sum(end - begin for (begin, state), (end, _) in spans if state is State.RUNNING), events


def keep_limits(result: Result, samples: Samples, rotary: list[bool]) -> None:
    """By the differences of positions every axis keeps its limits."""
    settings = result.lead["settings"]
    modes = {context.acceleration or settings.acceleration for context in result.toolpath.contexts}
    free = after_s(result.machine, 1, settings) > 0.0
    steps = np.diff(samples.position, axis=0)
    steps = np.where(rotary, (steps + 180.0) % 360.0 - 180.0, steps)
    axes = channel_axes(result.machine, 1, result.machine.channels[0].names)
    for step, axis, name in zip(steps.T, axes, result.toolpath.axes, strict=True):
        assert axis is not None
        able = [dynamics(axis, name, settings, use) for use in (Use.CUT, Use.RAPID)]
        limits = [max(axis.rapid, axis.max_feed)]
        if not free and max(own.acceleration for own in able) > 0.0:
            limits.append(max(own.acceleration for own in able))
            overlaps = any(
                context.overlap > 0.0 or context.rapid_overlap for context in result.toolpath.contexts
            )
            if modes == {AccelerationMode.JERK_LIMITED} and not overlaps:
                limits.append(max(own.jerk for own in able))
        for order, limit in enumerate(limits, 1):
            found = np.abs(np.diff(step, order - 1)).max(initial=0.0)
            assert found <= limit * PERIOD**order * SLACK + 1e-9, (name, order)


@pytest.mark.parametrize("part", range(TESTS))
def test_plan_samples_and_main_run_are_one_motion(part: int) -> None:
    compared = 0
    for folder, case in cases()[part::TESTS]:
        try:
            if (found := planned(folder, case)) is None:
                continue
            result, samples = found
            axes = channel_axes(result.machine, 1, result.machine.channels[0].names)
            rotary = [axis is not None and axis.rotary for axis in axes]
            seconds, events = executed(folder, case, samples, rotary)
            if events & OUTSIDE.keys() or "skip" in {row["type"] for row in result.rows}:
                continue
            assert seconds == pytest.approx(result.plan.total_s, abs=0.001)
            keep_limits(result, samples, rotary)
            compared += 1
        except Exception as error:
            error.add_note(f"{case.id} ({case.control}, {case.setup}):\n{case.program}")
            raise
    assert compared > 0
