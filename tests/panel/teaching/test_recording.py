"""A session is recorded and done again, with the same outcome to the last bit."""

from __future__ import annotations

import json
from functools import partial
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import VirtualControl
from polycnc.panel.teaching.recording import RecordingError, Replay, load_acts
from polycnc.panel.web.desk import Desk
from polycnc.panel.web.messages import answer, perform

if TYPE_CHECKING:
    from pathlib import Path


def desk_of(control: str = "fanuc-m") -> Desk:
    return Desk(VirtualControl(control, setup={"start": {"X": -40}}))


def worked(desk: Desk) -> Desk:
    """A session with keys, soft keys, typing, a program over the wire, a fault and a refusal."""
    answer(desk, json.dumps({"do": "load", "with": {"source": "O7\nG1 X10. F1200\nM30\n"}}))
    answer(desk, json.dumps({"do": "snapshot"}))
    desk.press("START")
    desk.control.step(1.0)
    desk.turn("feed", "50")
    desk.control.step(0.5)
    desk.press("B3")
    desk.press("HOLD")
    desk.control.step(1.0)
    desk.do("screen_key", key="OFS/SET")
    desk.do("type", text="12.5")
    desk.do("screen_key", key="INPUT")
    desk.do("fault", name="air")
    desk.control.step(0.1)
    desk.press("START")
    desk.control.step(2.0)
    return desk


def test_what_was_done_is_done_again(tmp_path: Path) -> None:
    first = worked(desk_of())
    path = tmp_path / "session.jsonl"
    path.write_text(first.recording.text(), encoding="utf-8")
    assert "snapshot" not in path.read_text(encoding="utf-8")
    second = desk_of()
    replay = Replay(second.control, load_acts(path, "fanuc-m"), partial(perform, second))
    while second.control.time < first.control.time - 1e-9:
        replay.step(0.052, second.control.step)
    assert replay.is_over
    assert second.screen.page.id == "offset"
    assert "12.500" in second.screen.view("en").text
    second.control.step(first.control.time + 1.0 - second.control.time)
    first.control.step(1.0)
    assert second.control.snapshot == first.control.snapshot
    assert second.screen.view("en") == first.screen.view("en")
    assert second.control.positions.work["X"] > -40.0


@pytest.mark.parametrize(
    "text", ["", "5\n", "{}\n", '{"polycnc": 1, "control": "fanuc-m"}\n{"at": "x"}\n', "{"]
)
def test_what_is_no_recording_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "session.jsonl"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(RecordingError):
        load_acts(path, "fanuc-m")


def test_a_recording_of_another_control_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "session.jsonl"
    path.write_text(desk_of().recording.text(), encoding="utf-8")
    assert load_acts(path, "fanuc-m") == []
    with pytest.raises(RecordingError):
        load_acts(path, "meldas-m")
    with pytest.raises(RecordingError):
        load_acts(tmp_path / "nothing", "meldas-m")
