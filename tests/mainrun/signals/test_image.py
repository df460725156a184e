"""The signal image and the rules of a machine's own controller."""

from __future__ import annotations

from pathlib import Path

import pytest

from polycnc.machine import MachineFileError, load_machine
from polycnc.machine.rules import Rule
from polycnc.mainrun import State, VirtualControl
from polycnc.mainrun.execution.clock import Clock
from polycnc.mainrun.signals.image import SignalImage
from tests.mainrun.support import recorded

HARTFORD = Path(__file__).parents[3] / "examples" / "hartford-vmc.toml"


class Bench:
    """A signal image with a clock in the hand."""

    def __init__(self, *rules: Rule) -> None:
        self.clock = Clock(0.004)
        self.edges: list[tuple[float, str, float]] = []
        self.image = SignalImage({}, rules, self.clock)
        self.image.on_edge = self._edge

    def _edge(self, name: str, value: float) -> None:
        self.edges.append((self.clock.time, name, value))

    def wait(self, seconds: float) -> None:
        end = self.clock.time + seconds
        while self.image.due <= end:
            self.clock.time = self.image.due
            self.image.advance(self.clock.time)
        self.clock.time = end


@pytest.mark.parametrize(
    ("text", "on", "expected"),
    [
        ("A", "", False),
        ("A", "A", True),
        ("!A", "", True),
        ("A & B", "A", False),
        ("A | B & C", "A", True),
        ("(A | B) & C", "A", False),
        ("(A|B)&!C", "B", True),
        ("!!A", "A", True),
        ("$A_IN[1]", "$A_IN[1]", True),
    ],
)
def test_conditions_are_read(text: str, on: str, expected: bool) -> None:
    assert Rule(text, "X").condition(lambda name: float(name == on)) is expected


@pytest.mark.parametrize("text", ["", "A &", "A B", "(A", "A)", "&", "!" * 1000 + "A"])
def test_what_is_no_condition_is_told(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - the argument is a place
        Rule(text, "X").condition  # noqa: B018


def test_an_output_follows_its_condition() -> None:
    bench = Bench(Rule("A & !B", "X"))
    bench.image["A"] = 1
    assert bench.image["X"] == 1.0
    bench.image["B"] = 1
    assert bench.image["X"] == 0.0


def test_a_delay_starts_anew_when_the_condition_breaks() -> None:
    bench = Bench(Rule("A", "X", after_s=1.0))
    bench.image["A"] = 1
    bench.wait(0.9)
    bench.image["A"] = 0
    bench.image["A"] = 1
    bench.wait(0.9)
    assert bench.image["X"] == 0.0
    bench.wait(0.2)
    assert bench.image["X"] == 1.0
    assert bench.image.since("X") == pytest.approx(1.9)


def test_a_latched_output_stays() -> None:
    bench = Bench(Rule("A", "X", latch="on"), Rule("B", "X", latch="off"))
    for name, expected in (("A", 1.0), ("B", 0.0)):
        bench.image[name] = 1
        bench.image[name] = 0
        assert bench.image["X"] == expected


def test_outputs_that_chase_each_other_do_not_hang() -> None:
    bench = Bench(Rule("!X", "X"))
    bench.image["A"] = 1
    assert bench.image.due == pytest.approx(0.004)


def test_a_wrong_rule_is_told_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text('base = "mill3"\n\n[[rule]]\nwhen = "A & & B"\noutput = "X"\n', encoding="utf-8")
    with pytest.raises(MachineFileError) as error:
        load_machine(file)
    assert error.value.line == 4


# ---- through a program -------------------------------------------------------------------------------------


def hartford(text: str) -> VirtualControl:
    virtual = VirtualControl("fanuc-m", machine=HARTFORD)
    virtual.load(text)
    return virtual


def test_coolant_is_on_between_its_m_functions() -> None:
    virtual = hartford("O1\nM8\nG1 X10. F600\nM9\nG1 X20.\nM30\n")
    virtual.cycle_start()
    virtual.step(0.5)
    assert virtual.signals["COOLANT"] == 1.0
    virtual.run_until(lambda control: control.machine_position[0] > 15.0)
    assert virtual.signals["COOLANT"] == 0.0


def test_a_tool_change_waits_for_the_machine() -> None:
    virtual = hartford("O1\nT5\nM6\nG0 X10.\nM30\n")
    records = recorded(virtual)
    virtual.cycle_start()
    virtual.signals["DOOR_OPEN"] = 1.0
    virtual.step(1.0)
    assert virtual.state is State.HOLD, "the open door holds the program"
    virtual.signals["DOOR_CLOSE_KEY"] = 1.0
    virtual.cycle_start()
    virtual.step(3.0)
    assert virtual.machine_position[0] == 0.0
    assert virtual.signals["CHANGING_TOOL"] == 1.0
    assert virtual.run() is State.READY
    assert virtual.tool.tool == 5
    edges = [r.time for r in records if r.what == "signal" and r.data["name"] == "FIN_M6"]
    assert edges[0] - virtual.signals.since("DOOR_CLOSE_KEY") == pytest.approx(4.0, abs=0.01)


def test_a_tool_change_that_the_machine_never_answers_is_an_alarm_after_its_time() -> None:
    virtual = hartford("O1\nM11\nT5\nM6\nG0 X10.\nM30\n")
    virtual.cycle_start()
    assert virtual.run(limit_s=25.0) is State.RUNNING
    assert virtual.signals["M6"] == 1.0
    assert virtual.run(limit_s=10.0) is State.ALARM
    assert [alarm.code for alarm in virtual.alarms] == ["1045"]
    virtual.reset()
    assert virtual.run() is State.READY
    assert virtual.signals["M6"] == 0.0


def test_signals_can_press_keys() -> None:
    virtual = hartford("O1\nG1 X10. F600\nM30\n")
    virtual.signals["CYCLE_START"] = 1.0
    virtual.step(0.5)
    assert str(virtual.state) == "running"
    virtual.signals["FEED_HOLD"] = 1.0
    virtual.step(0.5)
    assert str(virtual.state) == "hold"
    virtual.signals["CYCLE_START"] = 0.0
    virtual.signals["CYCLE_START"] = 1.0
    assert virtual.run() is State.READY


def test_state_and_mode_are_signals() -> None:
    virtual = hartford("O1\nG1 X10. F600\nM30\n")
    assert (virtual.signals["READY"], virtual.signals["AUTO"]) == (1.0, 1.0)
    virtual.cycle_start()
    assert (virtual.signals["READY"], virtual.signals["RUNNING"]) == (0.0, 1.0)
    virtual.select_mode("jog")
    assert (virtual.signals["AUTO"], virtual.signals["JOG"], virtual.signals["HOLD"]) == (0.0, 1.0, 1.0)
