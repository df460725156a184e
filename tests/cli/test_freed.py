"""Memory that a run frees."""

from __future__ import annotations

import subprocess
import sys

import pytest

#: Pages that are got anew when 8 MB are taken and freed ten times, behind the first time.
_TAKE = """
import resource, sys
if sys.argv[1] == "kept":
    from polycnc.cli.freed import keep_freed_memory
    keep_freed_memory()
faults = []
for _ in range(11):
    taken, also = bytearray(8 << 20), bytearray(8 << 20)
    taken[::4096] = also[::4096] = bytes(1) * 2048
    del taken, also
    faults.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt)
print(faults[-1] - faults[0])
"""


def _faults(kept: str) -> int:
    run = [sys.executable, "-c", _TAKE, kept]
    return int(subprocess.run(run, check=True, capture_output=True, text=True).stdout)


@pytest.mark.skipif(sys.platform != "linux", reason="of the GNU C library")
def test_freed_memory_is_taken_again() -> None:
    assert _faults("kept") < 100 < _faults("given back")
