"""Programs of several channels: what an operator loads, types in, searches and locks in each of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl

MACHINE = """base = "mill3"
name = { en = "Two channels with axes of their own", zh-TW = "雙通道，各有其軸" }

[channel.1]
axes = ["X", "Z"]

[channel.2]
axes = ["Y"]
"""


@pytest.fixture
def virtual(tmp_path: Path) -> VirtualControl:
    machine = tmp_path / "two.toml"
    machine.write_text(MACHINE, encoding="utf-8")
    return VirtualControl("sinumerik-840d", machine=machine)


def test_cycle_start_starts_every_channel_in_which_a_program_is_loaded(virtual: VirtualControl) -> None:
    virtual.load("G1 X10 F600\nM30\n")
    virtual.load("R1=R1+1\nG1 Y5 F600\nM30\n", channel=2)
    virtual.cycle_start()
    virtual.step(0.1)
    assert [virtual.channels[number].runs for number in (1, 2)] == [True, True]
    assert virtual.run(limit_s=60.0) is State.READY
    assert [virtual.channels[number].parts for number in (1, 2)] == [1, 1]
    assert virtual.channels[1].positions.work["X"] == 10.0
    assert virtual.read_variable("R1", channel=2) == 1.0
    assert virtual.read_variable("R1") == 0.0
    assert virtual.channels[1].program != virtual.channels[2].program


def test_a_program_loaded_in_the_second_channel_alone_runs_alone_and_again(virtual: VirtualControl) -> None:
    virtual.load("R1=R1+1\nSETM(3)\nG4 F0.1\nM30\n", channel=2)
    for count in (1, 2):
        virtual.cycle_start()
        assert virtual.run(limit_s=60.0) is State.READY
        assert virtual.read_variable("R1", channel=2) == count
        assert (virtual.channels[1].parts, virtual.channels[2].parts, virtual.parts) == (0, count, 0)


def test_a_program_that_an_operator_has_loaded_is_selected_for_others_to_start(
    virtual: VirtualControl,
) -> None:
    virtual.load("R1=R1+1\nM30\n", channel=2)
    virtual.load("START(2)\nWAITE(2)\nM30\n")
    virtual.cycle_start()
    assert virtual.run(limit_s=60.0) is State.READY  # it has run when the first one comes to its block
    assert virtual.read_variable("R1", channel=2) == 2.0


def test_loading_one_channel_leaves_the_program_of_another_where_it_can_be_called(
    virtual: VirtualControl,
) -> None:
    virtual.load(b"%_N_A_MPF\nM30\n%_N_SUB_SPF\nR7=R7+1\nM17\n", channel=2)
    virtual.load("SUB\nM30\n")
    virtual.load("SUB\nSUB\nM30\n")
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    assert virtual.read_variable("R7") == 2.0
    assert virtual.channels[2].parts == 1


def test_blocks_are_typed_in_for_the_channel_that_is_named(virtual: VirtualControl) -> None:
    virtual.select_mode("mdi")
    virtual.mdi("R5=4\n", channel=2)
    virtual.run(limit_s=60.0)
    assert [virtual.read_variable("R5", channel=number) for number in (1, 2)] == [0.0, 4.0]
    assert virtual.channels[2].parts == 0


def test_a_block_is_searched_in_the_channel_that_is_named(virtual: VirtualControl) -> None:
    virtual.load("N10 R1=1\nN20 G1 X9 F600\nR2=1\nM30\n")
    virtual.load("N10 R1=2\nM8\nN20 G1 Y5 F600\nR2=2\nM30\n", channel=2)
    virtual.block_search("N20", channel=2)
    assert virtual.read_variable("R1", channel=2) == 2.0
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    assert [virtual.read_variable("R2", channel=number) for number in (1, 2)] == [0.0, 2.0]


def test_the_machine_lock_holds_the_axes_of_every_channel(virtual: VirtualControl) -> None:
    virtual.load("G1 Y5 F600\nM30\n", channel=2)
    virtual.set_switches(machine_lock=True)
    virtual.cycle_start()
    virtual.run(limit_s=60.0)
    shown = virtual.channels[2].positions
    assert (shown.machine["Y"], shown.real["Y"]) == (5.0, 0.0)
    virtual.set_switches(machine_lock=False)
    assert virtual.channels[2].positions.machine["Y"] == 0.0


def test_a_channel_that_waits_for_nobody_is_an_alarm_whichever_it_is(
    virtual: VirtualControl,
) -> None:
    virtual.load("WAITM(1,1,2)\nM30\n", channel=2)
    virtual.cycle_start()
    assert virtual.run(limit_s=60.0) is State.ALARM
    assert [(alarm.code, alarm.channel) for alarm in virtual.alarms] == [("PC0005", 2)]


def test_a_block_is_taught_into_the_program_of_a_channel(virtual: VirtualControl) -> None:
    virtual.load("G1 F600\nM30\n", channel=2)
    virtual.select_mode("teach")
    block = virtual.teach("G1", line=1, channel=2)
    assert block.startswith("G1 ")
    with pytest.raises(CommandRefused):
        virtual.teach("G1", line=1)


@pytest.mark.parametrize("command", ["load", "load_tape", "mdi", "block_search"])
def test_a_channel_that_the_machine_does_not_have_is_refused(virtual: VirtualControl, command: str) -> None:
    if command == "mdi":
        virtual.select_mode("mdi")
    with pytest.raises(CommandRefused, match="channel"):
        getattr(virtual, command)("G0 X1\n", channel=3)
