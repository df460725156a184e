"""A calculation that goes on in time comes to an end, whatever the program waits for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

import polycnc
from polycnc.channel.channel import Channel
from polycnc.channel.waits import CLOCK
from polycnc.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from polycnc.channel.waits import Wait
    from polycnc.session import Result

CONTROL = "sinumerik-840d"


def test_a_path_that_an_override_of_nothing_holds_for_ever_is_an_alarm() -> None:
    result = polycnc.run("ID=1 DO $AC_OVR=0\nG1 X10 F1000\nM30\n", control=CONTROL)
    assert [alarm.code for alarm in result.alarms] == ["PC0013"]


def test_a_slow_path_is_no_waiting() -> None:
    result = polycnc.run("ID=1 DO $AC_OVR=1\nG1 X10 F100\nM30\n", control=CONTROL)
    assert not result.alarms
    assert result.main_run_s == pytest.approx(600.0, abs=1.0)


def test_cycles_in_which_actions_look_count_as_blocks() -> None:
    text = "ID=1 DO $AC_PARAM[0]=$AA_IM[X]\nG1 X100 F10\nM30\n"
    limited = polycnc.run(text, control=CONTROL, block_limit=20_000)
    assert [alarm.code for alarm in limited.alarms] == ["PC0002"]
    assert limited.main_run_s is not None
    assert 80.0 <= limited.main_run_s <= 111.0  # cycles of 4 ms, looked at each 30 s
    whole = polycnc.run(text.replace("F10", "F1000"), control=CONTROL, block_limit=20_000)
    assert not whole.alarms


def test_rows_of_blocks_in_time_are_handed_on_as_one_chunk() -> None:
    lines = "".join(f'MSG("{i}")\nG1 X{i} F6000\n' for i in range(1, 20))
    session = open_session(f"ID=1 DO $AC_PARAM[0]=1\n{lines}M30\n", control=CONTROL, keep=False)
    rows: list[int] = []
    session.consumers.append(lambda chunk: rows.append(len(chunk)))
    result = session.run()
    assert result.ok
    assert result.main_run_s is not None
    assert [count > 38 for count in rows if count] == [True]
    assert result.plan.total_s > 0.0


# ---- in time from the first block on a program does what it does without a clock


@pytest.fixture
def in_time(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    """Run a program in time from its first block on."""
    advance = Channel.advance
    handed_over: list[Channel] = []

    def hand_over(channel: Channel) -> Wait | None:
        if not handed_over:
            handed_over.append(channel)
            return CLOCK
        return advance(channel)

    def run(text: str, **more: Any) -> Result:
        with monkeypatch.context() as patched:
            patched.setattr(Channel, "advance", hand_over)
            return open_session(text, **more).run()

    return run


@pytest.mark.parametrize(
    ("control", "text", "setup"),
    [
        ("fanuc-0i-tf", "G0 X40. Z5.\nS100 M3\nG32 Z-10. F2. Q90000\nZ-20. Q45000\nX44. Z-22.\nM30\n", {}),
        (
            "fanuc-0i-tf",
            "G42 G0 X50. Z10.\nG1 Z0 F0.2\nZ-10. M8 T0101\nZ-20.\nG40 G0 X70.\nM30\n",
            {"tools": {1: {"radius": 2, "geom2": {"x": 4}}}},
        ),
        ("fanuc-m", "G90 G1 X20. ,R30. F100\nY5.\nM30\n", {}),
        ("fanuc-m", "G1 X20. F100\nX30. ,R3.\nG4 X1.\nG4 X1.\nY5.\nM30\n", {}),
        (CONTROL, "G1 Z1 F100\nM1\nSETAL(67001)\nX2\nM30\n", {}),
    ],
    ids=["threads", "tool-in-compensation", "corner-in-the-first-block", "corner", "stops-and-alarms"],
)
def test_a_program_in_time_has_the_rows_that_it_has_without_a_clock(
    in_time: Callable[..., Result], control: str, text: str, setup: dict[str, Any]
) -> None:
    timed = in_time(text, control=control, setup=setup)
    plain = open_session(text, control=control, setup=setup).run()
    assert timed.main_run_s is not None
    assert plain.main_run_s is None
    assert list(timed.rows) == list(plain.rows)
    assert timed.final == plain.final
    assert [alarm.code for alarm in timed.alarms] == [alarm.code for alarm in plain.alarms]


@pytest.mark.parametrize(
    ("refused", "code"), [("M89", "1501"), ("G1 X30.", "1501"), ("G4 X2.\nG1 Z-15.", "1502")]
)
def test_what_the_machine_refuses_in_time_ends_the_program(tmp_path: Path, refused: str, code: str) -> None:
    (tmp_path / "ours.toml").write_text(
        '[[rule]]\nwhen = "M60"\noutput = "OPEN"\nlatch = "on"\n'
        '[[rule]]\nwhen = "OPEN"\nafter_s = 1.5\noutput = "LATE"\n'
        '[[alarm]]\ncode = "1501"\nwhen = "(M89 | MOVE_X) & OPEN"\ntext = "The door is open"\n'
        '[[alarm]]\ncode = "1502"\nwhen = "LATE"\ntext = "The door is open still"\n',
        encoding="utf-8",
    )
    machine = tmp_path / "mine.toml"
    machine.write_text('base = "lathe-xza"\nname = "Mine"\nrules = "ours.toml"\n', encoding="utf-8")
    program = f"G98 F6000\nG81.1 A20. Q-10. R5.\nG1 Z-10.\nM60\n{refused}\nG1 Z-20.\nM30\n"
    result = polycnc.run(program, control="fanuc-0i-tf", machine=machine)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [(code, 5)]
    assert [result.final["machine"][axis] for axis in "XZ"] == [0.0, -10.0]
    assert max(row.line for row in result.toolpath.rows()) == 5
