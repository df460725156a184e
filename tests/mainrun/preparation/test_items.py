"""The speeds of a channel: a section of delayed stops keeps the overrides with which it was entered."""

from __future__ import annotations

from polycnc.mainrun.preparation.items import ChannelRates, Rates
from polycnc.toolpath import Context


def test_a_section_keeps_its_overrides() -> None:
    operator = Rates(feed=0.5)
    rates = ChannelRates(operator)
    section = Context(stop_delay=True, feed_hold=False)
    assert not rates.enter(Context())
    assert not rates.enter(section)
    operator.feed = 1.0
    assert not rates.enter(section)
    assert rates.feed == 0.5
    assert rates.enter(Context())
    assert rates.feed == 1.0
    assert not rates.enter(Context())
