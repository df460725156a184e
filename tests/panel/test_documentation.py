"""The example of the page about the panel runs, and gives what it says."""

from __future__ import annotations

from tests.pages import example


def test_the_example_prints_what_the_page_shows() -> None:
    printed, shown = example("panel.md")
    assert printed == shown
