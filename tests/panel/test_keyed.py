"""Numbers as they are keyed in."""

from __future__ import annotations

import pytest

from polycnc.mainrun import CommandRefused
from polycnc.panel.keyed import number_of, whole_number_of


@pytest.mark.parametrize(
    ("typed", "value"), [("12.5", 12.5), ("-.25", -0.25), ("+3", 3.0), ("7.", 7.0), (" 0.0 ", 0.0)]
)
def test_a_number_has_a_sign_and_one_point(typed: str, value: float) -> None:
    assert number_of(typed) == value


@pytest.mark.parametrize(
    "typed", ["", ".", "-", "--5", "1.2.3", "nan", "inf", "1e3", "1_0", "0x10", "٣", "²"]
)
def test_what_no_key_writes_is_no_number(typed: str) -> None:
    with pytest.raises(CommandRefused):
        number_of(typed)


def test_a_number_that_no_field_has_room_for_is_refused() -> None:
    with pytest.raises(CommandRefused, match="range"):
        number_of("9" * 13)


def test_a_whole_number_has_nothing_behind_its_point() -> None:
    assert whole_number_of("5.") == 5
    with pytest.raises(CommandRefused):
        whole_number_of("2.5")
