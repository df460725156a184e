"""Feeds of positioning axes, in inches and degrees."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.feed.path_feed import PathFeed
from tests.support import run


def test_inches_do_not_change_feeds_in_degrees() -> None:
    channel = run("G700\nFA[X]=60 FA[A]=60\nM2\n", "sinumerik-840d", machine="mill4")
    feeds = PathFeed.of(channel).of_axes
    assert feeds[channel.axes.index("X")] == pytest.approx(25.4)
    assert feeds[channel.axes.index("A")] == pytest.approx(1.0)
