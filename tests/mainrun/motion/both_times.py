"""The time of a program, as it is planned and sampled, and as the main run takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.machine import parse_setup
from polycnc.mainrun import State
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded

if TYPE_CHECKING:
    from collections.abc import Mapping


def planned(text: str, control: str, machine: str, setup: Mapping[str, object] | None = None) -> float:
    """The planned time of a program, with which its samples end as well."""
    session = open_session(text.encode(), control=control, machine=machine, setup=setup or {}, keep=False)
    sampler = session.sample(0.01, lambda _: None)
    result = session.run()
    assert result.ok, result.alarms
    total_s = result.plan.total_s
    sampler.close()
    assert sampler.time == pytest.approx(total_s, abs=1e-6)
    return total_s


def executed(text: str, control: str, machine: str, setup: Mapping[str, object] | None = None) -> float:
    """Seconds of the main run."""
    virtual = power_on(text, control, machine=machine, setup=parse_setup(setup or {}))
    records, start = recorded(virtual), virtual.time
    virtual.cycle_start()
    assert virtual.run(limit_s=1000.0) is State.READY
    return next(record.time for record in reversed(records) if record.what == "state") - start
