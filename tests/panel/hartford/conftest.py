"""Every test of the Hartford panels is made on both of its controls and in both languages."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import pytest

from polycnc.messages.catalogue import LANGUAGES
from tests.panel.bench import Bench

if TYPE_CHECKING:
    from collections.abc import Callable


@pytest.fixture(params=["fanuc-m", "meldas-m"])
def control(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(params=LANGUAGES)
def lang(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def bench(control: str, lang: str) -> Callable[..., Bench]:
    """Makes a bench of the control in the language."""
    return partial(Bench, control, lang, machine="hartford")
