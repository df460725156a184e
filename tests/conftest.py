"""What holds for all tests.

Random examples are the same in every run of the same test, so that a run says something about the change and not
about luck. `pytest --hypothesis-profile=explore` looks for new ones; `brief` draws a fifth of them, for a run that
repeats tests in another way.
"""

from __future__ import annotations

import gc
import os
import signal

import pytest
from hypothesis import settings

from polycnc.cases.features import PROPERTY
from polycnc.kernels.native import CHOICE
from tests import both_ways

# A slow machine is no failure.
settings.register_profile("polycnc", deadline=None, derandomize=True)
settings.register_profile("explore", deadline=None, derandomize=False)
settings.register_profile("brief", deadline=None, derandomize=True, max_examples=20)
settings.load_profile("polycnc")

# What a user tells polycnc and a terminal says of itself is the same in every run, but for the choice of kernels.
for name in [name for name in os.environ if name.startswith("POLYCNC_") and name != CHOICE]:
    del os.environ[name]
os.environ.update(POLYCNC_LANG="en", COLUMNS="80", LINES="24")

# Where tests run in the background of a shell, Ctrl-C is ignored, and the processes that they start would inherit that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_addoption(pluginmanager: pytest.PytestPluginManager) -> None:
    pluginmanager.register(both_ways)


def pytest_collection_finish() -> None:
    """Thousands of tests stay until the end: no search for garbage need look at them."""
    gc.collect()
    gc.freeze()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A test marked with `feature` says in the report (`--junitxml`) which function of which control it proves."""
    for item in items:
        for mark in item.iter_markers("feature"):
            control = mark.kwargs.get("control") or getattr(item, "callspec", None)
            control = (
                control if isinstance(control, str) or control is None else control.params.get("control")
            )
            if not isinstance(control, str):
                raise pytest.UsageError(f"{item.nodeid}: of which control is the feature?")
            item.user_properties += [(PROPERTY, f"{control} {feature}") for feature in mark.args]
