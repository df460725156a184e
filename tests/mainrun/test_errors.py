"""What a virtual control answers when it refuses, in both languages."""

from __future__ import annotations

import pytest

from polycnc import VirtualControl
from polycnc.mainrun import Command, CommandRefused, Mode, State
from polycnc.mainrun.errors import OutOfPlace


@pytest.mark.parametrize("command", Command)
def test_a_command_out_of_place_is_told_by_names_that_an_operator_knows(command: Command) -> None:
    for mode, state in zip([*Mode, Mode.JOG], [*State, State.OFF, State.HOLD], strict=False):
        refusal = OutOfPlace(command, mode, state)
        assert "_" not in refusal.text("en")
        chinese = refusal.text("zh-TW")
        known = chinese.replace("MDI", "").replace("DNC", "")
        assert not any(letter.isascii() and letter.isalpha() for letter in known), chinese


def test_a_jog_while_the_mode_is_another() -> None:
    control = VirtualControl("fanuc-m")
    control.select_mode("auto")
    with pytest.raises(CommandRefused) as refused:
        control.jog("X", 1)
    assert refused.value.text("en") == "jog is not possible in mode auto while the control is in state ready"
    assert refused.value.text("zh-TW") == "在「自動」模式、「就緒」狀態下無法執行「寸動」"
