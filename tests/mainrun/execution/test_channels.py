"""Several channels: the clock executes the plans of all of them, and they wait for each other's axes."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.session import open_session
from tests.mainrun.support import recorded

MAIN = """INIT(2,"B")
START(2)
G0 X10
RELEASE(Y)
G1 X100 F6000
WAITM(1,1,2)
G1 X0
WAITM(2,1,2)
WAITE(2)
G0 Y3
M30
"""
SIDE = "GET(Y)\nG1 Y50 F3000\nWAITM(1,1,2)\nG4 F0.5\nG1 Y20\nWAITM(2,1,2)\nRELEASE(Y)\nM30\n"


def two_channels(main: str = MAIN, side: str = SIDE) -> VirtualControl:
    virtual = VirtualControl("sinumerik-840d", machine="mill3-2ch", files={"B.MPF": side})
    virtual.load(main)
    return virtual


def blocks(virtual: VirtualControl) -> dict[tuple[int, int], float]:
    """When each block begins, by channel and line; filled while the control runs."""
    begins: dict[tuple[int, int], float] = {}

    def note(record: Any) -> None:
        if record.what == "block":
            begins[record.data.get("channel", 1), record.data["line"]] = record.time

    virtual.listeners.append(note)
    return begins


def test_axes_of_two_channels_move_at_the_same_time() -> None:
    virtual = two_channels()
    virtual.cycle_start()
    virtual.step(0.6)
    x, y = (virtual.machine_position[i] for i in (0, 1))
    virtual.step(0.2)
    assert virtual.machine_position[0] > x + 5.0
    assert virtual.machine_position[1] > y + 5.0


def test_who_comes_first_to_a_mark_waits_until_the_axes_of_the_other_are_there() -> None:
    virtual = two_channels()
    begins = blocks(virtual)
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.channels[1].waits, limit_s=5.0)
    assert virtual.channels[1].positions.work["X"] == 100.0
    assert virtual.channels[2].positions.work["Y"] < 50.0
    assert not virtual.channels[2].waits
    virtual.run()
    assert begins[1, 7] == begins[2, 4]  # both go on at the same moment
    assert begins[1, 10] == pytest.approx(begins[2, 8])  # WAITE and the end of the program


def test_the_end_is_that_of_the_run_without_a_clock() -> None:
    virtual = two_channels()
    virtual.cycle_start()
    assert virtual.run() is State.READY
    session = open_session(MAIN, control="sinumerik-840d", machine="mill3-2ch", files={"B.MPF": SIDE})
    assert virtual.positions.machine == session.run().final["machine"] == {"X": 0.0, "Y": 3.0, "Z": 0.0}


def test_an_axis_that_another_channel_moves_is_shown_where_it_is() -> None:
    virtual = two_channels()
    virtual.cycle_start()
    virtual.step(0.8)
    one, two = virtual.channels[1].positions, virtual.channels[2].positions
    assert one.machine == two.machine
    assert 0.0 < one.machine["Y"] < 50.0


def test_feed_hold_and_overrides_act_on_every_channel() -> None:
    undisturbed = two_channels()
    undisturbed.cycle_start()
    undisturbed.run()
    virtual = two_channels()
    virtual.cycle_start()
    virtual.step(0.4)
    virtual.override(feed=0.5)
    virtual.step(0.4)
    virtual.feed_hold()
    virtual.run()
    held = virtual.machine_position
    virtual.step(1.0)
    assert virtual.machine_position == held
    assert virtual.state is State.HOLD
    virtual.override(feed=1.2)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.machine_position == undisturbed.machine_position


def test_a_stop_of_one_channel_leaves_the_other_running() -> None:
    virtual = two_channels('INIT(2,"B")\nRELEASE(Y)\nSTART(2)\nM0\nG0 X5\nM30\n', "G1 Y30 F1000\nM30\n")
    virtual.cycle_start()
    virtual.step(0.5)
    assert virtual.channels[1].halt == "M0"
    assert virtual.state is State.RUNNING
    assert virtual.run() is State.STOPPED
    assert virtual.machine_position[1] == 30.0
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.machine_position[:2] == [5.0, 30.0]


def test_an_alarm_of_one_channel_brings_the_other_to_rest() -> None:
    virtual = two_channels('INIT(2,"B")\nSTART(2)\nG1 X500 F1000\nM30\n', "G4 F0.2\nSTOPRE\nR1=1/0\nM30\n")
    virtual.cycle_start()
    assert virtual.run() is State.ALARM
    assert [alarm.program for alarm in virtual.alarms] == ["_N_B_MPF"]
    x = virtual.machine_position[0]
    assert 0.0 < x < 100.0
    virtual.reset()
    assert virtual.run() is State.READY
    assert virtual.machine_position[0] == x


def test_channels_that_wait_for_each_other_for_ever_are_an_alarm() -> None:
    virtual = two_channels("G1 X5 F1000\nWAITM(1,2)\nM30\n")
    virtual.cycle_start()
    assert virtual.run() is State.ALARM
    assert [alarm.code for alarm in virtual.alarms] == ["PC0005"]
    assert virtual.machine_position[0] == 5.0


def test_reset_gives_up_every_channel_and_the_next_start_begins_anew() -> None:
    virtual = two_channels()
    virtual.cycle_start()
    virtual.step(0.6)
    virtual.reset()
    assert virtual.run() is State.READY
    assert not any(channel.runs for channel in virtual.channels.values())
    group = virtual.channel.group
    assert group is not None
    group.owner["Y"] = 1  # as at power-on
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.machine_position == [0.0, 3.0, 0.0]


def test_the_same_commands_give_the_same_trace() -> None:
    def trace() -> list[Any]:
        virtual = two_channels()
        records = recorded(virtual)
        virtual.cycle_start()
        positions = []
        while virtual.is_busy:
            virtual.step(0.012)
            positions.append({n: channel.positions.machine for n, channel in virtual.channels.items()})
        return [records, positions]

    assert trace() == trace()


def test_axis_groups_of_one_file_meet() -> None:
    text = "$1\nG90 G1 X50. F3000\nG04.1 P1\nX0.\nM30\n$2\nG90 G1 Y10. F3000\nG04.1 P1\nY0.\nM30\n"
    virtual = VirtualControl("syntec-mill", machine="mill2-2ch")
    virtual.load(text)
    begins = blocks(virtual)
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert begins[1, 4] == begins[2, 9]
    assert begins[1, 4] > 1.0


def test_a_block_search_does_not_wait_for_another_channel() -> None:
    virtual = two_channels()
    with pytest.raises(CommandRefused):
        virtual.block_search(7)
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_axes_of_the_second_channel_are_moved_by_hand() -> None:
    virtual = VirtualControl("fanuc-0i-tf", machine="lathe2-2path")
    virtual.select_mode("jog")
    virtual.jog("Z", 1, channel=2)
    virtual.step(1.0)
    virtual.stop_jog("Z", channel=2)
    virtual.run()
    assert virtual.channels[2].positions.machine["Z"] > 10.0
    assert virtual.channels[1].positions.machine["Z"] == 0.0
    with pytest.raises(CommandRefused):
        virtual.jog("Z", 1, channel=3)


def test_an_axis_is_moved_by_hand_in_the_channel_that_owns_it() -> None:
    virtual = two_channels()
    virtual.select_mode("jog")
    with pytest.raises(CommandRefused):
        virtual.jog("Y", 1, channel=2)


def test_an_axis_is_referenced_in_its_own_channel_though_another_calls_one_alike() -> None:
    encoders = {"switches": {"INCREMENTAL_ENCODERS": 1}}
    virtual = VirtualControl("fanuc-0i-tf", machine="lathe2-2path", setup=encoders)
    virtual.select_mode("jog")
    virtual.jog("Z", 1, channel=2)
    virtual.step(1.0)
    virtual.stop_jog("Z", channel=2)
    virtual.run()
    virtual.power_off()
    virtual.power_on()
    virtual.run()
    virtual.select_mode("reference")
    virtual.step(0.1)
    names = ("Z1", "X2", "Z2")
    assert [virtual.signals[f"NOT_REFERENCED_{name}"] for name in names] == [0.0, 0.0, 1.0]
    virtual.home("Z", channel=2)
    virtual.run()
    assert virtual.signals["NOT_REFERENCED_Z2"] == 0.0


def test_a_program_of_any_channel_asks_for_its_spindle() -> None:
    virtual = two_channels('INIT(2,"B")\nSTART(2)\nWAITE(2)\nM30\n', "S500 M3\nG4 F1\nM5\nM30\n")
    virtual.cycle_start()
    seen = []
    while virtual.state is State.RUNNING:
        virtual.step(0.2)
        seen.append(virtual.signals["SPINDLE_COMMANDED"])
    assert (max(seen), seen[-1]) == (1.0, 0.0)
