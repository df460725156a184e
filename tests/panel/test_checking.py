"""Checks of long programs in another process."""

from __future__ import annotations

import subprocess
import sys
from time import monotonic, sleep

import pytest

from polycnc.mainrun import VirtualControl
from polycnc.panel.checking import LONGEST_S, look
from polycnc.panel.editing import LONGEST_LOOK, Check, check_elsewhere, findings, told

#: Longer than a check looks at once, with an alarm at its end.
LONG = "O1\n" + "".join(f"G1 X{i % 7}. F500.\n" for i in range(LONGEST_LOOK + 500)) + "G999\nM30\n"
#: A busy machine takes its time, seconds.
PATIENCE_S = 120.0


def test_another_process_finds_what_lies_behind_the_first_blocks() -> None:
    control = VirtualControl("fanuc-m", machine="hartford")
    check = Check(control, "O0001", LONG, "en")
    while check.go_on():
        pass
    assert check.ends_early
    assert check.findings == ()
    far = check_elsewhere(control, "O0001", LONG)
    end = monotonic() + PATIENCE_S
    while not far.is_over and monotonic() < end:
        sleep(0.01)
    assert far.found is not None
    (found,) = told(control, far.found.program, far.found.alarms, "zh-TW")
    assert (found.line, found.code) == (LONGEST_LOOK + 502, "PS0010")
    assert control.alarms == ()


def test_a_check_elsewhere_finds_the_same_with_the_data_of_the_control() -> None:
    text = "O1\nM98 P77\nX#500\nM30\n"
    control = VirtualControl("fanuc-m")
    control.store_program("O0077", "O77\nG0 X1.\nM99\n")
    control.write_variable("#500", 5.0)
    found = look(control.forecast("O0001", text=text).job)
    assert found.to_the_end
    assert told(control, found.program, found.alarms, "en") == findings(control, "O0001", text, "en") == ()
    control.delete_program("O0077")
    found = look(control.forecast("O0001", text=text).job)
    assert [each.line for each in told(control, found.program, found.alarms, "en")] == [2]


def test_a_check_that_takes_too_long_says_so() -> None:
    endless = "O1\nN1 #1=#1+1\nIF[#1LT1000000]GOTO1\nM30\n"
    found = look(VirtualControl("fanuc-m").forecast("O0001", text=endless).job, seconds=0.0)
    assert not found.to_the_end


def test_a_check_that_nobody_wants_ends() -> None:
    far = check_elsewhere(VirtualControl("fanuc-m"), "O0001", LONG)
    far.give_up()
    end = monotonic() + PATIENCE_S
    while not far.is_over and monotonic() < end:
        sleep(0.01)
    assert far.is_over
    assert far.found is None


#: A process whose check goes on for long; the check, too, holds what it says something on.
LEAVING = """
import os, subprocess, sys
from functools import partial
from polycnc.mainrun import VirtualControl
from polycnc.panel import checking
from polycnc.panel.editing import check_elsewhere
checking.Popen = partial(subprocess.Popen, pass_fds=[os.dup(1)])
far = check_elsewhere(VirtualControl("fanuc-m"), "O0001", "O1\\nN1 #1=#1+1\\nGOTO 1\\nM30\\n")
print("goes on", flush=True)
far._process.wait()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs files that a process inherits")
def test_a_check_ends_with_the_process_that_wants_it() -> None:
    with subprocess.Popen([sys.executable, "-c", LEAVING], stdout=subprocess.PIPE) as panel:
        assert panel.stdout is not None
        assert panel.stdout.readline() == b"goes on\n"
        panel.kill()
        panel.communicate(timeout=LONGEST_S - 10.0)  # until the check has closed its end
