"""How many random examples a test draws, by the profile of Hypothesis that is chosen."""

from __future__ import annotations

from hypothesis import settings

#: As many as the library draws where nothing is said: what profiles are measured by.
_USUAL = 100


def examples(count: int) -> int:
    """As many examples as a test asks for; fewer or more of them in a profile that draws fewer or more in all."""
    return max(1, count * settings().max_examples // _USUAL)
