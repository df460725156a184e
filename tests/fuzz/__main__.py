"""`python -m tests.fuzz`: runs mutated inputs, and tells what they failed by."""

from __future__ import annotations

import argparse
import sys
import tempfile
import traceback
from pathlib import Path
from time import monotonic

from tests.fuzz import inputs
from tests.fuzz.farm import Farm, Findings, cores


def main() -> int:
    """Run what the command line asks for; 1 where an input has failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="how many inputs")
    parser.add_argument("--first", type=int, default=0, help="number of the first one, to go on with a run")
    parser.add_argument("--seed", type=int, default=1, help="another seed makes other inputs")
    parser.add_argument("--jobs", type=int, default=cores(), help="processes")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="no input begins later than that")
    parser.add_argument("--report", type=Path, help="where the report is renewed while it grows")
    parser.add_argument("--show", type=int, metavar="NUMBER", help="print one input and run it here")
    asked = parser.parse_args()
    if asked.show is not None:
        return _show(asked.seed, asked.show)
    reported = began = monotonic()

    def progress(findings: Findings) -> None:
        nonlocal reported
        if monotonic() - reported > 10:
            reported = monotonic()
            rate = findings.inputs / (reported - began)
            line = f"{findings.inputs} inputs, {rate:.0f} a second, {len(findings.roots)} roots\n"
            sys.stderr.write(line)
            if asked.report:
                asked.report.write_text(findings.report() + "\n", encoding="utf-8")

    findings = Farm(asked.seed, asked.first, asked.count, asked.jobs, asked.seconds, progress).run()
    sys.stdout.write(findings.report() + "\n")
    if asked.report:
        asked.report.write_text(findings.report() + "\n", encoding="utf-8")
    return 1 if findings.roots else 0


def _show(seed: int, number: int) -> int:
    given = inputs.make(seed, number)
    sys.stdout.write(f"{given}\n----\n")
    sys.stdout.flush()
    with tempfile.TemporaryDirectory() as folder:
        try:
            sys.stdout.write(inputs.run(given, Path(folder)) + "\n")
        except Exception:  # noqa: BLE001 - the failure is what was asked for
            sys.stdout.write(traceback.format_exc())
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
