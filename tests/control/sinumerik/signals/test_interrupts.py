"""Interrupt routines that meet each other on the way back to the contour."""

from __future__ import annotations

from typing import Any

from polycnc.control.sinumerik.signals.interrupts import Interrupts
from polycnc.session import Result, open_session

MAIN = "G0 X0 Y0\nSETINT(1) PRIO=2 AWAY\nSETINT(2) PRIO=1 MARK LIFTFAST\nG1 X100 F500\nY50\nM30\n"
FILES = {"AWAY.SPF": "G1 Y20\nREPOSL\n", "MARK.SPF": "M71\nREPOSL\n"}


def run(*interrupts: dict[str, Any]) -> Result:
    setup = {"switches": {"interrupts": list(interrupts)}}
    return open_session(MAIN, control="sinumerik-840d", setup=setup, files=FILES).run()


def ends(result: Result) -> list[tuple[float, float, float]]:
    return [(row["to"]["X"], row["to"]["Y"], row["to"]["Z"]) for row in result.rows if "to" in row]


def test_the_way_back_to_the_contour_can_be_interrupted() -> None:
    result = run(
        {"input": 1, "line": 4, "at": {"X": 40}},
        {"input": 2, "line": 2, "at": {"Y": 10}, "program": "AWAY"},
    )
    assert not result.alarms
    assert ends(result) == [
        (40, 0, 0), (40, 20, 0), (40, 10, 0), (40, 10, 5), (40, 10, 0), (40, 0, 0), (100, 0, 0), (100, 50, 0),
    ]  # fmt: skip


def test_both_inputs_of_one_block_come_in_the_order_of_the_way() -> None:
    result = run({"input": 2, "line": 4, "at": {"X": 60}}, {"input": 1, "line": 4, "at": {"X": 40}})
    assert not result.alarms
    assert [x for x, _, _ in ends(result)] == [40, 40, 40, 60, 60, 60, 100, 100]


def test_the_retraction_itself_is_not_interrupted() -> None:
    result = run({"input": 2, "line": 4, "at": {"X": 60}}, {"input": 1, "line": 4, "at": {"Z": 3}})
    assert not result.alarms
    assert ends(result) == [(60, 0, 0), (60, 0, 5), (60, 0, 0), (100, 0, 0), (100, 50, 0)]


def test_reset_keeps_the_watch_for_inputs() -> None:
    session = open_session(
        "SETINT(1) PRIO=1 ROUT\nG1 X20 F100\nM30\n",
        control="sinumerik-840d",
        setup={"switches": {"interrupts": [{"input": 1, "line": 2, "at": {"X": 10}}]}},
        files={"ROUT.SPF": "M55\nM17\n"},
    )
    session.run()
    channel = session.channel
    channel.control.reset(channel)
    assert channel.path.head is Interrupts.of(channel).watch
