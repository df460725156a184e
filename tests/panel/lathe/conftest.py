"""Every test of the lathe's screens is made in both languages."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import pytest

from polycnc.messages.catalogue import LANGUAGES
from tests.panel.bench import Bench

if TYPE_CHECKING:
    from collections.abc import Callable


@pytest.fixture(params=LANGUAGES)
def lang(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def bench(lang: str) -> Callable[..., Bench]:
    """Makes a bench of the lathe in the language; its machine has X, Z, Y, A and B."""
    return partial(Bench, "fanuc-0i-tf", lang, machine="lathe-yab")
