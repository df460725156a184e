"""What a virtual control retains: for all its channels, and beyond its power."""

from __future__ import annotations

import pickle

import pytest

from polycnc.mainrun import State, VirtualControl
from polycnc.mainrun.status import LONGEST_HISTORY
from polycnc.memory.retained import InMemoryStore
from polycnc.messages import Alarm


class Written(InMemoryStore):
    """A store that writes down what its tables hold when it is told to."""

    def __init__(self) -> None:
        super().__init__()
        self.written = b""

    def commit(self) -> None:
        self.written = pickle.dumps(self._tables)

    def read_again(self) -> Written:
        again = Written()
        again._tables = pickle.loads(self.written)
        return again


def run(text: str, store: InMemoryStore, control: str = "fanuc-m") -> VirtualControl:
    virtual = VirtualControl(control, retained=store)
    virtual.load(text)
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    return virtual


@pytest.mark.parametrize(
    ("control", "text", "variable"),
    [
        ("fanuc-m", "O1\n#500=#500+1\nM30\n", "#500"),
        ("syntec-mill", "%@MACRO\n@700 := @700 + 1;\nM30;\n", "@700"),
        ("fanuc-0i-tf", "O1\n#500=#500+1\nM30\n", "#500"),
        ("sinumerik-840d", "R5=R5+1\nM30\n", "R5"),
    ],
)
def test_the_end_of_a_program_writes_down_what_it_has_changed(control: str, text: str, variable: str) -> None:
    store = Written()
    first = run(text, store, control).read_variable(variable)
    second = run(text, store.read_again(), control).read_variable(variable)
    assert second == (1.0 if first is None else float(str(first)) + 1.0)


def test_a_reset_writes_down_what_a_broken_program_has_changed() -> None:
    store = Written()
    virtual = run("O1\n#500=7\nG1 X1.\nM30\n", store)  # no feed
    assert virtual.state is State.ALARM
    virtual.reset()
    assert VirtualControl("fanuc-m", retained=store.read_again()).read_variable("#500") == 7.0


def test_the_alarm_history_outlives_reset_and_power() -> None:
    store = Written()
    virtual = run("O1\nG1 X1.\nM30\n", store)
    virtual.reset()
    assert virtual.alarms == ()
    virtual.load("O1\nG777\nM30\n")
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    virtual.power_off()
    again = VirtualControl("fanuc-m", retained=store.read_again())
    assert [alarm.line for alarm in again.alarm_history] == [2, 2]
    assert again.alarm_history == virtual.alarm_history
    assert again.alarm_history[0].code != again.alarm_history[1].code
    assert again.alarms == ()


def test_the_alarm_history_forgets_the_oldest() -> None:
    virtual = VirtualControl("fanuc-m")
    for number in range(LONGEST_HISTORY + 5):
        virtual._status.show_alarms((Alarm("fanuc-m", f"A{number}"),))
    assert len(virtual.alarm_history) == LONGEST_HISTORY
    assert virtual.alarm_history[0].code == f"A{LONGEST_HISTORY + 4}"


EDITING = """DEF INT ERR
WRITE(ERR,"/_N_SPF_DIR/_N_LOG_SPF","R7=R7+1")
DELETE(ERR,"/_N_SPF_DIR/_N_OLD_SPF")
M30
"""
FILES = {"/_N_SPF_DIR/_N_LOG_SPF": "R7=10\n", "/_N_SPF_DIR/_N_OLD_SPF": "R8=1\nM17\n"}


def test_edited_and_deleted_programs_outlive_the_power() -> None:
    store = Written()
    first = VirtualControl("sinumerik-840d", retained=store, files=FILES)
    first.load(EDITING)
    first.cycle_start()
    first.run(limit_s=60.0)
    again = VirtualControl("sinumerik-840d", retained=store.read_again(), files=FILES)
    again.load("LOG\nM30\n")
    again.cycle_start()
    assert again.run(limit_s=60.0) is State.READY
    assert again.read_variable("R7") == 11.0
    again.load("OLD\nM30\n")
    again.cycle_start()
    assert again.run(limit_s=60.0) is State.ALARM
    assert [alarm.code for alarm in again.alarms] == ["12550"]  # no such name


def test_a_program_that_is_loaded_again_counts_and_not_what_was_edited_in_it() -> None:
    store = Written()
    virtual = VirtualControl("fanuc-m", retained=store)
    for _ in range(2):
        virtual.load("O1\nM30\n")
        virtual.select_mode("teach")
        virtual.teach("G0", line=1)
        virtual.select_mode("auto")
        assert len(virtual._programs.main(1).lines) == 3


def test_channels_of_a_control_share_what_is_the_control_s() -> None:
    virtual = VirtualControl(
        "syntec-mill", machine="mill2-2ch", setup={"parameters": {"742": 1, "701": 3, "702": 3}}
    )
    virtual.load("$1\n@5=7\nG04.1 P1\nM30\n$2\nG04.1 P1\n@6=@5+1\nM30\n")
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    assert virtual.alarms == ()
    assert virtual.read_variable("@6") == 8.0
