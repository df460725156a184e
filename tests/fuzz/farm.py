"""Several workers at once; what they find is grouped by root."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import threading
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

_FRAME = re.compile(r'File ".*/polycnc/([^"]+)", line \d+ in (\w+)')
#: How many inputs of a root are named.
NAMED = 8


@dataclass
class Root:
    """What several inputs have failed by.

    Attributes:
        what: The first one's error.
        path: Where it has come from.
        count: How many inputs.
        numbers: The first of them.
    """

    what: str
    path: str = ""
    count: int = 0
    numbers: list[int] = field(default_factory=list)


@dataclass
class Findings:
    """What a run of the farm has found.

    Attributes:
        inputs: How many inputs were run.
        roots: The failures by root.
    """

    inputs: int = 0
    roots: dict[str, Root] = field(default_factory=dict)

    def add(self, failed: int, root: str, what: str, path: str = "", **_: object) -> None:
        """One input has failed."""
        found = self.roots.setdefault(root, Root(what, path))
        found.count += 1
        if len(found.numbers) < NAMED:
            found.numbers.append(failed)

    def report(self) -> str:
        """Every root with its inputs, the most frequent first."""
        lines = [f"{self.inputs} inputs, {sum(root.count for root in self.roots.values())} failed"]
        for name, root in sorted(self.roots.items(), key=lambda item: -item[1].count):
            numbers = ", ".join(map(str, root.numbers))
            lines += [
                f"{root.count:6} {name}",
                f"       {root.what}",
                f"       {root.path}",
                f"       {numbers}",
            ]
        return "\n".join(lines)


class Farm:
    """Runs inputs on several processes.

    Args:
        seed: Seed of all inputs.
        first: Number of the first input.
        count: How many.
        jobs: Processes.
        seconds: No input begins later than that.
        progress: Called now and then.
    """

    def __init__(
        self,
        seed: int,
        first: int,
        count: int,
        jobs: int,
        seconds: float = float("inf"),
        progress: Callable[[Findings], None] | None = None,
    ) -> None:
        self._seed, self._first, self._count, self._jobs = seed, first, count, jobs
        self._end = monotonic() + seconds
        self._progress = progress
        self._lock = threading.Lock()
        self.findings = Findings()

    def run(self) -> Findings:
        """Run all inputs; gives what was found."""
        threads = [threading.Thread(target=self._one, args=(job,), daemon=True) for job in range(self._jobs)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        return self.findings

    def _one(self, job: int) -> None:
        """The inputs of one job: a worker that dies is replaced by one that goes on behind the input it died of."""
        number = self._first + job
        end = self._first + self._count
        while number < end and monotonic() < self._end:
            number = self._worker(number, (end - number + self._jobs - 1) // self._jobs) + self._jobs

    def _worker(self, first: int, count: int) -> int:
        """Run a worker; gives the number of its last input."""
        words = [sys.executable, "-m", "tests.fuzz.worker", *map(str, (self._seed, first, self._jobs, count))]
        at = first - self._jobs
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            errors: list[str] = []
            assert process.stdout is not None
            assert process.stderr is not None
            drain = threading.Thread(target=lambda: errors.extend(process.stderr or ()), daemon=True)
            drain.start()
            for line in process.stdout:
                told = json.loads(line)
                with self._lock:
                    if "at" in told:
                        at = told["at"]
                        self.findings.inputs += 1
                    else:
                        self.findings.add(**told)
                    if self._progress is not None:
                        self._progress(self.findings)
                if "at" in told and monotonic() > self._end:
                    process.kill()
                    return at + self._jobs * count
            drain.join()
            status = process.wait()
        if status != 0:
            self._died(at, status, "".join(errors))
        return at

    def _died(self, number: int, status: int, errors: str) -> None:
        """A worker has died of an input: by what hangs outside Python, or by a signal."""
        frames = [f"{file}:{name}" for file, name in _FRAME.findall(errors)]
        root = f"died at {frames[0]}" if frames else f"died with status {status}"
        what = errors.strip().splitlines()[-1] if errors.strip() else ""
        with self._lock:
            self.findings.add(number, root, what[:200], " < ".join(frames[:6]))


def cores() -> int:
    """How many processes the machine runs at once."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
