"""What holds for all tests.

Random examples are the same in every run of the same test, so that a run says something about the change and not
about luck. `pytest --hypothesis-profile=explore` looks for new ones.
"""

from __future__ import annotations

from hypothesis import settings

# A slow machine is no failure.
settings.register_profile("polycnc", deadline=None, derandomize=True)
settings.register_profile("explore", deadline=None, derandomize=False)
settings.load_profile("polycnc")
