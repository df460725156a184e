"""What polycnc says of mistakes of its own."""

from __future__ import annotations

import re

import pytest

from polycnc.geometry.frames import rotation
from polycnc.messages.errors import place_of_failure


def test_a_failure_is_placed_at_the_innermost_line_as_seen_from_the_package() -> None:
    with pytest.raises(TypeError) as raised:
        rotation(2, "ninety")  # type: ignore[arg-type]
    assert re.fullmatch(r"geometry/frames\.py:\d+", place_of_failure(raised.value))


def test_a_mistake_that_was_never_raised_has_no_place() -> None:
    assert place_of_failure(ValueError()) == ""
