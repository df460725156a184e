"""Exercises: their files, how they go, the result sheet."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest

from polycnc.mainrun import VirtualControl
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.teaching.exercise import CONDITIONS, ExerciseError, holds, load_exercises
from polycnc.panel.teaching.faults import inject
from polycnc.panel.teaching.lesson import Lesson
from polycnc.panel.web.desk import Desk

EXAMPLES = Path(__file__).parents[3] / "examples" / "exercises.yaml"
GOOD = """
- id: a
  control: fanuc-m
  title: A
  text: {en: Do, zh-TW: 做}
  checks:
    - {text: C, when: {state: ready}}
"""


def desk_of(name: str) -> Desk:
    exercise = next(each for each in load_exercises(EXAMPLES) if each.id == name)
    control = VirtualControl(exercise.control, setup=exercise.setup)
    if exercise.program:
        control.load(exercise.program)
    desk = Desk(control)
    desk.lesson = Lesson(exercise, control, desk.screen, lambda: datetime(2026, 1, 2, 3, 4, 5, tzinfo=UTC))
    return desk


def passes(desk: Desk, seconds: float) -> None:
    for _ in range(round(seconds / 0.1)):
        desk.control.step(0.1)
        assert desk.lesson is not None
        desk.lesson.follow()


def test_an_exercise_is_worked_on_step_by_step() -> None:
    desk = desk_of("home-first")
    assert desk.lesson is not None
    desk.press("START")
    desk.turn("mode", "zero")
    for axis in "ZXY":
        desk.press(f"{axis}+")
        passes(desk, 20.0)
    assert desk.lesson.is_done
    times = [each.at_s for each in desk.lesson.results("en")]
    assert times == sorted(times, key=lambda at: at or 0.0)
    sheet = desk.lesson.sheet("en")
    assert "Passed: 3 / 3" in sheet
    assert "Refused: 1" in sheet
    assert "Began: 2026-01-02 03:04:05" in sheet
    assert "2. [x] Z at its reference point" in sheet


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_fault_comes_in_the_midst_and_the_sheet_tells_the_alarm(lang: str) -> None:
    desk = desk_of("low-air")
    assert desk.lesson is not None
    desk.do("screen_key", key="PROG")
    desk.press("START")
    passes(desk, 5.0)
    assert [each.at_s is not None for each in desk.lesson.results(lang)] == [True, True, False, False, False]
    desk.do("screen_key", key="MESSAGE")
    desk.do("fault", name="air", pressed=False)
    desk.control.reset()
    passes(desk, 1.0)
    desk.press("START")
    passes(desk, 30.0)
    assert desk.lesson.is_done
    assert "1051" in desk.lesson.sheet(lang)


def test_every_condition_can_be_asked() -> None:
    desk = Desk(VirtualControl("fanuc-m"))
    control = desk.control
    control.load("O7\nM30\n")
    inject(control, "air")
    asked = {
        "state": "ready", "mode": "auto", "halt": "", "program": "O0007", "block": "", "parts": 0, "tool": 0,
        "alarms": 0, "work": {"X": 0}, "machine": {"Z": 0}, "signal": {"AIR_LOW": 1},
        "variable": {"#500": None}, "page": "pos-abs",
    }  # fmt: skip
    assert asked.keys() | {"alarm"} == CONDITIONS.keys()
    assert holds(asked, control, desk.screen)
    for word, other in {"alarm": "1", "parts": 1, "work": {"X": 1}, "variable": {"#500": 2.0, "#NO": 1}, "tool": 5,
                        "page": "mdi", "signal": {"AIR_LOW": 0}, "state": "running"}.items():  # fmt: skip
        assert not holds({word: other}, control, desk.screen)


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "a: 1", "- 5", "- {id: a}", "{", GOOD + "  more: 1\n", GOOD.replace("state: ready", "nothing: 1"),
        GOOD.replace("{state: ready}", "5"), GOOD.replace("state: ready", "work: 5"), GOOD.replace("text: C, ", ""),
        GOOD + "  faults: [{fault: nothing, when: {}}]\n", GOOD + "  faults: 5\n",
    ],
)  # fmt: skip
def test_a_file_that_is_no_exercise_is_refused_with_its_name(text: str, tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ExerciseError) as caught:
        load_exercises(path)
    assert "x.yaml" in str(caught.value)


def test_a_good_file_is_taken_and_a_missing_one_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(GOOD, encoding="utf-8")
    assert load_exercises(path)[0].id == "a"
    with pytest.raises(ExerciseError):
        load_exercises(tmp_path / "nothing.yaml")
