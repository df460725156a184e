"""Channels that run together."""

from __future__ import annotations

from polycnc.channel.channel import Channel
from polycnc.channel.group import ChannelGroup
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.program import Form, Program, ProgramStore

SINUMERIK = "sinumerik-840d"


def group_of(texts: dict[str, str]) -> tuple[ChannelGroup, Program]:
    store = ProgramStore(form=Form.SINUMERIK)
    programs = [store.add_text(f"/_N_MPF_DIR/_N_{name}_MPF", text) for name, text in texts.items()]
    channel = Channel(control(SINUMERIK), load_machine("mill3-2ch"), parse_setup(None), store)
    return ChannelGroup(channel), programs[0]


def run(texts: dict[str, str]) -> ChannelGroup:
    group, main = group_of(texts)
    for _ in group.run(main):
        pass
    return group


def read(group: ChannelGroup, number: int, name: str) -> object:
    channel = group.channel(number)
    return channel.control.read_variable(channel, name)


def test_one_channel_alone_runs_as_ever() -> None:
    group = run({"A": "R1=3\nG0 X5\nM30\n"})
    assert read(group, 1, "R1") == 3
    assert len(group.channels) == 1


def test_the_run_ends_with_the_first_channel() -> None:
    group = run({"A": 'INIT(2,"B")\nSTART(2)\nM30\n', "B": "R1=1\nWAITM(1,1)\nR1=2\nM30\n"})
    assert read(group, 2, "R1") == 1
    assert not group.is_running(2)
    assert group.first.alarms == []


def test_marks_are_gone_when_channels_have_met() -> None:
    group = run({"A": 'INIT(2,"B")\nSTART(2)\nWAITM(1,2)\nWAITE(2)\nM30\n', "B": "WAITM(1,1)\nM30\n"})
    assert group.marks(1) == group.marks(2) == set()


def test_meeting_again_at_the_same_mark_waits_again() -> None:
    first = 'INIT(2,"B")\nSTART(2)\n' + "WAITM(1,2)\n$A_DLD[0]=$A_DLD[0]*2\nWAITM(2,2)\n" * 3 + "M30\n"
    second = "WAITM(1,1)\nWAITM(2,1)\n$A_DLD[0]=$A_DLD[0]+1\n" * 3 + "M30\n"
    group = run({"A": first, "B": second})
    assert group.first.alarms == []
    # Between two marks of the first kind the second channel has always added before it comes there again.
    assert read(group, 1, "$A_DLD[0]") in (6, 7)


def test_a_missing_partner_ends_the_run_with_an_alarm() -> None:
    group = run({"A": "WAITM(1,2)\nM30\n"})
    assert [alarm.code for alarm in group.first.alarms] == ["PC0005"]


def test_an_alarm_of_another_channel_is_an_alarm_of_the_run() -> None:
    group = run({"A": 'INIT(2,"B")\nSTART(2)\nWAITM(1,2)\nM30\n', "B": "R1=1/0\nM30\n"})
    assert [(alarm.program, alarm.line) for alarm in group.first.alarms] == [("_N_B_MPF", 1)]


def test_a_channel_that_the_machine_lacks_cannot_be_had() -> None:
    group, _ = group_of({"A": "M30\n"})
    assert not group.has(3)
